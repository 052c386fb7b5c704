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

    surface = mesh.region(label)
    return trimesh.Trimesh(surface.points, surface.faces.astype(np.int64), process=False)
