"""Options are those of the program; wrong ones raise its line."""

import inspect

import numpy as np
import pytest

import regionmesh
from regionmesh import _core, _options


@pytest.mark.parametrize(
    "name, value, text",
    [
        ("target_faces", 10, "10"),
        ("reduce", 0.25, "0.25"),
        ("reduce", "25%", "25%"),
        ("reduce", np.float32(0.5), "0.5"),
        ("max_error", 1, "1.0"),
        ("memory", "1GiB", "1GiB"),
        ("memory", 10**9, "1000000000"),
        ("threads", np.int64(2), "2"),
        ("smooth", "strong", "strong"),
        ("smooth", 12, "12"),
        ("smooth", False, "off"),
        ("smooth", True, "normal"),
        ("smooth_filter", "taubin", "taubin"),
        ("preserve_volume", True, "true"),
        ("spacing", (1, 2.5, 3), "1.0,2.5,3.0"),
        ("spacing", 2, "2.0,2.0,2.0"),
        ("spacing", np.array([1.0, 2.0, 3.0]), "1.0,2.0,3.0"),
        ("size", (10, 20, 30), "10,20,30"),
    ],
)
def test_a_value_becomes_the_text_of_the_command_line(name, value, text):
    assert _options.pairs("reconstruct", {name: value}) == [(name.replace("_", "-"), text)]


@pytest.mark.parametrize("name", ["keep_samples", "decimate", "intersect_check"])
def test_a_flag_that_switches_off_is_a_positive_keyword(name):
    flag = "no-" + name.replace("_", "-")
    assert _options.pairs("reconstruct", {name: False}) == [(flag, "true")]
    assert _options.pairs("reconstruct", {name: True}) == [(flag, "false")]


@pytest.mark.parametrize(
    "value, pairs",
    [
        (None, [("no-background", "true")]),
        ([], [("no-background", "true")]),
        (3, [("background", "3")]),
        ([0, 7], [("background", "0"), ("background", "7")]),
        (np.array([4, 5], np.uint8), [("background", "4"), ("background", "5")]),
        (-2, [("background", "-2")]),
    ],
)
def test_background_is_one_label_or_several_or_none(value, pairs):
    assert _options.pairs("reconstruct", {"background": value}) == pairs


def test_none_is_the_default():
    assert _options.pairs("reconstruct", {"reduce": None, "memory": None}) == []


@pytest.mark.parametrize(
    "options",
    [
        {"target_face": 3},
        {"output": "a.vtp"},
        {"no_decimate": True},
        {"reduce": True},
        {"reduce": [0.5]},
        {"target_faces": 0.5},
        {"target_faces": True},
        {"target_faces": "many"},
        {"threads": 1.0},
        {"preserve_volume": 1},
        {"smooth_filter": 3},
        {"smooth": 0.5},
        {"max_error": "small"},
        {"sweep": 2},
        {"size": 5},
        {"columns": "X"},
        {"roi": [0, 4]},
        {"max_work": 5},
        {"progress": 3},
        {"background": "skin"},
    ],
)
def test_a_wrong_type_or_name_raises_type_error(two_boxes, options):
    with pytest.raises(TypeError, match=next(iter(options))):
        regionmesh.reconstruct(two_boxes, **options)


@pytest.mark.parametrize(
    "options, line",
    [
        ({"reduce": 2}, "reduce=2.0: not a share, such as 90% or 0.9"),
        ({"reduce": float("nan")}, "reduce=nan: not a share, such as 90% or 0.9"),
        ({"reduce": "lots"}, "reduce=lots: not a share, such as 90% or 0.9"),
        ({"target_faces": -1}, "target_faces=-1: not a whole number"),
        ({"memory": "much"}, "memory=much: not a size, such as 500MiB or 2GiB"),
        ({"smooth_filter": "soft"}, "smooth_filter=soft"),
        ({"smooth": "more"}, "smooth=more: not off, light, normal, strong or a whole number of 0 to 100000"),
        ({"sweep": "w"}, "sweep=w"),
        ({"boundary": "open", "preserve_volume": True}, "preserve_volume: open regions have no volume"),
    ],
)
def test_a_wrong_value_raises_the_line_of_the_program(two_boxes, options, line):
    with pytest.raises(ValueError) as raised:
        regionmesh.reconstruct(two_boxes, **options)
    assert str(raised.value).startswith(line)
    assert "\n" not in str(raised.value)


@pytest.mark.parametrize(
    "place, error",
    [
        ({"spacing": (1, 2)}, ValueError),
        ({"spacing": "1"}, TypeError),
        ({"spacing": (1, 0, 1)}, ValueError),
        ({"spacing": (1, -2, 1)}, ValueError),
        ({"spacing": (1, float("nan"), 1)}, ValueError),
        ({"origin": (0, 0)}, ValueError),
        ({"origin": (0, float("inf"), 0)}, ValueError),
        ({"direction": np.ones((3, 3))}, ValueError),
        ({"direction": np.eye(2)}, ValueError),
    ],
)
def test_a_wrong_place_in_space_is_refused(two_boxes, place, error):
    with pytest.raises(error, match=next(iter(place))):
        regionmesh.reconstruct(two_boxes, **place)


def test_memory_that_cannot_be_kept_is_refused(grains):
    with pytest.raises(ValueError, match="memory"):
        regionmesh.reconstruct(grains, memory="1kB", reduce=0.5)


def test_the_signature_lists_every_option_of_the_program():
    parameters = inspect.signature(regionmesh.reconstruct).parameters
    for row in _core.option_rows("reconstruct"):
        name = "purpose" if row["name"] == "for" else row["name"].removeprefix("no-").replace("-", "_")
        is_here = not row["is_argument"] and row["group"] != "Output" and row["kind"] != "file"
        of_process = ("quiet", "verbose", "memory_limit", "sandbox", "require_sandbox")
        is_here = is_here and name not in of_process
        assert (name in parameters) == (is_here or name in ("names", "collars", "surveys", "terrain", "merge", "units", "space")), name


@pytest.mark.parametrize("method", ["simplify", "smooth", "compare"])
def test_methods_have_their_options_in_signature_and_help(method):
    function = getattr(regionmesh.Mesh, method)
    assert "threads" in inspect.signature(function).parameters
    assert "threads : " in function.__doc__


def test_boundary_open_leaves_the_sides_open(grains):
    capped = regionmesh.reconstruct(grains, background=None)
    opened = regionmesh.reconstruct(grains, background=None, boundary="open")
    assert (capped.labels == capped.exterior_label).any()
    assert not (opened.labels == opened.exterior_label).any()
    assert opened.certified


def test_names_are_a_dict_or_a_table(two_boxes, tmp_path):
    table = tmp_path / "names.csv"
    table.write_text("label,name\n1,lower\n2,upper\n")
    for names in ({1: "lower", 2: "upper"}, table, str(table)):
        mesh = regionmesh.reconstruct(two_boxes, names=names)
        assert list(mesh.regions["name"]) == ["lower", "upper"]
