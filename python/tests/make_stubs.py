"""Writes regionmesh/__init__.pyi: the types of the package, options included.

    PYTHONPATH=build/python/python python3 python/tests/make_stubs.py
"""

import inspect
from pathlib import Path

import regionmesh
from regionmesh import _options

_HEAD = '''"""Types of the package. Written by python/tests/make_stubs.py."""

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

'''

_OF_KIND = {
    "flag": "bool", "count": "_Int", "label": "_Int", "number": "float", "share": "float | str", "bytes": "_Int | str",
    "text": "str", "file": "_Path", "counts": "Sequence[_Int]", "numbers": "Sequence[float]",
}  # fmt: skip
_OF_NAME = {
    "spacing": "float | _Vector | None", "ascii": "bool", "origin": "_Vector | None", "direction": "npt.ArrayLike | None",
    "names": "Mapping[int, str] | _Path | None", "labels_to_keep": "Iterable[_Int] | None", "sections": "_Int | None",
    "progress": "_Progress | None", "background": "_Int | Iterable[_Int] | None", "smooth": "str | _Int | bool | None",
    "path": "_Path", "points": "npt.ArrayLike", "faces": "npt.ArrayLike", "exterior_label": "_Int",
    "node_types": "npt.ArrayLike | None",
    "weld": "float | None", "orient": "bool", "boundary": 'Literal["cap", "open"]', "label": "_Int", "a": "_Int",
    "b": "_Int", "threads": "_Int", "other": "Mesh", "like": "Any", "shape": "Sequence[_Int] | None",
    "dtype": "npt.DTypeLike | None", "outside": "_Int", "per_region": "bool", "labels": "Any",
    "keep_samples": "bool", "min_quality": "float", "space": 'Literal["ras", "lps"] | None', "units": 'Literal["km", "m", "cm", "mm", "um", "nm", "ft", "in"] | None',
    "downsample": "str | _Int | None", "scale_z": 'float | Literal["auto"] | None',
    "edge_length": 'float | Literal["auto"] | None',
    "precomputed": 'Literal["multi", "legacy"] | None', "levels": "_Int | None", "sharded": "bool",
}  # fmt: skip
_RETURNS = {
    "reconstruct": "Mesh", "load": "Mesh", "from_arrays": "Mesh", "region": "Surface", "interface": "Surface",
    "simplify": "Mesh", "smooth": "Mesh", "improve": "Mesh", "check": "dict[str, Any]", "compare": "dict[str, Any]",
    "voxelise": "npt.NDArray[Any]", "save": "list[str]",
    "points": "npt.NDArray[np.float64]", "faces": "npt.NDArray[np.uint32]", "labels": "npt.NDArray[Any]",
    "node_types": "npt.NDArray[np.uint8]", "exterior_label": "int", "background": "list[int]", "space": "str | None",
    "metres": "float | None",
    "names": "dict[int, str]", "bounds": "npt.NDArray[np.float64]", "lines": "npt.NDArray[np.uint32]",
    "quadruple_points": "npt.NDArray[np.int64]", "report": "dict[str, Any]", "violations": "list[dict[str, Any]]",
    "certified": "bool", "regions": "dict[str, npt.NDArray[Any]]", "interfaces": "dict[str, npt.NDArray[Any]]",
    "triple_lines": "dict[str, npt.NDArray[Any]]",
}  # fmt: skip
_COMMANDS = {"reconstruct": "reconstruct", "simplify": "decimate", "smooth": "smooth", "compare": "compare"}


def _type_of(name, parameter, options):
    row = options.get(name)
    if parameter.default == "file":
        return '_Int | Iterable[_Int] | Literal["file"] | None'
    if row is None or name in ("spacing", "background", "smooth", "downsample", "scale_z", "edge_length"):
        return _OF_NAME[name]
    if row["words"]:
        return "Literal[" + ", ".join(f'"{word}"' for word in row["words"]) + "] | None"
    return _OF_KIND[row["kind"]] + " | None"


def _function(function, indent=""):
    options = _options.rows(_COMMANDS[function.__name__]) if function.__name__ in _COMMANDS else {}
    parts, is_keyword = [], False
    for name, parameter in inspect.signature(function).parameters.items():
        if name == "self":
            parts.append("self")
            continue
        if parameter.kind == parameter.KEYWORD_ONLY and not is_keyword:
            parts.append("*")
            is_keyword = True
        default = "" if parameter.default is parameter.empty else f" = {parameter.default!r}".replace("'", '"')
        parts.append(f"{name}: {_type_of(name, parameter, options)}{default}")
    result = _RETURNS.get(function.__name__, "Any")
    head = f"{indent}def {function.__name__}("
    line = f"{head}{', '.join(parts)}) -> {result}: ..."
    if len(line) <= 120:
        return line + "\n"
    return head + "\n" + "".join(f"{indent}    {part},\n" for part in parts) + f"{indent}) -> {result}: ...\n"


def _class(owner):
    lines = [f"class {owner.__name__}:\n"]
    for name, member in vars(owner).items():
        if name.startswith("_"):
            continue
        if isinstance(member, property):
            lines.append(f"    @property\n    def {name}(self) -> {_RETURNS[name]}: ...\n")
        else:
            lines.append(_function(member, "    "))
    lines.append("    def __len__(self) -> int: ...\n")
    return "".join(lines)


def text():
    """The text of the stubs."""
    functions = (regionmesh.reconstruct, regionmesh.load, regionmesh.from_arrays)
    return _HEAD + _class(regionmesh.Mesh) + "\n" + "".join(_function(function) for function in functions)


if __name__ == "__main__":
    (Path(__file__).parents[1] / "regionmesh" / "__init__.pyi").write_text(text())
