#!/usr/bin/python3
"""Runs the filters of docs/smoothing.md, draws the contact sheets and prints the tables:

    smoothing.py REGIONMESH VOLUMES [OUT] [SCENE...]

REGIONMESH is the program, VOLUMES a folder with chamfer_slab.npy, dpyramid_2reg_s1.npy, dpyramid_2reg_s4.npy and
in100_60x80x100.npy anywhere below it, OUT the folder of the pictures (this one if not given). Without a screen:
xvfb-run -a docs/pictures/smoothing.py ... Needs python3-vtk9 (script/bootstrap picture).
"""
import json
import pathlib
import subprocess
import sys
import tempfile

import numpy
import vtk
from vtk.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy

from render import line_actor, read, write_png

VARIANTS = (("none", 0), ("taubin", 20), ("taubin", 100), ("nifpms", 1), ("laplacian", 20), ("laplacian", 100))
EXTREMES = (("laplacian", 1000), ("laplacian", 5000), ("taubin", 5000))
CHAIN = 50  # passes of one call where many are made: the guard measures against what came in
TILE, COLUMNS = (480, 340), 3
CAPTION = 34  # pixels at the foot of a tile


def caption(filter_name, passes):
    if passes == 0:
        return "as reconstructed"
    return f"{filter_name}, one pass" if passes == 1 else f"{filter_name}, {passes} passes"


# Runs


def find_volume(folder, name):
    found = sorted(pathlib.Path(folder).rglob(name))
    if not found:
        sys.exit(f"smoothing.py: no {name} below {folder}")
    return found[0]


def reconstruct(program, volume, options, filter_name, passes, folder):
    """Model and report of a plain reconstruction, smoothed while it is read."""
    model, report = folder / f"{filter_name}-{passes}.vtp", folder / "report.json"
    smoothing = ["--smooth", str(passes)] + (["--smooth-filter", filter_name] if passes else [])
    subprocess.run([program, "reconstruct", volume, "--no-decimate", "--quiet", *options, *smoothing, "-o", model,
                    "--report", report], check=True)
    return read(str(model)), json.loads(report.read_text()), model


def smooth_in_core(program, plain, filter_name, passes, folder):
    """Short calls one after the other, without a bound on quality. One report for all of them."""
    model, report, model_before = folder / "core.vtp", folder / "core.json", plain
    reports = []
    for _ in range(passes // CHAIN):
        subprocess.run([program, "smooth", model_before, "--min-quality", "0", "--quiet", "--smooth", str(CHAIN),
                        "--smooth-filter", filter_name, "-o", model, "--report", report], check=True)
        model_before = model
        reports.append(json.loads(report.read_text()))
    whole, smoothed = reports[-1], read(str(model))
    for key in ("turned_faces", "low_quality_faces", "crossing_pairs", "stepped_back"):
        whole["smoothing"][key] = sum(each["smoothing"][key] for each in reports)
    moved = numpy.linalg.norm(points_of(smoothed) - points_of(read(str(plain))), axis=1)
    whole["smoothing"] |= {"largest_displacement": moved.max(), "rms_displacement": (moved**2).mean() ** 0.5}
    for region, before in zip(whole["regions"], reports[0]["regions"]):
        region["volume_unsmoothed"] = before["volume_unsmoothed"]
    return smoothed, whole


def points_of(model):
    return vtk_to_numpy(model.GetPoints().GetData())


# Tables


def change(region):
    return 100 * (region["volume_smoothed"] / region["volume_unsmoothed"] - 1)


def octant(points, centre_of):
    """Distances from the middle along the axes, and half the size."""
    low, high = centre_of.min(axis=0), centre_of.max(axis=0)
    return abs(points - (low + high) / 2), (high - low) / 2


def spread_left(before, after, zones):
    """What is left of steps on 45-degree slopes: spread of |u| + |v| over the vertices of each zone (u, v, mask)."""
    left = [(after[mask][:, u] + after[mask][:, v]).std() / (before[mask][:, u] + before[mask][:, v]).std()
            for u, v, mask in zones]
    return f"{100 * sum(left) / len(left):.0f} %"


def measures_of_slab(runs):
    """By run: change of volume, what is left of the steps, and what the edges beside the chamfers have lost."""
    plain = points_of(runs[0][1])
    a, half = octant(plain, plain)
    chamfer = 8
    zones, edges = [], []
    for u, v in ((0, 1), (0, 2), (1, 2)):
        inner = a[:, 3 - u - v] < half[3 - u - v] - chamfer - 2
        near = [(half[w] - a[:, w] > 1.5) & (half[w] - a[:, w] < chamfer - 1.5) for w in (u, v)]
        zones.append((u, v, inner & near[0] & near[1]))
        for side, along in ((u, v), (v, u)):
            edges.append((side, inner & (a[:, side] > half[side] - 0.3) &
                          (abs(a[:, along] - (half[along] - chamfer + 0.25)) < 0.6)))
    for _, model, report in runs[1:]:
        b, _ = octant(points_of(model), plain)
        lost = [abs(half[side] - b[mask][:, side]).mean() for side, mask in edges]
        yield [f"{change(report['regions'][0]):+.2f}", spread_left(a, b, zones), f"{sum(lost) / len(lost):.2f}"]


def measures_of_pyramid(runs):
    """By run: change of volume, the same for both halves, and what is left of the steps."""
    plain = points_of(runs[0][1])
    a, half = octant(plain, plain)
    zones = [(u, 2, (a[:, u] - a[:, 1 - u] > 4) & (a[:, u] > 6) & (a[:, 2] > 3) & (a[:, 2] < half[2] - 6))
             for u in (0, 1)]
    for _, model, report in runs[1:]:
        changes = [f"{change(region):+.2f}" for region in report["regions"]]
        yield [" ".join(dict.fromkeys(changes)), spread_left(a, octant(points_of(model), plain)[0], zones)]


def measures_of_grain(shown):
    """By run: change of volume of the grain and of all, and the turning angle of lines."""
    def measures(runs):
        for _, _, report in runs[1:]:
            regions = report["regions"]
            moved = sum(abs(r["volume_smoothed"] - r["volume_unsmoothed"]) for r in regions)
            of_shown = next(change(r) for r in regions if r["label"] == shown)
            yield [f"{of_shown:+.2f}", f"{100 * moved / sum(r['volume_unsmoothed'] for r in regions):.2f}",
                   f"{report['triple_lines']['mean_turning_angle']:.1f}"]
    return measures


def print_table(title, scene, runs):
    """The first run is the plain one, with which the others are compared."""
    print(f"\n{title}\n")
    print("| filter | " + " | ".join(scene["heads"]) +
          " | largest, rms displacement | turned, low, crossing | held | stepped back | least quality | violations |")
    print("|---" * (len(scene["heads"]) + 7) + "|")
    for (name, _, report), own in zip(runs[1:], scene["measures"](runs)):
        did = report["smoothing"]
        print(f"| {name} | " + " | ".join(own) + f" | {did['largest_displacement']:.2f}, {did['rms_displacement']:.2f}"
              f" | {did['turned_faces']}, {did['low_quality_faces']}, {did['crossing_pairs']} | {did['held_vertices']}"
              f" | {did['stepped_back']} | {report['quality']['min']:.3f}"
              f" | {sum(report['violation_counts'].values())} |", flush=True)


# Pictures


def boundary_of(model, label):
    """The faces of one region, all turned outward, with only the vertices that they use."""
    both = vtk_to_numpy(model.GetCellData().GetArray("BoundaryLabels"))
    faces = vtk_to_numpy(model.GetPolys().GetConnectivityArray()).reshape(-1, 3)
    first, second = faces[both[:, 0] == label], faces[both[:, 1] == label]
    used, faces = numpy.unique(numpy.concatenate([first, second[:, ::-1]]), return_inverse=True)
    cells = vtk.vtkCellArray()
    cells.SetData(3, numpy_to_vtkIdTypeArray(faces.ravel().astype(numpy.int64), deep=True))
    points = vtk.vtkPoints()
    points.SetData(numpy_to_vtk(points_of(model)[used], deep=True))
    surface = vtk.vtkPolyData()
    surface.SetPoints(points)
    surface.SetPolys(cells)
    others = numpy.concatenate([both[both[:, 0] == label][:, 1], both[both[:, 1] == label][:, 0]])
    return surface, faces.reshape(-1, 3), others


def lines_of(surface, faces, others):
    """Edges of a region's boundary between faces with different neighbours."""
    edges = numpy.sort(numpy.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]]), axis=1)
    beyond = numpy.tile(others, 3)
    order = numpy.lexsort((edges[:, 1], edges[:, 0]))
    edges, beyond = edges[order], beyond[order]
    twins = (edges[1:] == edges[:-1]).all(axis=1) & (beyond[1:] != beyond[:-1])
    lines = vtk.vtkCellArray()
    lines.SetData(2, numpy_to_vtkIdTypeArray(edges[1:][twins].ravel().astype(numpy.int64), deep=True))
    result = vtk.vtkPolyData()
    result.SetPoints(surface.GetPoints())
    result.SetLines(lines)
    return result


def face_actor(surface, colour):
    mapper = vtk.vtkPolyDataMapper()
    mapper.SetInputData(surface)
    mapper.ScalarVisibilityOff()
    actor = vtk.vtkActor()
    actor.SetMapper(mapper)
    style = actor.GetProperty()
    style.SetColor(*colour)
    style.SetInterpolationToFlat()
    style.SetAmbient(0.16)
    style.SetDiffuse(0.9)
    style.SetSpecular(0)
    return actor


def text_actor(text):
    actor = vtk.vtkTextActor()
    actor.SetInput(text)
    style = actor.GetTextProperty()
    style.SetFontFamilyToArial()
    style.SetFontSize(19)
    style.SetColor(0.15, 0.15, 0.18)
    style.SetJustificationToCentered()
    actor.SetPosition(TILE[0] / 2, 9)
    return actor


def light(direction, strength):
    """Beside the camera, and moving with it."""
    lamp = vtk.vtkLight()
    lamp.SetLightTypeToCameraLight()
    lamp.SetPosition(*direction)
    lamp.SetFocalPoint(0, 0, 0)
    lamp.SetIntensity(strength)
    return lamp


def tile(model, scene, view):
    renderer = vtk.vtkRenderer()
    renderer.SetBackground(1, 1, 1)
    renderer.SetAutomaticLightCreation(False)
    for direction, strength in (((-0.6, 0.75, 0.5), 0.85), ((0.9, 0.1, 0.45), 0.36), ((0, -0.9, 0.5), 0.2)):
        renderer.AddLight(light(direction, strength))
    for label, colour in scene["regions"].items():
        surface, faces, others = boundary_of(model, label)
        renderer.AddActor(face_actor(surface, colour))
        if scene["lines"]:
            renderer.AddActor(line_actor(lines_of(surface, faces, others), 2.2))
    focus, height = view
    camera = renderer.GetActiveCamera()
    camera.ParallelProjectionOn()
    camera.SetFocalPoint(*focus)
    camera.SetPosition(*(f + 500 * e for f, e in zip(focus, scene["eye"])))
    camera.SetViewUp(0, 0, 1)
    camera.SetParallelScale(height / 2)
    renderer.ResetCameraClippingRange()
    return renderer


def view_of(model, scene):
    """Middle of what is shown, and how much height it takes in a tile."""
    box = vtk.vtkBoundingBox()
    for label in scene["regions"]:
        box.AddBounds(boundary_of(model, label)[0].GetBounds())
    focus = [0.0] * 3
    box.GetCenter(focus)
    return focus, scene["height"]


def draw(tiles, path):
    window = vtk.vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(8)
    rows = -(-len(tiles) // COLUMNS)
    size = (COLUMNS * TILE[0], rows * (TILE[1] + CAPTION))
    window.SetSize(*size)
    for n, (text, picture) in enumerate(tiles):
        left, foot = n % COLUMNS * TILE[0], (rows - 1 - n // COLUMNS) * (TILE[1] + CAPTION)
        place = vtk.vtkRenderer()  # the caption has a ground of its own, so that nothing is drawn over it
        place.SetBackground(1, 1, 1)
        place.AddActor2D(text_actor(text))
        for renderer, low, height in ((place, foot, CAPTION), (picture, foot + CAPTION, TILE[1])):
            renderer.SetViewport(left / size[0], low / size[1], (left + TILE[0]) / size[0], (low + height) / size[1])
            window.AddRenderer(renderer)
    window.Render()
    write_png(window, str(path))


# Scenes


def largest_inside(volume):
    """The largest region that does not touch the box."""
    labels = numpy.load(volume)
    sides = [numpy.take(labels, end, axis).ravel() for axis in range(3) for end in (0, -1)]
    inside = ~numpy.isin(labels, numpy.unique(numpy.concatenate(sides)))
    found, counts = numpy.unique(labels[inside], return_counts=True)
    return int(found[counts.argmax()])


def run_scene(program, volume, out, name, scene, folder):
    """Draws the six variants of a scene. Returns tiles of its extremes."""
    files, runs = zip(*((file, (caption(*variant), model, report)) for variant in VARIANTS
                        for model, report, file in [reconstruct(program, volume, scene["options"], *variant, folder)]))
    _, plain, report = runs[0]
    print_table(f"{name}, {report['final_faces']} faces; volumes in percent; least quality before "
                f"{report['quality']['min']:.3f}, turning of lines before "
                f"{report['triple_lines']['mean_turning_angle']:.1f} degrees", scene, runs)
    view = view_of(plain, scene)
    draw([(text, tile(model, scene, view)) for text, model, _ in runs], out / f"smoothing-{name}.png")
    if not scene.get("extremes"):
        return []
    far = [(caption(*variant), *smooth_in_core(program, files[0], *variant, folder)) for variant in EXTREMES]
    print_table(f"{name}, in calls of {CHAIN} passes, no bound on quality", scene, [runs[0], *far])
    return [(text, tile(model, scene, view)) for text, model, _ in far]


def scenes(volumes):
    blue, clay, sand, green = (0.66, 0.78, 0.93), (0.95, 0.68, 0.52), (0.96, 0.85, 0.58), (0.70, 0.86, 0.70)
    yield "slab", find_volume(volumes, "chamfer_slab.npy"), {
        "options": [], "regions": {1: blue}, "lines": False, "eye": (0.5, -0.72, 0.48), "height": 78, "extremes": True,
        "heads": ["volume", "steps left", "edges lost"], "measures": measures_of_slab}
    pyramid = {"options": [], "regions": {1: clay, 2: sand}, "lines": True, "eye": (0.42, -0.8, 0.36), "height": 56,
               "heads": ["volume", "steps left"], "measures": measures_of_pyramid}
    yield "pyramid", find_volume(volumes, "dpyramid_2reg_s4.npy"), pyramid | {"extremes": True}
    yield "pyramid-fine", find_volume(volumes, "dpyramid_2reg_s1.npy"), pyramid
    polycrystal = find_volume(volumes, "in100_60x80x100.npy")
    shown = largest_inside(polycrystal)
    yield "grain", polycrystal, {
        "options": ["--no-background"], "regions": {shown: green}, "lines": True, "eye": (0.62, -0.62, 0.5),
        "height": 45, "heads": ["grain's volume", "volumes of all", "turning"], "measures": measures_of_grain(shown)}


def main():
    program, volumes = sys.argv[1], sys.argv[2]
    out = pathlib.Path(sys.argv[3] if len(sys.argv) > 3 else pathlib.Path(__file__).parent)
    extremes = []
    for name, volume, scene in scenes(volumes):
        if sys.argv[4:] and name not in sys.argv[4:]:
            continue
        with tempfile.TemporaryDirectory() as folder:
            extremes += run_scene(program, volume, out, name, scene, pathlib.Path(folder))
    if extremes:
        draw(extremes, out / "smoothing-extreme.png")


if __name__ == "__main__":
    main()
