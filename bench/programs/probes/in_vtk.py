"""What VTK holds of a file."""
import json
import sys

import vtk

path = sys.argv[1]
READERS = {"vtp": vtk.vtkXMLPolyDataReader, "vtu": vtk.vtkXMLUnstructuredGridReader, "ply": vtk.vtkPLYReader,
           "obj": vtk.vtkOBJReader, "stl": vtk.vtkSTLReader, "glb": vtk.vtkGLTFReader}
reader = READERS[path.rsplit(".", 1)[1]]()
reader.SetFileName(path)
reader.Update()
data = reader.GetOutputDataObject(0)
blocks, names = [data], set()
if data.IsA("vtkMultiBlockDataSet"):
    blocks, iterator = [], data.NewIterator()
    while not iterator.IsDoneWithTraversal():
        blocks.append(iterator.GetCurrentDataObject())
        info = iterator.GetCurrentMetaData()
        if info and info.Has(vtk.vtkCompositeDataSet.NAME()):
            names.add(info.Get(vtk.vtkCompositeDataSet.NAME()))
        iterator.GoToNextItem()
low, high, faces, values, colours, space = [1e30] * 3, [-1e30] * 3, 0, set(), 0, ""
for block in blocks:
    bounds = block.GetBounds()
    low, high = [min(a, b) for a, b in zip(low, bounds[::2])], [max(a, b) for a, b in zip(high, bounds[1::2])]
    faces += block.GetNumberOfCells()
    cells, field = block.GetCellData(), block.GetFieldData()
    for n in range(cells.GetNumberOfArrays()):
        array = cells.GetAbstractArray(n)
        title = (array.GetName() or "").lower()
        if "rgb" in title or "colour" in title or "color" in title:
            colours = 2
        elif "label" in title or "region" in title or "group" in title:
            for component in range(array.GetNumberOfComponents()):
                values |= {array.GetComponent(k, component) for k in range(array.GetNumberOfTuples())}
    for n in range(field.GetNumberOfArrays()):
        array = field.GetAbstractArray(n)
        if array.IsA("vtkStringArray"):
            texts = [array.GetValue(k) for k in range(array.GetNumberOfValues())]
            names |= set(texts)
            if any("SPACE" in text or text in ("RAS", "LPS") for text in texts):
                space = "yes"
print("FOUND " + json.dumps({"extent": [b - a for a, b in zip(low, high)], "faces": faces, "names": sorted(names), "space": space,
                             "regions": max(len(values & {1, 2}), len(blocks) if len(blocks) > 1 else 0), "colours": colours}))
