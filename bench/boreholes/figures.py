"""The tables of docs/how-to/boreholes.md, from what was measured."""
import io
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent / "paper"))
from page import Page  # noqa: E402: of the other pages

SITE = {"utrecht": "Utrecht", "kim": "Kim"}
MODEL = {"utrecht steps": "Utrecht, `--step 0.5`", "utrecht middles": "Utrecht, one an interval", "kim steps": "Kim, `--step 25`",
         "kim middles": "Kim, one an interval", "strata 0": "strata, `--smooth 0`", "strata 20": "strata",
         "boxed_strata 20": "strata, points on the box", "grains 0": "60 grains, `--smooth 0`", "grains 20": "60 grains"}


def percent(share):
    return f"{100 * share:.1f} %"


def megabytes(size):
    return f"{size / 1e6:.0f}"


def spacing(results):
    rows = [("Table", "holes", "hole to next, m", "step, m", "ratio", "--scale-z", "mean interval, m", "ratio", "--scale-z")]
    for site, one in results.items():
        step, scale = one["steps"]
        rows.append((SITE[site], str(one["holes"]), f"{one['distance']:.0f}", f"{step:g}", f"{one['distance'] / step:.0f}", f"{scale:g}",
                     f"{one['thickness']:.2f}", f"{one['distance'] / one['thickness']:.1f}", f"{one['middles']:g}"))
    return rows


def choices(results):
    rows = [("Options", "faces", "after", "quadruple points", "hole length as logged", "outside")]
    for words, one in results.items():
        after = one.get("reduced", one["final_faces"])
        rows.append((f"`{words}`", str(one["initial_faces"]), str(after) if after != one["initial_faces"] else "-",
                     str(one["quadruple_points_inside"]), percent(one["agreement"]), percent(one["outside"])))
    return rows


def models(results):
    rows = [("Model", "points", "tetrahedra", "regions", "faces", "after", "pairs", "quadruple points", "violations", "as logged", "s",
             "of it to make tetrahedra", "peak MB", "of the other program")]
    for name, one in results.items():
        rows.append((MODEL[name], str(one["points"]), str(one["tetrahedra"]), str(one["regions"]), str(one["initial_faces"]),
                     str(one["final_faces"]), str(one["region_pairs"]), str(one["quadruple_points_inside"]),
                     str(one["violations"]) if one["check"] == 0 else "check failed", percent(one["agreement"]), f"{one['whole']:.1f}",
                     f"{one['delaunay_seconds']:.1f}", megabytes(one["peak_bytes"]), megabytes(one["delaunay_bytes"])))
    return rows


def memory(results):
    rows = [("`--memory`", "faces after", "violations", "s", "peak MB", "of the other program")]
    for budget, one in results["rows"].items():
        rows.append((budget, str(one["final_faces"]), str(one["violations"]), f"{one['whole']:.1f}", megabytes(one["peak_bytes"]),
                     megabytes(one["delaunay_bytes"])))
    return rows


def of(results):
    """Each with the name that the page marks it by."""
    texts = {}
    for name, rows in (("spacing", spacing(results["spacing"])), ("choices", choices(results["choices"])),
                       ("models", models(results["sites"] | results["worlds"])), ("memory", memory(results["memory"]))):
        page = Page(io.StringIO(), None)
        page.table(rows)
        texts[name] = page.file.getvalue().rstrip() + "\n"
    page = Page(io.StringIO(), None)
    page.paragraph(f"Rough figures: seconds of the whole run, medians of three, on {results['machine']} that others used, too.")
    texts["machine"] = page.file.getvalue().rstrip() + "\n"
    return texts
