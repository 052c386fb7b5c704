"""Measures of regions, interfaces and lines, from the arrays of a mesh."""

import csv
import io

import numpy as np

from . import _core


def _normals(points, faces):
    """Twice the area of each face, as a vector."""
    a, b, c = (points[faces[:, corner]] for corner in range(3))
    return np.cross(b - a, c - a)


def quality(points, faces):
    """Return the quality of each face: 0.26 is equilateral, 0 degenerate (docs/explanation/decimate.md)."""
    area = np.linalg.norm(_normals(points, faces), axis=1) / 2
    sides = np.stack([np.linalg.norm(points[faces[:, n]] - points[faces[:, n - 1]], axis=1) for n in range(3)], axis=1)
    shortest, middle, longest = np.sort(sides, axis=1).T
    with np.errstate(invalid="ignore", divide="ignore"):
        product = longest * middle * (shortest + 8 * area / sides.sum(axis=1))
        return np.nan_to_num(area / np.cbrt(product**2), nan=0.0, posinf=0.0)


def lines(faces):
    """Edges with three or more faces."""
    edges = np.sort(faces[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1)
    found, counts = np.unique(edges, axis=0, return_counts=True)
    return found[counts >= 3]


def _rows(mesh, table):
    """The rows of a table that `regionmesh check` writes, as dicts of text."""
    return csv.DictReader(io.StringIO(_core.table(mesh._model, table)))


def _number(text):
    return float(text) if text not in ("", "-") else np.nan


def _column(found, keys, title):
    """A number of the rows in `found`, in the order of `keys`; nan where there is none."""
    return np.array([_number(found[key][title]) if key in found else np.nan for key in keys], dtype=float)


def interfaces(mesh):
    """The columns of Mesh.interfaces."""
    pairs, rows = np.unique(mesh.labels, axis=0, return_inverse=True)
    areas = np.linalg.norm(_normals(mesh.points, mesh.faces), axis=1) / 2
    rows = rows.ravel()
    found = {(int(row["label"]), int(row["neighbour"])): row for row in _rows(mesh, "interfaces")}
    keys = [tuple(pair) for pair in pairs.tolist()]
    return {
        "first": pairs[:, 0],
        "second": pairs[:, 1],
        "faces": np.bincount(rows, minlength=len(pairs)),
        "area": np.bincount(rows, areas, minlength=len(pairs)).astype(float),  # of no row it has integers
        "mean_curvature": _column(found, keys, "mean_curvature"),
        "line_length": _column(found, keys, "line_length"),
    }


def _lists(rows):
    """A column of lists, which numpy would make a table of."""
    column = np.empty(len(rows), dtype=object)
    column[:] = rows
    return column


def triple_lines(mesh):
    """The columns of Mesh.triple_lines."""
    rows = list(_rows(mesh, "lines"))
    return {
        "labels": _lists([[int(label) for label in row["labels"].split()] for row in rows]),
        "edges": np.array([int(row["edges"]) for row in rows], dtype=np.int64),
        "length": np.array([float(row["length"]) for row in rows], dtype=float),
        "angles": _lists([[_number(angle) for angle in row["angles"].split()] for row in rows]),
    }


class _Sides:
    """Each face twice, once for each of its labels, outward from it."""

    def __init__(self, mesh, wanted):
        labels = np.concatenate([mesh.labels[:, 0], mesh.labels[:, 1]])
        place = np.searchsorted(wanted, labels)
        place[place == len(wanted)] = 0
        known = wanted[place] == labels if len(wanted) else np.zeros(len(labels), bool)
        count = len(mesh.faces)
        self.row = place[known]
        self.face = np.tile(np.arange(count), 2)[known]
        self.sign = np.repeat([1.0, -1.0], count)[known]
        self.other = np.concatenate([mesh.labels[:, 1], mesh.labels[:, 0]])[known]
        self.count = len(wanted)

    def sum(self, values):
        return np.bincount(self.row, values, minlength=self.count)


def _centroids(mesh, sides, origin):
    """Of the volume inside each region, by tetrahedra from a common point."""
    points = mesh.points - origin
    corners = points[mesh.faces]
    volumes = np.einsum("ij,ij->i", corners[:, 0], np.cross(corners[:, 1], corners[:, 2]))[sides.face] * sides.sign
    centres = corners.sum(axis=1)[sides.face] / 4
    with np.errstate(invalid="ignore", divide="ignore"):
        moments = [sides.sum(volumes * centres[:, axis]) for axis in range(3)]
        return np.stack(moments, axis=1) / sides.sum(volumes)[:, None] + origin


def _boxes(mesh, sides):
    low, high = np.full((sides.count, 3), np.inf), np.full((sides.count, 3), -np.inf)
    corners = mesh.points[mesh.faces]
    np.minimum.at(low, sides.row, corners.min(axis=1)[sides.face])
    np.maximum.at(high, sides.row, corners.max(axis=1)[sides.face])
    return np.stack([low, high], axis=1)


def _neighbours(sides, exterior):
    pairs = np.unique(np.stack([sides.row.astype(np.int64), sides.other.view(np.int64)], axis=1), axis=0)
    found = [[] for _ in range(sides.count)]
    bits = pairs[:, 1].astype(np.int64)
    others = bits.view(sides.other.dtype)
    for row, other in zip(pairs[:, 0], others):
        if other != exterior:
            found[row].append(int(other))
    return [sorted(labels) for labels in found]


def regions(mesh):
    """The columns of Mesh.regions."""
    rows = mesh.report["regions"]
    labels = np.array([row["label"] for row in rows], dtype=mesh.labels.dtype)
    sides = _Sides(mesh, labels)
    voxels = {row["label"]: row["samples"] for row in mesh.report.get("dice_of_regions", [])}
    origin = mesh.bounds.mean(axis=0) if len(mesh.points) else np.zeros(3)
    centroids, boxes = _centroids(mesh, sides, origin), _boxes(mesh, sides)
    counts = np.bincount(sides.row, minlength=len(labels))
    with np.errstate(invalid="ignore", divide="ignore"):
        mean_quality = sides.sum(quality(mesh.points, mesh.faces)[sides.face]) / counts
    names = mesh.names
    columns = {
        "label": labels,
        "name": np.array([names.get(int(label), "") for label in labels], dtype=object),
        "voxels": np.array([voxels.get(int(label), -1) for label in labels], dtype=np.int64),
        "volume": np.array([row["volume"] for row in rows], dtype=float),
        "area": np.array([row["area"] for row in rows], dtype=float),
        "euler": np.array([row["euler"] for row in rows], dtype=np.int64),
        "components": np.array([row["components"] for row in rows], dtype=np.int64),
        "mean_quality": mean_quality,
    }
    for n, axis in enumerate("xyz"):
        columns[f"centroid_{axis}"] = centroids[:, n]
    for n, end in enumerate(("low", "high")):
        for m, axis in enumerate("xyz"):
            columns[f"box_{end}_{axis}"] = boxes[:, n, m]
    columns["neighbours"] = _lists(_neighbours(sides, mesh.exterior_label))
    found = {int(row["label"]): row for row in _rows(mesh, "regions")}
    for title in ("mean_curvature", "triple_line_length"):
        columns[title] = _column(found, labels.tolist(), title)
    return columns
