"""P 4.1: bytes a face, and what stands round a vertex."""
import numpy

import draw
from lab import ALL_REGIONS, AS_IN_PAPER

TITLE = "Memory, and what stands round a vertex (P 4.1)"
VOLUMES = {"head phantom": "zubal_head.npy", "AAL atlas": "aal.npy", "IN100": "in100_60x80x100.npy",
           "magnesia-like, 50 x 1000": "mgo_50x1000.npy"}
PAPER_BYTES, PAPER_FACES, PAPER_EDGES = (165, 224), 6.25, 6.15


def round_vertex(path):
    """Means over the vertices of a model: faces, and edges, each of which leads to one neighbour."""
    model = draw.read(path)
    faces = draw.faces_of(model).astype(numpy.int64)
    count = model.GetNumberOfPoints()
    ends = numpy.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]])
    edges = numpy.unique(ends.min(axis=1) * count + ends.max(axis=1)).size
    return {"faces": 3 * len(faces) / count, "edges": 2 * edges / count}


def measure(lab):
    results = {}
    for name, file in VOLUMES.items():
        volume = lab.volume(file)
        lab.reconstruct(volume, "--no-decimate", *AS_IN_PAPER, *ALL_REGIONS, model="full.vtp")
        report = lab.reconstruct(volume, "--reduce", "90%", *AS_IN_PAPER, *ALL_REGIONS)
        results[name] = {"initial_faces": report["initial_faces"], "final_faces": report["final_faces"],
                         "peak_bytes": report["peak_bytes"], "bytes_per_face": report["bytes_per_face"],
                         "full": round_vertex(lab.at("full.vtp")), "tenth": round_vertex(lab.at("model.vtp"))}
    return results


def write(page, results):
    rows = [("Model", "faces", "bytes a face", "peak MB", "in core at 165-224 B, MB", "faces a vertex", "edges a vertex",
             "at a tenth: faces", "edges")]
    for name, one in results.items():
        in_core = "-".join(f"{one['initial_faces'] * size / 1e6:.0f}" for size in PAPER_BYTES)
        rows.append((name, f"{one['initial_faces']}", f"{one['bytes_per_face']:.0f}", f"{one['peak_bytes'] / 1e6:.0f}", in_core,
                     *(f"{one[which][what]:.2f}" for which in ("full", "tenth") for what in ("faces", "edges"))))
    most = max(one["bytes_per_face"] for one in results.values())
    page.summary("4.1", "bytes a face", "165 to 224", f"at most {most:.0f}", "beaten")
    whole = [one["full"] for one in results.values()]
    low, high = (f(one["faces"] for one in whole) for f in (min, max))
    page.summary("4.1", "faces and edges a vertex", f"{PAPER_FACES} and {PAPER_EDGES}",
                 f"{low:.2f} to {high:.2f} and {min(one['edges'] for one in whole):.2f} to {max(one['edges'] for one in whole):.2f}",
                 "agrees")
    page.table(rows)
    page.paragraph("All labels are regions, none smoothed, decimated to a tenth on the fly. Bytes a face are those of the model and of all\n"
                   "that decimation holds, when most is held ([where each byte goes](../../docs/explanation/memory.md)); the peak is that of the process, sections\n"
                   "and program included. Each edge of a vertex leads to one neighbour. A closed surface has six faces and six edges a\n"
                   "vertex, less a little; lines, where three interfaces meet, have more of both. In a tenth of the faces more of the\n"
                   "vertices lie on lines.")
