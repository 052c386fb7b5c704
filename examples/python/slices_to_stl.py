"""A folder of segmented CT slices as a closed STL file for each organ, for a 3-D printer."""

import argparse
from pathlib import Path

import regionmesh

parser = argparse.ArgumentParser(description=__doc__)
parser.add_argument("slices", type=Path, help="folder of .png or .tif sections; the grey value is the organ")
parser.add_argument("folder", type=Path, help="folder to write ORGAN.stl to")
parser.add_argument("--spacing", type=float, nargs=3, default=(1, 1, 1), metavar=("X", "Y", "Z"), help="millimetres")
parser.add_argument("--names", type=Path, help="table of labels and names")
arguments = parser.parse_args()

mesh = regionmesh.reconstruct(
    arguments.slices,
    spacing=arguments.spacing,
    names=arguments.names,
    smooth="strong",
    preserve_volume=True,
    reduce=0.9,
)
arguments.folder.mkdir(exist_ok=True)
for path in mesh.save(arguments.folder / "organ.stl", per_region=True):
    print(path)
regions = mesh.regions
for label, name, volume in zip(regions["label"], regions["name"], regions["volume"]):
    print(f"{name or label}: {volume / 1000:.1f} ml")
