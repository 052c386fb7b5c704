"""Arrays in, models out."""

import numpy as np
import pytest

import regionmesh


def test_a_model_of_two_boxes(mesh):
    assert mesh.certified
    assert mesh.points.shape[1] == 3 and mesh.points.dtype == np.float64
    assert mesh.faces.shape[1] == 3 and mesh.faces.dtype == np.uint32
    assert mesh.labels.shape == (len(mesh.faces), 2) and mesh.labels.dtype == np.int64
    assert sorted({tuple(pair) for pair in mesh.labels.tolist()}) == [(1, 0), (1, 2), (2, 0)]


def test_every_row_of_faces_names_a_point(mesh):
    assert sorted(np.unique(mesh.faces)) == list(range(len(mesh.points)))


def test_points_are_in_the_order_x_y_z(two_boxes):
    mesh = regionmesh.reconstruct(two_boxes, smooth="off", decimate=False)
    np.testing.assert_allclose(mesh.bounds, [[1.5, 2.5, 1.5], [7.5, 8.5, 10.5]])


def test_spacing_and_origin_are_x_y_z(two_boxes):
    mesh = regionmesh.reconstruct(two_boxes, spacing=(1, 2, 4), origin=(10, 20, 30), smooth="off")
    np.testing.assert_allclose(mesh.bounds, [[11.5, 25, 36], [17.5, 37, 72]])


def test_direction_turns_the_points(two_boxes):
    turn = [[0, -1, 0], [1, 0, 0], [0, 0, 1]]
    straight = regionmesh.reconstruct(two_boxes)
    turned = regionmesh.reconstruct(two_boxes, direction=turn)
    np.testing.assert_allclose(turned.points, straight.points @ np.transpose(turn), atol=1e-12)


def test_reduce_removes_faces(grains):
    full = regionmesh.reconstruct(grains, background=None, decimate=False)
    half = regionmesh.reconstruct(grains, background=None, reduce=0.5)
    assert len(half) <= len(full) / 2 + 1
    assert half.certified and half.report["stopped"] == "target"


@pytest.mark.parametrize("is_file", [False, True])
def test_a_target_that_is_missed_is_a_warning(tmp_path, is_file):
    noise = np.random.default_rng(1).integers(0, 4, (12, 12, 12), np.uint8)
    np.save(tmp_path / "noise.npy", noise)
    with pytest.warns(UserWarning, match="reconstruct: reduce=99% is not reached with [0-9]+ faces"):
        regionmesh.reconstruct(str(tmp_path / "noise.npy") if is_file else noise, reduce="99%")


def test_the_model_does_not_depend_on_threads(grains):
    one, two = (regionmesh.reconstruct(grains, reduce="60%", threads=n) for n in (1, 2))
    np.testing.assert_array_equal(one.points, two.points)
    np.testing.assert_array_equal(one.faces, two.faces)
    np.testing.assert_array_equal(one.labels, two.labels)


def test_labels_to_keep_makes_the_others_background(grains):
    mesh = regionmesh.reconstruct(grains, labels_to_keep=[3, 5])
    assert sorted(mesh.regions["label"]) == [3, 5]
    same = regionmesh.reconstruct(np.where(np.isin(grains, [3, 5]), grains, 0))
    np.testing.assert_array_equal(mesh.points, same.points)


@pytest.mark.parametrize("choice", [{"downsample": 2}, {"min_region": 5}])
def test_labels_are_kept_before_all_else_is_chosen(tmp_path, choice):
    labels = np.zeros((12, 12, 12), np.uint8)
    labels[2:10, 2:10, 2:10] = np.random.default_rng(0).integers(1, 4, (8, 8, 8))
    np.save(tmp_path / "labels.npy", labels)
    same = regionmesh.reconstruct(np.where(labels == 1, labels, 0), **choice)
    for source in (labels, str(tmp_path / "labels.npy")):
        made = regionmesh.reconstruct(source, labels_to_keep=[1], **choice)
        np.testing.assert_array_equal(made.points, same.points)
    with pytest.raises(ValueError, match="name one or more"):
        regionmesh.reconstruct(labels, labels_to_keep=[])


def test_labels_are_joined_by_a_table(two_boxes, tmp_path):
    (tmp_path / "join.csv").write_text("old,new,name\n1,7,both\n2,7\n")
    np.save(tmp_path / "labels.npy", two_boxes)
    expected = regionmesh.reconstruct(np.where(two_boxes > 0, 7, 0))
    for source in (two_boxes, tmp_path / "labels.npy"):
        made = regionmesh.reconstruct(source, merge=tmp_path / "join.csv")
        np.testing.assert_array_equal(made.points, expected.points)
        assert made.names == {7: "both"}
        assert made.check(two_boxes)["samples_wrong"] == 0
        with pytest.raises(FileNotFoundError, match="none.csv"):
            regionmesh.reconstruct(source, merge=tmp_path / "none.csv")


@pytest.mark.parametrize("extension", [".vtp", ".ply", ".obj", ".stl"])
def test_a_saved_model_is_loaded_again(mesh, tmp_path, extension):
    path = tmp_path / f"model{extension}"
    mesh.save(path)
    again = regionmesh.load(path)
    assert again.certified
    assert len(again) == len(mesh)
    np.testing.assert_allclose(sorted(again.regions["volume"]), sorted(mesh.regions["volume"]), rtol=1e-6)


def test_a_vtp_file_keeps_every_bit(mesh, tmp_path):
    mesh.save(tmp_path / "model.vtp")
    again = regionmesh.load(tmp_path / "model.vtp")
    np.testing.assert_array_equal(again.points, mesh.points)
    np.testing.assert_array_equal(again.faces, mesh.faces)
    np.testing.assert_array_equal(again.labels, mesh.labels)


def test_the_report_is_that_of_the_program(mesh):
    assert mesh.report["final_faces"] == len(mesh)
    assert mesh.report["samples_wrong"] == 0
    assert [row["label"] for row in mesh.report["regions"]] == [1, 2]
