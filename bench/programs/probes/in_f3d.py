"""What F3D shows of a file: its log, and the colours of its picture."""
import colorsys
import json
import math
import re
import subprocess
import sys

import vtk

path = sys.argv[1]
log = subprocess.run(["xvfb-run", "-a", "f3d", "--no-render", "--verbose", path], capture_output=True, text=True, check=True).stdout
subprocess.run(["xvfb-run", "-a", "f3d", "--quiet", "--output", "seen.png", path], capture_output=True, check=True)
reader = vtk.vtkPNGReader()
reader.SetFileName("seen.png")
reader.Update()
pixels = reader.GetOutput().GetPointData().GetScalars()
hues = {}
for n in range(0, pixels.GetNumberOfTuples(), 37):
    hue, saturation, _ = colorsys.rgb_to_hsv(*(part / 255 for part in pixels.GetTuple(n)[:3]))
    if saturation > 0.25:
        hues[round(8 * hue) % 8] = hues.get(round(8 * hue) % 8, 0) + 1


def point(name):
    return [float(x) for x in re.search(name + ": (.*)", log)[1].split(",")]


# The camera stands where the sphere round the model fills its angle of 30 degrees.
radius = math.dist(point("Camera position"), point("Camera focal point")) * math.sin(math.radians(15))
arrays = re.findall(r"^ *(\w+) : [\w ]+ : (.*)$", log, re.MULTILINE)
faces = [int(count) for count in re.findall(r"Number of polygons: (\d+)", log)]
names = re.findall(r"material named (\S+)|(.*) Primitive Geometry", log)
colours = sum(count > 30 for count in hues.values())
regions = any(name == "Region" for name, _ in arrays) or len({name for pair in names for name in pair if name}) > 1
print("FOUND " + json.dumps({"diagonal": 2 * radius, "faces": sum(faces) or None, "regions": 2 if regions else 0,
                             "names": [name for pair in names for name in pair if name], "colours": colours,
                             "space": any(name == "SPACE" for name, _ in arrays)}))
