"""Pictures of models of drill holes: cut open, turned, heights exaggerated, with a legend of names and colours."""
import dataclasses
import math
import pathlib
import sys

import numpy
import vtk
from vtk.util.numpy_support import numpy_to_vtk

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent / "paper"))
import cutaway  # noqa: E402: the pictures of the other pages
import draw  # noqa: E402

FAR = 1e7
EYE = (0.62, 0.6, 0.42)
LEGEND, SQUARE, ROW = 190, 16, 27  # pixels


@dataclasses.dataclass
class Scene:
    """How a model is shown. Lengths are the model's."""
    colours: dict              # by label, each (red, green, blue) from 0 to 1
    exaggeration: float = 1    # of heights
    turn: float = 0            # degrees, counterclockwise, before an eighth is cut away on the side of the camera
    cut: tuple = (0.5, 0.5)    # where, as shares of the turned model's box
    floor: float = -math.inf   # height below which nothing is shown
    with_edges: bool = False
    with_cut: bool = True

    def placed(self, points, middle):
        a = math.radians(self.turn)
        turned = (points - middle) @ numpy.array([[math.cos(a), math.sin(a), 0], [-math.sin(a), math.cos(a), 0], [0, 0, 1]])
        return turned * [1, 1, self.exaggeration]


def names_of(model):
    """The names of a model's labels."""
    labels, names = (model.GetFieldData().GetAbstractArray(name) for name in ("RegionLabels", "RegionNames"))
    return {int(labels.GetValue(n)): names.GetValue(n) for n in range(labels.GetNumberOfValues())} if names else {}


def points_at(points):
    array = vtk.vtkPoints()
    array.SetData(numpy_to_vtk(numpy.ascontiguousarray(points), deep=True))
    return array


def hole_lines(holes, middle, scene):
    """A line for each (x, y, top, bottom)."""
    holes = numpy.array(holes)
    holes[:, 3] = numpy.maximum(holes[:, 3], scene.floor)
    ends = numpy.concatenate([holes[:, [0, 1, 2]], holes[:, [0, 1, 3]]])
    lines, count = vtk.vtkPolyData(), len(holes)
    lines.SetPoints(points_at(scene.placed(ends, middle)))
    lines.SetLines(draw.cells(numpy.stack([numpy.arange(count), numpy.arange(count) + count], axis=1)))
    return lines


def middle_of(model):
    bounds = model.GetBounds()
    return numpy.array([(bounds[0] + bounds[1]) / 2, (bounds[2] + bounds[3]) / 2, bounds[5]])


def flat(actor):
    """In the very colours of the legend."""
    actor.GetProperty().SetAmbient(1)
    actor.GetProperty().SetDiffuse(0)
    return actor


def beyond(data, corner, axis, side):
    """What lies above a corner along an axis, or with side -1 what lies below."""
    plane = vtk.vtkPlane()
    plane.SetOrigin(corner)
    plane.SetNormal(*(side * float(a == axis) for a in range(3)))
    return cutaway.clipped(data, plane)


def opened(data, corner):
    """Without what lies beyond the corner along both x and y, and what lies below it. Faces are as large as the cut: plane
    by plane it must be, and each plane through all that is kept, so that the parts fit."""
    data, parts, whole = beyond(data, corner, 2, 1), vtk.vtkAppendPolyData(), vtk.vtkCleanPolyData()
    low, high = (beyond(data, corner, 1, side) for side in (-1, 1))
    for part in (beyond(low, corner, 0, -1), beyond(low, corner, 0, 1), beyond(high, corner, 0, -1)):
        parts.AddInputData(part)
    whole.SetInputConnection(parts.GetOutputPort())
    whole.SetTolerance(1e-7)
    whole.Update()
    return whole.GetOutput()


def actors_of(path, scene, holes=()):
    """What is shown of a model, and the box that holds it."""
    model = draw.read(path)
    middle = middle_of(model)
    placed = vtk.vtkPolyData()
    placed.ShallowCopy(model)
    placed.SetPoints(points_at(scene.placed(draw.points_of(model), middle)))
    bounds = placed.GetBounds()
    floor = max((scene.floor - middle[2]) * scene.exaggeration, bounds[4] - 1)
    corner = [bounds[2 * axis] + scene.cut[axis] * (bounds[2 * axis + 1] - bounds[2 * axis]) for axis in (0, 1)] + [floor]
    if not scene.with_cut:
        corner[:2] = bounds[1] + 1, bounds[3] + 1
    colours = {label: [round(255 * c) for c in rgb] for label, rgb in scene.colours.items()} | {-1: [205] * 3}
    front, back = (opened(cutaway.coloured(placed, column, colours), corner) for column in (0, 1))
    actors = [cutaway.surface_actor(front, "back", scene.with_edges), cutaway.surface_actor(back, "front", scene.with_edges)]
    if scene.with_cut:
        cut = cutaway.caps(placed, corner[:2] + [floor + FAR * 1e-9], colours)  # its floor above the plane that ends all
        actors.append(flat(cutaway.surface_actor(cut, "none", False)))
    if not scene.with_edges:
        actors.append(draw.line_actor(cutaway.edges_of(front, True, False), 1))
        actors.append(draw.line_actor(cutaway.edges_of(front, False, True), 1))
    if len(holes):
        actors.append(draw.line_actor(hole_lines(holes, middle, scene), 1.6))
    return actors, bounds[:4] + (floor, bounds[5])


def boundary_actors(path, scene, faced):
    """The boundary of the union of regions towards others that are `faced`, in their colours, with edges."""
    model = draw.read(path)
    placed = vtk.vtkPolyData()
    placed.ShallowCopy(model)
    placed.SetPoints(points_at(scene.placed(draw.points_of(model), middle_of(model))))
    surface, other = draw.boundary_of(placed, [label for label, name in names_of(model).items() if name not in faced])
    kept = numpy.isin(other, [label for label, name in names_of(model).items() if name in faced])
    lid = draw.surface(draw.points_of(surface), draw.faces_of(surface)[kept])
    colours = numpy.array([scene.colours[label] for label in other[kept].tolist()])
    return [draw.coloured_actor(lid, colours, edges=True)], lid.GetBounds()


def legend(entries, renderer, height):
    """Squares and words, from the top down."""
    for n, (rgb, text) in enumerate(entries):
        foot = height - 40 - ROW * n
        square = vtk.vtkPlaneSource()
        square.SetOrigin(10, foot, 0)
        square.SetPoint1(10 + SQUARE, foot, 0)
        square.SetPoint2(10, foot + SQUARE, 0)
        mapper, box, word = vtk.vtkPolyDataMapper2D(), vtk.vtkActor2D(), vtk.vtkTextActor()
        mapper.SetInputConnection(square.GetOutputPort())
        box.SetMapper(mapper)
        box.GetProperty().SetColor(*rgb)
        word.SetInput(text)
        word.GetTextProperty().SetFontFamilyToArial()
        word.GetTextProperty().SetFontSize(17)
        word.GetTextProperty().SetColor(0.12, 0.12, 0.15)
        word.SetPosition(10 + SQUARE + 9, foot)
        renderer.AddActor2D(box)
        renderer.AddActor2D(word)


def view_of(box, zoom):
    middle = [(box[2 * axis] + box[2 * axis + 1]) / 2 for axis in range(3)]
    return draw.View(middle, EYE, math.dist(box[::2], box[1::2]) / zoom)


def sheet(path, panels, entries, size, zooms):
    """Draws (text, (actors, box)) side by side, and the legend at the right."""
    width, height = size[0] * len(panels), size[1]
    window = draw.window_of(width + LEGEND, height)
    for n, (text, (actors, box)) in enumerate(panels):
        draw.FAR = 2 * math.dist(box[::2], box[1::2])
        renderer = draw.tile(actors, view_of(box, zooms[n]))
        renderer.SetViewport(n * size[0] / (width + LEGEND), 0, (n + 1) * size[0] / (width + LEGEND), 1)
        words = draw.caption(text, size[0])
        words.GetTextProperty().SetBackgroundColor(1, 1, 1)
        words.GetTextProperty().SetBackgroundOpacity(1)
        renderer.AddActor2D(words)
        window.AddRenderer(renderer)
    side = vtk.vtkRenderer()
    side.SetBackground(1, 1, 1)
    side.SetViewport(width / (width + LEGEND), 0, 1, 1)
    legend(entries, side, height)
    window.AddRenderer(side)
    window.Render()
    draw.write_png(window, path)
