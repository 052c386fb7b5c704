"""The program, the wheel, the stubs."""

import os
import subprocess
import sys
import zipfile
from pathlib import Path

import numpy as np
import pytest

import regionmesh

ROOT = Path(__file__).resolve().parents[2]
BUILT = Path(regionmesh.__file__).parent.parent.parent


def run(*arguments, **options):
    return subprocess.run(arguments, capture_output=True, text=True, **options)


def test_the_module_is_the_program(two_boxes, tmp_path):
    np.save(tmp_path / "labels.npy", two_boxes)
    done = run(sys.executable, "-m", "regionmesh", "reconstruct", tmp_path / "labels.npy", "-o", tmp_path / "model.vtp")
    assert done.returncode == 0, done.stderr
    made = regionmesh.load(tmp_path / "model.vtp")
    np.testing.assert_array_equal(made.points, regionmesh.reconstruct(two_boxes).points)


@pytest.mark.parametrize("arguments, code", [(["--version"], 0), (["reconstruct"], 2), (["check", "no.vtp"], 1)])
def test_the_program_returns_its_exit_code(arguments, code):
    done = run(sys.executable, "-m", "regionmesh", *arguments)
    assert done.returncode == code
    if arguments == ["--version"]:
        assert done.stdout.strip() == regionmesh.__version__


def test_the_version_is_that_of_the_project():
    assert f"project(regionmesh VERSION {regionmesh.__version__} " in (ROOT / "CMakeLists.txt").read_text()


@pytest.fixture(scope="module")
def wheel(tmp_path_factory):
    """The wheel of what is built, by the hooks that pip calls."""
    folder = tmp_path_factory.mktemp("wheel")
    hook = f"import regionmesh_backend as b; print(b.build_wheel({str(folder)!r}, {{'build-dir': {str(BUILT)!r}}}))"
    done = run(sys.executable, "-c", hook, cwd=ROOT, env={**os.environ, "PYTHONPATH": str(ROOT / "python/backend")})
    assert done.returncode == 0, done.stderr
    return folder / done.stdout.strip()


def test_a_wheel_works_where_it_is_unpacked(wheel, tmp_path, two_boxes):
    assert run(sys.executable, "-m", "zipfile", "-e", wheel, tmp_path).returncode == 0
    (tmp_path / "regionmesh/bin/regionmesh").chmod(0o755)
    program = """if True:
        import numpy as np, regionmesh
        labels = np.zeros((5, 5, 5), int)
        labels[2, 2, 2] = 1
        print(regionmesh.__file__, regionmesh.reconstruct(labels).certified)
    """
    environment = {"PYTHONPATH": str(tmp_path), "PATH": os.environ["PATH"]}
    done = run(sys.executable, "-c", program, env=environment, cwd=tmp_path)
    assert done.stdout.split() == [str(tmp_path / "regionmesh/__init__.py"), "True"], done.stderr
    assert run(sys.executable, "-m", "regionmesh", "--version", env=environment, cwd=tmp_path).returncode == 0


def test_a_wheel_brings_the_libraries_that_it_loads(wheel, tmp_path):
    run(sys.executable, "-m", "zipfile", "-e", wheel, tmp_path)
    (module,) = (tmp_path / "regionmesh").glob("_core*.so")
    brought = str(tmp_path / "regionmesh")
    for file in (module, *(tmp_path / "regionmesh/bin").iterdir()):
        file.chmod(0o755)
        lines = run("ldd", file).stdout.splitlines()
        # libjpeg is loaded by libtiff, which knows nothing of the wheel.
        names = {"regionmesh-hdf5": ["libhdf5", "libsz"], "regionmesh-dicom": ["libdcmdata", "libicuuc"]}
        names = names.get(file.name, ["libtbb", "libgmp", "libfmt", "libjpeg"])
        found = [line for line in lines if any(name in line for name in names)]
        assert len(found) >= len(names), file
        for line in found:
            assert brought in line
    # A part of the C library that fits no other version of it.
    assert not list((tmp_path / "regionmesh/lib").glob("libresolv*"))


def test_a_wheel_holds_the_licences_of_what_it_brings(wheel):
    with zipfile.ZipFile(wheel) as archive:
        texts = {Path(name).name: archive.read(name) for name in archive.namelist() if ".dist-info/licenses/" in name}
    assert b"three.js" in texts["compiled-in"] and b"pybind11" in texts["compiled-in"]
    if Path("/usr/share/doc/libgmp10/copyright").exists():
        assert b"Free Software Foundation" in texts["libgmp10"]


def test_pip_installs_the_wheel(wheel, tmp_path):
    done = run(sys.executable, "-m", "pip", "install", "--no-index", "--no-deps", "--target", tmp_path, wheel)
    if "No module named pip" in done.stderr:
        pytest.skip("pip is not installed")
    assert done.returncode == 0, done.stderr
    assert list(tmp_path.glob("*.dist-info/RECORD"))
    assert run(tmp_path / "bin" / "regionmesh", "--version", env={"PYTHONPATH": str(tmp_path)}).returncode == 0


def test_the_record_of_a_wheel_lists_every_file(wheel):
    with zipfile.ZipFile(wheel) as archive:
        names = set(archive.namelist())
        (record,) = (name for name in names if name.endswith("/RECORD"))
        listed = {line.split(",")[0] for line in archive.read(record).decode().splitlines()}
    assert listed == names
    assert {"regionmesh/__init__.py", "regionmesh/py.typed", "regionmesh/bin/regionmesh"} <= names


def test_the_files_of_a_wheel_have_no_time_of_the_build(wheel):
    with zipfile.ZipFile(wheel) as archive:
        assert {info.date_time for info in archive.infolist()} == {(2000, 1, 1, 0, 0, 0)}


@pytest.fixture
def backend():
    """The module with the hooks that pip calls."""
    sys.path.insert(0, str(ROOT / "python/backend"))
    try:
        import regionmesh_backend
    finally:
        sys.path.pop(0)
    return regionmesh_backend


def test_metadata_is_that_of_the_wheel_without_a_build(backend, wheel, tmp_path):
    folder = backend.prepare_metadata_for_build_wheel(tmp_path)
    with zipfile.ZipFile(wheel) as archive:
        held = {name for name in archive.namelist() if name.startswith(f"{folder}/") and "/licenses/" not in name}
        assert held == {f"{folder}/{path.name}" for path in (tmp_path / folder).iterdir()} | {f"{folder}/RECORD"}
        for path in (tmp_path / folder).iterdir():
            assert archive.read(f"{folder}/{path.name}") == path.read_bytes()


def test_an_archive_of_sources_holds_what_a_build_needs(backend, tmp_path):
    name = backend.build_sdist(tmp_path)
    listed = run("tar", "-tzf", tmp_path / name).stdout.split()
    base = name.removesuffix(".tar.gz")
    for path in ("CMakeLists.txt", "pyproject.toml", "python/CMakeLists.txt", "src/base/stop.cpp", "PKG-INFO",
                 "viewer/dist/page.html", "docs/reference/files.md", "examples/CMakeLists.txt"):
        assert f"{base}/{path}" in listed
    assert not [path for path in listed if "__pycache__" in path]
    run("tar", "-xzf", tmp_path / name, "-C", tmp_path)
    parts = [f"-DREGIONMESH_{part}=OFF" for part in ("TESTS", "DELAUNAY", "WITH_HDF5", "WITH_DICOM")]
    done = run("cmake", "-S", tmp_path / base, "-B", tmp_path / "build", "-DREGIONMESH_WITH_PYTHON=ON", *parts)
    assert done.returncode == 0, done.stderr
