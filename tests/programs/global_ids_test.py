#!/usr/bin/python3
"""VTK reads a model in pieces: global_ids_test.py PROGRAM FOLDER

Points with the same global id are one vertex, and merged by it the pieces are the model in one file.
"""
import json
import os
import shutil
import sys

SKIPPED = 77
SIZE = 40

try:
    import vtk
    from vtk.util.numpy_support import vtk_to_numpy
    import numpy as np
except ImportError:
    print("VTK for Python is missing")
    sys.exit(SKIPPED)


def write_volume(path):
    """Cubes of 13 samples with labels from 0 to 4."""
    z, y, x = np.indices((SIZE, SIZE, SIZE)) // 13
    np.save(path, ((x + 2 * y + 3 * z) % 5).astype(np.uint8))


def run(*arguments):
    code = os.spawnv(os.P_WAIT, arguments[0], list(arguments))
    if code != 0:
        sys.exit(f"{' '.join(arguments)}: exit code {code}")


def read(reader, path):
    reader.SetFileName(path)
    reader.Update()
    return reader.GetOutput()


def points_of(data):
    return vtk_to_numpy(data.GetPoints().GetData())


def expect(claim, text):
    if not claim:
        sys.exit(f"failed: {text}")
    print("holds:", text)


def main():
    program, folder = os.path.abspath(sys.argv[1]), sys.argv[2]
    shutil.rmtree(folder, ignore_errors=True)
    os.makedirs(folder)
    os.chdir(folder)
    write_volume("cubes.npy")
    run(program, "reconstruct", "cubes.npy", "-o", "model/", "--block-size", "15", "--smooth", "light", "--quiet")
    run(program, "convert", "model/", "pieces.pvtp", "--quiet")
    run(program, "convert", "model/", "whole.vtp", "--quiet")
    pieces = read(vtk.vtkXMLPPolyDataReader(), "pieces.pvtp")
    whole = read(vtk.vtkXMLPolyDataReader(), "whole.vtp")
    with open("model/manifest.json") as file:
        manifest = json.load(file)

    array = pieces.GetPointData().GetGlobalIds()
    expect(array is not None, "VTK takes GlobalIds for global ids")
    ids = vtk_to_numpy(array)
    used = np.unique(ids)
    expect(len(ids) > len(used), "pieces share vertices")
    expect((used == np.arange(manifest["vertices"])).all(), "ids run from 0 to the manifest's number of vertices")
    merged = np.empty((len(used), 3))
    merged[ids] = points_of(pieces)
    expect((merged[ids] == points_of(pieces)).all(), "points with one id lie at one place")
    expect((merged == points_of(whole)).all(), "merged, they are the points of the model in one file")
    corners = vtk_to_numpy(pieces.GetPolys().GetConnectivityArray())
    expect((ids[corners] == vtk_to_numpy(whole.GetPolys().GetConnectivityArray())).all(), "so are the faces")


main()
