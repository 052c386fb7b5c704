"""What a mesh knows and what can be done with it."""

import copy
import json
import os
import pickle
import sys
import warnings
import zipfile

import numpy as np
import pytest

import regionmesh


@pytest.fixture(scope="module")
def filled(grains):
    """A model without background."""
    return regionmesh.reconstruct(grains, background=None, spacing=(1, 1, 2), reduce=0.4)


def volume_of(surface):
    a, b, c = (surface.points[surface.faces[:, n]] for n in range(3))
    return np.einsum("ij,ij->", a, np.cross(b, c)) / 6


def edge_counts(faces):
    edges = np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]])
    return np.unique(edges, axis=0, return_counts=True)


def test_a_region_is_closed_and_outward(filled):
    for label, volume in zip(filled.regions["label"], filled.regions["volume"]):
        surface = filled.region(label)
        edges, counts = edge_counts(surface.faces)
        assert (counts == 1).all()
        assert {tuple(edge) for edge in edges[:, ::-1].tolist()} == {tuple(edge) for edge in edges.tolist()}
        assert volume_of(surface) == pytest.approx(volume, rel=1e-9)
        np.testing.assert_array_equal(filled.points[surface.point_ids], surface.points)
        np.testing.assert_array_equal(
            np.sort(filled.faces[surface.face_ids], axis=1), np.sort(surface.point_ids[surface.faces], axis=1)
        )


def test_a_region_that_is_not_there(filled):
    with pytest.raises(KeyError):
        filled.region(999)
    with pytest.raises(TypeError):
        filled.region("x")


def test_an_interface_has_two_directions(filled):
    a, b = (int(filled.interfaces[name][0]) for name in ("first", "second"))
    there, back = filled.interface(a, b), filled.interface(b, a)
    assert len(there.faces) == filled.interfaces["faces"][0]
    np.testing.assert_array_equal(there.faces, back.faces[:, ::-1])
    assert len(filled.interface(a, 999).faces) == 0


def test_an_interface_points_from_the_first_label(mesh):
    surface = mesh.interface(1, 2)
    a, b, c = (surface.points[surface.faces[:, n]] for n in range(3))
    assert np.cross(b - a, c - a).sum(axis=0)[2] > 0  # box 2 lies above box 1


def test_interfaces_cover_all_faces(filled):
    columns = filled.interfaces
    assert columns["faces"].sum() == len(filled)
    report_area = sum(filled.regions["area"])
    both = columns["second"] != filled.exterior_label
    assert columns["area"].sum() + columns["area"][both].sum() == pytest.approx(report_area)


def test_regions_agree_with_the_labels(filled, grains):
    columns = filled.regions
    labels, counts = np.unique(grains, return_counts=True)
    np.testing.assert_array_equal(columns["label"], labels)
    np.testing.assert_array_equal(columns["voxels"], counts)
    assert columns["volume"].sum() == pytest.approx(19 * 19 * 38)
    assert (columns["euler"] == 2).all() and (columns["components"] == 1).all()
    for n, label in enumerate(labels):
        samples = np.argwhere(grains == label)[:, ::-1] * [1, 1, 2]
        centroid = [columns[f"centroid_{axis}"][n] for axis in "xyz"]
        assert np.abs(samples.mean(axis=0) - centroid).max() < 1.5
        assert columns["box_low_z"][n] <= samples[:, 2].min() and columns["box_high_z"][n] >= samples[:, 2].max()


def test_the_centroid_of_a_box(two_boxes):
    columns = regionmesh.reconstruct(two_boxes, smooth="off", origin=(100, 0, 0), decimate=False).regions
    # Not smoothed: along the interface, where three regions meet, the model follows the simplices of the lattice.
    np.testing.assert_allclose(columns["centroid_x"], [104.5, 104.5], atol=0.05)
    np.testing.assert_allclose(columns["centroid_z"], [4, 8.5], atol=0.1)
    np.testing.assert_allclose(columns["box_low_x"], [101.5, 101.5])
    np.testing.assert_allclose([columns["box_low_z"][0], columns["box_high_z"][1]], [1.5, 10.5])


def test_neighbours_are_symmetric(filled, mesh):
    table = dict(zip(filled.regions["label"].tolist(), filled.regions["neighbours"]))
    for label, neighbours in table.items():
        assert neighbours == sorted(neighbours) and all(label in table[other] for other in neighbours)
    assert list(mesh.regions["neighbours"]) == [[0, 2], [0, 1]]


def test_the_quality_is_that_of_the_report(filled):
    from regionmesh import _measure

    quality = _measure.quality(filled.points, filled.faces)
    assert quality.min() == pytest.approx(filled.report["quality"]["min"], rel=1e-6)
    assert quality.mean() == pytest.approx(filled.report["quality"]["mean"], rel=1e-6)


def test_regions_are_a_data_frame(filled):
    pandas = pytest.importorskip("pandas")
    frame = pandas.DataFrame(filled.regions)
    assert len(frame) == 24 and frame.set_index("label").loc[3, "voxels"] > 0


def test_curvature_of_halves_of_a_ball():
    z, y, x = np.indices((31, 31, 31)) - 15.2
    ball = np.where(z**2 + y**2 + x**2 < 11**2, np.where(x + 0.3 * y > 0, 1, 2), 0)
    made = regionmesh.reconstruct(ball)
    table = made.interfaces
    found = {(int(a), int(b)): kappa for a, b, kappa in zip(table["first"], table["second"], table["mean_curvature"])}
    assert found == {(1, 2): pytest.approx(0, abs=0.005), **{(n, 0): pytest.approx(1 / 11, rel=0.07) for n in (1, 2)}}
    assert (0.03 < made.regions["mean_curvature"]).all() and (made.regions["mean_curvature"] < 1 / 11).all()
    around = made.triple_lines["length"]
    assert around.tolist() == pytest.approx([2 * np.pi * 11], rel=0.1)
    assert made.regions["triple_line_length"] == pytest.approx([around[0]] * 2)
    assert table["line_length"] == pytest.approx([around[0]] * 3)


def test_angles_at_triple_lines(filled):
    table = filled.triple_lines
    for labels, angles in zip(table["labels"], table["angles"]):
        assert len(labels) == len(angles) >= 3 and labels[-1:] != [filled.exterior_label] or np.isnan(angles[-1])
        if len(labels) == 3 and filled.exterior_label not in labels and not np.isnan(angles).any():
            assert sum(angles) == pytest.approx(360, abs=0.01)
    assert any(len(labels) == 3 and filled.exterior_label not in labels for labels in table["labels"])


def test_tables_are_measured_once_and_stay(filled):
    first = filled.regions
    first["own"] = first.pop("volume")
    assert "own" not in filled.regions and filled.regions["area"] is first["area"]
    with pytest.raises(ValueError):
        first["area"][0] = 1


def test_quadruple_points_and_lines(filled, mesh):
    inside = filled.node_types[filled.quadruple_points] == 4
    assert inside.sum() == filled.report["quadruple_points_inside"]
    assert len(mesh.quadruple_points) == 0
    lines = mesh.lines
    assert len(lines) == mesh.report["triple_lines"]["edges"]
    length = np.linalg.norm(mesh.points[lines[:, 0]] - mesh.points[lines[:, 1]], axis=1).sum()
    assert length == pytest.approx(mesh.report["triple_lines"]["length"])


def test_simplify_makes_a_new_mesh(filled):
    before = filled.points.copy(), len(filled)
    fewer = filled.simplify(reduce=0.5)
    assert fewer.certified and len(fewer) <= before[1] / 2
    np.testing.assert_array_equal(filled.points, before[0])
    assert len(filled) == before[1]
    np.testing.assert_array_equal(fewer.regions["voxels"], filled.regions["voxels"])


def test_simplify_is_that_of_the_program(grains, tmp_path):
    # A file turns faces where its first faces have other labels than the first samples, as those of compact cells or
    # of a simplified model. Then sums over their corners are rounded differently.
    model = regionmesh.reconstruct(grains, background=None, spacing=(1, 1, 2), cells="tetrahedra", decimate=False)
    model.save(tmp_path / "a.vtp")
    direct = model.simplify(target_faces=600, keep_samples=False)
    loaded = regionmesh.load(tmp_path / "a.vtp", background=None).simplify(target_faces=600)
    np.testing.assert_array_equal(direct.points, loaded.points)
    np.testing.assert_array_equal(direct.faces, loaded.faces)


def test_simplify_can_improve_faces_without_a_target(filled):
    better = filled.simplify(improve=True)
    before, after = better.report["improved"]["before"], better.report["improved"]["after"]
    assert better.certified and after["mean_quality"] > before["mean_quality"]


@pytest.mark.parametrize(
    "options, warning",
    [
        ({"target_faces": 10}, "simplify: target_faces=10 is not reached with .* would change topology"),
        ({"reduce": "99.9%", "max_error": 0.2}, "simplify: reduce=.* is not reached with .* would exceed max_error"),
    ],
)
def test_simplify_warns_of_a_target_that_it_misses(filled, options, warning):
    with pytest.warns(UserWarning, match=warning):
        fewer = filled.simplify(**options)
    assert fewer.certified
    assert fewer.report["stopped"] in ("topology", "max_error")


def test_copies_of_oblique_meshes_have_the_same_lines_and_points():
    turn = [[0.75**0.5, -0.5, 0], [0.5, 0.75**0.5, 0], [0, 0, 1]]
    labels = np.ones((4, 5, 6), np.uint8)
    labels[:2] = 2
    mesh = regionmesh.reconstruct(labels, direction=turn, smooth="off")
    again = pickle.loads(pickle.dumps(mesh))
    np.testing.assert_array_equal(again.node_types, mesh.node_types)
    assert mesh.triple_lines["angles"][0][:2] == again.triple_lines["angles"][0][:2] == [90, 90]


def test_simplify_does_not_warn_without_a_target_or_at_it(filled):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert filled.simplify(max_error=0.2).report["stopped"] == "max_error"
        assert filled.simplify(reduce=0.3).report["stopped"] == "target"


def test_simplify_needs_a_target(filled):
    with pytest.raises(ValueError, match="no target"):
        filled.simplify()
    with pytest.raises(TypeError, match="simplify.*memory"):
        filled.simplify(memory=5)


@pytest.mark.filterwarnings("ignore:.* is not reached")
def test_simplify_and_improve_keep_samples(grains):
    mesh = regionmesh.reconstruct(grains, background=None)
    for changed in (mesh.simplify(reduce=0.95), mesh.improve()):
        assert changed.certified
        assert not np.array_equal(changed.points, mesh.points)
        assert changed.check(grains)["samples_wrong"] == 0
    without = mesh.simplify(reduce=0.95, keep_samples=False)
    assert without.report["verdicts"]["samples"] == 0
    assert mesh.simplify(reduce=0.95).report["verdicts"]["samples"] > 0


def test_an_oblique_mesh_keeps_its_box(grains):
    turn = np.array([[0.8, -0.6, 0], [0.6, 0.8, 0], [0, 0, 1]])
    mesh = regionmesh.reconstruct(grains, background=None, direction=turn, smooth="off")
    size = np.array(grains.shape[::-1]) - 1.0
    for changed in (mesh.simplify(reduce=0.9), mesh.smooth(smooth=10, smooth_filter="taubin")):
        assert changed.certified
        assert np.isclose(changed.regions["volume"].sum(), np.prod(size), rtol=1e-12)
        along = changed.points @ turn
        assert np.allclose(along.min(axis=0), 0, atol=1e-12) and np.allclose(along.max(axis=0), size, atol=1e-12)


def test_improve_raises_quality(grains):
    mesh = regionmesh.reconstruct(grains, background=None, reduce=0.8)
    better = mesh.improve()
    assert better.certified
    assert better.report["quality"]["mean"] > mesh.report["quality"]["mean"]
    assert better.report["improved"]["after"]["faces_below"] <= better.report["improved"]["before"]["faces_below"]
    both = mesh.simplify(reduce=0.3, improve=True)
    assert len(both) < len(mesh) and "improved" in both.report
    with pytest.raises(ValueError, match="min_quality"):
        mesh.improve(min_quality=5)


def test_smooth_lines_turn_less(grains):
    mesh = regionmesh.reconstruct(grains, background=None, reduce=0.8, smooth_lines=True)
    lines = mesh.report["smoothed_lines"]
    assert mesh.certified and lines["turn_after"] < lines["turn_before"]
    later = regionmesh.reconstruct(grains, background=None, reduce=0.8).simplify(smooth_lines=True)
    assert later.certified and later.report["smoothed_lines"]["moves"] > 0 and len(later) == len(mesh)


def test_simplify_reports_progress(filled):
    calls = []
    filled.simplify(reduce=0.2, progress=lambda *call: calls.append(call))
    assert calls[-1][0] == "check"


def test_smooth_moves_points(two_boxes):
    rough = regionmesh.reconstruct(two_boxes, smooth="off")
    smooth = rough.smooth(smooth=10)
    np.testing.assert_array_equal(smooth.faces, rough.faces)
    assert smooth.certified and not np.array_equal(smooth.points, rough.points)
    kept = rough.smooth(smooth=10, preserve_volume=True)
    np.testing.assert_allclose(kept.regions["volume"], rough.regions["volume"], rtol=1e-6)


def test_smooth_needs_a_filter_for_meshes(filled):
    with pytest.raises(ValueError, match="lattice"):
        filled.smooth(smooth_filter="lattice")


def test_check_against_the_labels(filled, grains):
    found = filled.check(grains)
    assert found["samples"] == grains.size and found["samples_wrong"] == 0 and not found["violations"]
    other = np.where(grains == 3, 4, grains)
    found = filled.check(other)
    assert found["samples_wrong"] == (grains == 3).sum()
    assert {violation["kind"] for violation in found["violations"]} >= {"region_pairs"}


def test_check_reads_files_and_sections(filled, grains, tmp_path):
    np.save(tmp_path / "grains.npy", grains)
    assert filled.check(tmp_path / "grains.npy", spacing=(1, 1, 2))["samples_wrong"] == 0
    assert filled.check(list(grains))["samples_wrong"] == 0
    assert filled.check(iter(grains))["samples_wrong"] == 0


@pytest.mark.parametrize(
    "options",
    [{"roi": "2:16,:,5:"}, {"box": "1:20,0:30,2:40"}, {"downsample": 2}, {"labels_to_keep": [3, 5]}, {"min_region": 20}],
)
def test_check_chooses_samples_as_the_model_did(grains, tmp_path, options):
    place = {"spacing": (1, 2, 3), "origin": (0.5, -4, 7)}
    np.save(tmp_path / "grains.npy", grains)
    made = regionmesh.reconstruct(grains, background=99, **place, **options)
    derived = made.simplify(reduce=0.2)
    for mesh in made, derived, pickle.loads(pickle.dumps(made)):
        for labels in grains, list(grains), mesh.voxelise():
            found = mesh.check(labels)
            assert found["samples"] == mesh.voxelise().size and found["samples_wrong"] == 0 and not found["violations"]
    read = regionmesh.reconstruct(tmp_path / "grains.npy", background=99, spacing=(1, 2, 3), **options)
    for labels in tmp_path / "grains.npy", grains, read.voxelise():
        assert read.check(labels)["samples_wrong"] == 0


def test_check_cleans_labels_as_the_model_did(grains, tmp_path):
    noisy = np.where(np.random.default_rng(7).random(grains.shape) < 0.1, 3, grains)
    np.save(tmp_path / "noisy.npy", noisy)
    for labels in noisy, tmp_path / "noisy.npy":
        made = regionmesh.reconstruct(labels, room=1.5, roi="0:18,:,:")
        assert (made.voxelise() != noisy[:, :, :18]).any()
        for mesh in made, pickle.loads(pickle.dumps(made)):
            found = mesh.check(labels)
            assert found["samples"] == 18 * 400 and found["samples_wrong"] == 0 and not found["violations"]


def test_reports_of_changes_do_not_repeat_dice(grains):
    made = regionmesh.reconstruct(grains, smooth="off")
    for changed in made.simplify(reduce=0.9, keep_samples=False), made.smooth(smooth=20):
        rows = changed.report["dice_of_regions"]
        assert rows and all(set(row) == {"label", "samples"} for row in rows)
        assert (changed.regions["voxels"] == made.regions["voxels"]).all()


def test_voxelise_like_a_mask(two_boxes):
    again = regionmesh.reconstruct(two_boxes > 0).voxelise(like=two_boxes > 0)
    assert again.dtype == np.uint8
    np.testing.assert_array_equal(again, two_boxes > 0)


def test_voxelise_of_a_file_of_truth_values(tmp_path, two_boxes):
    np.save(tmp_path / "mask.npy", two_boxes > 0)
    again = regionmesh.reconstruct(tmp_path / "mask.npy").voxelise()
    assert again.dtype == np.uint8 and (again == (two_boxes > 0)).all()


def test_voxelise_like_a_list(filled):
    assert (filled.voxelise(like=filled.voxelise().tolist()) == filled.voxelise()).all()


def test_check_refuses_points_and_tetrahedra(filled, tmp_path):
    (tmp_path / "points.csv").write_text("x,y,z,label\n0,0,0,1\n")
    with pytest.raises(ValueError, match="points.csv holds points or tetrahedra; give a volume"):
        filled.check(tmp_path / "points.csv")


def test_check_refuses_other_volumes(filled, grains, tmp_path):
    with pytest.raises(ValueError, match="19 x 20 x 20 samples along x, y, z, the model was made from 20 x 20 x 20"):
        filled.check(grains[:, :, 1:])
    np.save(tmp_path / "grains.npy", grains)
    with pytest.raises(TypeError, match="leave them out"):
        filled.check(tmp_path / "grains.npy", origin=(0, 0, 0))


def test_a_hole_is_found(mesh):
    x = mesh.points[mesh.faces, 0].mean(axis=1)
    kept = x > (x.min() + x.max()) / 2  # lines of samples along x leave regions that they have not entered
    open_model = regionmesh.from_arrays(mesh.points, mesh.faces[kept], mesh.labels[kept])
    assert not open_model.certified
    assert "open_edge" in {violation["kind"] for violation in open_model.violations}
    assert "violations" in repr(open_model)
    with pytest.raises(ValueError, match="not closed"):
        open_model.voxelise(shape=(14, 12, 10))


def test_compare_with_itself(filled):
    found = filled.compare(filled, samples=2000)
    assert found["distance"]["both"]["max"] < 1e-9
    moved = regionmesh.from_arrays(filled.points + [1, 0, 0], filled.faces, filled.labels, background=None)
    assert 0.1 < filled.compare(moved, samples=2000)["distance"]["both"]["max"] <= 1 + 1e-9
    with pytest.raises(TypeError, match="give a Mesh"):
        filled.compare(filled.points)


def test_voxelise_gives_the_labels_back(filled, grains):
    again = filled.voxelise()
    assert again.dtype == grains.dtype
    np.testing.assert_array_equal(again, grains)


@pytest.mark.parametrize("dtype", [np.uint8, np.int16, np.uint32, np.int64])
def test_voxelise_into_any_type(mesh, two_boxes, dtype):
    again = mesh.voxelise(like=two_boxes.astype(dtype))
    assert again.dtype == dtype
    np.testing.assert_array_equal(again, two_boxes)


def test_voxelise_takes_arrays_for_the_place(two_boxes):
    made = regionmesh.reconstruct(two_boxes, spacing=np.array([1.0, 2, 3]), origin=np.ones(3), direction=np.eye(3))
    there = {"spacing": np.array([1.0, 2, 3]), "origin": np.ones(3), "direction": np.eye(3)}
    np.testing.assert_array_equal(made.voxelise(two_boxes, **there), two_boxes)
    assert made.check(two_boxes, **there)["samples_wrong"] == 0


def test_voxelise_on_a_finer_lattice(mesh, two_boxes):
    fine = mesh.voxelise(shape=(27, 23, 19), spacing=(0.5, 0.5, 0.5))
    np.testing.assert_array_equal(fine[::2, ::2, ::2], two_boxes)


def test_voxelise_refuses_a_type_that_is_too_small(two_boxes):
    made = regionmesh.reconstruct(two_boxes.astype(np.int32) * 1000)
    with pytest.raises(ValueError, match="cannot hold"):
        made.voxelise(dtype=np.uint8)
    with pytest.raises(ValueError, match="no lattice"):
        regionmesh.from_arrays(made.points, made.faces, made.labels).voxelise()


def test_a_file_says_which_labels_are_background(two_boxes, tmp_path):
    regionmesh.reconstruct(two_boxes, background=None).save(tmp_path / "none.vtp")
    assert regionmesh.load(tmp_path / "none.vtp").background == []
    labels = np.full((8, 8, 8), 9, np.uint8)
    labels[2:6, 2:6, 2:6] = 4
    made = regionmesh.reconstruct(labels, background=9)
    for name in ("nine.vtp", "nine.ply", "nine.obj"):
        made.save(tmp_path / name)
        again = regionmesh.load(tmp_path / name)
        assert again.background == [9] and list(again.regions["label"]) == [4]
        assert list(regionmesh.load(tmp_path / name, background=None).regions["label"]) == [4, 9]


def test_colours_of_the_input_go_into_the_files_of_its_model(two_boxes, tmp_path):
    header = {"type": "uint8", "dimension": 3, "sizes": "10 12 14", "encoding": "raw"}
    lines = [f"{key}: {value}" for key, value in header.items()]
    lines += ["Segment0_Name:=box", "Segment0_LabelValue:=1", "Segment0_Layer:=0", "Segment0_Color:=1 0.5 0"]
    (tmp_path / "v.seg.nrrd").write_bytes(("NRRD0005\n" + "\n".join(lines) + "\n\n").encode() + two_boxes.tobytes())
    made = regionmesh.reconstruct(tmp_path / "v.seg.nrrd")
    for again in (made, pickle.loads(pickle.dumps(made)), made.smooth(), made.simplify(reduce=0.2)):
        again.save(tmp_path / "m.ply")
        assert b"comment colour 1 #ff8000" in (tmp_path / "m.ply").read_bytes()
        files = again.save(tmp_path / "m.obj")
        assert files == [str(tmp_path / "m.obj"), str(tmp_path / "m.mtl")]
        assert "newmtl box\nKd 1 0.502 0\n" in (tmp_path / "m.mtl").read_text()


def test_the_space_of_a_volume_goes_into_the_files_of_its_model(two_boxes, tmp_path):
    header = {"type": "uint8", "dimension": 3, "space": "left-posterior-superior", "sizes": "10 12 14"}
    lines = [f"{key}: {value}" for key, value in header.items()]
    lines += ["space directions: (1,0,0) (0,1,0) (0,0,1)", "space origin: (0,0,0)", "encoding: raw"]
    (tmp_path / "v.nrrd").write_bytes(("NRRD0005\n" + "\n".join(lines) + "\n\n").encode() + two_boxes.tobytes())
    made = regionmesh.reconstruct(tmp_path / "v.nrrd")
    assert made.space == "LPS" and regionmesh.reconstruct(two_boxes).space is None
    for again in (pickle.loads(pickle.dumps(made)), made.smooth(), made.simplify(reduce=0.2)):
        again.save(tmp_path / "m.ply")
        assert b"SPACE=LPS" in (tmp_path / "m.ply").read_bytes()
        assert regionmesh.load(tmp_path / "m.ply").space == "LPS"


def test_the_unit_and_the_spacing_of_a_volume_stay_with_its_model(two_boxes, tmp_path):
    header = {"type": "uint8", "dimension": 3, "sizes": "10 12 14", "spacings": "1 1 10", "units": '"um" "um" "um"'}
    lines = [f"{key}: {value}" for key, value in header.items()] + ["encoding: raw"]
    (tmp_path / "v.nrrd").write_bytes(("NRRD0005\n" + "\n".join(lines) + "\n\n").encode() + two_boxes.tobytes())
    made = regionmesh.reconstruct(tmp_path / "v.nrrd")
    assert regionmesh.reconstruct(two_boxes).metres is None
    made.save(tmp_path / "m.vtp")
    for again in (pickle.loads(pickle.dumps(made)), made.smooth(), regionmesh.load(tmp_path / "m.vtp")):
        assert again.metres == 1e-6
        again.save(tmp_path / "m.glb")
        assert b'"scale":[1e-06,1e-06,1e-06]' in (tmp_path / "m.glb").read_bytes()
        simplified = again.simplify(reduce=0.2, keep_samples=False)
        assert simplified.metres == 1e-6 and simplified.report["quality_bound"] == 0.01
    assert made.simplify(reduce=0.2, min_quality=0.05).report["quality_bound"] == 0.05
    made.save(tmp_path / "mm.vtp", units="mm")
    with pytest.warns(UserWarning, match="the mesh is in um and the other in mm"):
        made.compare(regionmesh.load(tmp_path / "mm.vtp"))


def test_save_returns_the_files_and_scales_to_metres(two_boxes, tmp_path):
    made = regionmesh.reconstruct(two_boxes, names={1: "left lung"})
    files = made.save(tmp_path / "m.stl", per_region=True)
    assert files == [str(tmp_path / "m-left_lung.stl"), str(tmp_path / "m-2.stl")]
    assert all(os.path.getsize(file) > 0 for file in files)
    assert made.save(tmp_path / "m.glb", units="mm") == [str(tmp_path / "m.glb")]
    assert b'"scale":[0.001,0.001,0.001]' in (tmp_path / "m.glb").read_bytes()
    with pytest.raises(ValueError, match="units"):
        made.save(tmp_path / "m.glb", units="furlong")
    for units, word in (None, b"millimeter"), ("m", b"meter"):
        made.save(tmp_path / "m.3mf", units=units)
        with zipfile.ZipFile(tmp_path / "m.3mf") as parts:
            assert b'unit="' + word + b'"' in b"".join(parts.read(part) for part in parts.namelist())


@pytest.mark.filterwarnings("ignore:.* is not reached")
def test_the_representation_tells_samples_in_other_regions():
    noise = np.random.default_rng(1).integers(0, 3, (9, 8, 10)).astype(np.uint8)
    made = regionmesh.reconstruct(noise, reduce=0.9, keep_samples=False)
    assert not made.certified
    assert f"{made.report['samples_wrong']} samples in other regions" in repr(made)
    assert f"{made.report['samples_wrong']} samples in other regions" in made._repr_html_()


def test_save_writes_folders_for_neuroglancer(two_boxes, tmp_path):
    made = regionmesh.reconstruct(two_boxes, names={1: "left lung"})
    folder = tmp_path / "m.precomputed"
    assert made.save(folder, units="um", levels=2) == [str(folder)]
    assert json.loads((folder / "info").read_text())["@type"] == "neuroglancer_multilod_draco"
    names = json.loads((folder / "names" / "info").read_text())["inline"]
    assert names["ids"] == ["1", "2"] and names["properties"][0]["values"] == ["left lung", "2"]
    assert (folder / "1.index").exists() and not (folder / "0.index").exists()
    made.save(f"{tmp_path}/s.precomputed/", sharded=True)
    assert json.loads((tmp_path / "s.precomputed" / "info").read_text())["sharding"]["hash"] == "identity"
    made.save(tmp_path / "l.precomputed", precomputed="legacy")
    fragment = np.fromfile(tmp_path / "l.precomputed" / "1:0:0", np.float32, 3, offset=4)
    assert np.abs(made.points * 1e9 - fragment).max(axis=1).min() < 1e3
    for options, name in (({"levels": 2}, "m.vtp"), ({"per_region": True}, "m.precomputed"), ({"levels": 9}, folder)):
        with pytest.raises(ValueError, match="levels|per_region"):
            made.save(tmp_path / name, **options)
    with pytest.raises(OSError, match="cannot be made"):
        made.save(tmp_path / "missing" / "m.precomputed")


def test_arrays_in_and_out(filled):
    again = regionmesh.from_arrays(filled.points, filled.faces, filled.labels, background=None)
    assert again.certified
    for name in ("points", "faces", "labels"):
        np.testing.assert_array_equal(getattr(again, name), getattr(filled, name))


def test_arrays_of_lists():
    points = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]
    faces = [(0, 2, 1), (0, 1, 3), (1, 2, 3), (0, 3, 2)]
    made = regionmesh.from_arrays(points, faces, [(7, 0)] * 4, names={7: "corner"})
    assert made.certified
    assert made.regions["volume"][0] == pytest.approx(1 / 6)
    assert made.regions["name"][0] == "corner"


@pytest.mark.parametrize(
    "change, error",
    [
        ({"points": np.zeros((4, 2))}, ValueError),
        ({"points": [[np.nan, 0, 0]] * 4}, ValueError),
        ({"points": "abcd"}, ValueError),
        ({"faces": [(0, 1, 4)]}, ValueError),
        ({"faces": [(0, 1, -1)]}, ValueError),
        ({"faces": [(0.0, 1.0, 2.0)]}, TypeError),
        ({"faces": [(0, 1)]}, ValueError),
        ({"labels": [(1, 0)] * 3}, ValueError),
        ({"labels": [1]}, ValueError),
        ({"labels": [(0.5, 1)]}, TypeError),
    ],
)
def test_wrong_arrays_are_refused(change, error):
    arrays = {"points": np.eye(4)[:, :3], "faces": [(0, 1, 2)], "labels": [(1, 0)]}
    with pytest.raises(error):
        regionmesh.from_arrays(**{**arrays, **change})


@pytest.mark.parametrize("protocol", range(2, pickle.HIGHEST_PROTOCOL + 1))
def test_a_pickle_keeps_everything(filled, protocol):
    again = pickle.loads(pickle.dumps(filled, protocol))
    for name in ("points", "faces", "labels", "node_types"):
        np.testing.assert_array_equal(getattr(again, name), getattr(filled, name))
    assert again.report == filled.report and again.background == filled.background
    np.testing.assert_array_equal(again.voxelise(), filled.voxelise())
    np.testing.assert_array_equal(again.simplify(reduce=0.3).points, filled.simplify(reduce=0.3).points)


def test_a_pickle_of_unsigned_labels(two_boxes):
    large = 2**64 - 2
    made = regionmesh.reconstruct(two_boxes.astype(np.uint64) * np.uint64(2**63 - 1), names={large: "large"})
    again = copy.deepcopy(made)
    assert list(again.regions["name"]) == ["", "large"]
    np.testing.assert_array_equal(again.labels, made.labels)
    assert again.exterior_label == made.exterior_label and again.names == made.names


def test_save_refuses_other_extensions(mesh, tmp_path):
    with pytest.raises(OSError, match="model.xyz"):
        mesh.save(tmp_path / "model.xyz")
    with pytest.raises(OSError):
        mesh.save(tmp_path / "no such folder" / "model.vtp")


def test_save_per_region(mesh, tmp_path):
    mesh.save(tmp_path / "organ.stl", per_region=True)
    assert sorted(path.name for path in tmp_path.iterdir()) == ["organ-1.stl", "organ-2.stl"]


def test_to_vtk(mesh):
    pytest.importorskip("vtkmodules")
    data = mesh.to_vtk()
    assert data.GetNumberOfPoints() == len(mesh.points) and data.GetNumberOfPolys() == len(mesh)
    assert data.GetCellData().GetArray("BoundaryLabels").GetNumberOfComponents() == 2
    assert data.GetPoint(5) == tuple(mesh.points[5])


def test_to_meshio(mesh, tmp_path):
    meshio = pytest.importorskip("meshio")
    mesh.to_meshio().write(tmp_path / "model.vtu")
    again = meshio.read(tmp_path / "model.vtu")
    np.testing.assert_array_equal(again.points, mesh.points)
    np.testing.assert_array_equal(again.cells_dict["triangle"], mesh.faces)
    np.testing.assert_array_equal(again.cell_data["BoundaryLabels"][0], mesh.labels)


def test_to_trimesh(mesh):
    trimesh = pytest.importorskip("trimesh")
    box = mesh.to_trimesh(1)
    assert isinstance(box, trimesh.Trimesh) and box.is_watertight
    assert box.volume == pytest.approx(mesh.regions["volume"][0])
    whole = mesh.to_trimesh()
    assert len(whole.faces) == len(mesh) and len(whole.face_attributes["labels"]) == len(mesh)


def test_plot_shows_the_view_of_a_notebook_where_pyvista_is_missing(mesh, monkeypatch):
    display = pytest.importorskip("IPython.display")
    monkeypatch.setitem(sys.modules, "pyvista", None)
    assert isinstance(mesh.plot(), display.HTML)


def test_the_view_warns_of_nothing(mesh, recwarn):
    mesh._repr_html_()
    assert not recwarn.list


def test_to_pyvista(mesh):
    pyvista = pytest.importorskip("pyvista")
    data = mesh.to_pyvista()
    assert isinstance(data, pyvista.PolyData) and data.n_cells == len(mesh)


def test_the_view_is_self_contained(filled):
    page = filled._repr_html_()
    assert "24 regions" in page and "certified" in page
    assert "http" not in page and "@" not in page
    assert page == filled._repr_html_()


def test_the_view_of_a_large_model_is_small(grains):
    large = regionmesh.reconstruct(grains.repeat(3, 0).repeat(3, 1).repeat(3, 2), background=None, decimate=False)
    assert len(large) > 30_000
    assert len(large._repr_html_()) < 600_000


def test_the_view_of_nothing():
    assert "0 faces" in regionmesh.reconstruct(np.zeros((3, 3, 3), int))._repr_html_()


def test_repr_and_length(mesh):
    assert repr(mesh) == f"<regionmesh.Mesh: {len(mesh.faces)} faces, {len(mesh.points)} points, 2 regions, certified>"


def test_voxelise_refuses_spacings_that_are_none(mesh):
    for place in ({"spacing": (float("nan"), 1, 1)}, {"spacing": (0, 1, 1)}, {"origin": (float("nan"), 0, 0)}):
        with pytest.raises(ValueError, match="voxelise"):
            mesh.voxelise(shape=(4, 4, 4), **place)


# Sagittal, mirrored, and turned by an angle.
DIRECTIONS = [
    [[0, 1, 0], [1, 0, 0], [0, 0, 1]],
    [[0, 0, 1], [1, 0, 0], [0, 1, 0]],
    [[-1, 0, 0], [0, -1, 0], [0, 0, 1]],
    [[-1, 0, 0], [0, 1, 0], [0, 0, 1]],
    [[0.8, -0.6, 0], [0.6, 0.8, 0], [0, 0, 1]],
]


@pytest.mark.parametrize("direction", DIRECTIONS)
@pytest.mark.parametrize("background", [None, 0])
def test_samples_and_box_are_kept_in_any_axes(grains, direction, background):
    place = {"spacing": (1, 1.2, 2.1), "origin": (0.3, -7.7, 100.1), "direction": direction}
    made = regionmesh.reconstruct(grains, background=background, **place)
    assert made.check(grains)["samples_wrong"] == 0
    for changed in made.simplify(reduce=0.8), made.improve(), made.simplify(reduce=0.5).simplify(reduce=0.5):
        np.testing.assert_allclose(changed.bounds, made.bounds, atol=1e-9)
        report = changed.check(grains)
        assert (report["samples_wrong"], report["violations"]) == (0, [])
    assert len(made.simplify(reduce=0.8)) < 0.5 * len(made)


def test_a_mesh_of_an_array_is_checked_against_the_file(grains, tmp_path):
    np.save(tmp_path / "v.npy", grains)
    made = regionmesh.reconstruct(grains, spacing=(1, 2, 3))
    assert made.check(tmp_path / "v.npy")["samples_wrong"] == 0
    moved = regionmesh.reconstruct(grains, origin=(10, 0, 0))
    with pytest.raises(ValueError, match="origin of the file is 0, 0, 0, that of the model 10, 0, 0"):
        moved.check(tmp_path / "v.npy")
    assert moved.check(grains)["samples_wrong"] == 0


def test_a_file_that_lies_elsewhere_is_refused_far_from_the_origin(grains, tmp_path):
    made = regionmesh.reconstruct(grains, origin=(512345, 5912345, 0))
    header = "NRRD0004\ntype: uint8\ndimension: 3\nspace dimension: 3\nsizes: {} {} {}\nencoding: raw\n"
    header = header.format(*grains.shape[::-1])
    header += "space directions: (1,0,0) (0,1,0) (0,0,1)\nspace origin: ({},{},0)\n\n"
    for shift in 0, 2:
        origin = header.format(512345, 5912345 + shift)
        (tmp_path / "v.nrrd").write_bytes(origin.encode() + grains.astype(np.uint8).tobytes())
        if shift == 0:
            assert made.check(tmp_path / "v.nrrd")["samples_wrong"] == 0
        else:
            with pytest.raises(ValueError, match="the origin of the file"):
                made.check(tmp_path / "v.nrrd")


def test_a_mesh_of_one_file_is_checked_against_another(grains, tmp_path):
    grains.astype(np.uint8).tofile(tmp_path / "v.raw")
    np.save(tmp_path / "v.npy", grains)
    made = regionmesh.reconstruct(tmp_path / "v.raw", size=grains.shape[::-1], type="uint8")
    for path in tmp_path / "v.raw", os.fsencode(tmp_path / "v.npy"):
        assert made.check(path)["samples_wrong"] == 0


def test_labels_kept_are_kept_where_the_cut_is_the_whole(grains):
    for cut in {"box": "-5:100,:,:"}, {"roi": ":,:,:"}, {"downsample": 1}:
        made = regionmesh.reconstruct(grains, labels_to_keep=[1], **cut)
        assert made.check(grains)["samples_wrong"] == 0


def test_a_file_without_background_is_checked_as_the_program_does(tmp_path):
    labels = np.zeros((8, 9, 10), np.uint8)
    labels[2:6, 2:6, 2:6], labels[2:6, 2:6, 6:] = 1, 2  # one of them on a side of the box
    made = regionmesh.reconstruct(labels)
    made.save(tmp_path / "m.stl")
    loaded = regionmesh.load(tmp_path / "m.stl")
    regionmesh.reconstruct(np.where(labels == 0, 5, labels), background=5).save(tmp_path / "m5.stl")
    of_5 = regionmesh.load(tmp_path / "m5.stl", background=5)
    for model, volume in (loaded, labels), (of_5, np.where(labels == 0, 5, labels)):
        for same in model, pickle.loads(pickle.dumps(model)):
            report = same.check(volume)
            assert (report["samples_wrong"], report["violations"]) == (0, [])


def test_a_volume_in_another_space_is_turned(grains, tmp_path):
    header = (
        "NRRD0004\ntype: uint8\ndimension: 3\nspace: left-posterior-superior\nsizes: {} {} {}\nencoding: raw\n"
        "space directions: (1,0,0) (0,1,0) (0,0,1)\nspace origin: (3,4,5)\n\n"
    ).format(*grains.shape[::-1])
    (tmp_path / "v.nrrd").write_bytes(header.encode() + grains.astype(np.uint8).tobytes())
    made = regionmesh.reconstruct(tmp_path / "v.nrrd")
    assert made.space == "LPS"
    turned = regionmesh.from_arrays(made.points * [-1, -1, 1], made.faces, made.labels)
    turned.save(tmp_path / "m.ply")
    text = (tmp_path / "m.ply").read_bytes().replace(b"ply\n", b"ply\n", 1)
    (tmp_path / "m.ply").write_bytes(text.replace(b"comment exterior_label", b"comment SPACE=RAS\ncomment exterior_label"))
    loaded = regionmesh.load(tmp_path / "m.ply")
    assert loaded.space == "RAS"
    assert loaded.check(tmp_path / "v.nrrd")["samples_wrong"] == 0
    with pytest.warns(UserWarning, match="are in LPS and RAS"):
        made.compare(loaded)


def test_coarse_files_are_worth_a_warning(grains, tmp_path):
    made = regionmesh.reconstruct(grains, origin=(1e7, 0, 0))
    with pytest.warns(UserWarning, match="single precision"):
        made.save(tmp_path / "m.dream3d")


def test_shapes_of_voxels_are_numbers_of_samples(filled):
    for shape in (1 << 32, 1, 1), (0, 2, 2), (-1, 2, 2):
        with pytest.raises(ValueError, match="samples along each axis"):
            filled.voxelise(shape=shape)
    with pytest.raises(TypeError, match="like or shape"):
        filled.voxelise(np.zeros((2, 2, 2), int), shape=(2, 2, 2))


def test_names_of_files_need_no_utf8(filled, tmp_path):
    path = os.path.join(os.fsencode(tmp_path), b"m\xff.ply")
    assert filled.save(path) == [os.fsdecode(path)]
    assert len(regionmesh.load(os.fsdecode(path))) == len(filled)
    with pytest.raises(ValueError, match="null"):
        filled.save("a\0b.vtp")
    with pytest.raises(FileNotFoundError):
        regionmesh.load(b"no\xff.vtp")


def test_labels_of_the_other_byte_order_keep_their_values():
    points, faces = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)], [(0, 2, 1), (0, 1, 3), (1, 2, 3), (0, 3, 2)]
    for order in "<>":
        labels = np.array([((1 << 63) + 5, 0)] * 4, order + "u8")
        assert regionmesh.from_arrays(points, faces, labels).regions["label"][0] == (1 << 63) + 5
    with pytest.raises(TypeError, match="not a whole number"):
        regionmesh.from_arrays(points, faces, [(7, 0)] * 4, exterior_label=1.5)


def test_arrays_of_an_open_model_with_its_node_types_are_that_model(grains):
    made = regionmesh.reconstruct(grains, background=None, boundary="open")
    given = dict(background=made.background, exterior_label=made.exterior_label, boundary="open")
    again = regionmesh.from_arrays(made.points, made.faces, made.labels, node_types=made.node_types, **given)
    assert made.certified and again.certified
    np.testing.assert_array_equal(again.node_types, made.node_types)
    assert not regionmesh.from_arrays(made.points, made.faces, made.labels, **given).certified
    for wrong in made.node_types[1:], made.node_types + 100, [2.5] * len(made.points):
        with pytest.raises((TypeError, ValueError), match="node_types"):
            regionmesh.from_arrays(made.points, made.faces, made.labels, node_types=wrong, **given)
