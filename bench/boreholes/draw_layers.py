#!/usr/bin/python3
"""Draws drill holes as layers, cut open: boreholes-layers.png, boreholes-formations.png and tutorial-geology.png
in docs/pictures.

bench/boreholes/draw_layers.py --data FOLDER    FOLDER holds the tables of bench/boreholes/run

script/bootstrap paper installs what this needs; the picture is drawn without a screen.
"""
import argparse
import colorsys
import csv
import os
import pathlib
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
PALE = (0.42, 0.68)  # saturation of every other colour


HILLSIDE = {"soil": "#7a5c3e", "sand": "#f2d98b", "clay": "#5f8f6b", "chalk": "#dfe3e6"}


def tutorial_words():
    folder = ROOT / "examples/data"
    return [folder / "intervals.csv", "--collars", folder / "collars.csv", "--surveys", folder / "surveys.csv", "--layers",
            "auto", "--terrain", folder / "ground.asc", "--spacing", "20,20,0.5", "--box", "0:1000,0:1000,-5:"]


def tutorial_shafts():
    """(x, y, top, bottom) of the vertical holes."""
    folder, depths = ROOT / "examples/data", {}
    for row in csv.DictReader(open(folder / "intervals.csv", newline="")):
        depths[row["hole"]] = float(row["to"])
    inclined = {row["hole"] for row in csv.DictReader(open(folder / "surveys.csv", newline="")) if row["dip"] != "-90"}
    return [(float(row["x"]), float(row["y"]), float(row["elevation"]), float(row["elevation"]) - depths[row["hole"]])
            for row in csv.DictReader(open(folder / "collars.csv", newline="")) if row["hole"] not in inclined]


def colours_of(names):
    """From young (yellow) to old (violet), the lightness alternating."""
    found = {}
    for n, name in enumerate(names):
        hue = 0.13 + 0.72 * n / max(len(names) - 1, 1)
        found[name] = colorsys.hsv_to_rgb(hue, PALE[n % 2], 0.93 - 0.22 * (n % 2) - 0.1 * n / len(names))
    return found


def reconstruct(arguments, model, words):
    subprocess.run([arguments.program, "reconstruct", *map(str, words), "--reduce", "80%", "--quiet", "-o", model], check=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--data", default="", help="folder of the tables")
    parser.add_argument("--program", default=ROOT / "build/release/regionmesh")
    parser.add_argument("--output", type=pathlib.Path, default=ROOT / "docs/pictures", help="folder of the pictures")
    parser.add_argument("--tutorial", action="store_true", help="draw that of the tutorial alone")
    arguments = parser.parse_args()
    if not os.environ.get("DISPLAY"):  # pictures need a screen, if only a virtual one
        os.execvp("xvfb-run", ["xvfb-run", "-a", *sys.argv])
    sys.path.insert(0, str(HERE))
    import holes
    import measure
    import picture
    data = pathlib.Path(arguments.data)
    kim_columns = measure.SITES["kim"]["columns"]
    utrecht_columns = holes.Columns("nr", "top", "bottom", "strat_2003", "surface")
    panels = []
    with tempfile.TemporaryDirectory() as folder:
        def panel(text, model, words, colours, shafts, **scene):
            path = os.path.join(folder, model)
            reconstruct(arguments, path, words)
            names = picture.names_of(picture.draw.read(path))
            scene = picture.Scene({0: (0.8, 0.8, 0.8)} | {label: colours[name] for label, name in names.items()}, **scene)
            panels.append((text, picture.actors_of(path, scene, shafts)))
            return names

        colours = {name: measure.rgb(code) for name, code in HILLSIDE.items()}
        panel("heights 6 times", "hillside.vtp", tutorial_words(), colours, tutorial_shafts(), exaggeration=6, turn=200)
        picture.sheet(arguments.output / "tutorial-geology.png", panels, [(rgb, name) for name, rgb in colours.items()],
                      (860, 520), (1.35,))
        if arguments.tutorial:
            return
        panels.clear()
        kim, utrecht = (next(data.rglob(measure.SITES[site]["file"])) for site in ("kim", "utrecht"))
        source = [kim, "--columns", ",".join(kim_columns.words())]
        colours = {name: measure.rgb(code) for name, code in measure.KIM.items()}
        shafts = holes.shafts(holes.read(kim, kim_columns)[0])
        names = panel("Kim, --layers auto,-null, heights 8 times", "kim.vtp", [*source, "--layers", "auto,-null"], colours,
                      shafts, exaggeration=8, turn=195)
        entries = [(colours[names[label]], names[label]) for label in sorted(names)]
        picture.sheet(arguments.output / "boreholes-layers.png", panels, entries, (860, 560), (1.35,))

        panels.clear()
        source = [utrecht, "--columns", ",".join(utrecht_columns.words())]
        rows, words = holes.read(utrecht, utrecht_columns)
        shafts = holes.shafts(rows[words != ""])
        found = subprocess.run([arguments.program, "info", *map(str, source), "--layers", "auto"], check=True,
                               capture_output=True, text=True).stdout
        units = found.split("young to old: ")[1].split(";")[0].split(", ")
        colours = colours_of(units)
        panel("Utrecht, formations, heights 4 times", "utrecht.vtp", [*source, "--layers", "auto", "--box", ":,:,-150:"],
              colours, shafts, exaggeration=4, turn=180, floor=-150)
        picture.sheet(arguments.output / "boreholes-formations.png", panels, [(colours[name], name) for name in units],
                      (860, 560), (1.35,))


main()
