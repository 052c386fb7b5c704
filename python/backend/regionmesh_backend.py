"""Builds the wheel with CMake; needs no package from an index (PEP 517).

    pip install --no-build-isolation --no-index .

The wheel holds the module, the program `regionmesh`, and the shared libraries that both need beyond the C and C++
libraries, so that it works where these are not installed. HDF5 and DICOM are left out, because their libraries bring
some thirty others; arrays of h5py are read all the same. Settings (pip: --config-settings KEY=VALUE) and variables:

    hdf5=on           with HDF5 and DREAM.3D files
    dicom=on          with DICOM segmentations
    build-dir=FOLDER  pack what was built there with REGIONMESH_WITH_PYTHON, instead of building
    CMAKE_ARGS        more arguments of CMake
"""

import base64
import hashlib
import io
import os
import re
import shlex
import shutil
import subprocess
import sys
import sysconfig
import tarfile
import zipfile
from pathlib import Path

_ROOT = Path(__file__).resolve().parents[2]
_PACKAGE = _ROOT / "python" / "regionmesh"
# On every system with an interpreter and apt.
_OF_SYSTEM = re.compile(r"(ld-linux.*|lib(c|m|dl|rt|pthread|resolv|gcc_s|stdc\+\+))\.so")
_SOURCES = (
    "CMakeLists.txt", "CMakePresets.json", "LICENSE", "README.md", "CHANGELOG.md", "pyproject.toml",
    "apps", "cmake", "docs", "examples", "include", "src", "python", "script", "viewer/dist/page.html",
    "viewer/three.LICENSE",
)  # fmt: skip


def _version():
    return re.search(r"project\(regionmesh VERSION ([0-9.]+)", (_ROOT / "CMakeLists.txt").read_text())[1]


def _metadata():
    readme = (_ROOT / "README.md").read_text(encoding="utf-8")
    return f"""Metadata-Version: 2.1
Name: regionmesh
Version: {_version()}
Summary: Certified multi-region surface models from labelled planar sections
License: BSD-3-Clause
Requires-Python: >=3.9
Requires-Dist: numpy
Description-Content-Type: text/markdown

{readme}"""


def _build(settings):
    """Configure and build; returns the build folder."""
    if "build-dir" in settings:
        return Path(settings["build-dir"]).resolve()
    folder = _ROOT / "build" / "wheel"
    parts = [
        f"-DREGIONMESH_WITH_{part.upper()}=" + ("ON" if settings.get(part, "off").lower() in ("on", "1", "true") else "OFF")
        for part in ("hdf5", "dicom")
    ]
    configure = [
        "cmake", "-S", _ROOT, "-B", folder, "-DCMAKE_BUILD_TYPE=Release", "-DCMAKE_INTERPROCEDURAL_OPTIMIZATION=ON",
        "-DCMAKE_CXX_FLAGS_RELEASE=-O3 -DNDEBUG",
        "-DREGIONMESH_WITH_PYTHON=ON", "-DREGIONMESH_TESTS=OFF", "-DREGIONMESH_DELAUNAY=OFF",
        *parts, f"-DPython_EXECUTABLE={sys.executable}",
    ]  # fmt: skip
    if not (folder / "CMakeCache.txt").exists() and shutil.which("ninja"):
        configure += ["-G", "Ninja"]
    subprocess.run(configure + shlex.split(os.environ.get("CMAKE_ARGS", "")), check=True)
    subprocess.run(["cmake", "--build", folder, "--parallel", str(os.cpu_count())], check=True)
    return folder


def _shared_libraries(files):
    """The libraries that the files load and that a system may lack, by name."""
    found = {}
    for file in files:
        lines = subprocess.run(["ldd", file], check=True, capture_output=True, text=True).stdout
        for name, path in re.findall(r"(\S+) => (/\S+)", lines):
            if not _OF_SYSTEM.match(name):
                found[name] = Path(path)
    return found


def _notices(folder, libraries):
    """Licences of what is compiled in, and of the Debian packages that the libraries come from, by file."""
    found = {}
    if (folder / "copyright").exists():
        found["compiled-in"] = (folder / "copyright").read_bytes()
    # Packages of before /lib became a link to /usr/lib list their files there.
    real = [str(path.resolve()) for path in libraries]
    names = real + [path.removeprefix("/usr") for path in real]
    if not shutil.which("dpkg-query") or not names:
        return found
    listed = subprocess.run(["dpkg-query", "-S", *names], capture_output=True, text=True).stdout
    for package in re.findall(r"^([^:, ]+)", listed, re.MULTILINE):
        notice = Path("/usr/share/doc") / package / "copyright"
        if notice.exists():
            found[package] = notice.read_bytes()
    return found


class _Wheel:
    """A zip file that keeps its own record."""

    def __init__(self, path):
        self.zip = zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED)
        self.record = []

    def _write(self, name, data, mode):
        info = zipfile.ZipInfo(name, (2000, 1, 1, 0, 0, 0))  # the same bytes whenever it is built
        info.external_attr = (0o100000 | mode) << 16
        info.compress_type = zipfile.ZIP_DEFLATED
        self.zip.writestr(info, data)

    def add(self, name, data, mode=0o644):
        self._write(name, data, mode)
        digest = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()
        self.record.append(f"{name},sha256={digest},{len(data)}")

    def close(self, folder):
        self.record.append(f"{folder}/RECORD,,")
        self._write(f"{folder}/RECORD", "\n".join(self.record) + "\n", 0o644)
        self.zip.close()


def get_requires_for_build_wheel(config_settings=None):
    return []


def _tag():
    python = f"cp{sys.version_info.major}{sys.version_info.minor}"
    return f"{python}-{python}-{sysconfig.get_platform().replace('-', '_').replace('.', '_')}"


def _info():
    """What the folder .dist-info holds beside its record, by file."""
    return {
        "METADATA": _metadata().encode(),
        "WHEEL": f"Wheel-Version: 1.0\nGenerator: regionmesh\nRoot-Is-Purelib: false\nTag: {_tag()}\n".encode(),
        "entry_points.txt": b"[console_scripts]\nregionmesh = regionmesh.__main__:main\n",
        "LICENSE": (_ROOT / "LICENSE").read_bytes(),
    }


def prepare_metadata_for_build_wheel(metadata_directory, config_settings=None):
    """Write the folder .dist-info and return its name; without this pip builds the wheel to learn its metadata."""
    info = Path(metadata_directory) / f"regionmesh-{_version()}.dist-info"
    info.mkdir()
    for name, data in _info().items():
        (info / name).write_bytes(data)
    return info.name


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    """Build the wheel and return its name."""
    folder = _build(config_settings or {})
    (module,) = (folder / "python" / "regionmesh").glob("_core.*.so")
    programs = [path for path in (folder / "regionmesh", folder / "regionmesh-hdf5", folder / "regionmesh-dicom") if path.exists()]
    name = f"regionmesh-{_version()}-{_tag()}.whl"
    wheel = _Wheel(Path(wheel_directory) / name)
    for path in sorted(_PACKAGE.iterdir()):
        if path.suffix in (".py", ".pyi", ".html") or path.name == "py.typed":
            wheel.add(f"regionmesh/{path.name}", path.read_bytes())
    wheel.add(f"regionmesh/{module.name}", module.read_bytes(), 0o755)
    for program in programs:
        wheel.add(f"regionmesh/bin/{program.name}", program.read_bytes(), 0o755)
    libraries = _shared_libraries([module, *programs])
    for library, path in sorted(libraries.items()):
        wheel.add(f"regionmesh/lib/{library}", path.read_bytes(), 0o755)
    info = f"regionmesh-{_version()}.dist-info"
    for file, data in _info().items():
        wheel.add(f"{info}/{file}", data)
    for package, data in sorted(_notices(folder, libraries.values()).items()):
        wheel.add(f"{info}/licenses/{package}", data)
    wheel.close(info)
    return name


def build_sdist(sdist_directory, config_settings=None):
    """Pack the sources and return the name of the archive."""
    base = f"regionmesh-{_version()}"

    def is_source(info):
        return None if "__pycache__" in info.name else info

    with tarfile.open(Path(sdist_directory) / f"{base}.tar.gz", "w:gz", format=tarfile.PAX_FORMAT) as archive:
        for name in _SOURCES:
            archive.add(_ROOT / name, f"{base}/{name}", filter=is_source)
        data = _metadata().encode()
        info = tarfile.TarInfo(f"{base}/PKG-INFO")
        info.size = len(data)
        archive.addfile(info, io.BytesIO(data))
    return f"{base}.tar.gz"
