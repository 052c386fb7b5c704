"""Labels that dask computes from a grey image section by section: three classes by two thresholds."""

import argparse
from pathlib import Path

import dask.array
import numpy as np

import regionmesh

parser = argparse.ArgumentParser(description=__doc__)
parser.add_argument("image", type=Path, help="grey values [z, y, x], .npy")
parser.add_argument("model", type=Path, help="model to write")
parser.add_argument("--thresholds", type=float, nargs=2, required=True, help="from the first class up")
arguments = parser.parse_args()

image = np.load(arguments.image, mmap_mode="r")
chunks = (16, *image.shape[1:])
classes = dask.array.from_array(image, chunks=chunks).map_blocks(
    np.digitize, bins=sorted(arguments.thresholds), dtype=np.int64
)

mesh = regionmesh.reconstruct(classes.astype(np.uint8), background=0, reduce=0.8, progress=True)
mesh.save(arguments.model)
print(mesh)
