#!/usr/bin/python3
"""Write pieces/ beside this file with the program itself: make_pieces.py BUILD/regionmesh

grains.npy holds four regions in 5 x 4 x 4 samples; grains.pieces is its model in pieces, and begun.pieces a run that
has counted the labels and made no piece. Neither names its input, so that any run may go on in them.
"""
import json, os, shutil, subprocess, sys

import numpy as np

FOLDER = os.path.join(os.path.dirname(os.path.abspath(__file__)), "pieces")


def path(*names):
    return os.path.join(FOLDER, *names)


def write_manifest(folder, manifest):
    with open(path(folder, "manifest.json"), "w") as file:
        file.write(json.dumps(manifest, indent=1) + "\n")


shutil.rmtree(FOLDER, ignore_errors=True)
os.makedirs(FOLDER)
seeds = np.random.default_rng(3).random((4, 3)) * [4, 4, 3]
nodes = np.stack(np.meshgrid(np.arange(5), np.arange(4), np.arange(4), indexing="ij"), -1)
nearest = ((nodes[..., None, :] - seeds) ** 2).sum(-1).argmin(-1)
np.save(path("grains.npy"), np.array([0, 5, -3, 300])[nearest].astype(np.int16).T)
arguments = ["grains.npy", "-o", "grains.pieces/", "--block-size", "2", "--reduce", "50%"]
subprocess.run([os.path.abspath(sys.argv[1]), "reconstruct", *arguments], cwd=FOLDER, check=True)

with open(path("grains.pieces", "manifest.json")) as file:
    manifest = json.load(file)
manifest["run"] = []
write_manifest("grains.pieces", manifest)
os.makedirs(path("begun.pieces"))
shutil.copy(path("grains.pieces", "labels.bin"), path("begun.pieces"))
manifest.update(pieces=[], passes=0, complete=False, faces=0, vertices=0, error_bound=0.0, stopped="", thresholds=[0.0, 0.0, 0.0])
write_manifest("begun.pieces", manifest)
