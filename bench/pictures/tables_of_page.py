"""The page bench/results/presets.md, from the results."""
import io
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent))
from tables import Printer  # noqa: E402: that of the other benchmarks

MODELS = {"brain": "AAL, `--reduce 90%`", "grains": "IN100", "mouse": "mouse, 5:1", "wells": "wells"}
VOLUMES = {"aal96": "AAL, 96 x 96 x 96", "in100": "IN100, 60 x 80 x 100", "head96": "head, 96 x 96 x 96"}


def table(rows):
    file = io.StringIO()
    Printer(True, file).table(rows)
    return file.getvalue().rstrip() + "\n"


def wrong(case):
    return "-" if case["samples"] in (None, 0) else str(case["samples_wrong"])


def of_presets(results):
    return table([("Model", "--smooth", "faces", "processor s", "samples wrong", "mean quality", "lowest quality", "turning, degrees", "violations")] + [
        (text, preset, str(case["final_faces"]), f"{case['seconds']:.1f}", wrong(case), f"{case['quality']:.3f}", f"{case['lowest']:.3f}",
         "-" if case["turning"] is None else f"{case['turning']:.1f}", str(case["violations"]))
        for model, text in MODELS.items() if model in results for preset, case in results[model].items()])


def of_rooms(results):
    return table([("--room", "faces from labels", "faces", "samples changed", "of all", "area, mm2", "mean quality", "violations")] + [
        (str(room), str(case["initial_faces"]), str(case["final_faces"]), str(case["samples_in_room"]),
         f"{100 * case['samples_in_room'] / case['samples']:.2f} %", f"{case['area']:.0f}", f"{case['quality']:.3f}", str(case["violations"]))
        for room, case in results["room"].items()])


def of_samples(results):
    rows = [("Volume", "--reduce", "faces kept: share", "with --no-keep-samples", "processor s", "with --no-keep-samples",
             "samples wrong", "with --no-keep-samples", "Dice")]
    for key, case in results["samples"].items():
        name, share, word = key.split()
        if word == "keep":
            other = results["samples"][f"{name} {share} nokeep"]
            faces = [f"{100 * one['final_faces'] / one['initial_faces']:.2f} %" for one in (case, other)]
            rows.append((VOLUMES[name], f"{share} %", *faces, f"{case['seconds']:.1f}", f"{other['seconds']:.1f}", wrong(case), wrong(other),
                         f"{other['dice']:.3f}"))
    return table(rows)


def of_rough(results):
    return table([("Labels", "options", "faces", "processor s", "mean quality", "lowest quality", "turning, degrees", "violations")] + [
        (kind, text, str(case["final_faces"]), f"{case['seconds']:.1f}", f"{case['quality']:.3f}", f"{case['lowest']:.3f}",
         f"{case['turning']:.1f}", str(case["violations"]))
        for key, case in results["rough"].items() for kind, text in [key.split(" ", 1)]])


PAGE = """\
# Presets of smoothing, measured

Written by `bench/pictures/run --data FOLDER`; [which to choose](../../docs/how-to/smooth.md) has the pictures.

{presets}
*One run each. Processor seconds are those of the whole process, summed over both cores of a shared machine. Samples wrong:
samples that do not lie in the region of their label; drill holes have no lattice. Quality: 0.26 is equilateral. Turning is the
mean angle between consecutive edges of triple lines. AAL is decimated, the others are not.*

![Kim's wells, cut open, with four presets](../../docs/pictures/presets-wells.png)

*The wells: tetrahedra are long and thin, so smoothing draws contacts out at their edges.*

## Room

{rooms}
*AAL, `--reduce 90%`. Of all: share of the samples. Area: of all interfaces together.*

## What keeping samples costs

{samples}
*Smoothed by default, then decimated. "Faces kept" is the share of faces that is left: where it is above the target, every
further collapse is refused. Dice: mean overlap of the regions with their labels, with `--no-keep-samples`.*

## Rough labels

{rough}
*`--reduce 0`: a segmentation of organs from CT, and grains of IN100 from diffraction.*
"""


def page_of(results):
    return PAGE.format(presets=of_presets(results), rooms=of_rooms(results), samples=of_samples(results),
                       rough=of_rough(results))
