"""The programs that lie beside the module."""

import os
import shutil
from pathlib import Path

_FOLDER = Path(__file__).parent / "bin"
_VARIABLES = {
    "regionmesh-hdf5": "REGIONMESH_HDF5_PROGRAM",
    "regionmesh-dicom": "REGIONMESH_DICOM_PROGRAM",
    "regionmesh-delaunay": "REGIONMESH_DELAUNAY",
}


def path_of(name):
    """The path of a program of the package, else of the system; or None."""
    path = _FOLDER / name
    return str(path) if path.exists() else shutil.which(name)


def announce():
    """Tell the library where its helpers are: it would look beside the interpreter."""
    for name, variable in _VARIABLES.items():
        path = path_of(name)
        if path is not None:
            os.environ.setdefault(variable, path)
