#!/usr/bin/python3
"""How much of a drill hole the others predict: by layers as docs/how-to/boreholes.md describes them, and by the nearest hole.

bench/boreholes/left_out.py --data FOLDER    prints a table; FOLDER holds the tables of bench/boreholes/run

An implementation of its own, in numpy, with the exponent of the variogram as a parameter. It takes the order of units
that `regionmesh info --layers` finds from the program.
"""
import argparse
import collections
import csv
import pathlib
import re
import subprocess

import numpy

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
SITES = {
    "Kim": ("kim_ready.csv", "hole=name,top=top,bottom=base,label=formation,surface=altitude", "auto,-null"),
    "Utrecht, formations": ("boreholes_usp_intervals.csv", "hole=nr,label=strat_2003,surface=surface,top=top,bottom=bottom", "auto"),
}
EXPONENTS = (0.5, 1, 1.5, 1.8)
LOOKED_UP = 40  # places of an interval


def order_of(program, path, columns, layers):
    told = subprocess.run([program, "info", path, "--columns", columns, "--layers", layers], check=True,
                          capture_output=True, text=True).stdout
    return re.search(r"young to old: (.*); ", told)[1].split(", ")


def holes_of(path, columns, units):
    """(x, y), ground and [(top, bottom, rank)] of each hole, elevations from the top down."""
    role = dict(pair.split("=") for pair in columns.split(","))
    rows = collections.defaultdict(list)
    with open(path, newline="") as file:
        for row in csv.DictReader(file):
            top, bottom, ground = (float(row[role[name]]) for name in ("top", "bottom", "surface"))
            if bottom > top:
                rows[float(row["x"]), float(row["y"]), ground].append((ground - top, ground - bottom, row[role["label"]]))
    holes = []
    for (x, y, ground), intervals in sorted(rows.items()):
        logged = [(top, bottom, units.index(unit)) for top, bottom, unit in sorted(intervals, reverse=True) if unit in units]
        if logged:
            holes.append(((x, y), ground, logged))
    return holes


def contact(logged, rank):
    """The height of the base of a unit, and whether the hole goes through it."""
    length, most, cut = 0, 0, 0
    for n, (top, bottom, other) in enumerate(logged):
        length += (top - bottom) * (1 if other <= rank else -1)
        if length > most:
            most, cut = length, n + 1
    if cut == 0:
        return logged[0][0], True
    return (logged[cut - 1][1], False) if cut == len(logged) else ((logged[cut - 1][1] + logged[cut][0]) / 2, True)


def kriged(places, heights, wanted, exponent):
    def covariance(a, b):
        return -numpy.linalg.norm(a[:, None] - b[None], axis=2) ** exponent
    count = len(places)
    matrix = numpy.ones((count + 1, count + 1))
    matrix[:count, :count], matrix[count, count] = covariance(places, places), 0
    weights = numpy.linalg.lstsq(matrix, numpy.append(heights, 0), rcond=None)[0]
    return covariance(wanted, places) @ weights[:count] + weights[count]


def bases_at(place, holes, unit_count, exponent):
    places = numpy.array([hole[0] for hole in holes])
    wanted = numpy.array([place])
    last, bases = kriged(places, [hole[1] for hole in holes], wanted, exponent)[0], []
    for rank in range(unit_count - 1):
        contacts = [contact(hole[2], rank) for hole in holes]
        z, used = numpy.array([c[0] for c in contacts]), numpy.array([c[1] for c in contacts])
        used |= not used.any()
        while True:
            crossed = ~used & (kriged(places[used], z[used], places, exponent) > z + 1e-9)
            if not crossed.any():
                break
            used |= crossed
        last = min(last, kriged(places[used], z[used], wanted, exponent)[0])
        bases.append(last)
    return numpy.array(bases)


def nearest_at(place, holes):
    """A function of heights: the rank in the nearest hole that is logged there."""
    def ranks(z):
        found = numpy.full(len(z), -1)
        for hole in sorted(holes, key=lambda hole: numpy.hypot(hole[0][0] - place[0], hole[0][1] - place[1])):
            for top, bottom, rank in hole[2]:
                found[(found < 0) & (z <= top) & (z >= bottom)] = rank
        return found
    return ranks


def predicted(holes, predict):
    """The share of the logged length where predict(place, other holes) has the unit of the log."""
    right = length = 0
    for n, (place, _, logged) in enumerate(holes):
        ranks = predict(place, holes[:n] + holes[n + 1:])
        for top, bottom, rank in logged:
            z = top + (bottom - top) * (numpy.arange(LOOKED_UP) + 0.5) / LOOKED_UP
            right += (ranks(z) == rank).mean() * (top - bottom)
            length += top - bottom
    return 100 * right / length


def by_layers(unit_count, exponent):
    def predict(place, others):
        bases = bases_at(place, others, unit_count, exponent)
        return lambda z: (z[:, None] < bases[None]).sum(axis=1)
    return predict


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--data", required=True, help="folder of the tables")
    parser.add_argument("--program", default=ROOT / "build/release/regionmesh")
    arguments = parser.parse_args()
    for site, (name, columns, layers) in SITES.items():
        path = next(pathlib.Path(arguments.data).rglob(name))
        units = order_of(arguments.program, path, columns, layers)
        holes = holes_of(path, columns, units)
        print(f"{site}: {len(holes)} holes, {len(units)} units; nearest hole {predicted(holes, nearest_at):.1f} %", flush=True)
        for exponent in EXPONENTS:
            print(f"  layers, variogram r^{exponent}: {predicted(holes, by_layers(len(units), exponent)):.1f} %", flush=True)


main()
