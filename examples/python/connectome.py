"""The largest neurons out of a Zarr store, which is read chunk by chunk and may be larger than memory."""

import argparse
from collections import Counter
from pathlib import Path

import numpy as np
import zarr

import regionmesh

parser = argparse.ArgumentParser(description=__doc__)
parser.add_argument("store", type=Path, help="Zarr array of segment ids [z, y, x]")
parser.add_argument("model", type=Path, help="model to write")
parser.add_argument("--largest", type=int, default=10, help="number of segments")
parser.add_argument("--memory", default="1GiB", help="that the process may use for the model")
parser.add_argument("--spacing", type=float, nargs=3, default=(8, 8, 30), metavar=("X", "Y", "Z"), help="nanometres")
arguments = parser.parse_args()

segments = zarr.open(str(arguments.store), mode="r")
sizes = Counter()
for first in range(0, segments.shape[0], segments.chunks[0]):
    ids, counts = np.unique(segments[first : first + segments.chunks[0]], return_counts=True)
    sizes.update(dict(zip(ids.tolist(), counts.tolist())))
del sizes[0]
kept = [label for label, _ in sizes.most_common(arguments.largest)]

mesh = regionmesh.reconstruct(
    segments, spacing=arguments.spacing, labels_to_keep=kept, reduce=0.9, memory=arguments.memory, progress=True
)
mesh.save(arguments.model)
for label in kept:
    print(f"{label}: {sizes[label]} samples, {len(mesh.region(label).faces)} faces")
