"""The programs in examples/python, on small input."""

import csv
import io
import subprocess
import sys
import zlib
from pathlib import Path

import numpy as np
import pytest

import regionmesh
from regionmesh import _programs

FOLDER = Path(__file__).resolve().parents[2] / "examples/python"


def run(name, *arguments, code=0):
    done = subprocess.run([sys.executable, FOLDER / name, *map(str, arguments)], capture_output=True, text=True)
    assert done.returncode == code, done.stdout + done.stderr
    return done.stdout


@pytest.fixture
def atlas(grains, tmp_path):
    path = tmp_path / "atlas.npy"
    np.save(path, np.where(grains < 12, grains, 0).astype(np.int16))
    return path


def write_png(path, section):
    """A grey image of 8 bits, without a library."""

    def chunk(kind, data):
        return len(data).to_bytes(4, "big") + kind + data + zlib.crc32(kind + data).to_bytes(4, "big")

    height, width = section.shape
    header = width.to_bytes(4, "big") + height.to_bytes(4, "big") + bytes([8, 0, 0, 0, 0])
    rows = b"".join(b"\0" + row.astype(np.uint8).tobytes() for row in section)
    path.write_bytes(
        b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b"")
    )


def test_every_example_is_tested_and_listed():
    page = (FOLDER / "README.md").read_text()
    names = {path.name for path in FOLDER.glob("*.py")}
    assert len(names) == 10
    for name in names:
        assert f"`{name}`" in page
        assert f'run("{name}"' in Path(__file__).read_text()


def test_atlas_to_web(atlas, tmp_path):
    assert "certified" in run("atlas_to_web.py", atlas, tmp_path / "page.html", "--reduce", "50%")
    assert "webgl2" in (tmp_path / "page.html").read_text()
    assert (tmp_path / "page.glb").read_bytes()[:4] == b"glTF"


def test_ebsd_to_abaqus(grains, tmp_path):
    ids = grains.copy()
    ids[5, 5, 5], ids[10:12, 3, 3] = 30, 0
    np.save(tmp_path / "grains.npy", ids)
    assert "24 regions" in run("ebsd_to_abaqus.py", tmp_path / "grains.npy", tmp_path / "model.inp")
    assert "*ELEMENT" in (tmp_path / "model.inp").read_text().upper()


def test_slices_to_stl(two_boxes, tmp_path):
    (tmp_path / "slices").mkdir()
    for number, section in enumerate(two_boxes):
        write_png(tmp_path / "slices" / f"s{number}.png", section)
    (tmp_path / "names.csv").write_text("label,name\n1,liver\n")
    printed = run("slices_to_stl.py", tmp_path / "slices", tmp_path / "out", "--names", tmp_path / "names.csv")
    assert "organ-liver.stl\n" in printed and "liver: 0.2 ml" in printed
    assert sorted(path.name for path in (tmp_path / "out").iterdir()) == ["organ-2.stl", "organ-liver.stl"]
    assert regionmesh.load(tmp_path / "out" / "organ-liver.stl").certified


def test_connectome(grains, tmp_path):
    zarr = pytest.importorskip("zarr")
    store = zarr.open(str(tmp_path / "a.zarr"), mode="w", shape=grains.shape, chunks=(6, 20, 20), dtype="u8")
    store[:] = np.where(grains < 12, grains, 0).astype(np.uint64) * 10**15
    printed = run("connectome.py", tmp_path / "a.zarr", tmp_path / "model.vtp", "--largest", 3)
    assert len(printed.splitlines()) == 3
    made = regionmesh.load(tmp_path / "model.vtp")
    labels, counts = np.unique(store[:], return_counts=True)
    largest = labels[1:][np.argsort(counts[1:])[-3:]]
    assert sorted(int(label) for label in made.regions["label"]) == sorted(int(label) for label in largest)


def test_grain_statistics(tmp_path):
    random = np.random.default_rng(2)
    seeds = random.uniform(0, 24, (60, 3))
    grid = np.stack(np.meshgrid(*[np.arange(24)] * 3, indexing="ij"), axis=-1)
    grains = ((grid[..., None, :] - seeds) ** 2).sum(axis=-1).argmin(axis=-1)
    np.save(tmp_path / "grains.npy", grains)
    assert "diameter: mean" in run("grain_statistics.py", tmp_path / "grains.npy", tmp_path / "table.csv")
    rows = list(csv.DictReader((tmp_path / "table.csv").open()))
    assert len(rows) == len(np.unique(grains))
    whole = [row for row in rows if row["whole"] == "1"]
    assert 0 < len(whole) < len(rows)
    for row in whole:
        count = (grains == int(row["grain"])).sum()
        assert float(row["diameter"]) == pytest.approx(np.cbrt(6 * count / np.pi), rel=0.1)
        assert 0.6 < float(row["sphericity"]) <= 1


def test_boreholes(tmp_path):
    if _programs.path_of("regionmesh-delaunay") is None:
        pytest.skip("regionmesh-delaunay is not built")
    random = np.random.default_rng(3)
    lines = ["hole,x,y,top,bottom,rock"]
    for hole in range(30):
        x, y = random.uniform(0, 100, 2)
        middle = 20 + x / 10
        lines += [f"{hole},{x},{y},0,{middle},1", f"{hole},{x},{y},{middle},50,2"]
    (tmp_path / "holes.csv").write_text("\n".join(lines) + "\n")
    columns = "hole=hole,x=x,y=y,top=top,bottom=bottom,label=rock"
    printed = run("boreholes.py", tmp_path / "holes.csv", tmp_path / "model.vtp", "--columns", columns)
    assert "cubic metres" in printed and (tmp_path / "model.vtp").exists()


def test_check_model(mesh, two_boxes, tmp_path):
    np.save(tmp_path / "labels.npy", two_boxes)
    mesh.save(tmp_path / "good.vtp")
    printed = run("check_model.py", tmp_path / "good.vtp", "--labels", tmp_path / "labels.npy")
    assert "certified" in printed and "0 of 1680 samples" in printed
    regionmesh.from_arrays(mesh.points, mesh.faces[9:], mesh.labels[9:]).save(tmp_path / "bad.vtp")
    assert "open_edge: " in run("check_model.py", tmp_path / "bad.vtp", code=3)


def test_resolutions(atlas, tmp_path):
    printed = run("resolutions.py", atlas, tmp_path / "model.vtp", "--levels", 3).splitlines()
    faces = [int(line.split()[1]) for line in printed]
    assert len(faces) == 3 and faces[0] > 2 * faces[1]
    assert all("certified" in line for line in printed)
    assert (tmp_path / "model-2.vtp").exists()


def test_dask_labels(grains, tmp_path):
    pytest.importorskip("dask.array")
    np.save(tmp_path / "image.npy", grains.astype(np.float32))
    printed = run("dask_labels.py", tmp_path / "image.npy", tmp_path / "model.vtp", "--thresholds", 6.5, 15.5)
    assert "2 regions" in printed and "certified" in printed


def test_batch(atlas, two_boxes, tmp_path):
    np.save(tmp_path / "boxes.npy", two_boxes)
    table = run("batch.py", tmp_path / "out", atlas, tmp_path / "boxes.npy", tmp_path / "none.npy", code=1)
    rows = {row["volume"]: row for row in csv.DictReader(io.StringIO(table))}
    assert rows["boxes.npy"]["regions"] == "2" and rows["atlas.npy"]["certified"] == "True"
    assert "none.npy" in rows["none.npy"]["error"]
    assert sorted(path.name for path in (tmp_path / "out").iterdir()) == ["atlas.vtp", "boxes.vtp"]
