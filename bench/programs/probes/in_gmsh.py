"""What Gmsh holds of a file: it opens the file, and writes it with all entities and physical groups."""
import json
import re
import subprocess
import sys

import meshio

done = subprocess.run(["gmsh", "-v", "1", "-0", sys.argv[1], "-save_all", "-format", "msh22", "-o", "seen.msh"], timeout=60,
                      stdin=subprocess.DEVNULL, capture_output=True, text=True)
if done.returncode:
    raise SystemExit((done.stderr or done.stdout).strip().splitlines()[-1] if done.stderr or done.stdout else f"exit code {done.returncode}")
mesh = meshio.gmsh.read("seen.msh")
faces = [block for block in mesh.cells if block.type == "triangle"]
used = {n for block in faces for n in block.data.ravel().tolist()}
points = mesh.points[sorted(used)]
names = re.findall(r'"([^"]*)"', open("seen.msh", errors="replace").read(100000))
geometry = {int(value) for array in mesh.cell_data.get("gmsh:geometrical", []) for value in array.tolist()}
print("FOUND " + json.dumps({"extent": (points.max(axis=0) - points.min(axis=0)).tolist(), "faces": sum(len(b.data) for b in faces),
                             "regions": len(geometry), "names": names}))
