"""Every form in which labels come."""

import os
import pickle
import subprocess
import sys
import tempfile
import types
import warnings

import numpy as np
import pytest

import regionmesh

INTEGERS = [np.int8, np.uint8, np.int16, np.uint16, np.int32, np.uint32, np.int64, np.uint64]


def same(a, b):
    np.testing.assert_array_equal(a.points, b.points)
    np.testing.assert_array_equal(a.faces, b.faces)
    np.testing.assert_array_equal(a.labels, b.labels)


@pytest.mark.parametrize("dtype", INTEGERS)
def test_every_integer_type(two_boxes, mesh, dtype):
    made = regionmesh.reconstruct(two_boxes.astype(dtype))
    np.testing.assert_array_equal(made.points, mesh.points)
    assert made.labels.dtype == (np.uint64 if dtype == np.uint64 else np.int64)


@pytest.mark.parametrize("dtype", [t for t in INTEGERS if np.dtype(t).itemsize > 1])
def test_the_other_byte_order(two_boxes, mesh, dtype):
    other = two_boxes.astype(np.dtype(dtype).newbyteorder())
    assert not other.dtype.isnative
    same(regionmesh.reconstruct(other), regionmesh.reconstruct(two_boxes.astype(dtype), sweep="z"))


def test_bool(two_boxes):
    made = regionmesh.reconstruct(two_boxes > 0)
    assert list(made.regions["label"]) == [1]
    same(made, regionmesh.reconstruct((two_boxes > 0).astype(np.uint8)))


@pytest.mark.parametrize("dtype", [np.float32, np.float64, np.complex64, object, "S1", "M8[s]"])
def test_other_types_are_refused(two_boxes, dtype):
    with pytest.raises(TypeError, match="give integers"):
        regionmesh.reconstruct(two_boxes.astype(np.int64).astype(dtype))


STRIDES = {
    "fortran": lambda a: np.asfortranarray(a),
    "reversed": lambda a: np.ascontiguousarray(a[::-1, ::-1, ::-1])[::-1, ::-1, ::-1],
    "transposed": lambda a: np.ascontiguousarray(a.T).T,
    "every second": lambda a: a.repeat(2, 0).repeat(3, 2)[::2, :, ::3],
    "window": lambda a: np.pad(a, 3)[3:-3, 3:-3, 3:-3],
    "field": lambda a: np.array(list(zip(a.ravel(), a.ravel())), [("x", "u1"), ("y", "u1")])["y"].reshape(a.shape),
    "unaligned": lambda a: np.frombuffer(b"x" + a.astype("<i4").tobytes(), np.uint8)[1:].view("<i4").reshape(a.shape),
    "read-only": lambda a: np.frombuffer(a.tobytes(), a.dtype).reshape(a.shape),
}


@pytest.mark.parametrize("name", STRIDES)
def test_any_strides(two_boxes, mesh, name):
    array = STRIDES[name](two_boxes)
    np.testing.assert_array_equal(array, two_boxes)
    np.testing.assert_array_equal(regionmesh.reconstruct(array).points, mesh.points)


def test_a_broadcast_array_has_stride_zero():
    section = np.zeros((8, 9), np.uint8)
    section[2:6, 3:7] = 4
    flat = np.broadcast_to(section, (50, 8, 9))
    same(regionmesh.reconstruct(flat), regionmesh.reconstruct(flat.copy()))


def test_an_array_is_not_copied():
    """A copy of the array would take 512 MB. It is read once before, since some kernels count zeros that are read."""
    program = """if True:
        import numpy as np, regionmesh, resource
        labels = np.zeros((400, 400, 400), np.int64)
        labels[10:20, 10:20, 10:20] = 1
        assert labels.max() == 1
        before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
        assert regionmesh.reconstruct(labels).certified
        print(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before)
    """
    kilobytes = int(subprocess.run([sys.executable, "-c", program], check=True, capture_output=True).stdout)
    assert kilobytes < 150_000


def test_negative_labels(two_boxes):
    made = regionmesh.reconstruct(two_boxes.astype(np.int32) * -7)
    assert list(made.regions["label"]) == [-14, -7]
    assert made.exterior_label == -15


def test_labels_of_64_bits(two_boxes):
    factor = 2**61 - 1
    made = regionmesh.reconstruct(two_boxes.astype(np.int64) * factor)
    assert list(made.regions["label"]) == [factor, 2 * factor]
    made = regionmesh.reconstruct(two_boxes.astype(np.uint64) * np.uint64(2**63 - 1) + np.uint64(0))
    assert [int(label) for label in made.regions["label"]] == [2**63 - 1, 2**64 - 2]
    assert made.labels.dtype == np.uint64


def test_large_unsigned_labels_are_kept_and_background(two_boxes):
    big = two_boxes.astype(np.uint64)
    big[big == 2] = 2**64 - 1
    big[big == 0] = 2**63 + 5
    made = regionmesh.reconstruct(big, background=2**63 + 5, labels_to_keep=[2**64 - 1])
    assert [int(label) for label in made.regions["label"]] == [2**64 - 1]
    assert len(made.region(2**64 - 1).faces) == len(made)


@pytest.mark.parametrize("shape", [(0, 4, 4), (4, 0, 4), (4, 4, 0), (1, 5, 5), (5, 1, 5), (5, 5, 1)])
def test_a_volume_without_cells_is_refused(shape):
    with pytest.raises(ValueError):
        regionmesh.reconstruct(np.ones(shape, np.uint8))


@pytest.mark.parametrize("shape", [(), (4,), (4, 4), (2, 4, 4, 4)])
def test_other_numbers_of_axes_are_refused(shape):
    with pytest.raises(ValueError, match="axes"):
        regionmesh.reconstruct(np.ones(shape, np.uint8))


@pytest.mark.parametrize("labels", [None, 5, 2.5, {1, 2}, object()])
def test_what_is_no_volume_is_refused(labels):
    with pytest.raises((TypeError, ValueError), match="labels"):
        regionmesh.reconstruct(labels)


def test_a_volume_of_background_has_no_faces():
    made = regionmesh.reconstruct(np.zeros((4, 4, 4), np.uint8))
    assert len(made) == 0 and made.points.shape == (0, 3) and made.labels.shape == (0, 2)
    assert made.certified
    assert len(made.regions["label"]) == 0 and len(made.interfaces["area"]) == 0
    assert np.isnan(made.bounds).all()


def test_nested_lists(two_boxes):
    lists = [section.tolist() for section in two_boxes]
    same(regionmesh.reconstruct(lists), regionmesh.reconstruct(two_boxes.astype(int)))


# Iterators of sections


def test_a_list_of_sections(two_boxes, mesh):
    same(regionmesh.reconstruct(list(two_boxes), sweep=None), regionmesh.reconstruct(two_boxes, sweep="z"))


def test_a_generator_of_known_length_is_streamed(two_boxes):
    held = []

    def sections():
        for section in two_boxes:
            held.append(True)
            yield section.copy()

    made = regionmesh.reconstruct(sections(), sections=len(two_boxes))
    assert len(held) == len(two_boxes)
    np.testing.assert_array_equal(made.points, regionmesh.reconstruct(two_boxes, sweep="z").points)
    assert "samples" not in made.report  # read once: not compared


def test_a_generator_of_unknown_length_goes_through_a_file(two_boxes, tmp_path, monkeypatch):
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    made = regionmesh.reconstruct(section for section in two_boxes)
    same(made, regionmesh.reconstruct(two_boxes))
    assert made.report["samples_wrong"] == 0
    assert os.listdir(tmp_path) == []


@pytest.mark.parametrize("known", [True, False])
def test_an_exception_of_a_generator_comes_through(two_boxes, known):
    class Broken(Exception):
        pass

    def sections():
        yield from two_boxes[:4]
        raise Broken("scanner")

    with pytest.raises(Broken, match="scanner"):
        regionmesh.reconstruct(sections(), sections=len(two_boxes) if known else None)


def test_a_generator_that_is_too_short_names_the_section(two_boxes):
    with pytest.raises(ValueError, match="section 5: missing; 14 sections were announced"):
        regionmesh.reconstruct(iter(two_boxes[:5]), sections=14)


@pytest.mark.parametrize("known", [True, False])
def test_sections_of_different_size_are_refused(two_boxes, known):
    sections = [*two_boxes[:3], two_boxes[3, :5]]
    with pytest.raises(ValueError, match="section 3: .*one size"):
        regionmesh.reconstruct(iter(sections), sections=4 if known else None)


def test_other_numbers_of_sections_than_announced_are_refused(two_boxes):
    with pytest.raises(ValueError, match=f"more than the {len(two_boxes) - 1} sections that were announced"):
        regionmesh.reconstruct(iter(two_boxes), sections=len(two_boxes) - 1)
    for count in -1, 1 << 33:
        with pytest.raises(ValueError, match=f"sections={count}: not a number of sections"):
            regionmesh.reconstruct(iter(two_boxes), sections=count)
    for count in 13.5, "13":
        with pytest.raises(TypeError, match="not a whole number"):
            regionmesh.reconstruct(iter(two_boxes), sections=count)
    with pytest.raises(ValueError, match="sections: is for iterators"):
        regionmesh.reconstruct(list(two_boxes), sections=5)


def test_sections_of_several_types_are_refused(two_boxes):
    sections = [section.astype(np.int8 if n < 2 else np.uint64) for n, section in enumerate(two_boxes)]
    with pytest.raises(ValueError, match="labels section 2: .* uint64, the first has .* int8"):
        regionmesh.reconstruct(sections)


@pytest.mark.parametrize(
    "options, error, said",
    [
        ({"names": {2**70: "a"}}, ValueError, "more than 64 bits"),
        ({"names": {1.5: "a"}}, TypeError, "not a whole number"),
        ({"names": {1: "\ud800"}}, ValueError, "no UTF-8"),
        ({"labels_to_keep": [2**70]}, ValueError, "more than 64 bits"),
        ({"spacing": "1,1,1"}, TypeError, "spacing='1,1,1': not three numbers"),
        ({"spacing": "125"}, TypeError, "spacing='125': not three numbers"),
        ({"labels_to_keep": ["a"]}, TypeError, "label 'a': not a whole number"),
        ({"labels_to_keep": [float("inf")]}, TypeError, "label inf: not a whole number"),
    ],
)
def test_values_that_are_none_are_refused_in_one_line(two_boxes, options, error, said):
    with pytest.raises(error, match=said) as refused:
        regionmesh.reconstruct(two_boxes, **options)
    assert "\n" not in str(refused.value)


@pytest.mark.parametrize("bad", [np.zeros((2, 3, 4), np.uint8), np.zeros(5, np.uint8)])
def test_sections_with_other_axes_are_refused(two_boxes, bad):
    with pytest.raises(ValueError, match="axes"):
        regionmesh.reconstruct(iter([two_boxes[0], bad]), sections=2)


def test_sections_of_floats_are_refused(two_boxes):
    with pytest.raises(TypeError, match="give integers"):
        regionmesh.reconstruct(iter(two_boxes.astype(float)), sections=14)


def test_no_sections_are_refused():
    with pytest.raises(ValueError, match="no sections"):
        regionmesh.reconstruct(iter([]))


def test_a_generator_is_closed_after_an_error(two_boxes):
    closed = []

    def sections():
        try:
            for _ in range(3):
                yield two_boxes[0]
            yield two_boxes[0, :3]
        finally:
            closed.append(True)

    with pytest.raises(ValueError):
        regionmesh.reconstruct(sections(), sections=9)
    assert closed


# Arrays on disk


def test_a_memory_map(two_boxes, tmp_path):
    np.save(tmp_path / "labels.npy", two_boxes)
    mapped = np.load(tmp_path / "labels.npy", mmap_mode="r")
    same(regionmesh.reconstruct(mapped), regionmesh.reconstruct(two_boxes))


def test_zarr_is_read_a_chunk_at_a_time(two_boxes, tmp_path):
    zarr = pytest.importorskip("zarr")
    array = zarr.open(str(tmp_path / "a.zarr"), mode="w", shape=two_boxes.shape, chunks=(4, 12, 10), dtype="u1")
    array[:] = two_boxes
    same(regionmesh.reconstruct(array), regionmesh.reconstruct(two_boxes, sweep="z"))


def test_h5py(two_boxes, tmp_path):
    h5py = pytest.importorskip("h5py")
    with h5py.File(tmp_path / "a.h5", "w") as file:
        file.create_dataset("labels", data=two_boxes, chunks=(3, 5, 5), compression="gzip")
    with h5py.File(tmp_path / "a.h5") as file:
        same(regionmesh.reconstruct(file["labels"]), regionmesh.reconstruct(two_boxes, sweep="z"))


def test_dask(two_boxes):
    dask_array = pytest.importorskip("dask.array")
    array = dask_array.from_array(two_boxes, chunks=(5, 6, 6))
    same(regionmesh.reconstruct(array), regionmesh.reconstruct(two_boxes, sweep="z"))


def test_an_array_on_disk_is_read_by_slabs_of_its_chunks(two_boxes):
    class Array:
        shape, dtype, chunks = two_boxes.shape, two_boxes.dtype, (4, 12, 10)
        reads = []

        def __getitem__(self, key):
            self.reads.append((key.start, key.stop))
            return two_boxes[key]

    same(regionmesh.reconstruct(Array()), regionmesh.reconstruct(two_boxes, sweep="z"))
    assert Array.reads[:4] == [(0, 4), (4, 8), (8, 12), (12, 16)]


def test_an_exception_of_an_array_on_disk_comes_through(two_boxes):
    class Array:
        shape, dtype = two_boxes.shape, two_boxes.dtype

        def __getitem__(self, key):
            raise OSError("disk")

    with pytest.raises(OSError, match="disk"):
        regionmesh.reconstruct(Array())


def test_an_object_with_types_of_its_own_becomes_an_array(two_boxes, mesh):
    class Tensor:
        shape, dtype = two_boxes.shape, "its uint8"

        def __array__(self, dtype=None):
            return two_boxes

    same(regionmesh.reconstruct(Tensor()), mesh)


# Images


def test_nibabel_gives_spacing_origin_and_axes(two_boxes, tmp_path):
    nibabel = pytest.importorskip("nibabel")
    affine = np.array([[0, -2.0, 0, 5], [1, 0, 0, 6], [0, 0, 3, 7], [0, 0, 0, 1]])
    image = nibabel.Nifti1Image(np.ascontiguousarray(two_boxes.T), affine)
    nibabel.save(image, tmp_path / "labels.nii.gz")
    expected = regionmesh.reconstruct(
        two_boxes, sweep="z", spacing=(1, 2, 3), origin=(5, 6, 7), direction=[[0, -1, 0], [1, 0, 0], [0, 0, 1]]
    )
    for opened in (image, nibabel.load(tmp_path / "labels.nii.gz")):
        made = regionmesh.reconstruct(opened, sweep="z")
        np.testing.assert_allclose(made.points, expected.points)
    from_file = regionmesh.reconstruct(tmp_path / "labels.nii.gz", sweep="z")
    np.testing.assert_allclose(from_file.points, expected.points)


def test_nibabel_gives_the_unit_of_length(two_boxes, tmp_path):
    nibabel = pytest.importorskip("nibabel")
    from nibabel.freesurfer import MGHImage

    samples = np.ascontiguousarray(two_boxes.T)
    assert regionmesh.reconstruct(nibabel.Nifti1Image(samples, np.eye(4))).metres is None
    for unit, metres in (("meter", 1), ("mm", 0.001), ("micron", 1e-6)):
        image = nibabel.Nifti1Image(samples, np.eye(4))
        image.header.set_xyzt_units(unit)
        nibabel.save(image, tmp_path / "labels.nii")
        for source in (image, nibabel.load(tmp_path / "labels.nii"), tmp_path / "labels.nii"):
            assert regionmesh.reconstruct(source).metres == metres
    for code, metres in ((5, None), (8, None), (66, 0.001)):  # the others are times
        image.header["xyzt_units"] = code
        nibabel.save(image, tmp_path / "labels.nii")
        for source in (image, tmp_path / "labels.nii"):
            assert regionmesh.reconstruct(source).metres == metres
    assert regionmesh.reconstruct(nibabel.Spm99AnalyzeImage(samples.astype(np.int16), np.eye(4))).metres is None
    assert regionmesh.reconstruct(MGHImage(samples.astype(np.int32), np.eye(4))).metres == 0.001


def test_nibabel_with_sheared_axes_is_read_as_its_file_is(two_boxes, tmp_path):
    nibabel = pytest.importorskip("nibabel")
    affine = np.array([[1, 0.5, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1.0]])
    image = nibabel.Nifti1Image(np.ascontiguousarray(two_boxes.T), affine)
    nibabel.save(image, tmp_path / "sheared.nii")
    from_file = regionmesh.reconstruct(tmp_path / "sheared.nii", sweep="z")
    made = regionmesh.reconstruct(image, sweep="z")
    np.testing.assert_allclose(made.points, from_file.points)
    for mesh in (made, from_file, pickle.loads(pickle.dumps(made))):
        assert mesh.simplify(reduce=0.3).certified and mesh.improve().certified
        np.testing.assert_array_equal(mesh.voxelise(), two_boxes)
        for labels in (image, two_boxes, tmp_path / "sheared.nii"):
            assert mesh.check(labels)["samples_wrong"] == 0


def test_a_direction_with_sheared_axes_is_refused(two_boxes, mesh):
    sheared, rounded = [[1, 0.5, 0], [0, 1, 0], [0, 0, 1]], [[0.866, -0.5, 0], [0.5, 0.866, 0], [0, 0, 1]]
    for call in (lambda turn: regionmesh.reconstruct(two_boxes, direction=turn), lambda turn: mesh.voxelise(direction=turn)):
        call(rounded)
        with pytest.raises(ValueError, match="direction: the columns are not orthonormal"):
            call(sheared)


def test_images_of_nibabel_are_in_ras(two_boxes, tmp_path):
    nibabel = pytest.importorskip("nibabel")
    affine = np.diag([1.0, 2, 3, 1]) + np.pad([[10], [20], [30], [0]], ((0, 0), (3, 0)))
    image = nibabel.Nifti1Image(np.ascontiguousarray(two_boxes.T), affine)
    nibabel.save(image, tmp_path / "labels.nii.gz")
    assert regionmesh.reconstruct(image).space == "RAS"
    for source in (image, tmp_path / "labels.nii.gz"):
        turned = regionmesh.reconstruct(source, space="lps", sweep="z")
        assert turned.space == "LPS" and np.all(turned.bounds[:, :2] < 0)
        turned.save(tmp_path / "turned.vtp")
        for mesh in (turned, regionmesh.load(tmp_path / "turned.vtp")):
            for labels in (image, nibabel.load(tmp_path / "labels.nii.gz"), tmp_path / "labels.nii.gz"):
                assert mesh.check(labels)["samples_wrong"] == 0
                np.testing.assert_array_equal(mesh.voxelise(labels), two_boxes)
    assert regionmesh.reconstruct(two_boxes).space is None
    assert regionmesh.reconstruct(two_boxes, space="lps").space == "LPS"


def test_nibabel_may_have_axes_of_one_sample(two_boxes, tmp_path):
    nibabel = pytest.importorskip("nibabel")
    samples = np.ascontiguousarray(two_boxes.T)[..., np.newaxis]
    nibabel.save(nibabel.Nifti1Image(samples, np.eye(4)), tmp_path / "four.nii")
    for image in (nibabel.Nifti1Image(samples, np.eye(4)), nibabel.load(tmp_path / "four.nii")):
        same(regionmesh.reconstruct(image, sweep="z"), regionmesh.reconstruct(two_boxes, sweep="z"))
    with pytest.raises(ValueError, match=r"an image of shape \(.*, 2\); give one of three axes"):
        regionmesh.reconstruct(nibabel.Nifti1Image(np.repeat(samples, 2, axis=3), np.eye(4)))


def test_compressed_images_are_read_at_once(two_boxes, tmp_path, monkeypatch):
    """Not section by section, each of which reads the file from its beginning."""
    nibabel = pytest.importorskip("nibabel")
    nibabel.save(nibabel.Nifti1Image(np.ascontiguousarray(two_boxes.T), np.eye(4)), tmp_path / "labels.nii.gz")
    monkeypatch.delattr(nibabel.arrayproxy.ArrayProxy, "__getitem__")
    same(regionmesh.reconstruct(nibabel.load(tmp_path / "labels.nii.gz")), regionmesh.reconstruct(two_boxes))


def test_an_image_of_simpleitk(two_boxes):
    simpleitk = pytest.importorskip("SimpleITK")
    image = simpleitk.GetImageFromArray(two_boxes)
    image.SetSpacing((1, 2, 4))
    image.SetOrigin((10, 20, 30))
    made = regionmesh.reconstruct(image)
    same(made, regionmesh.reconstruct(two_boxes, spacing=(1, 2, 4), origin=(10, 20, 30)))
    assert made.space == "LPS"


def test_the_interface_of_simpleitk(two_boxes, monkeypatch):
    """The four functions that are called, where SimpleITK is not installed."""
    module = types.ModuleType("itk_like")
    module.GetArrayViewFromImage = lambda image: image.data

    class Image:
        __module__ = "itk_like"
        data = two_boxes

        def GetSpacing(self):
            return (1.0, 2.0, 4.0)

        def GetOrigin(self):
            return (10.0, 20.0, 30.0)

        def GetDirection(self):
            return (1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0)

    monkeypatch.setitem(sys.modules, "itk_like", module)
    same(regionmesh.reconstruct(Image()), regionmesh.reconstruct(two_boxes, spacing=(1, 2, 4), origin=(10, 20, 30)))

    class Read(Image):
        __module__ = "itk_like"

        def __init__(self, **entries):
            self.entries = entries

        def HasMetaDataKey(self, key):
            return key in self.entries

        def GetMetaData(self, key):
            return self.entries[key]

    for entries, metres in (
        ({}, None),
        ({"xyzt_units": "0"}, None),
        ({"xyzt_units": "8"}, None),  # seconds
        ({"xyzt_units": "10"}, 0.001),  # millimetres and seconds
        ({"xyzt_units": "3"}, 0.001),  # micrometres, which ITK converts
        ({"0008|0016": "1.2.840.10008.5.1.4.1.1.66.4"}, 0.001),
    ):
        assert regionmesh.reconstruct(Read(**entries)).metres == metres


def test_a_model_in_a_unit_that_is_given(two_boxes, tmp_path):
    np.save(tmp_path / "labels.npy", two_boxes)
    for source in (two_boxes, tmp_path / "labels.npy"):
        assert regionmesh.reconstruct(source).metres is None
        made = regionmesh.reconstruct(source, units="ft")
        assert made.metres == 0.3048
    made.save(tmp_path / "m.vtp")
    assert regionmesh.load(tmp_path / "m.vtp").metres == 0.3048
    copy = regionmesh.from_arrays(made.points, made.faces, made.labels, units="mm")
    assert copy.metres == 0.001
    with pytest.warns(UserWarning, match="the mesh is in mm and the other in ft; they are compared as they are"):
        copy.compare(made)
    with pytest.raises(ValueError, match="units=furlong"):
        regionmesh.reconstruct(two_boxes, units="furlong")


def test_labels_in_another_unit_are_worth_a_warning(two_boxes, tmp_path):
    nibabel = pytest.importorskip("nibabel")
    image = nibabel.Nifti1Image(np.ascontiguousarray(two_boxes.T), np.eye(4))
    image.header.set_xyzt_units("meter")
    nibabel.save(image, tmp_path / "labels.nii")
    made = regionmesh.reconstruct(tmp_path / "labels.nii", units="mm")
    for labels in (image, tmp_path / "labels.nii"):
        with pytest.warns(UserWarning, match="check: the mesh is in mm and labels in m; they are compared"):
            assert made.check(labels)["samples_wrong"] == 0


# Files


def test_a_path(two_boxes, mesh, tmp_path):
    np.save(tmp_path / "labels.npy", two_boxes)
    for path in (tmp_path / "labels.npy", str(tmp_path / "labels.npy"), [tmp_path / "labels.npy"]):
        same(regionmesh.reconstruct(path), mesh)


def test_a_model_of_a_file_knows_its_lattice(two_boxes, tmp_path):
    np.save(tmp_path / "labels.npy", two_boxes)
    made = regionmesh.reconstruct(tmp_path / "labels.npy", spacing=(1, 2, 3))
    again = made.voxelise()
    assert again.dtype == np.uint8
    np.testing.assert_array_equal(again, two_boxes)
    assert made.check(two_boxes)["samples_wrong"] == 0


def test_a_path_takes_the_options_of_its_format(two_boxes, tmp_path):
    (tmp_path / "labels.raw").write_bytes(two_boxes.tobytes())
    made = regionmesh.reconstruct(tmp_path / "labels.raw", size=(10, 12, 14), type="uint8", spacing=(1, 2, 3))
    same(made, regionmesh.reconstruct(two_boxes, spacing=(1, 2, 3)))


def test_a_table_of_points(tmp_path):
    random = np.random.default_rng(0)
    points = random.uniform(0, 10, (300, 3))
    rows = "".join(f"{x},{y},{z},{1 + (x > 5)}\n" for x, y, z in points)
    (tmp_path / "points.csv").write_text("x,y,z,label\n" + rows)
    try:
        made = regionmesh.reconstruct(tmp_path / "points.csv", background=None)
    except ValueError as error:
        assert "regionmesh-delaunay: not found" in str(error)
        pytest.skip("regionmesh-delaunay is not built")
    assert list(made.regions["label"]) == [1, 2]


def test_a_word_among_the_labels_of_a_table_is_a_warning(tmp_path):
    rows = "".join(f"{at},0,4,1\n{at},4,9,sand\n" for at in ["0,0", "9,0", "0,9", "9,8"])
    (tmp_path / "holes.csv").write_text("x,y,from,to,unit\n" + rows)
    with pytest.warns(UserWarning, match="holes.csv: label '1' is a whole number and 'sand' is none"):
        made = regionmesh.reconstruct(tmp_path / "holes.csv", layers="auto")
    assert made.names == {1: "1", 2: "sand"}
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        with pytest.raises(UserWarning):  # before the run
            regionmesh.reconstruct(tmp_path / "holes.csv", layers="auto", progress=lambda *_: pytest.fail("it runs"))


def test_a_missing_file_is_not_found(tmp_path):
    with pytest.raises(FileNotFoundError, match="nothing.nii.gz"):
        regionmesh.reconstruct(tmp_path / "nothing.nii.gz")
    with pytest.raises(FileNotFoundError, match="nothing.vtp"):
        regionmesh.load(tmp_path / "nothing.vtp")
    labels = np.zeros((4, 4, 4), np.uint8)
    labels[1:3, 1:3, 1:3] = 1
    with pytest.raises(FileNotFoundError, match="nothing.csv"):
        regionmesh.reconstruct(labels, names=tmp_path / "nothing.csv")
    with pytest.raises(FileNotFoundError, match="nothing.npy"):
        regionmesh.reconstruct(labels).check(tmp_path / "nothing.npy")


def test_sections_by_calls_sweep_along_z_only(two_boxes):
    same(regionmesh.reconstruct(list(two_boxes), sweep="z"), regionmesh.reconstruct(two_boxes, sweep="z"))
    for labels in list(two_boxes), two_boxes.astype(">u2"):
        with pytest.raises(ValueError, match="along z only"):
            regionmesh.reconstruct(labels, sweep="x")


@pytest.mark.parametrize("name, text", [("a.nrrd", "no header"), ("a.txt", "text"), ("a.npy", "")])
def test_a_damaged_file_raises_one_line(tmp_path, name, text):
    (tmp_path / name).write_text(text)
    with pytest.raises(ValueError) as raised:
        regionmesh.reconstruct(tmp_path / name)
    assert name in str(raised.value) and "\n" not in str(raised.value)


@pytest.mark.parametrize("option", [{"origin": (0, 0, 0)}, {"direction": np.eye(3)}])
def test_place_in_space_is_that_of_the_file(tmp_path, two_boxes, option):
    np.save(tmp_path / "labels.npy", two_boxes)
    with pytest.raises(TypeError, match="of the file"):
        regionmesh.reconstruct(tmp_path / "labels.npy", **option)


@pytest.mark.parametrize("option", ["layer", "size", "type", "columns", "step", "array"])
def test_options_of_files_do_not_apply_to_arrays(two_boxes, option):
    with pytest.raises(TypeError, match=f"{option} applies to files"):
        regionmesh.reconstruct(two_boxes, **{option: 1})


def _the_smaller_of_two_sections(labels):
    """Of two samples with different labels: the one that is no background, then the smaller."""
    a, b = labels[::2], labels[1::2]
    return np.where(a == 0, b, np.where(b == 0, a, np.minimum(a, b)))


@pytest.mark.parametrize(
    "options, same",
    [
        ({"roi": "2:9,:,3:"}, lambda v: v[3:, :, 2:9]),
        ({"box": "0:6,:,:"}, lambda v: v[:, :, :7]),
        ({"downsample": "1,1,2"}, _the_smaller_of_two_sections),
    ],
)
def test_arrays_and_sections_are_chosen_from_as_files_are(two_boxes, tmp_path, options, same):
    np.save(tmp_path / "v.npy", two_boxes)
    direct = regionmesh.reconstruct(two_boxes, decimate=False, **options)
    for labels in (tmp_path / "v.npy", list(two_boxes), (section for section in two_boxes)):
        other = regionmesh.reconstruct(labels, decimate=False, **options)
        np.testing.assert_array_equal(direct.points, other.points)
    part = same(two_boxes)
    assert direct.report["regions"] and len(direct.faces) == len(regionmesh.reconstruct(part, decimate=False).faces)
    np.testing.assert_array_equal(direct.voxelise(), part)


def test_small_regions_are_given_away(two_boxes):
    labels = two_boxes.copy()
    labels[12, 10, 8] = 9
    assert 9 in regionmesh.reconstruct(labels).regions["label"]
    assert 9 not in regionmesh.reconstruct(labels, min_region=2).regions["label"]
    with pytest.raises(ValueError, match="min_region"):
        regionmesh.reconstruct((section for section in labels), sections=len(labels), min_region=2)


def test_masked_arrays_are_refused(grains):
    masked = np.ma.masked_array(grains, mask=grains == 2)
    for labels in masked, list(masked):
        with pytest.raises(TypeError, match="masked"):
            regionmesh.reconstruct(labels)


def test_of_several_files_none_may_be_a_table(two_boxes, tmp_path):
    np.save(tmp_path / "v.npy", two_boxes)
    (tmp_path / "p.csv").write_text("x,y,z,label\n0,0,0,1\n1,0,0,1\n0,1,0,2\n0,0,1,2\n")
    for paths in ["p.csv", "nothing.csv"], ["v.npy", "p.csv"], ["p.csv", "v.npy"]:
        with pytest.raises((ValueError, FileNotFoundError), match=f"{paths[1]}: one table or mesh at a time"):
            regionmesh.reconstruct([tmp_path / path for path in paths])


def test_a_missing_table_beside_another_is_not_found(tmp_path):
    (tmp_path / "i.csv").write_text("hole,from,to,unit\nA,0,1,sand\n")
    with pytest.raises(FileNotFoundError, match="nothing.csv"):
        regionmesh.reconstruct(tmp_path / "i.csv", collars=tmp_path / "nothing.csv")


def test_a_table_of_names_has_colours(two_boxes, tmp_path):
    (tmp_path / "names.csv").write_text("label,name,color\n1,bone,#ff8000\n")
    np.save(tmp_path / "v.npy", two_boxes)
    for labels in two_boxes, tmp_path / "v.npy":
        made = regionmesh.reconstruct(labels, names=tmp_path / "names.csv")
        made.save(tmp_path / "m.glb")
        plain = regionmesh.reconstruct(labels, names={1: "bone"})
        plain.save(tmp_path / "plain.glb")
        assert made.names == plain.names == {1: "bone"}
        assert (tmp_path / "m.glb").read_bytes() != (tmp_path / "plain.glb").read_bytes()


def test_arguments_of_another_kind_are_refused(two_boxes, tmp_path):
    np.save(tmp_path / "v.npy", two_boxes)
    for labels, options, wanted in [
        (tmp_path / "v.npy", {"sections": 5}, "sections applies to iterators"),
        (two_boxes, {"labels_to_keep": 3}, "labels_to_keep=3: not a sequence"),
        (two_boxes, {"names": ["a"]}, r"names=\['a'\]: neither names by label"),
    ]:
        with pytest.raises(TypeError, match=wanted):
            regionmesh.reconstruct(labels, **options)
