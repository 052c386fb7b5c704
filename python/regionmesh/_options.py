"""Keywords of Python from the options of the command line, declared once in the C++ library."""

import operator
import os
import warnings

from . import _core

# Options of the command line that are arguments of functions here, or have no meaning; files and output are neither.
_NOT_HERE = {"quiet", "verbose", "weld", "orient", "outside", "labels"}  # labels_to_keep
_NOT_HERE |= {"memory-limit", "no-sandbox", "require-sandbox"}  # of the process, which is the interpreter's
# Options that describe a model when it is made; its methods know them.
_OF_MODEL = {"background", "no-background", "boundary", "hull"}
_INPUT_FILES = {"collars", "surveys", "terrain", "merge"}  # other files are arguments here, or outputs
_WHY_STOPPED = {
    "topology": "every further collapse would change topology, fold, cross or degrade faces, or carry samples into other "
    "regions",
    "max_error": "every further collapse would exceed max_error",
}
_FALSE_AND_TRUE = {"smooth": ("off", "normal")}


def _keyword(name):
    """`--no-keep-samples` is the keyword keep_samples, with the opposite meaning; `for` is a word of Python."""
    if name == "for":
        return "purpose"
    if name.startswith("no-") and name != "no-background":
        return name[3:].replace("-", "_")
    return name.replace("-", "_")


def rows(command):
    """Return the options of a command that are keywords here: a dict by keyword."""
    found = {}
    for row in _core.option_rows(command):
        name = row["name"]
        if row["is_argument"] or row["group"] == "Output":
            continue
        if row["kind"] == "file" and name not in _INPUT_FILES:
            continue
        if name in _NOT_HERE or name == "no-background":
            continue
        if command != "reconstruct" and name in _OF_MODEL:
            continue
        found[_keyword(name)] = row
    return found


def whole(name, value):
    """Return the value as an int; TypeError where it is no whole number."""
    if isinstance(value, bool):
        raise TypeError(f"{name}={value!r}: not a whole number")
    try:
        return operator.index(value)
    except TypeError:
        raise TypeError(f"{name}={value!r}: not a whole number") from None


def _whole(name, value):
    return str(whole(name, value))


def _number(name, value):
    if name in ("scale_z", "edge_length") and isinstance(value, str) and value == "auto":
        return value
    if isinstance(value, (bool, str)):
        raise TypeError(f"{name}={value!r}: not a number")
    try:
        return repr(float(value))
    except TypeError:
        raise TypeError(f"{name}={value!r}: not a number") from None


def _three(name, value, text_of):
    if isinstance(value, (str, bytes)):
        raise TypeError(f"{name}={value!r}: not three numbers")
    if name == "spacing" and not hasattr(value, "__iter__"):
        value = (value,) * 3
    try:
        return ",".join(text_of(name, item) for item in value)
    except TypeError:
        raise TypeError(f"{name}={value!r}: not three numbers") from None


def _text(name, value):
    if not isinstance(value, str):
        raise TypeError(f"{name}={value!r}: not a text")
    return value


def _flag(name, value):
    import numpy

    if not isinstance(value, (bool, numpy.bool_)):
        raise TypeError(f"{name}={value!r}: not True or False")
    return "true" if value else "false"


def _free_text(name, value):
    """Text, or a number of passes; words for True and False where there are some."""
    if isinstance(value, bool) and name in _FALSE_AND_TRUE:
        return _FALSE_AND_TRUE[name][value]
    return _text(name, value) if isinstance(value, str) else _whole(name, value)


_TEXTS = {
    "flag": _flag,
    "count": _whole,
    "label": _whole,
    "number": _number,
    "share": lambda name, value: value if isinstance(value, str) else _number(name, value),
    "bytes": lambda name, value: value if isinstance(value, str) else _whole(name, value),
    "word": _text,
    "text": _free_text,
    "counts": lambda name, value: _three(name, value, _whole),
    "numbers": lambda name, value: _three(name, value, _number),
    "file": lambda name, value: os.fspath(value),
}


def _background_pairs(value):
    """None or an empty sequence: every label is a region."""
    if value is None:
        return [("no-background", "true")]
    labels = [value] if not hasattr(value, "__iter__") or isinstance(value, str) else list(value)
    if not labels:
        return [("no-background", "true")]
    return [("background", _whole("background", label)) for label in labels]


def pairs(command, options, function=None):
    """Return the options as (name, text), as the command line takes them.

    Parameters
    ----------
    command : str
        A command of the program.
    options : dict
        Values by keyword. None stands for the default, except for `background`.
    function : str, optional
        The name of the function in error messages; by default that of the command.

    Raises
    ------
    TypeError
        For an unknown keyword, or a value of the wrong type.
    ValueError
        For a value out of range, with the line of the command line.
    """
    return _pairs(rows(command), options, function or command)


def warn_of_target(function, given, model):
    """Warn where a model has more faces than the options `given`, as pairs() returns them, ask for."""
    target = next((f"{_keyword(name)}={text}" for name, text in given if name in ("reduce", "target-faces")), None)
    if target is None or model.stopped not in _WHY_STOPPED:
        return
    text = f"{function}: {target} is not reached with {model.face_count} faces: {_WHY_STOPPED[model.stopped]}"
    warnings.warn(text, stacklevel=3)


def output_pairs(options, function):
    """Return options about the files to write as pairs() does."""
    known = {_keyword(row["name"]): row for row in _core.option_rows("convert") if row["group"] == "Output"}
    return _pairs(known, options, function)


def _pairs(known, options, function):
    result = []
    for keyword, value in options.items():
        row = known.get(keyword)
        if row is None:
            raise TypeError(f"{function}() got an unexpected keyword argument '{keyword}'")
        if keyword == "background":
            result += _background_pairs(value)
            continue
        if value is None:
            continue
        text = _TEXTS[row["kind"]](keyword, value)
        if row["name"].startswith("no-"):
            text = "false" if text == "true" else "true"
        result.append((row["name"], text))
    _core.check_options(result)
    return result
