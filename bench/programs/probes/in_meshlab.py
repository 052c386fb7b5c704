"""What MeshLab holds of a file: meshlabserver opens it and writes it as PLY."""
import json
import re
import subprocess
import sys

import vtk

done = subprocess.run(["xvfb-run", "-a", "meshlabserver", "-i", sys.argv[1], "-o", "seen.ply", "-m", "fc"], capture_output=True, text=True)
if done.returncode:
    failed = re.search("Assertion `.*' failed", done.stderr)
    raise SystemExit(failed[0] if failed else f"exit code {done.returncode}")
reader = vtk.vtkPLYReader()
reader.SetFileName("seen.ply")
reader.Update()
mesh, bounds = reader.GetOutput(), reader.GetOutput().GetBounds()
rgb = mesh.GetCellData().GetArray("RGB")
colours = {rgb.GetTuple(n)[:3] for n in range(rgb.GetNumberOfTuples())} if rgb else set()
print("FOUND " + json.dumps({"extent": [bounds[2 * n + 1] - bounds[2 * n] for n in range(3)], "regions": len(colours),
                             "faces": mesh.GetNumberOfCells(), "colours": len(colours)}))
