"""Tables of drill holes, as far as pictures and measures need them."""
import collections
import csv
import dataclasses
import pathlib
import sys

import numpy
import vtk

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent / "paper"))
import draw  # noqa: E402

NUDGE = 1e-3  # towards the middle of all holes: those outermost are edges of the hull


@dataclasses.dataclass
class Columns:
    hole: str
    top: str
    bottom: str
    label: str
    surface: str

    def words(self):
        return [f"{role}={getattr(self, role)}" for role in ("hole", "top", "bottom", "label", "surface")]


def read(path, columns):
    """Rows (x, y, elevation of the top, of the bottom), and the word of each."""
    rows, words = [], []
    with open(path, newline="") as file:
        for row in csv.DictReader(file):
            x, y, surface, top, bottom = (float(row[name]) for name in ("x", "y", columns.surface, columns.top, columns.bottom))
            if bottom > top:
                rows.append((x, y, surface - top, surface - bottom))
                words.append(row[columns.label])
    return numpy.array(rows), numpy.array(words)


def shafts(rows):
    """One (x, y, top, bottom) for each place."""
    ends = collections.defaultdict(list)
    for x, y, top, bottom in rows.tolist():
        ends[x, y] += [top, bottom]
    return [(x, y, max(both), min(both)) for (x, y), both in ends.items()]


def distances(rows):
    """From each hole to the one next to it."""
    from scipy.spatial import cKDTree
    places = numpy.unique(rows[:, :2], axis=0)
    return cKDTree(places).query(places, 2)[0][:, 1]


def samples(rows, words, step):
    """Points down the holes, no farther apart than step, and the word and the length that each stands for."""
    counts = numpy.ceil((rows[:, 2] - rows[:, 3]) / step).astype(int)
    n = numpy.repeat(numpy.arange(len(rows)), counts)
    k = numpy.concatenate([numpy.arange(count) for count in counts])
    part = (rows[n, 2] - rows[n, 3]) / counts[n]
    z = rows[n, 2] - (k + 0.5) * part
    return numpy.stack([rows[n, 0], rows[n, 1], z], axis=1), words[n], part


def labels_at(path, points):
    """The label of the region in which each point lies, from the first face above it; None outside."""
    model = draw.read(path)
    corners, both = draw.points_of(model)[draw.faces_of(model)], draw.labels_of(model)
    normals_up = numpy.cross(corners[:, 1, :2] - corners[:, 0, :2], corners[:, 2, :2] - corners[:, 0, :2]) > 0
    below = numpy.where(normals_up, both[:, 0], both[:, 1])
    locator = vtk.vtkStaticCellLocator()
    locator.SetDataSet(model)
    locator.BuildLocator()
    top, found = model.GetBounds()[5] + 1, []
    middle = points[:, :2].mean(axis=0)
    t, part, cell, at, place = vtk.mutable(0.0), vtk.mutable(0), vtk.mutable(0), [0.0] * 3, [0.0] * 3
    for x, y, z in numpy.column_stack([points[:, :2] + NUDGE * (middle - points[:, :2]), points[:, 2]]).tolist():
        hit = z < top and locator.IntersectWithLine((x, y, z), (x, y, top), 0.0, t, at, place, part, cell)
        found.append(int(below[cell.get()]) if hit else None)
    return found
