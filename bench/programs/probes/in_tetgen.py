"""What TetGen makes of a file: tetrahedra with the number of their region."""
import json
import subprocess
import sys

subprocess.run(["tetgen", "-pAQ", sys.argv[1]], check=True, capture_output=True)
stem = sys.argv[1].rsplit(".", 1)[0] + ".1"
rows = [line.split() for line in open(stem + ".ele") if line.strip() and not line.startswith("#")][1:]
points = [[float(x) for x in line.split()[1:4]] for line in open(stem + ".node") if line.strip() and not line.startswith("#")][1:]
print("FOUND " + json.dumps({"extent": [max(p[n] for p in points) - min(p[n] for p in points) for n in range(3)],
                             "regions": len({row[5] for row in rows})}))
