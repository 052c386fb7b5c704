"""A surface model of many regions."""

import json
import os
import warnings

import numpy as np

from . import _core, _measure, _options, _progress, _sources, _surface
from ._labels import bits

_COARSE = 0.01  # of an edge: numbers of a file that move points farther are worth a warning


class Mesh:
    """Triangles that separate two regions and belong to both.

    Made by `reconstruct`, `load` and `from_arrays`. A mesh never changes: `simplify`, `smooth` and `improve` return a
    new one. All arrays are read-only, have no copy, and stay valid after the mesh is gone.

    Examples
    --------
    >>> import numpy as np, regionmesh
    >>> labels = np.zeros((9, 9, 9), np.uint8)
    >>> labels[2:7, 2:7, 2:4], labels[2:7, 2:7, 4:7] = 1, 2
    >>> mesh = regionmesh.reconstruct(labels)
    >>> mesh.certified
    True
    >>> [int(label) for label in mesh.regions["voxels"]]
    [50, 75]
    >>> mesh.regions["neighbours"][0]
    [0, 2]
    >>> surface = mesh.region(1)
    >>> surface.points.shape[1], surface.faces.shape[1]
    (3, 3)
    >>> len(mesh.simplify(reduce=0.5)) <= len(mesh) / 2
    True
    >>> bool((mesh.voxelise() == labels).all())
    True
    """

    def __init__(self, model, lattice=None):
        self._model = model
        self._lattice = lattice
        self._views = None
        self._report = None
        self._tables = {}

    # Arrays

    def _arrays(self):
        if self._views is None:
            self._views = self._model.arrays
        return self._views

    @property
    def points(self):
        """(n, 3) float64: x, y, z of each point, in the unit of the spacing."""
        return self._arrays()[0]

    @property
    def faces(self):
        """(m, 3) uint32: rows of `points`. The normal of a face points from its first label to its second."""
        return self._arrays()[1]

    @property
    def labels(self):
        """(m, 2) int64, or uint64 for labels of that type: the two regions of each face.

        The smaller label is first; background and the exterior (`exterior_label`) are second.
        """
        return self._arrays()[2]

    @property
    def node_types(self):
        """(n,) uint8: number of labels around each point, 2, 3 or 4, where sides of the box count; +10 on the box."""
        return self._arrays()[3]

    @property
    def exterior_label(self):
        """The label that stands for the outside of the box in `labels`."""
        return self._unsigned(self._model.exterior_label)

    @property
    def background(self):
        """Labels of empty space, a list of int."""
        return [self._unsigned(label) for label in self._model.background]

    @property
    def space(self):
        """Where x and y point in the patient: "RAS" or "LPS", or None where no file said it. Saved with the model."""
        return self._model.space or None

    @property
    def metres(self):
        """Metres in a unit of length, 0.001 for millimetres, or None where no file said it. Saved with the model."""
        return self._model.metres

    def _unsigned(self, label):
        return label + (1 << 64) if self._model.is_unsigned and label < 0 else label

    @property
    def names(self):
        """Names of regions, a dict by label."""
        return {self._unsigned(label): name for label, name in self._model.names.items()}

    @property
    def bounds(self):
        """(2, 3) float64: the lowest and the highest x, y, z of all points; nan without points."""
        if not len(self.points):
            return np.full((2, 3), np.nan)
        return np.stack([self.points.min(axis=0), self.points.max(axis=0)])

    @property
    def lines(self):
        """(k, 2) uint32: edges with three or more faces; rows of `points`.

        Three or more regions meet there, the outside counted. Where a region, the background and the outside of the box
        meet, an edge has two faces: `triple_lines` has these, too.
        """
        return _measure.lines(self.faces)

    @property
    def quadruple_points(self):
        """(k,) int64: rows of `points` where four regions meet; each side of the box counts as one."""
        return np.flatnonzero(self.node_types % 10 == 4)

    # What was found

    @property
    def report(self):
        """The report of the last step as a dict (keys: docs/reference/report.md). A loaded model is checked first."""
        if self._report is None:
            self._report = json.loads(self._model.report or _core.check(self._model, 0, None, []))
        return self._report

    @property
    def violations(self):
        """What the check found: a list of dicts with kind, text, vertices and faces."""
        return self.report["violations"]

    @property
    def certified(self):
        """True if the check found no violation, and no sample lies in another region where samples were checked."""
        report = self.report
        return sum(report["violation_counts"].values()) == 0 and report.get("samples_wrong", 0) == 0

    @property
    def regions(self):
        """A dict of columns, one row a region, in the order of labels; `pandas.DataFrame(mesh.regions)` takes it.

        label, name; voxels (samples; -1 where they are not known); volume (length^3); area (length^2); euler (Euler
        characteristic of the boundary); components (of the boundary); mean_quality (of faces; 0.26 is equilateral);
        centroid_x, centroid_y, centroid_z (of the volume); box_low_x to box_high_z; neighbours (list of labels,
        background included); mean_curvature (1 / length, positive where the region is convex; nan where it has none)
        and triple_line_length, both without the sides of the box (docs/reference/files.md).
        """
        return self._table("regions")

    @property
    def interfaces(self):
        """A dict of columns, one row a pair of labels.

        first, second; faces; area (length^2); mean_curvature (1 / length, positive where `first` is convex; nan on the
        exterior, between two labels of background, and where all is near lines: docs/reference/files.md); line_length (the
        lines that bound it).
        """
        return self._table("interfaces")

    @property
    def triple_lines(self):
        """A dict of columns, one row a set of three labels or more that meet at edges; the outside counts as one.

        labels (list); edges; length; angles (list: the mean dihedral angle of each label in degrees, nan for the
        outside and where it has none: docs/reference/files.md).
        """
        return self._table("triple_lines")

    def _table(self, name):
        """Columns are measured once; the dict is the caller's."""
        if name not in self._tables:
            self._tables[name] = getattr(_measure, name)(self)
            for column in self._tables[name].values():
                column.flags.writeable = False
        return dict(self._tables[name])

    def region(self, label):
        """Return the closed surface of a region, its normals outward.

        Parameters
        ----------
        label : int
            A label of the model.

        Returns
        -------
        Surface

        Raises
        ------
        KeyError
            For a label that no face has.
        """
        return _surface.region(self, label)

    def interface(self, a, b):
        """Return the faces between two labels, their normals from `a` to `b`.

        Parameters
        ----------
        a, b : int
            Labels; `exterior_label` stands for the outside of the box.

        Returns
        -------
        Surface
            Without faces where the two do not meet.
        """
        return _surface.interface(self, a, b)

    # What can be done

    def simplify(self, *, keep_samples=True, progress=None, **options):
        """Return a mesh with fewer faces and the same regions.

        Parameters
        ----------
        keep_samples : bool
            No sample of the volume that the mesh was made from changes its region. Meshes from files and arrays have
            no samples.
        progress : bool or callable, optional
            As in `reconstruct`.
        **options
            The options of `regionmesh decimate`, see below; one of `reduce`, `target_faces`, `max_error`,
            `edge_length`, `improve` and `smooth_lines` is needed.

        Returns
        -------
        Mesh

        Raises
        ------
        ValueError
            Without a target, and for values out of range.

        Warns
        -----
        UserWarning
            Where the mesh has more faces than `reduce` or `target_faces` ask for.
        """
        pairs = _options.pairs("decimate", options, "simplify")
        mesh = self._simplified(pairs, keep_samples, progress)
        _options.warn_of_target("simplify", pairs, mesh._model)
        return mesh

    def improve(self, *, min_quality=0.1, keep_samples=True, threads=0, progress=None):
        """Return a mesh with better shaped faces, for finite elements: edges are flipped, vertices moved.

        The worst faces get better first. Regions, interfaces and lines stay. Steps near a vertex add up to no more than a
        tenth of a typical edge, three tenths round faces below `min_quality` (docs/explanation/improve.md: the surface may
        move farther in places).

        Parameters
        ----------
        min_quality : float
            Edges of faces below this quality may be collapsed, too; 0.26 is that of an equilateral face.
        keep_samples : bool
            As in `simplify`.
        threads : int
            Of the check; 0: one per core.
        progress : bool or callable, optional
            As in `reconstruct`.

        Returns
        -------
        Mesh
            Its `report` has `improved`: qualities and angles before and after.

        Examples
        --------
        >>> import numpy as np, regionmesh
        >>> labels = np.zeros((12, 12, 12), np.uint8)
        >>> labels[2:6, 2:10, 2:10], labels[6:10, 2:10, 2:10] = 1, 2
        >>> mesh = regionmesh.reconstruct(labels, reduce=0.5)
        >>> better = mesh.improve()
        >>> better.certified, better.report["quality"]["min"] >= mesh.report["quality"]["min"]
        (True, True)
        """
        pairs = _options.pairs("decimate", {"min_quality": min_quality, "threads": threads, "improve": True}, "improve")
        return self._simplified(pairs, keep_samples, progress)

    def _simplified(self, pairs, keep_samples, progress):
        samples = self._samples() if keep_samples else None
        with _progress.bar(progress) as report:
            return self._derived(_core.simplify(self._model, pairs, samples, report))

    def _samples(self):
        """The lattice that the mesh was made from, or None."""
        own = self._lattice
        return own and (_sources.frame(own["spacing"], own["origin"], own["direction"]), own["size"])

    def smooth(self, **options):
        """Return a smoother mesh with the same faces.

        Parameters
        ----------
        **options
            The options of `regionmesh smooth`; see below.

        Returns
        -------
        Mesh
        """
        return self._derived(_core.smooth(self._model, _options.pairs("smooth", options)))

    def _derived(self, model):
        mesh = Mesh(model, self._lattice)
        rows = self.report.get("dice_of_regions")
        # The samples of regions stay; what the model makes of them may change.
        if rows and "dice_of_regions" not in mesh.report:
            mesh.report["dice_of_regions"] = [{key: row[key] for key in ("label", "samples")} for row in rows]
        return mesh

    def check(self, labels=None, *, spacing=None, origin=None, direction=None, threads=0):
        """Look for cracks, folds, crossing faces and changes of topology.

        Parameters
        ----------
        labels : array_like, path or image, optional
            The labels that the model was made from, as in `reconstruct`: the model is compared with them, too. `roi`,
            `downsample` and all else that chose samples for the model chooses them here, too; samples already so
            chosen are taken as they are. `room` and `denoise` change labels as they did for the model. A volume in another space is
            turned into that of the model.
        spacing, origin, direction : optional
            As in `reconstruct`; default: those the model was made with.
        threads : int
            0: one per core.

        Returns
        -------
        dict
            quality, regions, region_pairs, quadruple_points_inside, violations, violation_counts; with labels also
            samples, samples_wrong and dice (docs/reference/report.md).

        Raises
        ------
        ValueError
            For labels that are not as many along each axis as the model was made from, and for a file whose samples
            lie elsewhere.
        FileNotFoundError
            For a path where there is no file.
        """
        source = None
        threads = int(dict(_options.pairs("reconstruct", {"threads": threads}, "check")).get("threads", 0))
        if labels is not None:
            opened = self._file_source if _sources.is_path(labels) else self._array_source
            source = opened(labels, (spacing, origin, direction))
            self._require_same_size(source.info)
            self._warn_of_units("check", "labels", source.info["metres"])
        made = (self._lattice or {}).get("made", {})
        changes = made.get("changes", [("denoise", "off")])
        return json.loads(_core.check(self._model, threads, source, changes))

    def _require_same_size(self, info):
        own = (self._lattice or {}).get("size", info["size"])
        if info["size"] != own:
            size, made = (" x ".join(str(n) for n in each) for each in (info["size"], own))
            raise ValueError(
                f"labels: {size} samples along x, y, z, the model was made from {made}; "
                "give the volume that it was made from"
            )

    def _require_same_place(self, info, keys):
        """Files say where their samples lie: where those of the model do."""
        if "size" not in (self._lattice or {}):
            return
        near = {"direction": 1e-6, "origin": 1e-6 * min(self._lattice["spacing"]) * max(self._lattice["size"])}
        for key in keys:
            theirs, own = info[key], self._lattice[key]
            rounding = np.finfo(np.float32).eps if key == "origin" else 1e-6
            if not np.allclose(theirs, own, rtol=rounding, atol=near.get(key, 0)):
                theirs, own = (", ".join(f"{n:g}" for n in each) for each in (theirs, own))
                raise ValueError(
                    f"labels: the {key} of the file is {theirs}, that of the model {own}; give the labels as an array"
                )

    def _made(self):
        """How samples were chosen: options, labels kept, and the place of the whole input."""
        made = (self._lattice or {}).get("made")
        return (made["selection"], made["kept"], made["place"]) if made else ([], None, self._place())

    def _is_chosen(self, size):
        """Whether a volume of that size is the part that was chosen, not the whole."""
        made = (self._lattice or {}).get("made")
        return made is not None and list(size) == list(self._lattice["size"]) != list(made["size"])

    def _file_source(self, labels, given):
        if given[1] is not None or given[2] is not None:
            raise TypeError("check(): origin and direction are those of the file; leave them out")
        paths = _sources.paths_of(labels)
        if _core.kind_of_input(paths) == "tetrahedra":
            path = os.fsdecode(paths[0])
            raise ValueError(f"check(): {path} holds points or tetrahedra; give a volume, or run regionmesh check")
        selection, kept, place = self._made()
        suffix, reading = (self._lattice or {}).get("made", {}).get("reading", (None, []))
        if suffix is None and given[0] is None and place[0] is not None:  # made from an array
            given = (place[0], None, None)
        spacing = _options.pairs("reconstruct", {"spacing": given[0]})
        spacing += self._into_space()
        selection = [pair for pair in selection if pair[0] != "spacing" or given[0] is None] + spacing
        if suffix != _sources.suffix_of(paths):  # another kind of file is read in another way
            reading = []
        with _sources.missing_files(*paths):
            whole = [pair for pair in selection if pair[0] in ("spacing", "space")]
            source = _core.file_source(paths, reading + whole, None)
            if not self._is_chosen(source.info["size"]) and (selection != whole or kept is not None):
                source = _core.file_source(paths, reading + selection, kept)
        keys = ("direction", "origin") if given[0] is not None else ("direction", "origin", "spacing")
        self._require_same_place(source.info, keys)
        return source

    def _into_space(self):
        """The option that turns a file into the space of the mesh."""
        return [("space", self.space.lower())] if self.space else []

    def _array_source(self, labels, given):
        _sources.require_axes(given[2])
        opened = _sources.opened(labels).in_space(self.space)
        selection, kept, place = self._made()
        if self._is_chosen(_sources.size_of(opened)):
            selection, kept, place = [], None, self._place()
        selection = [pair for pair in selection if pair[0] not in ("spacing", "sweep")]
        place = [mine if mine is not None else made for mine, made in zip(given, place)]
        source = _sources.source(opened, _sources.place_of(opened, place), selection, {}, kept)
        if not source.info["can_rewind"]:
            raise ValueError("labels: an iterator is read once and check reads twice; give a list or an array")
        return source

    def _place(self, spacing=None, origin=None, direction=None):
        """Where samples lie: as given, else as the mesh was made."""
        given = {"spacing": spacing, "origin": origin, "direction": direction}
        own = self._lattice or {}
        return [value if value is not None else own.get(key) for key, value in given.items()]

    def compare(self, other, **options):
        """Measure the distances to another model: as a whole, by region, by interface and by line.

        Parameters
        ----------
        other : Mesh
        **options
            The options of `regionmesh compare`; see below.

        Returns
        -------
        dict
            docs/how-to/compare.md lists the keys.
        """
        if not isinstance(other, Mesh):
            raise TypeError(f"compare: {type(other).__name__}; give a Mesh")
        if self.space and other.space and self.space != other.space:
            warnings.warn(
                f"compare: the meshes are in {self.space} and {other.space}; they are compared as they are", stacklevel=2
            )
        self._warn_of_units("compare", "the other", other.metres)
        return json.loads(_core.compare(self._model, other._model, _options.pairs("compare", options)))

    def _warn_of_units(self, function, what, metres):
        if self.metres and metres and self.metres != metres:
            mine, theirs = _core.length_symbol(self.metres), _core.length_symbol(metres)
            warnings.warn(
                f"{function}: the mesh is in {mine} and {what} in {theirs}; they are compared as they are", stacklevel=3
            )

    def voxelise(self, like=None, *, shape=None, spacing=None, origin=None, direction=None, dtype=None, outside=0):
        """Return the label of each sample of a lattice: the inverse of `reconstruct`.

        Parameters
        ----------
        like : array_like, path or image, optional
            A volume [z, y, x] with the shape and type of the result; uint8 for bool. An image or a file also says where
            the samples lie.
        shape : (3,) sequence of int, optional
            Samples along z, y, x. Default: those the model was made from.
        spacing, origin, direction : optional
            As in `reconstruct`; default: those the model was made with.
        dtype : integer type, optional
            Default: that of `like`, else that the model was made from.
        outside : int
            Label of samples in no region, where there is no background.

        Returns
        -------
        (z, y, x) ndarray

        Raises
        ------
        ValueError
            Without a shape, for a type that cannot hold the labels, and for a surface that is not closed.
        """
        own = self._lattice or {}
        if like is not None and shape is not None:
            raise TypeError("voxelise: give like or shape, not both")
        place = (spacing, origin, direction)
        _sources.require_axes(direction)
        if like is not None:
            shape, of_like, own_place = self._lattice_like(like)
            dtype = of_like if dtype is None else dtype
            place = [given if given is not None else value for given, value in zip(place, own_place)]
        if shape is None and "size" in own:
            shape = own["size"][::-1]
        if shape is None or len(shape) != 3:
            raise ValueError("voxelise: no lattice; give like or shape with three axes")
        if not all(0 < n < 1 << 32 for n in shape):
            raise ValueError(f"voxelise: shape {tuple(shape)}; give 1 to {(1 << 32) - 1} samples along each axis")
        of_own = own.get("type", "int64")
        dtype = np.dtype(dtype if dtype is not None else "uint8" if of_own == "bool" else of_own)
        regions = [row["label"] for row in self.report["regions"]] + self.background + [outside]
        if dtype.kind not in "iu" or min(regions) < np.iinfo(dtype).min or max(regions) > np.iinfo(dtype).max:
            raise ValueError(f"voxelise: {dtype} cannot hold the labels {min(regions)} to {max(regions)}; give dtype")
        where = _sources.frame(*self._place(*place))
        result = np.empty(tuple(shape), dtype.newbyteorder("="))
        _core.voxelise(self._model, where, bits(outside), result)
        return result

    def _lattice_like(self, like):
        """Return the shape, the type and the place of a volume; the place is None where it says nothing."""
        if _sources.is_path(like):
            with _sources.missing_files(*_sources.paths_of(like)):
                info = _core.file_source(_sources.paths_of(like), self._into_space(), None).info
            shape, dtype, place = info["size"][::-1], info["type"], [info[key] for key in ("spacing", "origin", "direction")]
        else:
            own = _sources.placed(like).in_space(self.space)
            data = own.data if hasattr(own.data, "shape") else np.asarray(own.data)
            shape, dtype, place = data.shape, data.dtype, (own.spacing, own.origin, own.direction)
        return shape, "uint8" if dtype == "bool" else dtype, place

    def save(self, path, *, per_region=False, ascii=False, units=None, precomputed=None, levels=None, sharded=False):
        """Write the model; the extension selects the format (docs/reference/files.md).

        Parameters
        ----------
        path : path
            .vtp .vtu .ply .obj .stl .msh .smesh .poly .inp .glb .3mf .dream3d, or a folder .precomputed for
            Neuroglancer (docs/how-to/neuroglancer.md), whose parent exists.
        per_region : bool
            .stl, .obj and .ply: a file for each region, MODEL-NAME.EXTENSION, or MODEL-LABEL.EXTENSION where it has no
            name.
        ascii : bool
            .stl: text, doubles and a solid with a name for each region, instead of binary.
        units : {"km", "m", "cm", "mm", "um", "nm", "ft", "in"}, optional
            The unit of length of the model: .glb files are in metres and .precomputed in nanometres, and are scaled;
            other files say the unit, where they can. Default: that of the model (`metres`), else metres, and
            millimetres in .3mf.
        precomputed : {"multi", "legacy"}, optional
            .precomputed: levels of detail compressed by Draco (the default), or the model, not compressed.
        levels : int, optional
            .precomputed, multi: levels of detail; by default from the number of faces.
        sharded : bool
            .precomputed, multi: few large files instead of two for each region.

        Returns
        -------
        list of str
            The files written, or the folder.

        Raises
        ------
        OSError
            For another extension, and where the file cannot be written.
        ValueError
            For options that are not for such a file.
        """
        pairs = _options.output_pairs({"units": units, "ascii": ascii}, "save")
        of_folder = {"precomputed": precomputed, "levels": levels, "sharded": None if sharded is False else sharded}
        given = _options.output_pairs(of_folder, "save")
        folder = os.path.normpath(os.fsdecode(path))
        is_folder = os.path.splitext(folder)[1] == ".precomputed"
        path = folder if is_folder else path
        if given and not is_folder or per_region and is_folder:
            option = "per_region" if is_folder else given[0][0]
            raise ValueError(f"save: {option} is not for {os.fsdecode(path)!r}")
        pairs += given
        paths, share = _core.save(self._model, _sources.file_name(path), bool(per_region), pairs)
        if share > _COARSE:
            warnings.warn(
                f"save: {os.fspath(path)!r} holds numbers of single precision, which moves points by up to {share:.2g} "
                "of an edge; subtract an offset, or write .vtp or .ply",
                stacklevel=2,
            )
        return [os.fsdecode(path) for path in paths]

    # Python

    def __len__(self):
        return self._model.face_count

    def __repr__(self):
        return (
            f"<regionmesh.Mesh: {self._model.face_count} faces, {self._model.vertex_count} points, "
            f"{len(self.report['regions'])} regions, {self._state()}>"
        )

    def _state(self):
        """In words: certified, or what is wrong."""
        violations, wrong = sum(self.report["violation_counts"].values()), self.report.get("samples_wrong", 0)
        found = [f"{violations} violations"] * (violations > 0) + [f"{wrong} samples in other regions"] * (wrong > 0)
        return ", ".join(found) or "certified"

    def __reduce__(self):
        types = self.node_types
        state = {
            "background": self._model.background,
            "order": self._model.label_order,
            "is_open": self._model.is_open,
            "names": self._model.names,
            "colours": self._model.colours,
            "space": self._model.space,
            "metres": self._model.metres,
            "spacing": self._model.spacing,
            "lacking": self._model.lacking,
            "exterior": self._model.exterior_label,
            "is_unsigned": self._model.is_unsigned,
            "lattice": self._lattice,
            "report": self.report,
        }
        from ._make import unpickle

        return unpickle, (self.points, self.faces, self.labels, types, state)

    def to_vtk(self):
        """Return a vtkPolyData with the cell array BoundaryLabels and the point array NodeType. Needs VTK."""
        from . import _convert

        return _convert.to_vtk(self)

    def to_pyvista(self):
        """Return a pyvista.PolyData with the arrays of `to_vtk`. Needs PyVista."""
        from . import _convert

        return _convert.to_pyvista(self)

    def to_meshio(self):
        """Return a meshio.Mesh with the arrays of `to_vtk`. Needs meshio."""
        from . import _convert

        return _convert.to_meshio(self)

    def plot(self):
        """Show the model: all regions in a window of PyVista, or where it is missing the view of a notebook."""
        from . import _convert

        return _convert.plot(self)

    def to_trimesh(self, label=None):
        """Return a trimesh.Trimesh of one region, or of all faces with their labels as attribute. Needs trimesh."""
        from . import _convert

        return _convert.to_trimesh(self, label)

    def _repr_html_(self):
        from . import _page

        return _page.html(self)
