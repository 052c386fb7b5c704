"""What is wrong with a surface model of another program; ends with 3 where something is."""

import argparse
import sys
from pathlib import Path

import regionmesh

parser = argparse.ArgumentParser(description=__doc__)
parser.add_argument("model", type=Path, help="a .stl, .ply, .obj or .vtp file, or a folder of them")
parser.add_argument("--weld", type=float, help="join points no farther apart than this")
parser.add_argument("--labels", type=Path, help="the labels that the model was made from")
arguments = parser.parse_args()

mesh = regionmesh.load(arguments.model, weld=arguments.weld)
found = mesh.check(arguments.labels) if arguments.labels else mesh.report
print(mesh)
for kind, count in found["violation_counts"].items():
    if count:
        example = next(violation for violation in found["violations"] if violation["kind"] == kind)
        print(f"{kind}: {count}, such as: {example['text']}")
if "samples_wrong" in found:
    print(f"{found['samples_wrong']} of {found['samples']} samples lie in another region")
sys.exit(3 if any(found["violation_counts"].values()) else 0)
