"""Scattered labelled points of worlds that are known everywhere, from fixed seeds."""
import numpy

SIZE = numpy.array((1000.0, 1000.0, 400.0))
BOTTOMS = (60, 105, 150, 200, 240, 290, 335)  # of layers 1 to 7, counted up from below; layer 8 is on top
LENS, INTRUSION = 9, 10
GRAINS = 60


def scattered(count, seed):
    generator = numpy.random.default_rng(seed)
    return generator, generator.random((count, 3)) * SIZE


def strata(count, seed=20):
    _, points = scattered(count, seed)
    return points, labels_of_strata(points)


def boxed_strata(count, seed=20):
    """The same, a tenth of the points moved to the sides of the box, and eight to its corners."""
    generator, points = scattered(count, seed)
    moved = numpy.arange(count // 10)
    axis = generator.integers(0, 3, len(moved))
    points[moved, axis] = generator.integers(0, 2, len(moved)) * SIZE[axis]
    points[:8] = SIZE * [[n >> a & 1 for a in range(3)] for n in range(8)]
    return points, labels_of_strata(points)


def labels_of_strata(points):
    """Eight folded layers, thrown by a fault, with lenses in one of them; and a stock that goes through most."""
    x, y, z = points.T
    throw = numpy.where(x + 0.35 * y - 0.5 * z > 640, 55.0, 0.0)  # an oblique plane; what is beyond it has sunk
    height = z + throw - 28 * numpy.sin(x / 140 + y / 420) - 16 * numpy.cos(y / 95) - 0.06 * (x - 500)
    labels = 1 + numpy.searchsorted(BOTTOMS, height)
    for a, b, c in ((260, 300, 178), (300, 760, 176), (760, 560, 172)):
        inside = ((x - a) / 120) ** 2 + ((y - b) / 90) ** 2 + ((height - c) / 14) ** 2 < 1
        labels[inside] = LENS
    radius = 70 + 0.25 * (400 - z) + 12 * numpy.sin(4 * numpy.arctan2(y - 430, x - 520))
    labels[(numpy.hypot(x - 520, y - 430) < radius) & (z < 330)] = INTRUSION
    return labels


def grains(count, seed=60):
    """Cells of 60 random points."""
    from scipy.spatial import cKDTree
    generator, points = scattered(count, seed)
    seeds = generator.random((GRAINS, 3)) * SIZE
    return points, 1 + cKDTree(seeds).query(points)[1]


def write(path, points, labels):
    with open(path, "w") as file:
        file.write("x,y,z,label\n")
        file.writelines("%.3f,%.3f,%.3f,%d\n" % row for row in zip(*points.T.tolist(), labels.tolist()))
