#!/usr/bin/python3
"""Draws a model with a piece cut away, and a close-up of the cut: cutaway.py MODEL.vtp OUT.png

The cut shows the regions as solids; label 0 is left empty. Each side of a face has the colour of the region behind it;
triple lines are drawn black. It makes the picture of the README. Without a screen: xvfb-run -a bench/paper/cutaway.py ...
"""
import colorsys
import sys

import numpy
import vtk
from vtk.util.numpy_support import numpy_to_vtk

from draw import View, aim, cells, faces_of, labels_of, line_actor, read, window_of, write_png

WIDTH, HEIGHT = 1400, 740
FAR = 1e4
CLOSE_UP = (3, 21, 5)  # from the corner of the cut to the middle of the close-up


def region_colours(labels):
    """A light colour of its own for each label; grey for what lies outside all regions."""
    colours = {}
    for rank, label in enumerate(sorted(set(labels.ravel().tolist()))):
        hue = rank * 0.618034 % 1
        rgb = colorsys.hsv_to_rgb(hue, 0.42 + 0.2 * (rank % 3) / 2, 0.95 - 0.12 * (rank % 2))
        colours[label] = [round(255 * c) for c in rgb]
    colours[0] = colours[-1] = [205, 205, 205]
    return colours


def coloured(model, column, colours):
    """A copy whose faces have the colour of their first (0) or second (1) label."""
    rgb = numpy.array([colours[label] for label in labels_of(model)[:, column].tolist()], dtype=numpy.uint8)
    copy = vtk.vtkPolyData()
    copy.ShallowCopy(model)
    array = numpy_to_vtk(rgb, deep=True)
    array.SetName("colour")
    copy.GetCellData().SetScalars(array)
    return copy


def plane_at(corner, axis):
    plane = vtk.vtkPlane()
    plane.SetOrigin(corner)
    plane.SetNormal(*(float(a == axis) for a in range(3)))
    return plane


def clipped(model, function):
    """What lies where the function is positive."""
    clip = vtk.vtkClipPolyData()
    clip.SetInputData(model)
    clip.SetClipFunction(function)
    clip.Update()
    return clip.GetOutput()


def surface_actor(model, hidden, with_edges):
    mapper = vtk.vtkPolyDataMapper()
    mapper.SetInputData(model)
    mapper.SetScalarModeToUseCellData()
    actor = vtk.vtkActor()
    actor.SetMapper(mapper)
    style = actor.GetProperty()
    style.SetInterpolationToFlat()
    style.SetAmbient(0.3)
    style.SetDiffuse(0.75)
    style.SetBackfaceCulling(hidden == "back")
    style.SetFrontfaceCulling(hidden == "front")
    style.SetEdgeVisibility(with_edges)
    style.SetEdgeColor(0.33, 0.33, 0.36)
    return actor


def edges_of(model, with_one_face, with_many):
    edges = vtk.vtkFeatureEdges()
    edges.SetInputData(model)
    edges.SetBoundaryEdges(with_one_face)
    edges.SetNonManifoldEdges(with_many)
    edges.FeatureEdgesOff()
    edges.ManifoldEdgesOff()
    edges.ColoringOff()
    edges.Update()
    return edges.GetOutput()


def faces_round(model, label):
    """The closed surface of one region, turned either way."""
    surface = vtk.vtkPolyData()
    surface.SetPoints(model.GetPoints())
    surface.SetPolys(cells(faces_of(model)[(labels_of(model) == label).any(axis=1)]))
    return surface


def caps(model, corner, colours):
    """Where the three planes of the cut pass through regions, as flat pieces in the regions' colours."""
    pieces = vtk.vtkAppendPolyData()
    for label, colour in colours.items():
        if label in (0, -1):
            continue
        surface = faces_round(model, label)
        for axis in range(3):
            cut = vtk.vtkCutter()
            cut.SetInputData(surface)
            cut.SetCutFunction(plane_at(corner, axis))
            fill = vtk.vtkContourTriangulator()
            fill.SetInputConnection(cut.GetOutputPort())
            fill.Update()
            piece = fill.GetOutput()
            for other in {0, 1, 2} - {axis}:
                piece = clipped(piece, plane_at(corner, other))
            rgb = numpy.tile(numpy.array(colour, dtype=numpy.uint8), (piece.GetNumberOfCells(), 1))
            array = numpy_to_vtk(rgb.reshape(-1, 3), deep=True)
            array.SetName("colour")
            piece.GetCellData().SetScalars(array)
            if piece.GetNumberOfCells():
                pieces.AddInputData(piece)
    pieces.Update()
    return pieces.GetOutput()


def scene(parts, viewport, with_edges, focus, eye, height):
    front, back, cut = parts
    renderer = vtk.vtkRenderer()
    renderer.SetViewport(*viewport)
    renderer.SetBackground(1, 1, 1)
    renderer.AddActor(surface_actor(front, "back", with_edges))
    renderer.AddActor(surface_actor(back, "front", with_edges))
    renderer.AddActor(surface_actor(cut, "none", False))
    renderer.AddActor(line_actor(edges_of(front, True, False), 1.5))
    renderer.AddActor(line_actor(edges_of(front, False, True), 3 if with_edges else 1.2))
    aim(renderer, View(focus, eye, height))
    return renderer


def main():
    model = read(sys.argv[1])
    colours = region_colours(labels_of(model))
    bounds = model.GetBounds()
    # Beside the lattice, whose planes hold many faces.
    corner = [(bounds[2 * axis] + bounds[2 * axis + 1]) / 2 + 0.237 for axis in range(3)]
    wedge = vtk.vtkBox()  # an eighth is taken away: right, front, top
    wedge.SetBounds(*(bound for c in corner for bound in (c, FAR)))
    parts = [clipped(coloured(model, column, colours), wedge) for column in (0, 1)] + [caps(model, corner, colours)]

    window = window_of(WIDTH, HEIGHT)
    eye = (0.62, 0.6, 0.5)
    window.AddRenderer(scene(parts, (0, 0, 0.6, 1), False, corner, eye, 1.2 * (bounds[5] - bounds[4])))
    window.AddRenderer(scene(parts, (0.6, 0, 1, 1), True, [c + d for c, d in zip(corner, CLOSE_UP)], eye, 40))
    window.Render()
    write_png(window, sys.argv[2])


if __name__ == "__main__":
    main()
