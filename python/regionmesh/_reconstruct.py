"""From labels to a model."""

import os

from . import _core, _options, _progress, _sources
from ._labels import bits, colours_of, names_of
from ._mesh import Mesh

# Options that say how an input is read.
_OF_SOURCE = {"sweep", "roi", "box", "downsample", "min-region", "merge", "background", "no-background"}
_OF_FILES = ("size", "type", "layer", "columns", "step", "layers", "collars", "surveys", "terrain", "array", "hull",
             "max_work", "external_files")  # fmt: skip
_SPACES = {"ras": "RAS", "lps": "LPS"}
_OF_READING = {name.replace("_", "-") for name in _OF_FILES}


def _split(options, names):
    return [(name, text) for name, text in options if name in names]


def _named(options):
    """Files that options name."""
    return [value for name, value in options if name in ("collars", "surveys", "terrain", "merge")]


def _kept(labels):
    if labels is None:
        return None
    if not hasattr(labels, "__iter__"):
        raise TypeError(f"labels_to_keep={labels!r}: not a sequence of labels")
    return [bits(label) for label in labels]


def _from_files(labels, options, kept, described, progress):
    paths = _sources.paths_of(labels)
    with _sources.missing_files(*paths, *_named(options)):
        if _core.kind_of_input(paths) == "tetrahedra":
            if len(paths) > 1:
                raise ValueError(f"{os.fsdecode(paths[1])}: one table or mesh at a time; give one")
            if kept is not None:
                raise ValueError("labels_to_keep: does not apply to tables and meshes; leave it out")
            return Mesh(_core.reconstruct_tetrahedra(paths[0], options, *described, progress))
        source = _core.file_source(paths, options, kept)
        chosen = _split(options, _OF_SOURCE | {"spacing"})
        whole = source.info
        if _sources.is_cut(chosen):
            whole = _core.file_source(paths, [pair for pair in options if pair[0] not in _OF_SOURCE], None).info
        place = tuple(whole[key] for key in ("spacing", "origin", "direction"))
        model = _core.reconstruct_source(source, options, *described, progress)
        made = _made(options, chosen, kept, place, whole["size"])
        return Mesh(model, {**source.info, "made": {**made, "reading": (_sources.suffix_of(paths), _split(options, _OF_READING))}})


def _made(options, chosen, kept, place, size):
    """What Mesh.check needs to choose the same samples again."""
    changes = [pair for pair in options if pair[0] in ("room", "denoise", "specks", "between", "align")]
    return {"selection": chosen, "kept": kept, "place": place, "size": list(size), "changes": changes}


def reconstruct(
    labels,
    *,
    spacing=None,
    origin=None,
    direction=None,
    names=None,
    labels_to_keep=None,
    sections=None,
    units=None,
    space=None,
    progress=None,
    **options,
):
    """Make one surface model of all regions, and check it.

    Parameters
    ----------
    labels : array_like, path, iterable or image
        A volume of integers [z, y, x] of any type and strides: a numpy array or memory map (not copied); an array
        of dask, zarr or h5py (read section by section); an image of SimpleITK or nibabel, with its place in space
        and its unit of length; an iterable of sections [y, x]; or the path of a file that the program `regionmesh`
        reads, or a list of paths of sections.
    spacing : float or (3,) sequence of float, optional
        Distance between samples along x, y, z, or along all axes. Default: that of the image or file, else 1.
    origin : (3,) sequence of float, optional
        Place of the first sample, x, y, z, in the unit of the spacing. Not for paths.
    direction : (3, 3) array_like, optional
        Directions of the axes x, y, z as orthonormal columns. Not for paths.
    names : dict of int to str, or path, optional
        Names of labels; a table has their colours, too.
    labels_to_keep : sequence of int, optional
        All other labels become background, before `downsample` and `min_region`.
    sections : int, optional
        Number of sections of an iterator. With it the sections are used as they come and the volume is never
        stored; without it they go through a temporary file in TMPDIR.
    units : {"km", "m", "cm", "mm", "um", "nm", "ft", "in"}, optional
        Unit of length of the model, `Mesh.metres`. Default: that of the image or file, where it says one.
    space : {"ras", "lps"}, optional
        Space of the model, `Mesh.space`: that of an image or file is turned into it, and others are taken to be in it.
        Default: that of the image (RAS for nibabel, LPS for SimpleITK) or file, where it says one.
    progress : bool or callable, optional
        True: a progress bar, by tqdm where it is installed. A callable gets (stage, done, total); total is None where
        it is not known.
    **options
        The options of `regionmesh reconstruct`; see below.

    Returns
    -------
    Mesh
        The model. Violations are no errors: see `Mesh.certified` and `Mesh.report`.

    Warns
    -----
    UserWarning
        Where the model has more faces than `reduce` or `target_faces` ask for; and of tables of names that cannot be
        read.

    Raises
    ------
    TypeError
        For labels that are no integers, unknown options and values of the wrong type.
    ValueError
        For values out of range and for input that cannot be used, with the line of the program.
    FileNotFoundError
        For a path where there is no file.
    KeyboardInterrupt
        At Ctrl-C; everything is freed. An exception of an iterator or of `progress` comes through in the same way.

    Notes
    -----
    Another thread of Python may run meanwhile. Iterators are called on the caller's thread and on another one. The
    model depends on labels and options only, not on the number of threads.

    Examples
    --------
    >>> import numpy as np, regionmesh
    >>> labels = np.zeros((10, 10, 10), np.int16)
    >>> labels[2:8, 2:8, 2:8] = 5
    >>> mesh = regionmesh.reconstruct(labels, smooth="off")
    >>> mesh.bounds
    array([[1.5, 1.5, 1.5],
           [7.5, 7.5, 7.5]])
    """
    from_files = _sources.is_path(labels)
    kept = _kept(labels_to_keep)
    described = names_of(names), colours_of(names)
    given = _options.output_pairs({"units": units, "space": space}, "reconstruct")
    with _progress.bar(progress) as report:
        if from_files:
            if origin is not None or direction is not None:
                raise TypeError("reconstruct(): origin and direction are those of the file; leave them out")
            if sections is not None:
                raise TypeError("reconstruct(): sections applies to iterators, not to files; leave it out")
            if spacing is not None:
                options = {"spacing": spacing, **options}
            pairs = _options.pairs("reconstruct", options) + given
            mesh = _from_files(labels, pairs, kept, described, report)
        else:
            for name in _OF_FILES:
                if options.get(name) is not None:
                    raise TypeError(f"reconstruct(): {name} applies to files, not to {type(labels).__name__}")
            pairs = _options.pairs("reconstruct", options) + given
            _sources.require_axes(direction)
            opened = _sources.opened(labels, sections).in_space(_SPACES.get(space, ""))
            place, chosen = _sources.place_of(opened, (spacing, origin, direction)), _split(pairs, _OF_SOURCE)
            with _sources.missing_files(*_named(pairs)):
                source = _sources.source(opened, place, chosen, described[0] or {}, kept)
            model = _core.reconstruct_source(source, pairs, *described, report)
            mesh = Mesh(model, {**source.info, "made": _made(pairs, chosen, kept, place, _sources.size_of(opened))})
    _options.warn_of_target("reconstruct", pairs, mesh._model)
    return mesh


def _describe(function, command):
    """Add the options to the signature and the docstring of a function."""
    import inspect

    lines = ["", "Other Parameters", "----------------"]
    signature = inspect.signature(function)
    parameters = [p for p in signature.parameters.values() if p.kind != p.VAR_KEYWORD]
    taken = {p.name for p in parameters}
    for keyword, row in _options.rows(command).items():
        if keyword in taken:
            continue
        parameters.append(inspect.Parameter(keyword, inspect.Parameter.KEYWORD_ONLY, default=None))
        details = [row["kind"] if not row["words"] else " | ".join(row["words"])]
        details += [row["unit"]] if row["unit"] else []
        details += [row["range"]] if row["range"] else []
        details += [f"default {row['default']}"] if row["default"] else []
        help_text = row["help"] if not row["name"].startswith("no-") else f"False: {row['help']}"
        lines += [f"{keyword} : {', '.join(details)}", f"    {help_text}"]
    function.__signature__ = signature.replace(parameters=parameters)
    function.__doc__ = inspect.cleandoc(function.__doc__) + "\n" + "\n".join(lines) + "\n"


_describe(reconstruct, "reconstruct")
_describe(Mesh.simplify, "decimate")
_describe(Mesh.smooth, "smooth")
_describe(Mesh.compare, "compare")
