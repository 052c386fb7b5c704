"""Drill holes as closed bodies of rock. Needs the program regionmesh-delaunay."""

import argparse
from pathlib import Path

import regionmesh

parser = argparse.ArgumentParser(description=__doc__)
parser.add_argument("holes", type=Path, help="table of intervals, .csv")
parser.add_argument("model", type=Path, help="model to write")
parser.add_argument("--columns", help="which columns are which, such as hole=nr,label=lith")
parser.add_argument("--step", type=float, default=1.0, help="largest distance of points along a hole")
parser.add_argument("--scale-z", type=float, default=10.0, help="holes are long and far apart: stretch z meanwhile")
arguments = parser.parse_args()

mesh = regionmesh.reconstruct(
    arguments.holes, columns=arguments.columns, step=arguments.step, scale_z=arguments.scale_z, background=None
)
mesh.save(arguments.model)
regions = mesh.regions
for label, name, volume, bodies in zip(*(regions[key] for key in ("label", "name", "volume", "components"))):
    print(f"{name or label}: {volume:.0f} cubic metres in {bodies} surfaces")
