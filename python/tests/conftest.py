import numpy as np
import pytest

import regionmesh


@pytest.fixture(scope="session")
def two_boxes():
    """Two touching boxes in background, labels [z, y, x]."""
    labels = np.zeros((14, 12, 10), np.uint8)
    labels[2:7, 3:9, 2:8] = 1
    labels[7:11, 3:9, 2:8] = 2
    return labels


@pytest.fixture(scope="session")
def grains():
    """Twenty-four grains around random points, without background."""
    random = np.random.default_rng(4)
    seeds = random.uniform(0, 20, (24, 3))
    grid = np.stack(np.meshgrid(*[np.arange(20)] * 3, indexing="ij"), axis=-1)
    distance = ((grid[..., None, :] - seeds) ** 2).sum(axis=-1)
    return (distance.argmin(axis=-1) + 1).astype(np.int32)


@pytest.fixture(scope="session")
def mesh(two_boxes):
    return regionmesh.reconstruct(two_boxes)
