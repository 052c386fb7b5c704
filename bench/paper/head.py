"""P 4.6, Fig. 10: the head phantom, to 2 million faces and to 1.67 million."""
import numpy

import draw
from lab import ALL_REGIONS, AS_IN_PAPER, TAUBIN, median, race

TITLE = "MRI head phantom (P 4.6, Fig. 10)"
VOLUME = "zubal_head.npy"
TARGETS = (2000000, 1670000)
PAPER = {"initial_faces": 6691110, "regions": 61, 2000000: 944, 1670000: 942}
ROUNDS = 3
OUTSIDE = (0, -1)  # air, and beyond the box
# Labels of the phantom. The brain is the cerebrum: its lobes, white matter, nuclei, and the ventricles inside them.
BRAIN = (83, 89, 95, 96, 99, 101, 103, 105, 107, 108, 109, 111, 112, 113, 114, 117, 118, 120, 123, 124)
PARTS = {"brain": (BRAIN, (0.80, 0.81, 0.83), 0.3), "cerebellum": ((77,), (0.45, 0.46, 0.50), 0.5),
         "spinal cord": ((3,), (0.85, 0.62, 0.25), 1), "medulla oblongata": ((85,), (0.78, 0.33, 0.28), 1),
         "pons": ((91,), (0.33, 0.52, 0.76), 1)}


def unmatched(model):
    """The faces that only one region has, when each region's closed surface is taken alone, by the places of their corners;
    and how many edges of a region have not two of its faces."""
    places, faces, both = draw.points_of(model), draw.faces_of(model), draw.labels_of(model)
    _, point = numpy.unique(places, axis=0, return_inverse=True)
    keys = numpy.sort(point.reshape(-1)[faces], axis=1)
    alone = [keys[(both[:, side] != OUTSIDE[0]) & (both[:, side] != OUTSIDE[1])] for side in (0, 1)]
    every = numpy.concatenate(alone)
    _, first, count = numpy.unique(every, axis=0, return_index=True, return_counts=True)
    lone = every[first[count == 1]]
    index = {tuple(key): n for n, key in enumerate(keys.tolist())}
    return numpy.array([index[tuple(key)] for key in lone.tolist()]), int((count > 2).sum())


def open_edges(model):
    """Edges of a region that have not exactly two of its faces, or not one in each direction."""
    faces, both, count = draw.faces_of(model).astype(numpy.int64), draw.labels_of(model), model.GetNumberOfPoints()
    _, both = numpy.unique(both, return_inverse=True)
    both = both.reshape(-1, 2)
    keys = []
    for side, turned in ((0, faces), (1, faces[:, ::-1])):
        for a, b in ((0, 1), (1, 2), (2, 0)):
            keys.append((both[:, side] * count + turned[:, a]) * count + turned[:, b])
    forward = numpy.sort(numpy.concatenate(keys))
    backward = numpy.sort(forward // count // count * count * count + forward % count * count + forward // count % count)
    return int((forward != backward).sum() + (forward[1:] == forward[:-1]).sum())


def picture(lab, model, lone):
    def boundaries(opaque):
        for regions, colour, opacity in PARTS.values():
            data, _ = draw.boundary_of(model, regions)
            yield data, draw.face_actor(data, colour, 1 if opaque else opacity)
    parts = list(boundaries(False))
    box = draw.middle_of([data for data, _ in parts])
    eye = (0.9, -0.3, 0.2)
    skin = draw.surface(draw.points_of(model), draw.faces_of(model)[lone])
    tiles = [("five regions, brain and cerebellum semitransparent", draw.tile([actor for _, actor in parts], draw.View(box, eye, 165))),
             ("the faces of one region only", draw.tile([draw.face_actor(skin, (0.86, 0.74, 0.64))],
                                                        draw.View(draw.middle_of([skin]), eye, 235)))]
    draw.contact_sheet(tiles, lab.pictures / "head.png", columns=2, size=(560, 560))


def measure(lab):
    volume = lab.volume(VOLUME)
    lanes = {str(target): (lambda t=target: lab.reconstruct(volume, *ALL_REGIONS, *AS_IN_PAPER, "--target-faces", t)) for target in TARGETS}
    runs = race(lanes, ROUNDS)
    smooth = lab.reconstruct(volume, *ALL_REGIONS, *TAUBIN, "--target-faces", TARGETS[0], model="smooth.vtp")
    model = draw.read(lab.at("smooth.vtp"))
    lone, over = unmatched(model)
    both = draw.labels_of(model)[lone]
    picture(lab, model, lone)
    first = runs[str(TARGETS[0])][0]
    return {"initial_faces": first["initial_faces"], "regions": len(first["regions"]), "peak_bytes": first["peak_bytes"],
            "seconds": {name: median(reports) for name, reports in runs.items()},
            "final_faces": {name: reports[0]["final_faces"] for name, reports in runs.items()},
            "smooth_seconds": median([smooth]), "violations": sum(smooth["violation_counts"].values()),
            "unmatched": len(lone), "unmatched_outside": int(numpy.isin(both, OUTSIDE).any(axis=1).sum()), "shared_by_many": over,
            "outside_faces": int((numpy.isin(draw.labels_of(model), OUTSIDE).sum(axis=1) == 1).sum()), "open_edges": open_edges(model)}


def write(page, results):
    page.picture("Five regions of the head, and the faces that only one region has", "head.png",
                 f"All {results['regions']} labels of the phantom reconstructed, smoothed and decimated together to "
                 f"{results['final_faces'][str(TARGETS[0])]} faces.")
    rows = [("What", "paper", "here"), ("faces before", str(PAPER["initial_faces"]), str(results["initial_faces"])),
            ("regions", str(PAPER["regions"]), f"{results['regions']} labels")]
    for target in TARGETS:
        rows.append((f"seconds to {target / 1e6:g} million", str(PAPER[target]), f"{results['seconds'][str(target)]:.1f}"))
    rows += [("seconds to 2 million, 20 passes of taubin", "-", f"{results['smooth_seconds']:.1f}"),
             ("memory, MB", "below 1000; in core 50 % too large", f"{results['peak_bytes'] / 1e6:.0f}"),
             ("violations", "none", str(results["violations"] or "none"))]
    page.table(rows)
    fits = results["unmatched"] == results["unmatched_outside"] == results["outside_faces"] and not results["shared_by_many"]
    page.paragraph(f"The count before decimation is the paper's, to the face. Matching: each region's surface taken alone, faces compared by\n"
                   f"the places of their corners. {results['unmatched']} faces belong to one region only, {results['unmatched_outside']} of them\n"
                   f"have air or the end of the volume beyond, which are all such faces there are ({results['outside_faces']}); "
                   f"{results['shared_by_many']} belong to\n"
                   f"more than two. Edges of a region without exactly two of its faces, one in each direction: {results['open_edges']}. So the regions\n"
                   "fit without gaps. Air inside the head, in sinuses and mouth, is outside, too, and is hidden in the picture.")
    page.summary("4.6", "faces of the head before decimation", str(PAPER["initial_faces"]), str(results["initial_faces"]),
                 "agrees to the face" if results["initial_faces"] == PAPER["initial_faces"] else "contradicted")
    page.summary("4.6", "unmatched faces inside the head", "none", "none" if fits else "some", "agrees" if fits else "falls short")
    a, b = (results["seconds"][str(target)] for target in TARGETS)
    page.summary("4.6", "seconds to 2 and 1.67 million", "944 and 942", f"{a:.1f} and {b:.1f}", "agrees: nearly equal" if abs(a / b - 1) < 0.1 else "differs")
