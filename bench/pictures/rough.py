"""Labels of three kinds as people have them: every sample kept, the defaults, and VTK's SurfaceNets beside them."""
import shade
import draw
import numpy
import presets
import scipy.sparse
from vtk.util.numpy_support import numpy_to_vtk

TILE = (460, 420)  # pixels
ROUNDS = 16        # of SurfaceNets


def surface_nets(labels, spacing):
    """A model of an array [z, y, x]: a vertex in each cell with two labels or more, moved to the middle of those beside it,
    round after round, within its cell (Gibson 1998)."""
    labels = numpy.pad(labels.astype(numpy.int64), 1, constant_values=-1)
    corners = [labels[numpy.ix_(*(numpy.arange(size - 1) + at for size, at in zip(labels.shape, corner)))]
               for corner in numpy.ndindex(2, 2, 2)]
    mixed = numpy.any([corner != corners[0] for corner in corners], axis=0)
    number = numpy.cumsum(mixed).reshape(mixed.shape) - 1
    cells = numpy.argwhere(mixed)
    faces, both, pairs = [], [], []
    for axis in range(3):
        u, w = (numpy.eye(3, dtype=int)[other] for other in range(3) if other != axis)
        step = numpy.eye(3, dtype=int)[axis]
        ahead = numpy.take(labels, range(1, labels.shape[axis]), axis)
        behind = numpy.take(labels, range(labels.shape[axis] - 1), axis)
        at = numpy.argwhere(ahead != behind)
        a, b, c, d = (number[tuple((at - offset).T)] for offset in (0 * u, u, u + w, w))
        faces += [numpy.stack([a, b, c], 1), numpy.stack([a, c, d], 1)]
        both += 2 * [numpy.stack([behind[tuple(at.T)], ahead[tuple(at.T)]], 1)]
        near = cells[cells[:, axis] > 0]
        shared = [labels[tuple((near + i * u + j * w).T)] for i in (0, 1) for j in (0, 1)]
        near = near[numpy.any([label != shared[0] for label in shared], axis=0)]
        pairs.append(numpy.stack([number[tuple(near.T)], number[tuple((near - step).T)]], 1))
    pairs = numpy.concatenate([*pairs, *(pair[:, ::-1] for pair in pairs)])
    beside = scipy.sparse.csr_matrix((numpy.ones(len(pairs)), pairs.T), shape=(len(cells), len(cells)))
    count = numpy.maximum(beside.sum(axis=1), 1)
    points = cells + 0.5
    for _ in range(ROUNDS):
        points = numpy.clip((points + numpy.asarray((beside @ points) / count)) / 2, cells, cells + 1)
    data = draw.surface((points[:, ::-1] - 1) * spacing, numpy.concatenate(faces))
    array = numpy_to_vtk(numpy.concatenate(both), deep=True)
    array.SetName("BoundaryLabels")
    data.GetCellData().AddArray(array)
    return data


def outside_panel(model, shared, view):
    """All regions as seen from label 0."""
    skin, behind = shade.side_of(model, [0, -1])
    colours = shared.setdefault("colours", shade.colours_of(model))
    shade.painted(skin, [colours[label] for label in behind.tolist()])
    return shade.scene([shade.actor_of(skin, is_flat=True)], view)


def region_panel(model, region, eye, shared):
    """One region with the lines on it."""
    boundary, beyond = draw.boundary_of(model, [region])
    view = shared.setdefault("view", presets.fitted(draw.points_of(boundary), eye, TILE))
    faces = shade.actor_of(shade.painted(boundary, numpy.tile(shade.PALETTE[7], (len(beyond), 1))), is_flat=True)
    return shade.scene([faces, shade.lines_actor(draw.lines_of(boundary, beyond), 1.2, [0.2 * e for e in eye])], view)


# Kinds of labels, each on one file: spacing, the region that is shown (none: all), the direction to the camera, the
# height of the picture and its middle, or nothing where the region fills it.
KINDS = {"segmentation": ("totalseg_ct20.npy", (0.9765625, 0.9765625, 2), None, (0.1, -0.62, 0.78), 230, (300, 215, 18)),
         "diffraction": ("in100_60x80x100.npy", (1, 1, 1), 1183, (0.75, -0.5, 0.42), None, None)}
OPTIONS = {"--denoise off": ("--denoise", "off"), "the defaults": ()}


def panel(model, kind, shared):
    _, _, region, eye, height, middle = KINDS[kind]
    if region is not None:
        return region_panel(model, region, eye, shared)
    return outside_panel(model, shared, draw.View(middle, eye, height))


def make(bench, out):
    """Draws one row for each kind; returns the figures of the models."""
    tiles, results = [], {}
    for kind, (file, spacing, *_) in KINDS.items():
        source, shared = bench.volume(file), {}
        for n, (text, options) in enumerate(OPTIONS.items()):
            name = f"rough_{kind}_{n}"
            results[f"{kind} {text}"] = bench.case(name, [source], "--spacing", ",".join(map(str, spacing)),
                                                   "--reduce", "0", *options)
            tiles.append((text, panel(draw.read(bench.model(name)), kind, shared)))
        tiles.append(("SurfaceNets", panel(surface_nets(numpy.load(source), spacing), kind, shared)))
    presets.sheet(tiles, out, TILE, columns=3)
    return results
