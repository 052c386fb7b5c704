"""Labels in any form that Python has, as sources of sections."""

import contextlib
import itertools
import os
import sys
import tempfile

import numpy as np

from . import _core
from ._options import whole

IDENTITY = (1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0)
PATHS = (str, bytes, os.PathLike)
_COMPRESSED = (".gz", ".bz2", ".zst")
_SLAB_BYTES = 64 << 20  # of sections that are read at once from an array in chunks


def frame(spacing, origin, direction, metres=None, space=""):
    """Where samples lie; each may be None."""
    spacing = _vector("spacing", spacing, (1.0, 1.0, 1.0))
    origin = _vector("origin", origin, (0.0, 0.0, 0.0))
    direction = IDENTITY if direction is None else tuple(_matrix(direction).ravel().tolist())
    return _core.Frame(spacing, origin, direction, metres, space)


def _vector(name, value, default):
    if value is None:
        return default
    if isinstance(value, (str, bytes)):
        raise TypeError(f"{name}={value!r}: not three numbers")
    try:
        vector = tuple(float(item) for item in (value if np.ndim(value) or name != "spacing" else (value,) * 3))
    except (TypeError, ValueError):
        raise TypeError(f"{name}={value!r}: not three numbers") from None
    if len(vector) != 3:
        raise ValueError(f"{name}={value!r}: {len(vector)} numbers; give three, along x, y and z")
    return vector


def _matrix(direction):
    matrix = np.asarray(direction, dtype=float)
    if matrix.size != 9:
        raise ValueError(f"direction: {matrix.size} numbers; give nine: the directions of x, y, z as columns")
    return matrix.reshape(3, 3)


def require_axes(direction):
    """Refuse a direction given by the user that is not orthonormal; those of files and images may be sheared."""
    matrix = np.eye(3) if direction is None else _matrix(direction)
    if not np.allclose(matrix.T @ matrix, np.eye(3), atol=1e-3):
        raise ValueError("direction: the columns are not orthonormal; give the directions of x, y, z as unit columns")


class Placed:
    """What an input says about its place in space and its unit of length; None where it says nothing.

    `space` is "RAS", "LPS" or "".
    """

    def __init__(self, data, spacing=None, origin=None, direction=None, metres=None, space=""):
        self.data, self.spacing, self.origin, self.direction = data, spacing, origin, direction
        self.metres, self.space = metres, space

    def in_space(self, space):
        """Return the same samples turned into "RAS" or "LPS", where their own is the other; "" leaves them."""
        if not space or self.space == space:
            return self
        turn = np.diag([-1.0, -1.0, 1.0]) if self.space else np.eye(3)
        origin = None if self.origin is None else turn @ np.asarray(self.origin, dtype=float)
        direction = None if self.direction is None else turn @ _matrix(self.direction)
        return Placed(self.data, self.spacing, origin, direction, self.metres, space)


def is_path(labels):
    """Whether the input names files: a path, or a list of paths."""
    if isinstance(labels, PATHS):
        return True
    return isinstance(labels, (list, tuple)) and bool(labels) and all(isinstance(path, PATHS) for path in labels)


def file_name(path):
    """A path as the file system has it: bytes, which need not be UTF-8."""
    name = os.fsencode(path)
    if b"\0" in name:
        raise ValueError(f"{path!r}: has a null character; give another path")
    return name


def paths_of(labels):
    """The paths as bytes."""
    return [file_name(p) for p in ([labels] if isinstance(labels, PATHS) else labels)]


def suffix_of(paths):
    """The extension of the first of paths as bytes, in small letters."""
    return os.path.splitext(paths[0])[1].lower()


def _metres_of_simpleitk(image):
    """ITK converts lengths of NIfTI to millimetres, and DICOM is in millimetres. Images of other files say no unit."""
    if not hasattr(image, "HasMetaDataKey"):
        return None
    nifti = image.GetMetaData("xyzt_units") if image.HasMetaDataKey("xyzt_units") else ""
    is_known = (nifti.isdigit() and int(nifti) % 8 in (1, 2, 3)) or image.HasMetaDataKey("0008|0016")
    return 0.001 if is_known else None


def _from_simpleitk(image):
    module = sys.modules[type(image).__module__.split(".")[0]]
    data = module.GetArrayViewFromImage(image)
    metres = _metres_of_simpleitk(image)
    return Placed(data, image.GetSpacing(), image.GetOrigin(), image.GetDirection(), metres, "LPS")


class _Turned:
    """An array [x, y, z, 1 ...] on disk, read as [z, y, x]."""

    def __init__(self, data):
        self.data = data
        self.shape = tuple(data.shape)[2::-1]
        self.dtype = data.dtype
        self.ndim = 3

    def __getitem__(self, sections):
        return np.asanyarray(self.data[(slice(None), slice(None), sections, *_firsts(self.data))]).T


def _firsts(data):
    """Zeros for the axes behind the third."""
    return (0,) * (len(data.shape) - 3)


def _metres_of_nibabel(image):
    header = getattr(image, "header", None)
    if type(header).__name__ == "MGHHeader":
        return 0.001
    if not hasattr(header, "get_xyzt_units"):  # of a format without units
        return None
    return {1: 1.0, 2: 0.001, 3: 1e-6}.get(int(header["xyzt_units"]) % 8)


def _is_compressed(image):
    """Whether reading a section reads all that comes before it in the file."""
    names = (holder.filename for holder in getattr(image, "file_map", {}).values())
    return any(os.fspath(name).lower().endswith(_COMPRESSED) for name in names if name)


def _from_nibabel(image):
    if len(image.shape) < 3 or any(size != 1 for size in image.shape[3:]):
        raise ValueError(f"labels: an image of shape {tuple(image.shape)}; give one of three axes")
    data = image.dataobj
    if _is_compressed(image):
        data = np.asanyarray(data)
    affine = np.asarray(image.affine, dtype=float)
    spacing = np.linalg.norm(affine[:3, :3], axis=0)
    if np.any(spacing == 0):
        raise ValueError("labels: the affine of the image is singular; give one with three axes")
    turned = data[(..., *_firsts(data))].T if isinstance(data, np.ndarray) else _Turned(data)
    return Placed(turned, spacing, affine[:3, 3], affine[:3, :3] / spacing, _metres_of_nibabel(image), "RAS")


def placed(labels):
    """Unwrap images of other libraries."""
    if all(hasattr(labels, name) for name in ("GetSpacing", "GetOrigin", "GetDirection")):
        return _from_simpleitk(labels)
    if hasattr(labels, "affine") and hasattr(labels, "dataobj"):
        return _from_nibabel(labels)
    _refuse_masked(labels)
    return Placed(labels)


def _refuse_masked(array):
    if isinstance(array, np.ma.MaskedArray):
        raise TypeError("labels: a masked array; give labels.filled(LABEL), with the label of what is masked")


def _native(array):
    """Bring into the byte order of the machine; no copy otherwise."""
    _refuse_masked(array)
    array = np.asarray(array)
    return array if array.dtype.isnative else array.astype(array.dtype.newbyteorder("="))


def _type_name(dtype):
    dtype = np.dtype(dtype)
    if dtype.kind == "b":
        return "uint8"
    if dtype.kind not in "iu":
        raise TypeError(f"labels are {dtype}; give integers")
    return dtype.name


def _chunk_depth(array):
    """Sections that lie in one chunk."""
    chunks = getattr(array, "chunks", None)
    if not chunks:
        return 1
    depth = chunks[0]
    return max(int(depth[0] if isinstance(depth, tuple) else depth), 1)


class _ArrayCalls:
    """Sections of anything that has a shape and is read by slices, a slab of chunks at a time."""

    def __init__(self, array):
        self.array = array
        section_bytes = max(int(np.prod(array.shape[1:], dtype=np.int64)) * np.dtype(array.dtype).itemsize, 1)
        self.depth = min(_chunk_depth(array), max(_SLAB_BYTES // section_bytes, 1))
        self.rewind()

    def rewind(self):
        self.section, self.slab, self.first = 0, None, 0

    def next(self):
        section = self.section
        if section >= self.array.shape[0]:
            return None
        if self.slab is None or section >= self.first + len(self.slab):
            self.slab, self.first = None, section
            slab = self.array[section : section + self.depth]
            self.slab = _native(slab)
        self.section += 1
        return self.slab[section - self.first]


class _IteratorCalls:
    """Sections of an iterator, once, or of a sequence, any number of times."""

    def __init__(self, sections, first, count, sequence):
        self.rest, self.first, self.count, self.sequence = sections, first, count, sequence
        self.section = 0

    def rewind(self):
        self.rest, self.section = iter(self.sequence), 0

    def next(self):
        section = next(self.rest, None)
        if section is not None:
            section = _section_like(self.first, section, self.section)
        self.section += 1
        if self.section == self.count and next(self.rest, None) is not None:
            raise ValueError(f"labels: more than the {self.count} sections that were announced; give their number")
        return section


def _section(section):
    section = _native(section)
    if section.ndim != 2:
        raise ValueError(f"labels: a section of {section.ndim} axes; give sections [y, x]")
    _type_name(section.dtype)
    return section


def _section_like(first, section, number):
    section = _section(section)
    if section.shape != first.shape or section.dtype != first.dtype:
        raise ValueError(
            f"labels section {number}: {section.shape} {section.dtype}, the first has {first.shape} "
            f"{first.dtype}; give sections of one size and type"
        )
    return section


def _spooled(sections, first):
    """Copy sections into a file without a name, in TMPDIR, and map it: their number is known only at the end."""
    with tempfile.TemporaryFile(prefix="regionmesh-") as file:
        count = 0
        for section in sections:
            file.write(np.ascontiguousarray(_section_like(first, section, count)).data)
            count += 1
        file.flush()
        return np.memmap(file, dtype=first.dtype, mode="r", shape=(count, *first.shape))


def _iterated(labels, sections):
    """An array or the calls for an iterable of sections."""
    count = len(labels) if hasattr(labels, "__len__") else sections
    if count is not None:
        count = whole("sections", count)
        if not 0 <= count < 1 << 31:
            raise ValueError(f"sections={count}: not a number of sections")
    rest = iter(labels)
    first = next(rest, None)
    if first is None:
        raise ValueError("labels: no sections; give at least two")
    first = _section(first)
    rest = itertools.chain([first], rest)
    if count is None:
        return _spooled(rest, first)
    sequence = labels if hasattr(labels, "__len__") else None
    calls = _IteratorCalls(rest, first, count, sequence)
    size = (first.shape[1], first.shape[0], count)
    return calls.next, (calls.rewind if sequence is not None else None), size, _type_name(first.dtype)


def _is_sliced(data):
    """Whether it is a volume that is no array of numpy, but has its types."""
    if isinstance(data, np.ndarray) or not hasattr(data, "dtype") or len(getattr(data, "shape", ())) != 3:
        return False
    try:
        np.dtype(data.dtype)
    except TypeError:
        return False  # such as a tensor, which becomes an array at once
    return True


def _calls_of(array):
    calls = _ArrayCalls(array)
    size = tuple(int(n) for n in array.shape[::-1])
    return calls.next, calls.rewind, size, _type_name(np.dtype(array.dtype).newbyteorder("="))


def opened(labels, sections=None):
    """An input that is no path, with its place: `data` is an array, or the calls for its sections."""
    own = placed(labels)
    data = own.data
    if sections is not None and any(hasattr(data, name) for name in ("shape", "__array__", "__len__")):
        raise ValueError("sections: is for iterators; leave it out, arrays and lists have a number of sections")
    if _is_sliced(data):
        data = _calls_of(data)
    elif not isinstance(data, np.ndarray) and hasattr(data, "__array__"):
        data = np.asarray(data)
    elif not isinstance(data, np.ndarray):
        if not hasattr(data, "__iter__"):
            raise TypeError(f"labels: {type(labels).__name__}; give an array, a path or an iterable of sections")
        data = _iterated(data, sections)
    if isinstance(data, np.ndarray) and not data.dtype.isnative and data.dtype.kind in "iu" and data.ndim == 3:
        data = _calls_of(data)
    return Placed(data, own.spacing, own.origin, own.direction, own.metres, own.space)


def size_of(input):
    """Samples along x, y, z of an opened input."""
    return tuple(input.data.shape[::-1]) if isinstance(input.data, np.ndarray) else tuple(input.data[2])


def is_cut(options):
    """Whether options of the input leave fewer samples."""
    return any(name in ("roi", "box", "downsample") for name, _ in options)


def place_of(input, given):
    """Spacing, origin and direction: as given, or where that is None, the input's own, or else the default."""
    own, default = (input.spacing, input.origin, input.direction), ((1.0, 1.0, 1.0), (0.0, 0.0, 0.0), IDENTITY)
    return tuple(next(value for value in values if value is not None) for values in zip(given, own, default))


def source(input, place, options, names, kept=None):
    """The samples of an opened input that `options` and `kept` choose."""
    where = frame(*place, input.metres, input.space)
    if isinstance(input.data, np.ndarray):
        return _core.array_source(input.data, where, options, kept, names, "labels")
    if dict(options).get("sweep", "auto") not in ("auto", "z"):
        raise ValueError("sweep: these sections come along z only; leave it out, or give an array")
    return _core.call_source(input.data, where, options, kept, names, "labels")


@contextlib.contextmanager
def missing_files(*paths):
    """Turn an error into a FileNotFoundError where one of the paths leads nowhere."""
    try:
        yield
    except ValueError as error:
        names = (os.fsencode(path).split(b":/")[0] for path in paths)
        if all(name == b"-" or os.path.exists(name) for name in names):
            raise
        raise FileNotFoundError(str(error)) from None
