"""What meshio holds of a file."""
import json
import sys

import meshio

mesh = meshio.read(sys.argv[1])
faces = sum(len(block.data) for block in mesh.cells if block.type == "triangle")
values, colours = set(), 0
for title, arrays in mesh.cell_data.items():
    if "color" in title.lower() or "rgb" in title.lower() or title in ("red", "green", "blue"):
        colours = 2
    else:
        for array in arrays:
            values |= {int(value) for value in array.ravel().tolist() if value == int(value)}
names = [*mesh.field_data, *mesh.cell_sets]
extent = (mesh.points.max(axis=0) - mesh.points.min(axis=0)).tolist()
print("FOUND " + json.dumps({"extent": extent, "faces": faces, "colours": colours, "names": names,
                             "regions": max(len(values & {1, 2}), len(mesh.cell_sets), len([c for c in mesh.cells if c.type == "triangle"]) if len(mesh.cells) > 1 else 0)}))
