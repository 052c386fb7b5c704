#!/usr/bin/python3
"""Write surfaces/ beside this file with other programs: VTK, meshio and h5py (Debian: python3-vtk9, python3-meshio,
python3-h5py).

All hold the box 1 x 1 x 2, region 3 in its lower half and 5 in its upper, outside -1: 12 points, 22 triangles, or 11
quads where the name says so. By region: the two boxes, closed each for itself.
"""
import os

import h5py
import meshio
import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
from vtkmodules.vtkIOGeometry import vtkOBJWriter, vtkSTLWriter
from vtkmodules.vtkIOPLY import vtkPLYWriter
from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter

FOLDER = os.path.join(os.path.dirname(os.path.abspath(__file__)), "surfaces")
POINTS = np.array([(x, y, z) for z in range(3) for y in range(2) for x in range(2)], float)

# Corners are numbered x + 2 y + 4 z; each quad is turned outward, or up for the interface.
QUADS = [((0, 2, 3, 1), 3, -1), ((4, 5, 7, 6), 3, 5), ((8, 9, 11, 10), 5, -1)]
for low, label in ((0, 3), (4, 5)):
    for a, b in ((0, 1), (1, 3), (3, 2), (2, 0)):
        QUADS.append(((low + a, low + b, low + b + 4, low + a + 4), label, -1))
TRIANGLES = [((c[i], c[j], c[k]), first, second) for c, first, second in QUADS for i, j, k in ((0, 1, 2), (0, 2, 3))]
CELLS = np.array([t[0] for t in TRIANGLES])
LABELS = np.array([t[1:] for t in TRIANGLES], np.int32)


def path(name):
    return os.path.join(FOLDER, name)


def poly_data(corners, labels=None):
    corners = np.asarray(corners, np.int64)
    points, cells, data = vtkPoints(), vtkCellArray(), vtkPolyData()
    points.SetData(numpy_to_vtk(POINTS.astype(np.float32), deep=1))
    offsets = np.arange(0, corners.size + 1, corners.shape[1], dtype=np.int64)
    cells.SetData(numpy_to_vtkIdTypeArray(offsets, deep=1), numpy_to_vtkIdTypeArray(corners.ravel(), deep=1))
    data.SetPoints(points)
    data.SetPolys(cells)
    if labels is not None:
        array = numpy_to_vtk(np.ascontiguousarray(labels, np.int32), deep=1)
        array.SetName("BoundaryLabels")
        data.GetCellData().AddArray(array)
    return data


def write(writer, data, name, binary=None):
    writer.SetInputData(data)
    writer.SetFileName(path(name))
    if binary is not None:
        writer.SetFileTypeToBinary() if binary else writer.SetFileTypeToASCII()
    assert writer.Write()


def boundary(label):
    """The closed boundary of one region, outward."""
    faces = []
    for corners, first, second in TRIANGLES:
        if first == label:
            faces.append(corners)
        elif second == label:
            faces.append(corners[::-1])
    return np.array(faces)


def dream3d(name, version):
    """As DREAM.3D 6 and DREAM3D-NX lay it out; the second has a volume beside."""
    with h5py.File(path(name), "w") as file:
        file.attrs["FileVersion"] = f"{version}.0"
        if version < 8:
            container = file.create_group("DataContainers/TriangleDataContainer")
            lists = container.create_group("_SIMPL_GEOMETRY")
            lists.attrs["GeometryTypeName"] = "TriangleGeometry"
        else:
            container = lists = file.create_group("DataStructure/TriangleDataContainer")
            lists.attrs["ObjectType"] = "TriangleGeom"
            file.create_group("DataStructure/Image")["FeatureIds"] = np.zeros((2, 2, 2, 1), np.int32)
        lists["SharedVertexList"] = POINTS.astype(np.float32)
        lists.create_dataset("SharedTriList", data=CELLS.astype(np.int64 if version < 8 else np.uint64), chunks=(8, 3),
                             compression="gzip" if version == 8 else None)
        container.create_group("FaceData")["FaceLabels"] = LABELS
        container.create_group("VertexData")["NodeType"] = np.full((12, 1), 14, np.int8)


def main():
    os.makedirs(FOLDER, exist_ok=True)
    quads, quad_labels = [q[0] for q in QUADS], [q[1:] for q in QUADS]
    write(vtkXMLPolyDataWriter(), poly_data(quads, quad_labels), "vtk_quads.vtp")
    write(vtkSTLWriter(), poly_data(boundary(3)), "vtk_text.stl", False)
    write(vtkSTLWriter(), poly_data(boundary(3)), "vtk_binary.stl", True)
    write(vtkOBJWriter(), poly_data(boundary(3)), "vtk.obj")
    ply = vtkPLYWriter()
    ply.SetDataByteOrderToBigEndian()
    write(ply, poly_data(boundary(3)), "vtk_big_endian.ply", True)
    ply = vtkPLYWriter()
    write(ply, poly_data(boundary(3)), "vtk_text.ply", False)

    mesh = meshio.Mesh(POINTS, [("triangle", CELLS)], cell_data={"BoundaryLabels": [LABELS.astype(np.int64)]})
    mesh.write(path("meshio.vtu"))
    meshio.write(path("meshio_text.vtu"), mesh, binary=False)
    mixed = meshio.Mesh(POINTS, [("quad", np.array(quads[:5])), ("triangle", CELLS[10:])],
                        cell_data={"BoundaryLabels": [np.array(quad_labels[:5], np.int64), LABELS[10:].astype(np.int64)]})
    mixed.write(path("meshio_quads.vtu"))
    meshio.write(path("meshio.ply"), meshio.Mesh(POINTS, [("triangle", boundary(3))]), binary=True)

    dream3d("dream3d_6.dream3d", 7)
    dream3d("dream3d_8.dream3d", 8)

    folder = path("regions")
    os.makedirs(folder, exist_ok=True)
    for label in (3, 5):
        write(vtkSTLWriter(), poly_data(boundary(label)), f"regions/region_{label}.stl", True)


main()
