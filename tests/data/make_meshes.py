#!/usr/bin/python3
"""Write meshes/ beside this file: tetrahedra with labels, by VTK (python3-vtk9), meshio and Gmsh themselves.

VTK: the box 2 x 1 x 1 of two cubes, six tetrahedra each, region 3 where x < 1 and 5 beyond; triangles in front of the
tetrahedra and lines behind them. Gmsh: two boxes that share a side, meshed coarsely, groups `left` (7) and `right`
(9). What VTK's reader and meshio find in them stands in a .txt for several that must hold the same: a line for each
tetrahedron, its twelve coordinates to nine digits, and its label.
"""
import itertools, os, subprocess, tempfile

import meshio
import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkUnstructuredGrid
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader, vtkXMLUnstructuredGridWriter

FOLDER = os.path.join(os.path.dirname(os.path.abspath(__file__)), "meshes")
os.makedirs(FOLDER, exist_ok=True)


def place(name):
    return os.path.join(FOLDER, name)


truths = {}


def write_truth(name, points, tetrahedra, labels):
    text = ""
    for corners, label in zip(tetrahedra, labels):
        text += " ".join(f"{c:.9g}" for c in np.asarray(points)[corners].ravel()) + f" {int(label)}\n"
    assert truths.setdefault(name, text) == text, name
    with open(place(name + ".txt"), "w") as out:
        out.write(text)


def cubes():
    points = [(x, y, z) for z in range(2) for y in range(2) for x in range(3)]
    number = {p: i for i, p in enumerate(points)}
    tetrahedra, labels = [], []
    for x, axes in itertools.product(range(2), itertools.permutations(range(3))):
        corner, tetrahedron = [x, 0, 0], [number[x, 0, 0]]
        for axis in axes:
            corner[axis] += 1
            tetrahedron.append(number[tuple(corner)])
        tetrahedra.append(tetrahedron)
        labels.append(3 if x == 0 else 5)
    return np.array(points, float), np.array(tetrahedra), np.array(labels)


def grid(labels_of_points):
    points, tetrahedra, labels = cubes()
    data = vtkUnstructuredGrid()
    places = vtkPoints()
    places.SetDataTypeToDouble()
    for p in points:
        places.InsertNextPoint(*(p * [1, 1, 0.1]))
    data.SetPoints(places)
    data.InsertNextCell(5, 3, (0, 1, 3))
    for corners in tetrahedra:
        data.InsertNextCell(10, 4, corners)
    data.InsertNextCell(3, 2, (0, 1))
    cell_labels = np.concatenate([[0], labels, [0]]).astype(np.int16)
    point_labels = (10 + points[:, 0]).astype(np.uint8)
    for values, owner, name in (
        (cell_labels, data.GetCellData(), "region"),
        (point_labels, data.GetPointData(), "tissue"),
        (np.arange(len(points)), data.GetPointData(), "GlobalIds"),
        (np.linspace(0, 1, len(points)), data.GetPointData(), "temperature"),
    ):
        if name == ("region" if labels_of_points else "tissue"):
            continue
        array = numpy_to_vtk(values, deep=True)
        array.SetName(name)
        owner.AddArray(array)
    return data


def write_vtu(name, data, mode, compressed, words, big_endian=False):
    writer = vtkXMLUnstructuredGridWriter()
    writer.SetInputData(data)
    writer.SetFileName(place(name + ".vtu"))
    writer.SetDataMode({"ascii": writer.Ascii, "binary": writer.Binary, "raw": writer.Appended, "base64": writer.Appended}[mode])
    writer.SetEncodeAppendedData(mode == "base64")
    writer.SetCompressorType(writer.ZLIB if compressed else writer.NONE)
    writer.SetHeaderType(writer.UInt32 if words == 32 else writer.UInt64)
    writer.SetIdType(writer.Int32 if words == 32 else writer.Int64)
    writer.SetBlockSize(128)
    if big_endian:
        writer.SetByteOrderToBigEndian()
    assert writer.Write()
    reader = vtkXMLUnstructuredGridReader()
    reader.SetFileName(place(name + ".vtu"))
    reader.Update()
    found = reader.GetOutput()
    cells = [i for i in range(found.GetNumberOfCells()) if found.GetCellType(i) == 10]
    corners = [[found.GetCell(i).GetPointId(k) for k in range(4)] for i in cells]
    region = found.GetCellData().GetArray("region")
    if region:
        write_truth("vtk", vtk_to_numpy(found.GetPoints().GetData()), corners, vtk_to_numpy(region)[cells])


by_cells = grid(labels_of_points=False)
write_vtu("vtk_ascii", by_cells, "ascii", False, 64)
for mode, compressed, words in itertools.product(("binary", "raw", "base64"), (False, True), (32, 64)):
    write_vtu(f"vtk_{mode}_{'zlib' if compressed else 'plain'}_{words}", by_cells, mode, compressed, words)
write_vtu("vtk_raw_zlib_big_endian", by_cells, "raw", True, 64, big_endian=True)
write_vtu("vtk_points", grid(labels_of_points=True), "binary", True, 32)

points, tetrahedra, labels = cubes()
for binary in (False, True):
    name = "meshio_" + ("binary" if binary else "ascii")
    mesh = meshio.Mesh(points, [("triangle", tetrahedra[:1, :3]), ("tetra", tetrahedra)], cell_data={"medit:ref": [np.array([0]), labels]})
    mesh.write(place(name + ".vtu"), binary=binary)
    write_truth("meshio", points, tetrahedra, labels)

views = meshio.Mesh(points, [("tetra", tetrahedra)], cell_data={"label": [labels.astype(float)]}, point_data={"tissue": 10 + points[:, 0]})
views.write(place("views_22_ascii.msh"), file_format="gmsh22", binary=False)
views.write(place("views_41_binary.msh"), file_format="gmsh", binary=True)

GEO = """
SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 1, 1, 1};
Box(2) = {1, 0, 0, 0.5, 1, 1};
Coherence;
MeshSize{:} = 2;
"""
GROUPS = """
Physical Volume("left", 7) = {1};
Physical Volume("right", 9) = {2};
Physical Surface("front", 3) = {1};
"""


def write_msh(name, geo, version, binary, labels_are, options=()):
    with tempfile.TemporaryDirectory() as folder:
        source = os.path.join(folder, "boxes.geo")
        with open(source, "w") as out:
            out.write(geo)
        command = ["gmsh", "-3", "-format", version, "-bin" if binary else "", *options, "-o", place(name + ".msh"), source]
        subprocess.run([word for word in command if word], check=True, stdout=subprocess.DEVNULL)
    mesh = meshio.read(place(name + ".msh"))
    found, values = [], []
    for block, labels in zip(mesh.cells, mesh.cell_data[labels_are]):
        if block.type == "tetra":
            found += list(block.data)
            values += list(labels)
    write_truth(labels_are.replace(":", "_"), mesh.points, found, values)


for version, binary in itertools.product(("msh22", "msh41"), (False, True)):
    name = f"gmsh_{version[3:]}_{'binary' if binary else 'ascii'}"
    write_msh(name, GEO + GROUPS, version, binary, "gmsh:physical")
    write_msh(name + "_volumes", GEO, version, binary, "gmsh:geometrical")
