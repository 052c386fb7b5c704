#!/usr/bin/python3
"""Write vtp_*.vtp beside this file with VTK's own writer (Debian: python3-vtk9), in every encoding it has.

The surface: the box 1 x 1 x 2, region 3 in its lower half and 5 in its upper, exterior -1: 12 points, 22 triangles.
"""
import itertools, os

from vtkmodules.vtkCommonCore import vtkDoubleArray, vtkFloatArray, vtkIntArray, vtkLongLongArray, vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter

# Corners are numbered x + 2 y + 4 z; each quad is turned outward, or up for the interface.
QUADS = [((0, 2, 3, 1), 3, -1), ((4, 5, 7, 6), 3, 5), ((8, 9, 11, 10), 5, -1)]
for low, label in ((0, 3), (4, 5)):
    for a, b in ((0, 1), (1, 3), (3, 2), (2, 0)):
        QUADS.append(((low + a, low + b, low + b + 4, low + a + 4), label, -1))


def surface(array_of_points, array_of_labels):
    points = vtkPoints()
    points.SetData(array_of_points)
    for z, y, x in itertools.product(range(3), range(2), range(2)):
        points.InsertNextPoint(x, y, z)
    polys, labels = vtkCellArray(), array_of_labels
    labels.SetName("BoundaryLabels")
    labels.SetNumberOfComponents(2)
    for (a, b, c, d), first, second in QUADS:
        for triangle in ((a, b, c), (a, c, d)):
            polys.InsertNextCell(3, triangle)
            labels.InsertNextTuple2(first, second)
    data = vtkPolyData()
    data.SetPoints(points)
    data.SetPolys(polys)
    data.GetCellData().AddArray(labels)
    return data


def write(name, mode, compressed, words, big_endian=False):
    small = words == 32
    points = vtkFloatArray() if small else vtkDoubleArray()
    points.SetNumberOfComponents(3)
    writer = vtkXMLPolyDataWriter()
    writer.SetInputData(surface(points, vtkIntArray() if small else vtkLongLongArray()))
    writer.SetFileName(os.path.join(os.path.dirname(os.path.abspath(__file__)), f"vtp_{name}.vtp"))
    writer.SetDataMode({"ascii": writer.Ascii, "binary": writer.Binary, "raw": writer.Appended, "base64": writer.Appended}[mode])
    writer.SetEncodeAppendedData(mode == "base64")
    writer.SetCompressorType(writer.ZLIB if compressed else writer.NONE)
    writer.SetHeaderType(writer.UInt32 if small else writer.UInt64)
    writer.SetIdType(writer.Int32 if small else writer.Int64)
    writer.SetBlockSize(128)
    if big_endian:
        writer.SetByteOrderToBigEndian()
    assert writer.Write()


write("ascii", "ascii", False, 64)
for mode, compressed, words in itertools.product(("binary", "raw", "base64"), (False, True), (32, 64)):
    write(f"{mode}_{'zlib' if compressed else 'plain'}_{words}", mode, compressed, words)
write("raw_zlib_big_endian", "raw", True, 64, big_endian=True)
