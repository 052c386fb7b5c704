"""P 4.2, Fig. 4 to 6: what three filters do to a slab, a double pyramid and a grain."""
import numpy

import draw
from lab import ALL_REGIONS
from quality import GREEN, largest_inside

TITLE = "Smoothing: slab, pyramid, grain (P 4.2, Fig. 4 to 6)"
VARIANTS = (("none", 0), ("taubin", 20), ("taubin", 100), ("nifpms", 1), ("laplacian", 20), ("laplacian", 100))
EXTREMES = (("laplacian", 1000), ("laplacian", 5000), ("taubin", 5000))
CHAIN = 50  # passes of one call where many are made: the guard measures against what came in


def caption(filter_name, passes):
    if passes == 0:
        return "as reconstructed"
    return f"{filter_name}, one pass" if passes == 1 else f"{filter_name}, {passes} passes"


# Runs


def reconstruct(lab, volume, options, filter_name, passes):
    """Model and report of a plain reconstruction, smoothed while it is read."""
    model = f"{filter_name}-{passes}.vtp"
    smoothing = ["--smooth", passes] + (["--smooth-filter", filter_name] if passes else [])
    report = lab.reconstruct(volume, "--no-decimate", *options, *smoothing, model=model)
    return draw.read(lab.at(model)), report, model


def smooth_in_core(lab, plain, filter_name, passes):
    """Short calls one after the other, without a bound on quality. One report for all of them."""
    model, reports = plain, []
    for _ in range(passes // CHAIN):
        reports.append(lab.reported("smooth", lab.at(model), "--min-quality", "0", "--smooth", CHAIN, "--smooth-filter", filter_name,
                                    "-o", lab.at("core.vtp")))
        model = "core.vtp"
    whole, smoothed = reports[-1], draw.read(lab.at(model))
    for key in ("turned_faces", "low_quality_faces", "crossing_pairs", "stepped_back"):
        whole["smoothing"][key] = sum(each["smoothing"][key] for each in reports)
    moved = numpy.linalg.norm(draw.points_of(smoothed) - draw.points_of(draw.read(lab.at(plain))), axis=1)
    whole["smoothing"] |= {"largest_displacement": moved.max(), "rms_displacement": (moved**2).mean() ** 0.5}
    for region, before in zip(whole["regions"], reports[0]["regions"]):
        region["volume_unsmoothed"] = before["volume_unsmoothed"]
    return smoothed, whole


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
    plain = draw.points_of(runs[0][1])
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
        b, _ = octant(draw.points_of(model), plain)
        lost = [abs(half[side] - b[mask][:, side]).mean() for side, mask in edges]
        yield [f"{change(report['regions'][0]):+.2f}", spread_left(a, b, zones), f"{sum(lost) / len(lost):.2f}"]


def measures_of_pyramid(runs):
    """By run: change of volume, the same for both halves, and what is left of the steps."""
    plain = draw.points_of(runs[0][1])
    a, half = octant(plain, plain)
    zones = [(u, 2, (a[:, u] - a[:, 1 - u] > 4) & (a[:, u] > 6) & (a[:, 2] > 3) & (a[:, 2] < half[2] - 6))
             for u in (0, 1)]
    for _, model, report in runs[1:]:
        changes = [f"{change(region):+.2f}" for region in report["regions"]]
        yield [" ".join(dict.fromkeys(changes)), spread_left(a, octant(draw.points_of(model), plain)[0], zones)]


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


def table_of(scene, runs):
    """The first run is the plain one, with which the others are compared."""
    rows = [("Filter", *scene["heads"], "largest, rms displacement", "turned, low, crossing", "stepped back", "least quality",
             "violations")]
    for (name, _, report), own in zip(runs[1:], scene["measures"](runs)):
        did = report["smoothing"]
        rows.append((name, *own, f"{did['largest_displacement']:.2f}, {did['rms_displacement']:.2f}",
                     f"{did['turned_faces']}, {did['low_quality_faces']}, {did['crossing_pairs']}", str(did["stepped_back"]),
                     f"{report['quality']['min']:.3f}", str(sum(report["violation_counts"].values()))))
    return rows


# Pictures


def tile(model, scene, view):
    actors = []
    for label, colour in scene["regions"].items():
        boundary, beyond = draw.boundary_of(model, [label])
        actors.append(draw.face_actor(boundary, colour))
        if scene["lines"]:
            actors.append(draw.line_actor(draw.lines_of(boundary, beyond), 2.2))
    return draw.tile(actors, view)


def view_of(model, scene):
    boundaries = [draw.boundary_of(model, [label])[0] for label in scene["regions"]]
    return draw.View(draw.middle_of(boundaries), scene["eye"], scene["height"])


# Scenes


def run_scene(lab, volume, name, scene):
    """Draws the six variants of a scene. Its table, that of its extremes where there are any, and tiles of these."""
    files, runs = zip(*((file, (caption(*variant), model, report)) for variant in VARIANTS
                        for model, report, file in [reconstruct(lab, volume, scene["options"], *variant)]))
    _, plain, report = runs[0]
    results = {"faces": report["final_faces"], "quality": report["quality"]["min"], "table": table_of(scene, runs)}
    view = view_of(plain, scene)
    draw.contact_sheet([(text, tile(model, scene, view)) for text, model, _ in runs], lab.pictures / f"smoothing-{name}.png")
    if not scene.get("extremes"):
        return results, []
    far = [(caption(*variant), *smooth_in_core(lab, files[0], *variant)) for variant in EXTREMES]
    results["far"] = table_of(scene, [runs[0], *far])
    return results, [(text, tile(model, scene, view)) for text, model, _ in far]


def scenes(lab):
    blue, clay, sand = (0.66, 0.78, 0.93), (0.95, 0.68, 0.52), (0.96, 0.85, 0.58)
    yield "slab", lab.volume("chamfer_slab.npy"), {
        "options": [], "regions": {1: blue}, "lines": False, "eye": (0.5, -0.72, 0.48), "height": 78, "extremes": True,
        "heads": ["volume, %", "steps left", "edges lost"], "measures": measures_of_slab}
    pyramid = {"options": [], "regions": {1: clay, 2: sand}, "lines": True, "eye": (0.42, -0.8, 0.36), "height": 56,
               "heads": ["volume, %", "steps left"], "measures": measures_of_pyramid}
    yield "pyramid", lab.volume("dpyramid_2reg_s4.npy"), pyramid | {"extremes": True}
    yield "pyramid-fine", lab.volume("dpyramid_2reg_s1.npy"), pyramid
    polycrystal = lab.volume("in100_60x80x100.npy")
    shown = largest_inside(polycrystal)
    yield "grain", polycrystal, {
        "options": ALL_REGIONS, "regions": {shown: GREEN}, "lines": True, "eye": (0.62, -0.62, 0.5), "height": 45,
        "heads": ["grain's volume, %", "volumes of all, %", "turning"], "measures": measures_of_grain(shown)}


def measure(lab):
    extremes, results = [], {}
    for name, volume, scene in scenes(lab):
        results[name], far = run_scene(lab, volume, name, scene)
        extremes += far
    draw.contact_sheet(extremes, lab.pictures / "smoothing-extreme.png")
    return results


WORDS = {"slab": "Slab of 96 x 48 x 24 samples, chamfered by 8 (Fig. 4)",
         "pyramid": "Double pyramid, steps of four samples (Fig. 5)", "pyramid-fine": "Double pyramid, steps of one sample",
         "grain": "A grain of IN100, with the triple lines on it (Fig. 6)"}


def cell(table, filter_name, head):
    return next(row[table[0].index(head)] for row in table[1:] if row[0] == filter_name)


def write(page, results):
    page.paragraph("*Volume*: change in percent. *Steps left*: spread of the vertices about 45-degree slopes against that before. *Edges\n"
                   "lost*: what edges beside the chamfers lose, in samples. *Turning*: mean angle between consecutive edges of triple\n"
                   "lines, in degrees. *Turned, low, crossing*: faces or pairs that the filter alone would have spoilt, and the guard took\n"
                   "back. [Smoothing](../../docs/explanation/smoothing.md) says how.")
    for name, one in results.items():
        page.picture(f"{WORDS[name]}: five ways of smoothing", f"smoothing-{name}.png", f"{WORDS[name]}; {one['faces']} faces.")
        page.table(one["table"])
    page.picture("Slab and pyramid after thousands of passes", "smoothing-extreme.png", "Farther than anyone would go.")
    page.paragraph("Volumes of slab and of pyramid with steps of four then: " + "; ".join(
        f"{row[0]}: {row[1]} and {other[1]} %" for row, other in zip(results["slab"]["far"][1:], results["pyramid"]["far"][1:])) + ".")
    slab, fine, grain = (results[name]["table"] for name in ("slab", "pyramid-fine", "grain"))
    few, many = "taubin, 20 passes", "taubin, 100 passes"
    page.paragraph("The paper is right that the plain Laplacian ends as a cigar and a pancake, that Taubin's filter keeps the shape and needs 100\n"
                   "passes to take the steps away, that NIFPMS keeps edges and leaves steps, and that Taubin's is the better one for grains. It\n"
                   "is not confirmed that Taubin's filter, too, ends at the cigar at the same volume: the slab swells a little and stays a slab.\n"
                   "Nor does NIFPMS round the pyramid.")
    page.summary("4.2", "slab, volume after Taubin's filter, 100 passes", "kept", f"{cell(slab, many, 'volume, %')} %", "agrees")
    page.summary("4.2", "steps left after 20 and 100 passes, pyramid", "significant, none",
                 f"{cell(fine, few, 'steps left')}, {cell(fine, many, 'steps left')}", "agrees")
    page.summary("4.2", "spoilt faces of IN100: NIFPMS, Taubin with 100 passes", "spikes; none told",
                 "; ".join(cell(grain, f, "turned, low, crossing") for f in ("nifpms, one pass", many)), "agrees; all taken back")
    page.summary("4.2", "Taubin's filter after thousands of passes", "a cigar", f"{results['slab']['far'][-1][1]} % of volume, still a slab",
                 "contradicted")
