"""What is printed works."""

import doctest
import importlib
import pkgutil
import re
from pathlib import Path

import numpy as np
import pytest

import regionmesh

ROOT = Path(__file__).resolve().parents[2]


def blocks(page):
    return re.findall(r"^```python\n(.*?)^```", (ROOT / page).read_text(encoding="utf-8"), re.M | re.S)


def test_the_lines_of_the_readme(two_boxes, tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    np.save("labels.npy", two_boxes)
    (block,) = blocks("README.md")
    assert sum(1 for line in block.splitlines() if line.strip()) == 6
    exec(block, {})
    assert capsys.readouterr().out.startswith("True")
    assert regionmesh.load("model.vtp").certified


def test_the_blocks_of_the_reference(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    names = {}
    found = blocks("docs/reference/python.md")
    assert len(found) == 3
    for block in found:
        exec(block, names)
    np.testing.assert_array_equal(names["again"], names["labels"])


MODULES = {f"regionmesh.{module.name}" for module in pkgutil.iter_modules(regionmesh.__path__)}
MODULES -= {"regionmesh._core", "regionmesh.__main__"}


@pytest.mark.parametrize("name", ["regionmesh", *sorted(MODULES)])
def test_examples_in_docstrings(name, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert doctest.testmod(importlib.import_module(name)).failed == 0


def test_the_main_functions_have_examples():
    finder = doctest.DocTestFinder()
    for item in (regionmesh, regionmesh.reconstruct, regionmesh.Mesh, regionmesh.load, regionmesh.from_arrays):
        assert any(test.examples for test in finder.find(item, getattr(item, "__name__", ""))), item


@pytest.mark.parametrize("owner", [regionmesh, regionmesh.Mesh])
def test_everything_public_has_a_docstring(owner):
    names = regionmesh.__all__ if owner is regionmesh else [name for name in vars(owner) if not name.startswith("_")]
    for name in names:
        assert name == "__version__" or getattr(owner, name).__doc__, name


def test_the_stubs_are_those_of_the_package():
    import make_stubs

    assert (ROOT / "python/regionmesh/__init__.pyi").read_text() == make_stubs.text(), "run python/tests/make_stubs.py"
