"""Models as objects of other libraries, which are imported only here."""

import numpy as np


def to_vtk(mesh):
    """See Mesh.to_vtk."""
    from vtkmodules.util import numpy_support
    from vtkmodules.vtkCommonCore import vtkPoints
    from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData

    points = vtkPoints()
    points.SetData(numpy_support.numpy_to_vtk(mesh.points, deep=True))
    offsets = np.arange(0, 3 * len(mesh.faces) + 1, 3, dtype=np.int64)
    cells = vtkCellArray()
    cells.SetData(
        numpy_support.numpy_to_vtkIdTypeArray(offsets, deep=True),
        numpy_support.numpy_to_vtkIdTypeArray(mesh.faces.ravel().astype(np.int64), deep=True),
    )
    data = vtkPolyData()
    data.SetPoints(points)
    data.SetPolys(cells)
    for name, values, target in (
        ("BoundaryLabels", mesh.labels, data.GetCellData()),
        ("NodeType", mesh.node_types.astype(np.int8), data.GetPointData()),
    ):
        array = numpy_support.numpy_to_vtk(values, deep=True)
        array.SetName(name)
        target.AddArray(array)
    return data


def to_pyvista(mesh):
    """See Mesh.to_pyvista."""
    import pyvista

    data = pyvista.PolyData(np.array(mesh.points), np.insert(mesh.faces.astype(np.int64), 0, 3, axis=1).ravel())
    data.cell_data["BoundaryLabels"] = np.array(mesh.labels)
    data.point_data["NodeType"] = mesh.node_types.astype(np.int8)
    return data


def plot(mesh):
    """See Mesh.plot."""
    try:
        import pyvista
    except ImportError:
        try:
            from IPython.display import HTML
        except ImportError:
            raise ImportError("plot() needs PyVista, or a notebook: pip install pyvista") from None
        return HTML(mesh._repr_html_())
    plotter = pyvista.Plotter()
    for label in mesh.regions["label"]:
        surface = mesh.region(label)
        faces = np.insert(surface.faces.astype(np.int64), 0, 3, axis=1).ravel()
        name = mesh.names.get(int(label), f"region {label}")
        plotter.add_mesh(pyvista.PolyData(np.array(surface.points), faces), color=_colour(len(plotter.actors)), label=name)
    return plotter.show()


def _colour(number):
    """Hues as far apart as can be, whatever their number."""
    import colorsys

    return colorsys.hsv_to_rgb(number * 0.61803398875 % 1, 0.65, 0.9)


def to_meshio(mesh):
    """See Mesh.to_meshio."""
    import meshio

    return meshio.Mesh(
        mesh.points,
        [("triangle", mesh.faces.astype(np.int64))],
        point_data={"NodeType": mesh.node_types},
        cell_data={"BoundaryLabels": [mesh.labels]},
    )


def to_trimesh(mesh, label):
    """See Mesh.to_trimesh."""
    import trimesh

    if label is None:
        whole = trimesh.Trimesh(np.array(mesh.points), mesh.faces.astype(np.int64), process=False)
        whole.face_attributes["labels"] = np.array(mesh.labels)
        return whole
    surface = mesh.region(label)
    return trimesh.Trimesh(surface.points, surface.faces.astype(np.int64), process=False)
