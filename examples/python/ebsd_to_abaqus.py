"""A grain map as a surface mesh for Abaqus or CalculiX: each grain, interface and side of the box is a set."""

import argparse
from pathlib import Path

import numpy as np

import regionmesh

parser = argparse.ArgumentParser(description=__doc__)
parser.add_argument("grains", type=Path, help="grain ids [z, y, x], .npy; 0 is not indexed")
parser.add_argument("model", type=Path, help="model to write, .inp")
parser.add_argument("--spacing", type=float, nargs=3, default=(1, 1, 1), metavar=("X", "Y", "Z"), help="micrometres")
parser.add_argument("--smallest", type=int, default=8, help="samples; smaller grains join the grain around them")
arguments = parser.parse_args()


def join_small_grains(ids, smallest):
    """Give samples of small grains, and those not indexed, the grain of a neighbour, from outside in."""
    ids = ids.copy()
    is_small = np.bincount(ids.ravel()) < smallest
    is_small[0] = True
    while is_small[ids].any() and not is_small[ids].all():
        for axis in range(3):
            for step in (1, -1):
                # The neighbour on one side; the last section has itself.
                near = np.take(ids, np.clip(np.arange(ids.shape[axis]) + step, 0, ids.shape[axis] - 1), axis)
                ids = np.where(is_small[ids] & ~is_small[near], near, ids)
    return ids


ids = join_small_grains(np.load(arguments.grains), arguments.smallest)
mesh = regionmesh.reconstruct(ids, spacing=arguments.spacing, background=None, reduce=0.8, min_quality=0.15)
mesh.save(arguments.model)
print(mesh)
print(f"lowest angle of a face: {mesh.report['quality']['min_angle']:.1f} degrees")
