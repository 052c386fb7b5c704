#!/usr/bin/python3
"""Writes the drill holes and the terrain of the tutorial on geology: examples/data/make_holes.py

Four units, soil, sand, clay and chalk, on a hillside of 1 km by 1 km. Their bases are known functions; the clay pinches
out in the east. Six of the 30 holes are inclined.
"""
import math
import pathlib
import random

HERE = pathlib.Path(__file__).resolve().parent
STEP = 0.05  # metres along a hole


def ground(x, y):
    return 40 + 0.02 * x + 3 * math.sin(x / 170) * math.cos(y / 210)


def bases(x, y):
    """Of soil, sand and clay."""
    soil = ground(x, y) - 2 - math.sin(x / 90)
    sand = 22 + 0.012 * x + 5 * math.sin(y / 160)
    clay = sand - max(0.0, 14 * (1 - x / 700))
    return soil, min(soil, sand), min(soil, clay)


def unit_at(x, y, z):
    return ("chalk", "clay", "sand", "soil")[sum(z > base for base in bases(x, y))]


def main():
    choose = random.Random(11)
    collars, surveys, intervals = ["hole,x,y,elevation"], ["hole,depth,azimuth,dip"], ["hole,from,to,unit"]
    for n in range(30):
        hole, x, y = f"B{n + 1:02}", round(choose.uniform(20, 980), 1), round(choose.uniform(20, 980), 1)
        z, depth = round(ground(x, y), 2), choose.choice((25, 40, 50))
        azimuth, dip = (choose.randrange(0, 360, 15), -65) if n % 5 == 0 else (0, -90)
        collars.append(f"{hole},{x},{y},{z}")
        surveys.append(f"{hole},0,{azimuth},{dip}")
        a, d = math.radians(azimuth), math.radians(dip)
        along = (math.cos(d) * math.sin(a), math.cos(d) * math.cos(a), math.sin(d))
        units = [unit_at(*(p + s * k * STEP for p, s in zip((x, y, z), along))) for k in range(1, int(depth / STEP) + 1)]
        begin = 0
        for k in range(1, len(units) + 1):
            if k == len(units) or units[k] != units[begin]:
                intervals.append(f"{hole},{begin * STEP:.2f},{k * STEP:.2f},{units[begin]}")
                begin = k
    for name, rows in (("collars", collars), ("surveys", surveys), ("intervals", intervals)):
        (HERE / f"{name}.csv").write_text("\n".join(rows) + "\n")
    heights = [" ".join(f"{ground(50 * i, 1000 - 50 * j):.2f}" for i in range(21)) for j in range(21)]
    (HERE / "ground.asc").write_text("ncols 21\nnrows 21\nxllcenter 0\nyllcenter 0\ncellsize 50\nNODATA_value -9999\n" +
                                     "\n".join(heights) + "\n")


main()
