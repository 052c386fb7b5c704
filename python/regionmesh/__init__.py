"""Certified multi-region surface models from labelled sections.

>>> import numpy as np
>>> import regionmesh
>>> labels = np.zeros((12, 12, 12), np.uint8)
>>> labels[3:9, 3:9, 3:6] = 1
>>> labels[3:9, 3:9, 6:9] = 2
>>> mesh = regionmesh.reconstruct(labels, spacing=(1, 1, 2.5), reduce=0.5)
>>> mesh.certified
True
>>> list(mesh.regions["label"])
[1, 2]

Arrays of labels are [z, y, x]; points, spacing, origin and boxes are x, y, z, in the unit of the spacing.
"""

from . import _programs
from ._core import version as __version__
from ._make import from_arrays, load
from ._mesh import Mesh
from ._reconstruct import reconstruct
from ._surface import Surface

__all__ = ["Mesh", "Surface", "from_arrays", "load", "reconstruct", "__version__"]

_programs.announce()
