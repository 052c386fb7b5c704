"""What Assimp holds of a file; many viewers and game engines read through it."""
import json
import re
import subprocess
import sys

told = subprocess.run(["assimp", "info", sys.argv[1]], capture_output=True, text=True, check=True).stdout


def point(name):
    return [float(x) for x in re.search(name + r"[^(]*\(([^)]*)\)", told)[1].split()]


meshes = int(re.search(r"Meshes:\s+(\d+)", told)[1])
materials = int(re.search(r"Materials:\s+(\d+)", told)[1])
print("FOUND " + json.dumps({"extent": [b - a for a, b in zip(point("Minimum point"), point("Maximum point"))],
                             "faces": int(re.search(r"Faces:\s+(\d+)", told)[1]), "regions": meshes, "colours": materials,
                             "names": re.findall(r"'([^']*)'", told)}))
