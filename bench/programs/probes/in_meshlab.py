"""What MeshLab holds of a file: meshlabserver opens it and writes it as PLY."""
import json
import re
import subprocess
import sys

import meshio

done = subprocess.run(["xvfb-run", "-a", "meshlabserver", "-i", sys.argv[1], "-o", "seen.ply", "-m", "fc"], capture_output=True, text=True)
if done.returncode:
    failed = re.search("Assertion `.*' failed", done.stderr)
    raise SystemExit(failed[0] if failed else f"exit code {done.returncode}")
mesh = meshio.read("seen.ply")
colours = {tuple(int(mesh.cell_data[name][0][n]) for name in ("red", "green", "blue")) for n in range(len(mesh.cells[0].data))
           } if "red" in mesh.cell_data else set()
print("FOUND " + json.dumps({"extent": (mesh.points.max(axis=0) - mesh.points.min(axis=0)).tolist(), "regions": len(colours),
                             "faces": sum(len(block.data) for block in mesh.cells), "colours": len(colours)}))
