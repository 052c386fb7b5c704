"""The picture of the README: a model with an eighth cut away, and a close-up of its faces. Label 0 is left empty."""
import numpy
import shade
import vtk

import cutaway  # found by shade
import draw

SIZE, CLOSE_UP = (880, 760), (500, 760)  # pixels
GAP = 20
EYE = (0.62, 0.6, 0.5)
LIFT = [0.25 * e for e in EYE]
FOCUS = (3, 21, 5)  # of the close-up, from the corner of the cut


def wedge_at(corner):
    """An eighth: right, front, top."""
    wedge = vtk.vtkBox()
    wedge.SetBounds(*(bound for c in corner for bound in (c, cutaway.FAR)))
    return wedge


def section_lines(model, corner):
    """Where the planes of the cut pass through interfaces."""
    pieces = vtk.vtkAppendPolyData()
    for axis in range(3):
        cut = vtk.vtkCutter()
        cut.SetInputData(model)
        cut.SetCutFunction(cutaway.plane_at(corner, axis))
        cut.Update()
        piece = cut.GetOutput()
        for other in {0, 1, 2} - {axis}:
            piece = cutaway.clipped(piece, cutaway.plane_at(corner, other))
        pieces.AddInputData(piece)
    pieces.Update()
    return pieces.GetOutput()


def actors_of(model, corner, colours):
    """Two lists: shaded smoothly, and flat with the edges of faces."""
    skin, behind = shade.side_of(model, [0, -1])
    lines = cutaway.clipped(draw.lines_of(skin, behind), wedge_at(corner))
    skin = cutaway.clipped(shade.painted(skin, [colours[label] for label in behind.tolist()]), wedge_at(corner))
    caps = cutaway.caps(model, corner, {label: [round(255 * c) for c in rgb] for label, rgb in colours.items()})
    sections = section_lines(model, corner)
    return [[shade.actor_of(skin, with_edges, with_edges), shade.unlit(shade.actor_of(caps, True)),
             shade.lines_actor(lines, width, LIFT), shade.lines_actor(sections, width)]
            for with_edges, width in ((False, 1), (True, 1.6))]


def make(path, out):
    model = draw.read(path)
    bounds = model.GetBounds()
    middle = [(bounds[2 * axis] + bounds[2 * axis + 1]) / 2 for axis in range(3)]
    corner = [m + 0.237 for m in middle]  # beside the lattice, whose planes hold many faces
    whole, close = actors_of(model, corner, shade.colours_of(model))
    left = shade.scene(whole, draw.View([*middle[:2], middle[2] - 1], EYE, 1.15 * (bounds[5] - bounds[4])))
    right = shade.scene(close, draw.View([c + d for c, d in zip(corner, FOCUS)], EYE, 44))
    gap = numpy.full((SIZE[1], GAP, 3), 255, dtype=numpy.uint8)
    shade.write_png(numpy.concatenate([shade.image_of(left, SIZE), gap, shade.image_of(right, CLOSE_UP)], axis=1), out)


if __name__ == "__main__":
    import sys
    make(sys.argv[1], sys.argv[2])
