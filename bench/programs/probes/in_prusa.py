"""What PrusaSlicer holds of a file: its measures, the names of objects in what it saves, and whether it uses the unit."""
import json
import re
import subprocess
import sys
import zipfile


def run(*words):
    return subprocess.run(["prusa-slicer", *words], capture_output=True, text=True, check=True).stdout


def extent(path):
    said = run("--info", path)
    low, high = ([[float(x) for x in re.findall(rf"{end}_{axis} = (\S+)", said)] for axis in "xyz"] for end in ("min", "max"))
    return [max(b) - min(a) for a, b in zip(low, high)], [int(count) for count in re.findall(r"number_of_facets = (\d+)", said)]


path = sys.argv[1]
size, faces = extent(path)
found = {"extent": size, "faces": sum(faces), "regions": len(faces)}
run("--export-3mf", "--dont-arrange", "--output", "seen.3mf", path)
with zipfile.ZipFile("seen.3mf") as saved:
    found["names"] = re.findall(r'<metadata type="object" key="name" value="([^"]*)"', saved.read("Metadata/Slic3r_PE_model.config").decode())
if path.endswith(".3mf"):  # the same file in micrometres is a thousandth as large
    with zipfile.ZipFile(path) as model, zipfile.ZipFile("micron.3mf", "w") as other:
        for entry in model.namelist():
            other.writestr(entry, model.read(entry).replace(b'unit="millimeter"', b'unit="micron"'))
    found["units"] = all(abs(1000 * a - b) < 1e-2 for a, b in zip(extent("micron.3mf")[0], size))
print("FOUND " + json.dumps(found))
