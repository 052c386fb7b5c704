#!/usr/bin/python3
"""Contours and decimates a labelled volume by VTK and prints the cost as JSON:
vtk_pair.py VOLUME.npy|.nii|.nii.gz SHARE [PREFIX]

Two filters: vtkDiscreteFlyingEdges3D at all labels but 0, one closed surface a label away from the box, so that an
interface between two labels is there twice, and open where a label reaches the box; then vtkQuadricDecimation, which
removes SHARE of the faces (0.9). Both with their defaults, except that the first makes no normals, which nobody needs
here. Seconds are those of the two Update() alone. With PREFIX, writes PREFIX-full.ply and PREFIX-reduced.ply for
regionmesh compare; all faces lie between 1 and 2 in them. Exit code 3: this kind of file is not read here.
"""
import json
import sys
import time

import numpy
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkVersion
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkFiltersCore import vtkQuadricDecimation
from vtkmodules.vtkFiltersGeneral import vtkDiscreteFlyingEdges3D

VERTEX = [("point", "<f8", 3), ("node_type", "u1")]
FACE = [("corners", "u1"), ("vertices", "<u4", 3), ("labels", "<i4", 2)]


def image_of(samples, spacing):
    """The image with its labels numbered from 0, of the least type that holds them, and the numbers without label 0."""
    labels, numbers = numpy.unique(samples, return_inverse=True)
    numbers = numbers.ravel().astype(numpy.min_scalar_type(len(labels)))
    image = vtkImageData()
    image.SetDimensions(*samples.shape[::-1])
    image.SetSpacing(*spacing)
    image.GetPointData().SetScalars(numpy_to_vtk(numbers, deep=True))
    return image, [number for number, label in enumerate(labels) if label != 0]


def read(path):
    if path.endswith(".npy"):
        samples = numpy.load(path)
        return image_of(samples.reshape((1,) * (3 - samples.ndim) + samples.shape), (1, 1, 1))
    if path.endswith((".nii", ".nii.gz")):
        from vtkmodules.vtkIOImage import vtkNIFTIImageReader
        reader = vtkNIFTIImageReader()
        reader.SetFileName(path)
        reader.Update()
        image = reader.GetOutput()
        samples = vtk_to_numpy(image.GetPointData().GetScalars()).reshape(image.GetDimensions()[::-1])
        return image_of(samples, image.GetSpacing())
    sys.exit(3)


def updated(algorithm):
    """The output, on its own, and the seconds it took."""
    start = time.perf_counter()
    algorithm.Update()
    return algorithm.GetOutput(), time.perf_counter() - start


def peak_bytes():
    """Of this process alone; rusage would count what the process held that started it."""
    with open("/proc/self/status") as file:
        return next(int(line.split()[1]) * 1024 for line in file if line.startswith("VmHWM:"))


def write_ply(surface, path):
    vertices = numpy.zeros(surface.GetNumberOfPoints(), VERTEX)
    vertices["point"] = vtk_to_numpy(surface.GetPoints().GetData())
    faces = numpy.zeros(surface.GetNumberOfPolys(), FACE)
    faces["corners"] = 3
    faces["vertices"] = vtk_to_numpy(surface.GetPolys().GetConnectivityArray()).reshape(-1, 3)
    faces["labels"] = 1, 2
    head = ("ply\nformat binary_little_endian 1.0\n"
            f"element vertex {len(vertices)}\nproperty double x\nproperty double y\nproperty double z\nproperty uchar node_type\n"
            f"element face {len(faces)}\nproperty list uchar uint vertex_indices\nproperty int label_first\nproperty int label_second\n"
            "end_header\n")
    with open(path, "wb") as file:
        file.write(head.encode())
        file.write(vertices.tobytes())
        file.write(faces.tobytes())


def main():
    if len(sys.argv) not in (3, 4):
        sys.exit(__doc__)
    image, numbers = read(sys.argv[1])
    contours = vtkDiscreteFlyingEdges3D()
    contours.SetInputData(image)
    contours.ComputeNormalsOff()
    for n, number in enumerate(numbers):
        contours.SetValue(n, number)
    full, contour_seconds = updated(contours)
    decimation = vtkQuadricDecimation()
    decimation.SetInputData(full)
    decimation.SetTargetReduction(float(sys.argv[2]))
    reduced, decimation_seconds = updated(decimation)
    print(json.dumps({"version": vtkVersion.GetVTKVersion(), "initial_faces": full.GetNumberOfPolys(),
                      "final_faces": reduced.GetNumberOfPolys(), "seconds": contour_seconds + decimation_seconds,
                      "contour_seconds": contour_seconds, "decimation_seconds": decimation_seconds, "peak_bytes": peak_bytes()}))
    if len(sys.argv) == 4:
        write_ply(full, f"{sys.argv[3]}-full.ply")
        write_ply(reduced, f"{sys.argv[3]}-reduced.ply")


main()
