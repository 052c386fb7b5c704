"""Pictures of four models with each of --smooth off, light, normal, strong; and of a model with three rooms."""
import shade
import draw
import numpy

import cutaway
import lead

PRESETS = ("off", "light", "normal", "strong")
TILES = {"brain": (500, 400), "grains": (500, 360), "mouse": (640, 320), "wells": (500, 440),
         "room": (460, 400)}  # pixels
FOOT = 40  # pixels below a tile
GRAINS = 1  # drawn of IN100, 4 at most


def brain_panel(path, shared):
    """A part of the cut atlas, flat: faces as they are."""
    model = draw.read(path)
    bounds = model.GetBounds()
    corner = [(bounds[2 * axis] + bounds[2 * axis + 1]) / 2 + 0.237 for axis in range(3)]
    if "brain" not in shared:  # one set of colours for all panels
        shared["brain"] = shade.colours_of(model)
    whole, _ = lead.actors_of(model, corner, shared["brain"])
    whole[0].GetProperty().SetInterpolationToFlat()
    return shade.scene(whole, draw.View([c + d for c, d in zip(corner, (4, 12, 10))], lead.EYE, 92))


def grains_of(model):
    """The largest region that touches neither the box nor empty space, and its largest such neighbours."""
    pairs, area = shade.pairs_of(model)
    outer = {label for pair in pairs.tolist() if min(pair) <= 0 for label in pair}
    touch = {}
    for (a, b), size in zip(pairs.tolist(), area):
        if a not in outer and b not in outer:
            touch.setdefault(a, {})[b] = touch.setdefault(b, {})[a] = size
    first = max(touch, key=lambda label: sum(touch[label].values()))
    return [first, *sorted(touch[first], key=lambda label: -touch[first][label])[:GRAINS - 1]]


def grains_panel(path, shared):
    """Some grains with the triple lines on them."""
    model = draw.read(path)
    if "grains" not in shared:
        shared["grains"] = grains_of(model)
    actors, boundaries, eye = [], [], (0.75, -0.5, 0.42)
    for grain, rgb in zip(shared["grains"], (shade.PALETTE[n] for n in (7, 1, 4, 9))):
        boundary, beyond = draw.boundary_of(model, [grain])
        boundaries.append(boundary)
        actors.append(shade.actor_of(shade.painted(boundary, numpy.tile(rgb, (len(beyond), 1))), is_flat=True))
        actors.append(shade.lines_actor(draw.lines_of(boundary, beyond), 1.5, [0.2 * e for e in eye]))
    if "grains_view" not in shared:  # one for all presets
        shared["grains_view"] = fitted(numpy.concatenate([draw.points_of(boundary) for boundary in boundaries]), eye, TILES["grains"])
    return shade.scene(actors, shared["grains_view"])


def fitted(points, eye, size, room=1.06):
    """The view from `eye` that just holds the points."""
    ahead = numpy.array(eye) / numpy.linalg.norm(eye)
    right = numpy.cross((0, 0, 1), ahead)
    right /= numpy.linalg.norm(right)
    axes = numpy.stack([right, numpy.cross(ahead, right), ahead])
    low, high = (points @ axes.T).min(axis=0), (points @ axes.T).max(axis=0)
    wide, tall, _ = high - low
    return draw.View(tuple((low + high) / 2 @ axes), eye, room * max(tall, wide * size[1] / size[0]))


SKIN, SKELETON = 1, 2
BONE = (0.93, 0.9, 0.82)


def mouse_panel(path, shared):
    """Skeleton and organs without the skin; sections lie upright, across the body."""
    model = draw.read(path)
    organs, behind = shade.side_of(model, [SKIN, 0, -1], hidden=(SKIN, 0, -1))
    if "mouse" not in shared:
        shared["mouse"] = shade.colours_of(model, empty=(SKIN, 0, -1)) | {SKELETON: BONE}
    shade.painted(organs, [shared["mouse"][label] for label in behind.tolist()])
    bounds = organs.GetBounds()
    middle = [(bounds[2 * axis] + bounds[2 * axis + 1]) / 2 + shift for axis, shift in enumerate((0, 0, 18))]
    return shade.scene([shade.actor_of(organs, is_flat=True)], draw.View(middle, (0.8, -0.35, 0.5), 165))


def wells_panel(path, shared):
    """Kim's wells, cut open, heights eight times."""
    actors, box = shared["wells"](path)
    draw.FAR = 2 * float(numpy.linalg.norm(numpy.subtract(box[1::2], box[::2])))
    points = numpy.concatenate([draw.points_of(actor.GetMapper().GetInput()) for actor in actors])
    scene = shade.scene(actors, fitted(points, (0.62, 0.6, 0.42), TILES["wells"]))
    draw.FAR = 500
    return scene


PANELS = {"brain": brain_panel, "grains": grains_panel, "mouse": mouse_panel, "wells": wells_panel}


def sheet(tiles, out, size, columns=2):
    """Draws (text, scene) pairs row by row, each text below its scene."""
    pictures = [numpy.concatenate([shade.image_of(scene, size), shade.words(text, (size[0], FOOT))]) for text, scene in tiles]
    rows = [numpy.concatenate(pictures[n:n + columns], axis=1) for n in range(0, len(pictures), columns)]
    shade.write_png(numpy.concatenate(rows), out)
