"""The page bench/results/boreholes.md, from what was measured."""
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


PAGE = """\
# Drill holes and scattered points, measured

Written by `bench/boreholes/run --data FOLDER`; [drill holes](../../docs/how-to/boreholes.md) says how to choose options.

## How far apart points are

{spacing}
## Options

{choices}
*Kim's wells, neither smoothed nor decimated unless stated. After: the faces that `--reduce 90%` or the given share leaves. As logged:
the share of the length of all holes that lies in the region given by the table, sampled each 10 m.*

## Models

{models}
{machine}
*Utrecht and Kim with half of the faces, the others, of a million points, with a tenth; 20 passes of smoothing unless stated. Strata:
eight folded layers, a fault, lenses and an intrusion. As logged: of scattered points, the share that lies in the region of its label.
Peaks are largest resident sizes, of regionmesh and of regionmesh-delaunay, which ends before faces are made.*

![Formations below Utrecht as layers, cut open](../../docs/pictures/boreholes-formations.png)

*The formations below Utrecht as layers (`--layers auto --box :,:,-150:`), heights exaggerated 4 times.*

![The top of the Vedder, with all faces and with fewer](../../docs/pictures/boreholes-decimated.png)

*The top of Kim's Vedder formation (`--step 100 --scale-z 22`), with all faces and with 30 % of them.*

![Utrecht, all of it and the uppermost metres, cut open](../../docs/pictures/boreholes-utrecht.png)

*67 holes on 1.8 by 1.2 km, three quarters of them shallower than 10 m, three deeper than 260 m; half of the faces.*

![A million points: at random, and with some on the sides of the box](../../docs/pictures/boreholes-strata.png)

*The strata with a tenth of the faces: points at random, and with a tenth of them on the sides of the box.*

## Memory

{memory}
*The strata, `--smooth 0`.*
"""


def text_of(rows):
    page = Page(io.StringIO(), None)
    page.table(rows)
    return page.file.getvalue().rstrip() + "\n"


def page_of(results):
    page = Page(io.StringIO(), None)
    page.paragraph(f"Rough figures: seconds of the whole run, medians of three, on {results['machine']} that others used, too.")
    return PAGE.format(spacing=text_of(spacing(results["spacing"])), choices=text_of(choices(results["choices"])),
                       models=text_of(models(results["sites"] | results["worlds"])), memory=text_of(memory(results["memory"])),
                       machine=page.file.getvalue().rstrip() + "\n")
