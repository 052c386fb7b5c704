"""One way from labels to surfaces: measured, checked and printed as JSON. Run by bench/python/run."""
import json
import os
import resource
import subprocess
import sys
import tempfile
import time

import numpy as np

import regionmesh


def peak_bytes():
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024


def module(labels, path, **options):
    return regionmesh.reconstruct(labels, background=None, **options)


def skimage(labels, path):
    """A closed surface for each label; the faces between two labels are made twice, and do not match."""
    from skimage.measure import marching_cubes

    parts = []
    for label in np.unique(labels):
        mask = np.pad(labels == label, 1).astype(np.float32)
        points, faces, _, _ = marching_cubes(mask, 0.5)
        parts.append((points[:, ::-1] - 1, faces, np.full(len(faces), label)))
    return joined(parts)


def vtk(labels, path):
    """All labels in one pass; each is closed on its own."""
    from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
    from vtkmodules.vtkCommonDataModel import vtkImageData
    from vtkmodules.vtkFiltersGeneral import vtkDiscreteFlyingEdges3D

    padded = np.pad(labels, 1)
    image = vtkImageData()
    image.SetDimensions(*padded.shape[::-1])
    image.GetPointData().SetScalars(numpy_to_vtk(padded.ravel(), deep=False))
    surface = vtkDiscreteFlyingEdges3D()
    surface.SetInputData(image)
    for number, label in enumerate(np.unique(labels)):
        surface.SetValue(number, int(label))
    surface.Update()
    output = surface.GetOutput()
    points = vtk_to_numpy(output.GetPoints().GetData()).astype(float) - 1
    faces = vtk_to_numpy(output.GetPolys().GetConnectivityArray()).reshape(-1, 3)
    scalars = output.GetPointData().GetScalars() or output.GetCellData().GetScalars()
    values = vtk_to_numpy(scalars)
    return points, faces, values[faces[:, 0]] if len(values) == len(points) else values


def joined(parts):
    offsets = np.cumsum([0, *(len(points) for points, _, _ in parts)])
    return (np.concatenate([points for points, _, _ in parts]),
            np.concatenate([faces + offset for (_, faces, _), offset in zip(parts, offsets)]),
            np.concatenate([labels for _, _, labels in parts]))


def checked(points, faces, labels):
    """What our check finds: points at the same place are joined, and opposite faces become one between two labels."""
    places, rows = np.unique(np.asarray(points, float), axis=0, return_inverse=True)
    faces = rows.ravel()[faces]
    keys, first, inverse = np.unique(np.sort(faces, axis=1), axis=0, return_index=True, return_inverse=True)
    second = np.full(len(keys), -1, np.int64)
    others = np.setdiff1d(np.arange(len(faces)), first)
    second[inverse.ravel()[others]] = labels[others]
    pairs = np.stack([labels[first].astype(np.int64), second], axis=1)
    return regionmesh.from_arrays(places, faces[first], pairs, background=None).report["violation_counts"]


def program(path):
    """The program on the file; its report has the seconds without reading and writing."""
    with tempfile.TemporaryDirectory() as folder:
        report = os.path.join(folder, "report.json")
        subprocess.run([sys.executable, "-m", "regionmesh", "reconstruct", path, "-o", os.path.join(folder, "a.vtp"),
                        "--no-background", "--smooth", "off", "--quiet", "--report", report], check=True)
        with open(report) as file:
            found = json.load(file)
    seconds = found["seconds"]
    return {"seconds": seconds["total"] - seconds["write"], "bytes": found["peak_bytes"],
            "faces": found["final_faces"], "violations": found["violation_counts"]}


LANES = {
    "module": lambda labels, path: module(labels, path, smooth="off"),
    "module_smooth": module,
    "module_reduced": lambda labels, path: module(labels, path, reduce=0.9),
    "skimage": skimage,
    "vtk": vtk,
}


def main():
    lane, path = sys.argv[1:]
    if lane == "program":
        print(json.dumps(program(path)))
        return
    labels = np.load(path)
    before, start = peak_bytes(), time.perf_counter()
    made = LANES[lane](labels, path)
    seconds, memory = time.perf_counter() - start, peak_bytes() - before
    is_ours = isinstance(made, regionmesh.Mesh)
    violations = made.report["violation_counts"] if is_ours else checked(*made)
    faces = len(made) if is_ours else len(made[1])
    print(json.dumps({"seconds": seconds, "bytes": memory, "faces": faces, "violations": violations}))


main()
