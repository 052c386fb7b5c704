"""What CalculiX reads of a file: a step without loads on shells, by the sets of interfaces; volumes by the sets of regions."""
import json
import pathlib
import re
import subprocess
import sys

THICKNESS = 1e-6
model = pathlib.Path(sys.argv[1])
text = model.read_text()
interfaces = re.findall(r"^\*ELEMENT, TYPE=S3, ELSET=(\S+)", text, re.MULTILINE)
regions = re.findall(r"^\*ELSET, ELSET=(\S+)", text, re.MULTILINE)
nodes = [int(number) for number in re.findall(r"^(\d+),", text.split("*NODE")[1].split("*")[0], re.MULTILINE)]
deck = [f"*INCLUDE, INPUT={model.name}", f"*NSET, NSET=all, GENERATE\n{min(nodes)}, {max(nodes)}",
        "*MATERIAL, NAME=stuff\n*ELASTIC\n1000, 0.3"]
deck += [f"*SHELL SECTION, ELSET={name}, MATERIAL=stuff\n{THICKNESS}" for name in interfaces]
deck += ["*STEP\n*STATIC\n*BOUNDARY\nall, 1, 3", "*NODE FILE\nU"]
deck += [f"*EL PRINT, ELSET={name}, TOTALS=ONLY\nEVOL" for name in regions]
(model.parent / "deck.inp").write_text("\n".join(deck) + "\n*END STEP\n")
done = subprocess.run(["ccx", "deck"], cwd=model.parent, capture_output=True, text=True)
if "*ERROR" in done.stdout or "Job finished" not in done.stdout:
    raise SystemExit((re.search(r"\*ERROR.*", done.stdout) or ["it ends early"])[0])
totals = re.findall(r"volume[^\n]*set (\S+)[^\n]*\n\n\s*(\S+)", (model.parent / "deck.dat").read_text())
lines = (model.parent / "deck.frd").read_text().split("\n")
begin = next(n for n, line in enumerate(lines) if line.startswith("    2C"))
points = []
for line in lines[begin + 1:]:
    if not line.startswith(" -1"):
        break
    points.append([float(line[13 + 12 * n:25 + 12 * n]) for n in range(3)])
elements = sum(line.startswith(" -1") for line in lines[next(n for n, line in enumerate(lines) if line.startswith("    3C")) + 1:]
               [:next(n for n, line in enumerate(lines[next(k for k, one in enumerate(lines) if one.startswith("    3C")) + 1:])
                      if line.startswith(" -3"))])
print("FOUND " + json.dumps({"extent": [max(p[n] for p in points) - min(p[n] for p in points) for n in range(3)],
                             "faces": elements, "regions": len(totals), "names": [name.lower() for name, _ in totals]}))
