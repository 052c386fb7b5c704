"""Labels and their names."""

from . import _core, _sources


def bits(label):
    """A label as a signed number of 64 bits; unsigned ones keep their bits."""
    try:
        value = int(label)
    except (OverflowError, TypeError, ValueError):
        value = None
    if value is None or value != label:
        raise TypeError(f"label {label!r}: not a whole number")
    if not -(1 << 63) <= value < 1 << 64:
        raise ValueError(f"label {value}: more than 64 bits")
    return value - (1 << 64) if value >= 1 << 63 else value


def names_of(names):
    """Names by label: a dict, or the path of a table; None stays None."""
    if names is None:
        return None
    if isinstance(names, _sources.PATHS):
        with _sources.missing_files(names):
            return _core.read_names(_sources.file_name(names))
    if not hasattr(names, "items"):
        raise TypeError(f"names={names!r}: neither names by label nor the path of a table")
    return {bits(label): _text(name) for label, name in names.items()}


def colours_of(names):
    """Colours of the table of names, by label; None where it has none, or the names are no table."""
    return (_core.read_colours(_sources.file_name(names)) or None) if isinstance(names, _sources.PATHS) else None


def _text(name):
    try:
        str(name).encode()
    except UnicodeEncodeError:
        raise ValueError(f"name {str(name)!r}: no UTF-8; it has half of a surrogate pair") from None
    return str(name)
