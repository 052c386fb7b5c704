"""Models from files, from arrays and from pickles."""

import os

import numpy as np

from . import _core, _options, _sources
from ._labels import bits, colours_of, names_of
from ._mesh import Mesh


def unpickle(points, faces, labels, node_types, state):
    model = _core.from_arrays(
        (points, faces, labels.view(np.int64), node_types),
        (state["background"], state["order"], state["names"], state.get("colours", {}), state.get("lacking")),
        (state["space"], state.get("metres"), state.get("spacing")),
        state["exterior"], state["is_unsigned"], state["is_open"],
    )  # fmt: skip
    mesh = Mesh(model, state["lattice"])
    mesh._report = state["report"]
    return mesh


def load(path, *, background="file", weld=None, orient=False, boundary="cap"):
    """Read a surface model of regionmesh or of another program.

    Parameters
    ----------
    path : path
        .vtp .vtu .ply .stl .obj .dream3d, or a folder with a file for each region (docs/reference/files.md).
    background : int or sequence of int, or None
        Labels of empty space; None: every label is a region. "file": what the file says, or else 0.
    weld : float, optional
        Join points no farther apart than this, in the unit of the file.
    orient : bool
        Turn faces so that neighbours agree on the side of each region.
    boundary : {"cap", "open"}
        "open": a model without faces on the sides of its box.

    Returns
    -------
    Mesh

    Raises
    ------
    FileNotFoundError
        Where there is no file.
    ValueError
        For a file that cannot be used.

    Examples
    --------
    >>> import numpy as np, regionmesh
    >>> labels = np.zeros((6, 6, 6), np.uint8)
    >>> labels[2:4, 2:4, 2:4] = 3
    >>> regionmesh.reconstruct(labels).save("cube.vtp")
    ['cube.vtp']
    >>> regionmesh.load("cube.vtp").certified
    True
    """
    name = _sources.file_name(path)
    asked = {"boundary": boundary}
    if not (isinstance(background, str) and background == "file"):
        asked["background"] = background
    pairs = _options.pairs("reconstruct", asked, "load")
    if weld is not None:
        pairs.append(("weld", repr(float(weld))))
    pairs.append(("orient", "true" if orient else "false"))
    with _sources.missing_files(path):
        return Mesh(_core.load(name, pairs))


def from_arrays(
    points, faces, labels, *, background=0, exterior_label=-1, names=None, boundary="cap", node_types=None, units=None
):
    """Make a model from arrays, such as those of another program.

    Parameters
    ----------
    points : (n, 3) array_like of float
        x, y, z.
    faces : (m, 3) array_like of int
        Rows of `points`; the normal of a face points from its first label to its second.
    labels : (m, 2) array_like of int
        The two regions of each face.
    background : int or sequence of int, or None
        Labels of empty space.
    exterior_label : int
        The label that stands for the outside of the box: `Mesh.exterior_label` for the labels of a mesh.
    names : dict of int to str, optional
        Names of labels.
    boundary : {"cap", "open"}
        "open": a model without faces on the sides of its box.
    node_types : (n,) array_like of int, optional
        `Mesh.node_types`, which says what points lie on the box. Needed where no faces lie there, as in open models
        and between backgrounds.
    units : {"km", "m", "cm", "mm", "um", "nm", "ft", "in"}, optional
        Unit of length, `Mesh.metres`.

    Returns
    -------
    Mesh

    Raises
    ------
    TypeError
        For faces or labels that are no integers.
    ValueError
        For arrays of other shapes, a face that names no point, and points that are not finite.

    Examples
    --------
    A tetrahedron of region 7 in empty space:

    >>> import regionmesh
    >>> points = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]
    >>> faces = [(0, 2, 1), (0, 1, 3), (1, 2, 3), (0, 3, 2)]
    >>> mesh = regionmesh.from_arrays(points, faces, [(7, 0)] * 4)
    >>> mesh.certified, round(float(mesh.regions["volume"][0]), 4)
    (True, 0.1667)
    """
    if boundary not in ("cap", "open"):
        raise ValueError(f"boundary={boundary!r}: neither 'cap' nor 'open'")
    points = _rows("points", np.asarray(points, dtype=np.float64), 3)
    faces = _rows("faces", _integers("faces", faces), 3)
    labels = _rows("labels", _integers("labels", labels), 2)
    if faces.size and (faces.min() < 0 or faces.max() >= len(points)):
        raise ValueError(f"faces: rows {faces.min()} to {faces.max()} of {len(points)} points; give rows from 0")
    is_unsigned = labels.dtype == np.uint64
    whole = labels.view(np.int64) if is_unsigned else labels.astype(np.int64)
    outside = [] if background is None else [background] if np.ndim(background) == 0 else list(background)
    model = _core.from_arrays(
        (points, faces.astype(np.uint32), np.ascontiguousarray(whole), _node_types(node_types, len(points))),
        ([bits(label) for label in outside], [], names_of(names) or {}, colours_of(names) or {}, None),
        ("", _core.metres_of(_options.output_pairs({"units": units}, "from_arrays")), None),
        bits(exterior_label), bool(is_unsigned), boundary == "open",
    )  # fmt: skip
    return Mesh(model)


def _integers(name, values):
    array = np.asarray(values)
    if array.size and array.dtype.kind not in "iu":
        raise TypeError(f"{name}: {array.dtype}; give integers")
    return array.astype(array.dtype.newbyteorder("=")) if array.size else array.astype(np.int64)


def _node_types(values, count):
    if values is None:
        return None
    types = _integers("node_types", values)
    if types.shape != (count,):
        raise ValueError(f"node_types: shape {types.shape}; give one for each of {count} points")
    wrong = types[~np.isin(types, (2, 3, 4, 12, 13, 14))]
    if wrong.size:
        raise ValueError(f"node_types: {wrong[0]}; give 2, 3 or 4, and 12, 13 or 14 on the box")
    return np.ascontiguousarray(types, np.uint8)


def _rows(name, array, columns):
    if array.size == 0:
        return array.reshape(0, columns)
    if array.ndim != 2 or array.shape[1] != columns:
        raise ValueError(f"{name}: shape {array.shape}; give rows of {columns}")
    return np.ascontiguousarray(array)
