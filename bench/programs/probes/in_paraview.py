"""What ParaView holds of a file: its own readers, as File > Open chooses them."""
import json
import sys

from paraview import simple

source = simple.OpenDataFile(sys.argv[1])
source.UpdatePipeline()
information = source.GetDataInformation()
bounds = information.GetBounds()
names, values, colours, space = set(), set(), 0, ""
cells = source.GetCellDataInformation()
for n in range(cells.GetNumberOfArrays()):
    array = cells.GetArray(n)
    title = array.GetName().lower()
    if "rgb" in title or "color" in title:
        colours = 2
    elif "region" in title or "label" in title:
        for component in range(array.GetNumberOfComponents()):
            low, high = array.GetRange(component)
            values |= set(range(int(low), int(high) + 1))
data = simple.servermanager.Fetch(source)
blocks = []
if data.IsA("vtkMultiBlockDataSet"):
    iterator = data.NewIterator()
    while not iterator.IsDoneWithTraversal():
        blocks.append(iterator.GetCurrentDataObject())
        if iterator.HasCurrentMetaData():
            names.add(str(iterator.GetCurrentMetaData()))
        iterator.GoToNextItem()
for block in blocks or [data]:
    field = block.GetFieldData()
    for n in range(field.GetNumberOfArrays()):
        array = field.GetAbstractArray(n)
        if array.IsA("vtkStringArray"):
            texts = [array.GetValue(k) for k in range(array.GetNumberOfValues())]
            names |= set(texts)
            if any("SPACE" in text or text in ("RAS", "LPS") for text in texts):
                space = "yes"
print("FOUND " + json.dumps({"extent": [bounds[2 * n + 1] - bounds[2 * n] for n in range(3)], "faces": information.GetNumberOfCells(),
                             "regions": max(len(values & {1, 2}), len(blocks)), "names": sorted(names), "colours": colours,
                             "space": space}), flush=True)
