"""Types of the package. Written by python/tests/make_stubs.py."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from os import PathLike
from typing import Any, Literal, NamedTuple, SupportsIndex

import numpy as np
import numpy.typing as npt

__version__: str

_Path = str | PathLike[str]
_Int = SupportsIndex
_Vector = Sequence[float] | npt.NDArray[Any]
_Progress = bool | Callable[[str, int, int | None], object]

class Surface(NamedTuple):
    points: npt.NDArray[np.float64]
    faces: npt.NDArray[np.uint32]
    point_ids: npt.NDArray[np.uint32]
    face_ids: npt.NDArray[np.int64]

class Mesh:
    @property
    def points(self) -> npt.NDArray[np.float64]: ...
    @property
    def faces(self) -> npt.NDArray[np.uint32]: ...
    @property
    def labels(self) -> npt.NDArray[Any]: ...
    @property
    def node_types(self) -> npt.NDArray[np.uint8]: ...
    @property
    def exterior_label(self) -> int: ...
    @property
    def background(self) -> list[int]: ...
    @property
    def space(self) -> str | None: ...
    @property
    def metres(self) -> float | None: ...
    @property
    def names(self) -> dict[int, str]: ...
    @property
    def bounds(self) -> npt.NDArray[np.float64]: ...
    @property
    def lines(self) -> npt.NDArray[np.uint32]: ...
    @property
    def quadruple_points(self) -> npt.NDArray[np.int64]: ...
    @property
    def report(self) -> dict[str, Any]: ...
    @property
    def violations(self) -> list[dict[str, Any]]: ...
    @property
    def certified(self) -> bool: ...
    @property
    def regions(self) -> dict[str, npt.NDArray[Any]]: ...
    @property
    def interfaces(self) -> dict[str, npt.NDArray[Any]]: ...
    @property
    def triple_lines(self) -> dict[str, npt.NDArray[Any]]: ...
    def region(self, label: _Int) -> Surface: ...
    def interface(self, a: _Int, b: _Int) -> Surface: ...
    def simplify(
        self,
        *,
        keep_samples: bool = True,
        progress: _Progress | None = None,
        target_faces: _Int | None = None,
        reduce: float | str | None = None,
        max_error: float | None = None,
        perturbation: float | None = None,
        placement: Literal["quadric", "lindstrom-turk"] | None = None,
        min_quality: float | None = None,
        edge_length: float | Literal["auto"] | None = None,
        smooth_lines: bool | None = None,
        improve: bool | None = None,
        intersect_check: bool | None = None,
        threads: _Int | None = None,
    ) -> Mesh: ...
    def improve(
        self,
        *,
        min_quality: float = 0.1,
        keep_samples: bool = True,
        threads: _Int = 0,
        progress: _Progress | None = None,
    ) -> Mesh: ...
    def smooth(
        self,
        *,
        smooth: str | _Int | bool | None = None,
        smooth_filter: Literal["auto", "lattice", "taubin", "laplacian", "nifpms", "none"] | None = None,
        smooth_lambda: float | None = None,
        smooth_points: bool | None = None,
        scale: float | None = None,
        preserve_volume: bool | None = None,
        min_quality: float | None = None,
        intersect_check: bool | None = None,
        threads: _Int | None = None,
    ) -> Mesh: ...
    def check(
        self,
        labels: Any = None,
        *,
        spacing: float | _Vector | None = None,
        origin: _Vector | None = None,
        direction: npt.ArrayLike | None = None,
        threads: _Int = 0,
    ) -> dict[str, Any]: ...
    def compare(self, other: Mesh, *, samples: _Int | None = None, threads: _Int | None = None) -> dict[str, Any]: ...
    def voxelise(
        self,
        like: Any = None,
        *,
        shape: Sequence[_Int] | None = None,
        spacing: float | _Vector | None = None,
        origin: _Vector | None = None,
        direction: npt.ArrayLike | None = None,
        dtype: npt.DTypeLike | None = None,
        outside: _Int = 0,
    ) -> npt.NDArray[Any]: ...
    def save(
        self,
        path: _Path,
        *,
        per_region: bool = False,
        ascii: bool = False,
        units: Literal["km", "m", "cm", "mm", "um", "nm", "ft", "in"] | None = None,
        precomputed: Literal["multi", "legacy"] | None = None,
        levels: _Int | None = None,
        sharded: bool = False,
    ) -> list[str]: ...
    def to_vtk(self) -> Any: ...
    def to_pyvista(self) -> Any: ...
    def to_meshio(self) -> Any: ...
    def plot(self) -> Any: ...
    def to_trimesh(self, label: _Int = None) -> Any: ...
    def __len__(self) -> int: ...

def reconstruct(
    labels: Any,
    *,
    spacing: float | _Vector | None = None,
    origin: _Vector | None = None,
    direction: npt.ArrayLike | None = None,
    names: Mapping[int, str] | _Path | None = None,
    labels_to_keep: Iterable[_Int] | None = None,
    sections: _Int | None = None,
    units: Literal["km", "m", "cm", "mm", "um", "nm", "ft", "in"] | None = None,
    space: Literal["ras", "lps"] | None = None,
    progress: _Progress | None = None,
    sweep: Literal["auto", "x", "y", "z"] | None = None,
    layer: _Int | None = None,
    max_work: _Int | None = None,
    external_files: bool | None = None,
    size: Sequence[_Int] | None = None,
    type: str | None = None,
    threshold: str | None = None,
    argmax: bool | None = None,
    pitch: float | None = None,
    priority: str | None = None,
    roi: str | None = None,
    box: str | None = None,
    merge: _Path | None = None,
    downsample: str | _Int | None = None,
    min_region: _Int | None = None,
    columns: str | None = None,
    step: float | None = None,
    layers: str | None = None,
    collars: _Path | None = None,
    surveys: _Path | None = None,
    terrain: _Path | None = None,
    scale_z: float | Literal["auto"] | None = None,
    array: str | None = None,
    hull: bool | None = None,
    background: _Int | Iterable[_Int] | None = None,
    boundary: Literal["cap", "open"] | None = None,
    cells: Literal["auto", "compact", "tetrahedra"] | None = None,
    purpose: Literal["any", "fe", "print", "view"] | None = None,
    target_faces: _Int | None = None,
    reduce: float | str | None = None,
    max_error: float | None = None,
    perturbation: float | None = None,
    placement: Literal["quadric", "lindstrom-turk"] | None = None,
    decimate: bool | None = None,
    smooth: str | _Int | bool | None = None,
    smooth_filter: Literal["auto", "lattice", "taubin", "laplacian", "nifpms", "none"] | None = None,
    smooth_lambda: float | None = None,
    between: str | None = None,
    align: Literal["off", "translate", "rigid"] | None = None,
    room: float | None = None,
    denoise: str | None = None,
    specks: str | None = None,
    smooth_points: bool | None = None,
    preserve_volume: bool | None = None,
    min_quality: float | None = None,
    edge_length: float | Literal["auto"] | None = None,
    smooth_lines: bool | None = None,
    improve: bool | None = None,
    keep_samples: bool | None = None,
    intersect_check: bool | None = None,
    memory: _Int | str | None = None,
    face_budget: _Int | None = None,
    threads: _Int | None = None,
) -> Mesh: ...
def load(
    path: _Path,
    *,
    background: _Int | Iterable[_Int] | Literal["file"] | None = "file",
    weld: float | None = None,
    orient: bool = False,
    boundary: Literal["cap", "open"] = "cap",
) -> Mesh: ...
def from_arrays(
    points: npt.ArrayLike,
    faces: npt.ArrayLike,
    labels: Any,
    *,
    background: _Int | Iterable[_Int] | None = 0,
    exterior_label: _Int = -1,
    names: Mapping[int, str] | _Path | None = None,
    boundary: Literal["cap", "open"] = "cap",
    node_types: npt.ArrayLike | None = None,
    units: Literal["km", "m", "cm", "mm", "um", "nm", "ft", "in"] | None = None,
) -> Mesh: ...
