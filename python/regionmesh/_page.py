"""A small view of a model for notebooks: one piece of HTML, no network."""

import base64
import html as escaping
import warnings
from importlib import resources

import numpy as np

_MOST_FACES = 12_000


def _text_of(array):
    return base64.b64encode(np.ascontiguousarray(array).tobytes()).decode()


def _caption(mesh):
    count = len(mesh.report["regions"])
    return f"{count} regions, {len(mesh.faces):,} faces, {len(mesh.points):,} points, {mesh._state()}"


def _preview(mesh):
    """A coarser model where there are many faces."""
    if len(mesh.faces) <= _MOST_FACES:
        return mesh
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # of a target that a preview misses
        return mesh.simplify(target_faces=_MOST_FACES, min_quality=0.0, intersect_check=False, keep_samples=False)


def html(mesh):
    """Return the view; drag to turn it."""
    shown = _preview(mesh)
    faces = shown.faces[: 4 * _MOST_FACES]
    corners = shown.points[faces]
    low, high = shown.bounds
    half = max(float(np.max(high - low)) / 2, 1e-300) if len(faces) else 1.0
    places = np.round((corners - (low + high) / 2) / half * 32767) if len(faces) else np.zeros((0, 3, 3))
    colours = np.unique(shown.labels[: len(faces)], return_inverse=True)[1].reshape(-1, 2)[:, 0]
    page = resources.files(__package__).joinpath("page.html").read_text(encoding="utf-8")
    page = page.replace("@PLACES@", _text_of(places.astype("<i2")))
    page = page.replace("@COLOURS@", _text_of(colours.astype("<u2")))
    page = page.replace("@CAPTION@", _caption(mesh))
    return (
        f'<iframe srcdoc="{escaping.escape(page)}" style="border:0;width:100%;max-width:480px;height:420px" '
        'sandbox="allow-scripts"></iframe>'
    )
