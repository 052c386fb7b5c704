#!/usr/bin/python3
"""Draws a model with a piece cut away, and a close-up of the cut: render.py MODEL.vtp OUT.png

The cut shows the regions as solids; label 0 is left empty. Each side of a face has the colour of the region behind it;
triple lines are drawn black. Without a screen: xvfb-run -a docs/pictures/render.py ...
Needs python3-vtk9 (script/bootstrap picture).
"""
import colorsys
import struct
import sys
import zlib

import numpy
import vtk
from vtk.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy

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


def read(path):
    reader = vtk.vtkXMLPolyDataReader()
    reader.SetFileName(path)
    reader.Update()
    return reader.GetOutput()


def coloured(model, column, colours):
    """A copy whose faces have the colour of their first (0) or second (1) label."""
    labels = vtk_to_numpy(model.GetCellData().GetArray("BoundaryLabels"))[:, column]
    rgb = numpy.array([colours[label] for label in labels.tolist()], dtype=numpy.uint8)
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


def line_actor(lines, width):
    mapper = vtk.vtkPolyDataMapper()
    mapper.SetInputData(lines)
    mapper.ScalarVisibilityOff()
    mapper.SetResolveCoincidentTopologyToPolygonOffset()
    actor = vtk.vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().SetColor(0.1, 0.1, 0.12)
    actor.GetProperty().SetLineWidth(width)
    actor.GetProperty().LightingOff()
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


def boundary_of(model, label):
    """The closed surface of one region."""
    both = vtk_to_numpy(model.GetCellData().GetArray("BoundaryLabels"))
    faces = vtk_to_numpy(model.GetPolys().GetConnectivityArray()).reshape(-1, 3)[(both == label).any(axis=1)]
    cells = vtk.vtkCellArray()
    cells.SetData(3, numpy_to_vtkIdTypeArray(faces.ravel().astype(numpy.int64), deep=True))
    surface = vtk.vtkPolyData()
    surface.SetPoints(model.GetPoints())
    surface.SetPolys(cells)
    return surface


def caps(model, corner, colours):
    """Where the three planes of the cut pass through regions, as flat pieces in the regions' colours."""
    pieces = vtk.vtkAppendPolyData()
    for label, colour in colours.items():
        if label in (0, -1):
            continue
        surface = boundary_of(model, label)
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
    camera = renderer.GetActiveCamera()
    camera.ParallelProjectionOn()
    camera.SetFocalPoint(*focus)
    camera.SetPosition(*(f + 500 * e for f, e in zip(focus, eye)))
    camera.SetViewUp(0, 0, 1)
    camera.SetParallelScale(height / 2)
    renderer.ResetCameraClippingRange()
    return renderer


def write_png(window, path):
    """With 256 colours: a third of the bytes."""
    grab = vtk.vtkWindowToImageFilter()
    grab.SetInput(window)
    grab.ReadFrontBufferOff()
    palette = vtk.vtkImageQuantizeRGBToIndex()
    palette.SetInputConnection(grab.GetOutputPort())
    palette.SetNumberOfColors(256)
    palette.Update()
    width, height, _ = palette.GetOutput().GetDimensions()
    pixels = vtk_to_numpy(palette.GetOutput().GetPointData().GetScalars()).astype(numpy.uint8).reshape(height, width)[::-1]
    table = palette.GetLookupTable()
    colours = b"".join(bytes(round(255 * c) for c in table.GetTableValue(n)[:3]) for n in range(table.GetNumberOfTableValues()))
    rows = b"".join(b"\0" + row.tobytes() for row in pixels)
    with open(path, "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n")
        for kind, data in ((b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 3, 0, 0, 0)), (b"PLTE", colours),
                           (b"IDAT", zlib.compress(rows, 9)), (b"IEND", b"")):
            file.write(struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data)))


def main():
    model = read(sys.argv[1])
    colours = region_colours(vtk_to_numpy(model.GetCellData().GetArray("BoundaryLabels")))
    bounds = model.GetBounds()
    # Beside the lattice, whose planes hold many faces.
    corner = [(bounds[2 * axis] + bounds[2 * axis + 1]) / 2 + 0.237 for axis in range(3)]
    wedge = vtk.vtkBox()  # an eighth is taken away: right, front, top
    wedge.SetBounds(*(bound for c in corner for bound in (c, FAR)))
    parts = [clipped(coloured(model, column, colours), wedge) for column in (0, 1)] + [caps(model, corner, colours)]

    window = vtk.vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(8)
    window.SetSize(WIDTH, HEIGHT)
    eye = (0.62, 0.6, 0.5)
    window.AddRenderer(scene(parts, (0, 0, 0.6, 1), False, corner, eye, 1.2 * (bounds[5] - bounds[4])))
    window.AddRenderer(scene(parts, (0.6, 0, 1, 1), True, [c + d for c, d in zip(corner, CLOSE_UP)], eye, 40))
    window.Render()
    write_png(window, sys.argv[2])


if __name__ == "__main__":
    main()
