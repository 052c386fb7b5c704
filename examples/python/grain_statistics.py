"""Size, shape and neighbours of grains, as a table and, where matplotlib is installed, as a plot."""

import argparse
import csv
from pathlib import Path

import numpy as np

import regionmesh

parser = argparse.ArgumentParser(description=__doc__)
parser.add_argument("grains", type=Path, help="grain ids, any format that regionmesh reads")
parser.add_argument("table", type=Path, help="table to write, .csv; the plot is written beside it as .png")
arguments = parser.parse_args()

mesh = regionmesh.reconstruct(arguments.grains, background=None)
grains = mesh.regions
low, high = mesh.bounds
# Grains that the box cuts are left out of the statistics: their size is not known.
at_box = [
    (grains[f"box_low_{axis}"] <= low[n]) | (grains[f"box_high_{axis}"] >= high[n]) for n, axis in enumerate("xyz")
]
is_whole = ~np.logical_or.reduce(at_box)

columns = {
    "grain": grains["label"],
    "whole": is_whole.astype(int),
    "diameter": np.cbrt(6 * grains["volume"] / np.pi),  # of the sphere of the same volume
    "sphericity": np.pi ** (1 / 3) * (6 * grains["volume"]) ** (2 / 3) / grains["area"],
    "neighbours": np.array([len(labels) for labels in grains["neighbours"]]),
}
with arguments.table.open("w", newline="") as file:
    writer = csv.writer(file)
    writer.writerow(columns)
    writer.writerows(zip(*columns.values()))

for name in ("diameter", "sphericity", "neighbours"):
    values = columns[name][is_whole]
    if len(values):
        print(f"{name}: mean {values.mean():.2f}, standard deviation {values.std():.2f}, {len(values)} grains")

try:
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot
except ImportError:
    print("no plot: matplotlib is not installed")
else:
    figure, axes = pyplot.subplots(1, 2, figsize=(8, 3), layout="constrained")
    axes[0].hist(columns["diameter"][is_whole], bins=20)
    axes[0].set(xlabel="equivalent diameter", ylabel="grains")
    axes[1].hist(columns["neighbours"][is_whole], bins=20)
    axes[1].set(xlabel="neighbours")
    figure.savefig(arguments.table.with_suffix(".png"))
