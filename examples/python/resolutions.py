"""One model at several resolutions, each made from the one before, and how far each is from the finest."""

import argparse
from pathlib import Path

import regionmesh

parser = argparse.ArgumentParser(description=__doc__)
parser.add_argument("labels", type=Path, help="labels, any format that regionmesh reads")
parser.add_argument("model", type=Path, help="models to write: NAME-0.vtp, NAME-1.vtp and so on for NAME.vtp")
parser.add_argument("--levels", type=int, default=4, help="each has a quarter of the faces of the one before")
arguments = parser.parse_args()

levels = [regionmesh.reconstruct(arguments.labels, progress=True)]
while len(levels) < arguments.levels:
    levels.append(levels[-1].simplify(reduce=0.75))

for number, mesh in enumerate(levels):
    mesh.save(arguments.model.with_stem(f"{arguments.model.stem}-{number}"))
    distance = levels[0].compare(mesh, samples=100_000)["distance"]["both"]
    state = "certified" if mesh.certified else "with violations"
    print(f"{number}: {len(mesh)} faces, distance {distance['rms']:.3g} rms, {distance['max']:.3g} at most, {state}")
