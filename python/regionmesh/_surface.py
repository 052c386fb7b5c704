"""Parts of a model as surfaces of their own."""

import operator
from typing import NamedTuple

import numpy as np


class Surface(NamedTuple):
    """A part of a model: one region or one interface.

    Attributes
    ----------
    points : (n, 3) ndarray of float64
        Points of the part, x, y, z.
    faces : (m, 3) ndarray of uint32
        Rows of `points`, counter-clockwise seen from outside.
    point_ids : (n,) ndarray of uint32
        Rows of `Mesh.points`.
    face_ids : (m,) ndarray of int64
        Rows of `Mesh.faces`.
    """

    points: np.ndarray
    faces: np.ndarray
    point_ids: np.ndarray
    face_ids: np.ndarray


def region(mesh, label):
    """Faces around a region, outward."""
    first, second = np.equal(mesh.labels, operator.index(label)).T
    face_ids = np.flatnonzero(first | second)
    if not len(face_ids):
        raise KeyError(label)
    return _part(mesh, face_ids, second[face_ids])


def interface(mesh, a, b):
    """Faces between two labels, from a to b."""
    labels = mesh.labels
    forward = (labels[:, 0] == a) & (labels[:, 1] == b)
    backward = (labels[:, 0] == b) & (labels[:, 1] == a)
    face_ids = np.flatnonzero(forward | backward)
    return _part(mesh, face_ids, backward[face_ids])


def _part(mesh, face_ids, is_flipped):
    faces = mesh.faces[face_ids]
    faces[is_flipped] = faces[is_flipped][:, ::-1]
    point_ids, rows = np.unique(faces, return_inverse=True)
    rows = rows.reshape(faces.shape).astype(np.uint32)
    return Surface(mesh.points[point_ids], rows, point_ids, face_ids)
