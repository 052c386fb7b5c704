"""Pictures of models, drawn by VTK without a window. Models are vtkPolyData as regionmesh writes them."""
import dataclasses
import struct
import zlib

import numpy
import vtk
from vtk.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy

CAPTION = 34  # pixels at the foot of a tile
FAR = 500     # of the camera: views are parallel
LIGHTS = (((-0.6, 0.75, 0.5), 0.85), ((0.9, 0.1, 0.45), 0.36), ((0, -0.9, 0.5), 0.2))  # beside the camera; strength


def read(path):
    reader = vtk.vtkXMLPolyDataReader()
    reader.SetFileName(str(path))
    reader.Update()
    return reader.GetOutput()


def points_of(model):
    return vtk_to_numpy(model.GetPoints().GetData())


def faces_of(model):
    return vtk_to_numpy(model.GetPolys().GetConnectivityArray()).reshape(-1, 3)


def labels_of(model):
    """Two labels a face; the normal points from the first to the second."""
    return vtk_to_numpy(model.GetCellData().GetArray("BoundaryLabels"))


def cells(simplices):
    array = vtk.vtkCellArray()
    array.SetData(simplices.shape[1], numpy_to_vtkIdTypeArray(simplices.ravel().astype(numpy.int64), deep=True))
    return array


def surface(points, faces):
    """Only the points that are used."""
    used, faces = numpy.unique(faces, return_inverse=True)
    data, array = vtk.vtkPolyData(), vtk.vtkPoints()
    array.SetData(numpy_to_vtk(points[used], deep=True))
    data.SetPoints(array)
    data.SetPolys(cells(faces.reshape(-1, 3)))
    return data


def boundary_of(model, regions):
    """The boundary of the union of some regions, turned outward, and the label beyond each of its faces."""
    faces, both = faces_of(model), labels_of(model)
    inside = numpy.isin(both, regions)
    first, second = inside[:, 0] & ~inside[:, 1], inside[:, 1] & ~inside[:, 0]
    outward = numpy.concatenate([faces[first], faces[second][:, ::-1]])
    return surface(points_of(model), outward), numpy.concatenate([both[first][:, 1], both[second][:, 0]])


def lines_of(boundary, beyond):
    """Edges of a boundary between faces with different labels beyond them."""
    faces = faces_of(boundary)
    edges = numpy.sort(numpy.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]]), axis=1)
    of_edge = numpy.tile(beyond, 3)
    order = numpy.lexsort((edges[:, 1], edges[:, 0]))
    edges, of_edge = edges[order], of_edge[order]
    twins = (edges[1:] == edges[:-1]).all(axis=1) & (of_edge[1:] != of_edge[:-1])
    lines = vtk.vtkPolyData()
    lines.SetPoints(boundary.GetPoints())
    lines.SetLines(cells(edges[1:][twins]))
    return lines


def face_actor(data, colour, opacity=1, edges=False):
    mapper = vtk.vtkPolyDataMapper()
    mapper.SetInputData(data)
    mapper.ScalarVisibilityOff()
    actor = vtk.vtkActor()
    actor.SetMapper(mapper)
    style = actor.GetProperty()
    style.SetColor(*colour)
    style.SetOpacity(opacity)
    style.SetInterpolationToFlat()
    style.SetAmbient(0.16)
    style.SetDiffuse(0.9)
    style.SetSpecular(0)
    style.SetEdgeVisibility(edges)
    style.SetEdgeColor(0.25, 0.27, 0.3)
    return actor


def coloured_actor(data, rgb, edges=False):
    """Colours from 0 to 1, one a face."""
    array = numpy_to_vtk((255 * rgb).astype(numpy.uint8), deep=True)
    array.SetName("colour")
    data.GetCellData().SetScalars(array)
    actor = face_actor(data, (1, 1, 1), edges=edges)
    actor.GetMapper().ScalarVisibilityOn()
    actor.GetMapper().SetScalarModeToUseCellData()
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


@dataclasses.dataclass
class View:
    focus: tuple   # what is in the middle
    eye: tuple     # direction to the camera
    height: float  # that fills a tile
    up: tuple = (0, 0, 1)


def aim(renderer, view):
    camera = renderer.GetActiveCamera()
    camera.ParallelProjectionOn()
    camera.SetFocalPoint(*view.focus)
    camera.SetPosition(*(f + FAR * e for f, e in zip(view.focus, view.eye)))
    camera.SetViewUp(*view.up)
    camera.SetParallelScale(view.height / 2)
    renderer.ResetCameraClippingRange()


def middle_of(boundaries):
    box = vtk.vtkBoundingBox()
    for boundary in boundaries:
        box.AddBounds(boundary.GetBounds())
    middle = [0.0] * 3
    box.GetCenter(middle)
    return middle


def light(direction, strength):
    """Moves with the camera."""
    lamp = vtk.vtkLight()
    lamp.SetLightTypeToCameraLight()
    lamp.SetPosition(*direction)
    lamp.SetFocalPoint(0, 0, 0)
    lamp.SetIntensity(strength)
    return lamp


def tile(actors, view):
    renderer = vtk.vtkRenderer()
    renderer.SetBackground(1, 1, 1)
    renderer.SetAutomaticLightCreation(False)
    renderer.SetUseDepthPeeling(any(actor.GetProperty().GetOpacity() < 1 for actor in actors))
    renderer.SetMaximumNumberOfPeels(12)
    for direction, strength in LIGHTS:
        renderer.AddLight(light(direction, strength))
    for actor in actors:
        renderer.AddActor(actor)
    aim(renderer, view)
    return renderer


def caption(text, width):
    actor = vtk.vtkTextActor()
    actor.SetInput(text)
    style = actor.GetTextProperty()
    style.SetFontFamilyToArial()
    style.SetFontSize(19)
    style.SetColor(0.15, 0.15, 0.18)
    style.SetJustificationToCentered()
    actor.SetPosition(width / 2, 9)
    return actor


def window_of(width, height, samples=8):
    window = vtk.vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(samples)
    window.SetAlphaBitPlanes(1)
    window.SetSize(width, height)
    return window


def contact_sheet(tiles, path, columns=3, size=(480, 340)):
    """Draws (text, renderer) pairs, row by row."""
    rows = -(-len(tiles) // columns)
    width, height = columns * size[0], rows * (size[1] + CAPTION)
    is_clear = any(renderer.GetUseDepthPeeling() for _, renderer in tiles)
    window = window_of(width, height, 0 if is_clear else 8)  # VTK peels no layers where it smooths edges
    for n, (text, picture) in enumerate(tiles):
        left, foot = n % columns * size[0], (rows - 1 - n // columns) * (size[1] + CAPTION)
        place = vtk.vtkRenderer()  # the caption has a ground of its own, so that nothing is drawn over it
        place.SetBackground(1, 1, 1)
        place.AddActor2D(caption(text, size[0]))
        for renderer, low, high in ((place, foot, foot + CAPTION), (picture, foot + CAPTION, foot + CAPTION + size[1])):
            renderer.SetViewport(left / width, low / height, (left + size[0]) / width, high / height)
            window.AddRenderer(renderer)
    window.Render()
    write_png(window, path)


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
