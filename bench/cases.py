"""The volumes that are measured: synthetic ones from fixed seeds, the same in every run, and files of the user."""
import dataclasses
import os
import sys

GRAIN_SECTIONS = 5


@dataclasses.dataclass
class Case:
    name: str
    path: str
    family: str = ""  # the synthetic ones
    size: int = 0     # samples a side

    def make(self):
        """In a process of its own: what this one holds would count as memory of the programs that it starts."""
        if not self.family:
            return
        if os.fork() == 0:
            try:
                import numpy
                numpy.save(self.path, FAMILIES[self.family](numpy, self.size))
                os._exit(0)
            except Exception as error:
                print(error, file=sys.stderr)
            finally:
                os._exit(1)
        if os.wait()[1] != 0:
            sys.exit("no volume made; script/bootstrap bench installs python3-numpy")

    def remove(self):
        if self.family:
            os.remove(self.path)


def grid(numpy, size):
    return numpy.meshgrid(*[numpy.linspace(-1, 1, size)] * 3, indexing="ij")


def balls(numpy, size):
    """Eight nested balls in a background of label 0: smooth interfaces, no triple lines."""
    z, y, x = grid(numpy, size)
    radius = numpy.sqrt(x * x + y * y + z * z)
    return numpy.where(radius < 0.9, 1 + numpy.floor(radius / 0.9 * 8), 0).astype(numpy.uint8)


def voronoi(numpy, size):
    """The cells of 64 random points, two samples in a hundred with the label of a neighbour: many lines, points, specks."""
    random = numpy.random.default_rng(1)
    z, y, x = grid(numpy, size)
    nearest = numpy.full((size,) * 3, numpy.inf)
    labels = numpy.zeros((size,) * 3, numpy.uint8)
    for label, (a, b, c) in enumerate(random.uniform(-1, 1, (64, 3)), 1):
        distance = (x - a) ** 2 + (y - b) ** 2 + (z - c) ** 2
        labels[distance < nearest] = label
        numpy.minimum(nearest, distance, out=nearest)
    from_neighbour = random.random(labels.shape) < 0.02
    return numpy.where(from_neighbour, numpy.roll(labels, 1, axis=0), labels)


def noise(numpy, size):
    """A smoothed random field cut into four labels: tangled interfaces, many separate parts."""
    random = numpy.random.default_rng(2)
    field = random.random((size,) * 3)
    for _ in range(3):
        for axis in range(3):
            field = (numpy.roll(field, 1, axis) + 2 * field + numpy.roll(field, -1, axis)) / 4
    return numpy.digitize(field, numpy.quantile(field, [0.25, 0.5, 0.75])).astype(numpy.uint8) + 1


def grains(numpy, size):
    """Five sections of a polycrystal, a grain about 70 samples wide, in all sections much the same: as micrographs are.

    Grains are the cells of one point in each square of a grid; squares two away are far enough to look for the nearest.
    """
    random = numpy.random.default_rng(3)
    count = max(2, round(size / 70)) + 4  # squares a side, two of them outside at each end
    width = size / (count - 4)
    corner = numpy.stack(numpy.meshgrid(*[numpy.arange(count) - 2] * 2, indexing="ij"))
    points = (corner + random.random(corner.shape)) * width
    drift = random.normal(0, 1.5, corner.shape)  # of a point from section to section, in samples
    samples = numpy.arange(size)
    square = (samples / width).astype(int) + 2
    labels = numpy.empty((GRAIN_SECTIONS, size, size), numpy.uint16)
    for section in range(GRAIN_SECTIONS):
        at = points + section * drift
        shift = random.normal(0, 0.6, (2, size, size))  # boundaries are rough
        y, x = samples[:, None] + shift[0], samples[None, :] + shift[1]
        nearest = numpy.full((size, size), numpy.inf)
        for i in range(-2, 3):
            for j in range(-2, 3):
                cell = (square[:, None] + i, square[None, :] + j)
                distance = (at[0][cell] - y) ** 2 + (at[1][cell] - x) ** 2
                closer = distance < nearest
                labels[section][closer] = (cell[0] * count + cell[1] + 1)[closer]
                nearest[closer] = distance[closer]
    return labels


FAMILIES = {"balls": balls, "voronoi": voronoi, "noise": noise, "grains": grains}
SMALLEST = {"balls": 32, "voronoi": 32, "noise": 16}  # samples a side; grains are for the table of growth


def synthetic(folder, family, size):
    return Case(f"{family}-{size}", os.path.join(folder, f"{family}-{size}.npy"), family, size)


def doubling_cases(folder, doublings, only):
    return [synthetic(folder, family, smallest << n)
            for family, smallest in SMALLEST.items() if only in (None, family) for n in range(doublings + 1)]


def growth_cases(folder, doublings):
    """Grains whose faces double, from 0.4 million: twice the samples in each section."""
    return [synthetic(folder, "grains", round(256 * 2 ** (n / 2))) for n in range(doublings + 1)]


def files_of_the_user(paths):
    def name(path):
        base = os.path.basename(os.path.normpath(path))
        return base.removesuffix(".gz").rsplit(".", 1)[0] or base
    return [Case(name(path), path) for path in paths]
