"""What ADMesh holds of a file."""
import json
import re
import subprocess
import sys

told = subprocess.run(["admesh", sys.argv[1]], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True).stdout
if "Number of facets" not in told:
    raise SystemExit((told.strip().splitlines() or ["nothing"])[-1])
bounds = [(float(a), float(b)) for a, b in re.findall(r"Min [XYZ] = +(\S+), Max [XYZ] = +(\S+)", told)]
print("FOUND " + json.dumps({"extent": [b - a for a, b in bounds], "faces": int(re.search(r"Number of facets +: +(\d+)", told)[1])}))
