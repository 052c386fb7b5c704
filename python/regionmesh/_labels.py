"""Labels and their names."""

import os

from . import _core, _sources


def bits(label):
    """A label as a signed number of 64 bits; unsigned ones keep their bits."""
    value = int(label)
    return value - (1 << 64) if value >= 1 << 63 else value


def names_of(names):
    """Names by label: a dict, or the path of a table; None stays None."""
    if names is None:
        return None
    if isinstance(names, (str, os.PathLike)):
        with _sources.missing_files(names):
            return _core.read_names(os.fspath(names))
    return {bits(label): str(name) for label, name in dict(names).items()}
