"""Models with a piece cut away. The cut shows the regions as solids; label 0 is left empty. Each side of a face has the
colour of the region behind it."""
import numpy
import vtk
from vtk.util.numpy_support import numpy_to_vtk

from draw import cells, faces_of, labels_of

FAR = 1e4


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
