"""Smoothly shaded pictures of models: normals of one side of a model, colours that tell neighbours apart, large samples.

Pictures are drawn at twice their size and averaged, so that edges, lines and shades are free of stairs.
"""
import pathlib
import sys

import numpy
import vtk
from vtk.util.numpy_support import numpy_to_vtk, vtk_to_numpy

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent / "paper"))
import draw  # noqa: E402: the pictures of the other pages

SCALE = 2  # samples a pixel, along each axis
PALETTE = [(0.894, 0.408, 0.353), (0.965, 0.647, 0.361), (0.976, 0.812, 0.431), (0.733, 0.804, 0.404), (0.471, 0.741, 0.475),
           (0.302, 0.678, 0.627), (0.380, 0.722, 0.843), (0.357, 0.553, 0.839), (0.510, 0.471, 0.796), (0.702, 0.494, 0.788),
           (0.886, 0.533, 0.706), (0.749, 0.561, 0.439), (0.937, 0.745, 0.702), (0.612, 0.702, 0.757)]
LAMPS = (((-0.55, 0.7, 0.6), 0.78), ((0.9, 0.15, 0.5), 0.34), ((0.1, -0.9, 0.4), 0.16), ((0, 0, 1), 0.14))


def pairs_of(model):
    """Pairs of labels in contact, with the area of each interface."""
    points, faces = draw.points_of(model).astype(float), draw.faces_of(model)
    a, b, c = (points[faces[:, k]] for k in range(3))
    area = numpy.linalg.norm(numpy.cross(b - a, c - a), axis=1) / 2
    both, which = numpy.unique(draw.labels_of(model), axis=0, return_inverse=True)
    return both, numpy.bincount(which.ravel(), area)


def colours_of(model, empty=(0, -1), palette=PALETTE):
    """Colours by label: those of neighbours differ, and each colour is used about as often; grey outside all regions."""
    both, area = pairs_of(model)
    near = {}
    for (a, b), size in zip(both.tolist(), area):
        near.setdefault(a, {})[b] = near.setdefault(b, {})[a] = size
    colours, used = {label: (0.8, 0.8, 0.8) for label in empty}, [0] * len(palette)
    rgb = numpy.array(palette)
    for label in sorted((l for l in near if l not in empty), key=lambda l: (-len(near[l]), l)):
        def worth(n):
            apart = [numpy.linalg.norm(rgb[n] - colours[other]) for other in near[label] if other in colours and other not in empty]
            return min([*apart, 0.35]) - 0.012 * used[n]
        best = max(range(len(palette)), key=worth)
        colours[label], used[best] = palette[best], used[best] + 1
    return colours


def side_of(model, seen_from, hidden=()):
    """The faces of some regions as seen from there: turned towards them, with the labels behind. Points inside the cut have
    one normal for each side, the mean by area of the faces round them."""
    faces, both = draw.faces_of(model), draw.labels_of(model)
    inside = numpy.isin(both, seen_from)
    first, second = inside[:, 0] & ~inside[:, 1], inside[:, 1] & ~inside[:, 0]
    turned = numpy.concatenate([faces[first][:, ::-1], faces[second]])
    behind = numpy.concatenate([both[first][:, 1], both[second][:, 0]])
    kept = ~numpy.isin(behind, hidden)
    return with_normals(draw.points_of(model), turned[kept]), behind[kept]


def with_normals(points, faces):
    data = draw.surface(points, faces)
    points, faces = draw.points_of(data).astype(float), draw.faces_of(data)
    a, b, c = (points[faces[:, k]] for k in range(3))
    normals = numpy.cross(b - a, c - a)
    sums = numpy.stack([sum(numpy.bincount(faces[:, k], normals[:, axis], len(points)) for k in range(3)) for axis in range(3)], axis=1)
    sums /= numpy.maximum(numpy.linalg.norm(sums, axis=1, keepdims=True), 1e-30)
    array = numpy_to_vtk(sums.astype(numpy.float32), deep=True)
    array.SetName("Normals")
    data.GetPointData().SetNormals(array)
    return data


def painted(data, rgb):
    """Colours from 0 to 1, one a face."""
    array = numpy_to_vtk(numpy.round(255 * numpy.asarray(rgb)).astype(numpy.uint8), deep=True)
    array.SetName("colour")
    data.GetCellData().SetScalars(array)
    return data


def actor_of(data, is_flat=False, with_edges=False, opacity=1.0):
    mapper = vtk.vtkPolyDataMapper()
    mapper.SetInputData(data)
    mapper.SetScalarModeToUseCellData()
    actor = vtk.vtkActor()
    actor.SetMapper(mapper)
    style = actor.GetProperty()
    style.SetInterpolation(vtk.VTK_FLAT if is_flat else vtk.VTK_PHONG)
    style.SetAmbient(0.3)
    style.SetDiffuse(0.82)
    style.SetSpecular(0 if is_flat else 0.1)
    style.SetSpecularPower(24)
    style.SetOpacity(opacity)
    style.SetEdgeVisibility(with_edges)
    style.SetEdgeColor(0.22, 0.24, 0.28)
    style.SetLineWidth(SCALE * 0.5)
    return actor


def unlit(actor):
    actor.GetProperty().SetAmbient(1)
    actor.GetProperty().SetDiffuse(0)
    actor.GetProperty().SetSpecular(0)
    return actor


def lines_actor(lines, width, lift=(0, 0, 0), colour=(0.16, 0.16, 0.2)):
    """Moved by `lift`, towards the camera, so that the faces beside a line do not hide it."""
    actor = draw.line_actor(lines, width * SCALE)
    actor.GetProperty().SetColor(*colour)
    actor.SetPosition(*lift)
    return actor


def scene(actors, view, lamps=LAMPS):
    renderer = vtk.vtkRenderer()
    renderer.SetBackground(1, 1, 1)
    renderer.SetAutomaticLightCreation(False)
    for direction, strength in lamps:
        renderer.AddLight(draw.light(direction, strength))
    for actor in actors:
        renderer.AddActor(actor)
    draw.aim(renderer, view)
    return renderer


def image_of(renderer, size):
    """Pixels of one scene, rows from the top."""
    window = draw.window_of(SCALE * size[0], SCALE * size[1], 4)
    window.AddRenderer(renderer)
    window.Render()
    grab = vtk.vtkWindowToImageFilter()
    grab.SetInput(window)
    grab.ReadFrontBufferOff()
    grab.Update()
    image = grab.GetOutput()
    width, height, _ = image.GetDimensions()
    pixels = vtk_to_numpy(image.GetPointData().GetScalars()).reshape(height, width, -1)[::-1, :, :3].astype(float)
    window.Finalize()
    return pixels.reshape(size[1], SCALE, size[0], SCALE, 3).mean(axis=(1, 3)).astype(numpy.uint8)


def words(text, size, points=19, is_bold=False):
    """Pixels of a line of text, in the middle of white."""
    actor = draw.caption(text, SCALE * size[0])
    actor.GetTextProperty().SetFontSize(SCALE * points)
    actor.GetTextProperty().SetBold(is_bold)
    actor.GetTextProperty().SetVerticalJustificationToCentered()
    actor.SetPosition(SCALE * size[0] / 2, SCALE * size[1] / 2)
    renderer = vtk.vtkRenderer()
    renderer.SetBackground(1, 1, 1)
    renderer.AddActor2D(actor)
    return image_of(renderer, size)


def write_png(pixels, path):
    """With 64 shades of each colour, which are a third fewer bytes than 256."""
    pixels = numpy.where(pixels == 255, pixels, pixels & 0xFC).astype(numpy.uint8)
    image = vtk.vtkImageData()
    image.SetDimensions(pixels.shape[1], pixels.shape[0], 1)
    image.GetPointData().SetScalars(numpy_to_vtk(numpy.ascontiguousarray(pixels[::-1]).reshape(-1, 3), deep=True))
    writer = vtk.vtkPNGWriter()
    writer.SetFileName(str(path))
    writer.SetCompressionLevel(9)
    writer.SetInputData(image)
    writer.Write()
