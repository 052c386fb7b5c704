# Makes tests/data/more: small volumes of 5 x 4 x 3 samples v = x + 5 y + 20 z in formats that need no library.
import pathlib
import struct
import zipfile
import zlib

FOLDER = pathlib.Path(__file__).parent / "more"
SIZE = (5, 4, 3)
V = list(range(60))


def npy(values, shape, descr, code):
    header = f"{{'descr': '{descr}', 'fortran_order': False, 'shape': {shape}, }}"
    header += " " * (117 - len(header)) + "\n"
    return b"\x93NUMPY\x01\x00" + struct.pack("<H", len(header)) + header.encode() + struct.pack(f"<{len(values)}{code}", *values)


def archive(name, compression):
    with zipfile.ZipFile(FOLDER / name, "w", compression) as file:
        file.writestr(zipfile.ZipInfo("labels.npy"), npy(V, (3, 4, 5), "<u2", "H"), compression)


def mrc(name, mode, data, order):
    header = bytearray(1024)
    struct.pack_into(order + "4i", header, 0, *SIZE, mode)
    struct.pack_into(order + "3i3f", header, 28, *SIZE, 10, 8, 12)
    struct.pack_into(order + "3i", header, 64, 1, 2, 3)
    struct.pack_into(order + "i", header, 92, 16)
    struct.pack_into(order + "3f", header, 196, 1, 2, 3)
    header[208:212] = b"MAP "
    (FOLDER / name).write_bytes(bytes(header) + bytes(16) + data)


def vtk(name, kind, data, arrays="SCALARS labels unsigned_short 1\nLOOKUP_TABLE default\n", behind=b""):
    head = f"# vtk DataFile Version 3.0\nlabels\n{kind}\nDATASET STRUCTURED_POINTS\nDIMENSIONS 5 4 3\nORIGIN 1 2 3\nSPACING 2 2 4\nPOINT_DATA 60\n"
    (FOLDER / name).write_bytes((head + arrays).encode() + data + behind)


def amira(name, first, coding, data):
    head = f"""# {first}

define Lattice 5 4 3

Parameters {{
    Materials {{
        Exterior {{
            Id 0
        }}
        Bone {{
            Color 1 0.5 0,
            Id 1
        }}
    }}
    Content "5x4x3 byte, uniform coordinates",
    BoundingBox 1 9 2 8 3 11,
    CoordType "uniform"
}}

Lattice {{ byte Labels }} @1{coding}

# Data section follows
@1
"""
    (FOLDER / name).write_bytes(head.encode() + data + b"\n")


FOLDER.mkdir(exist_ok=True)
archive("stored.npz", zipfile.ZIP_STORED)
archive("deflated.npz", zipfile.ZIP_DEFLATED)
mrc("bytes.mrc", 0, bytes(V), "<")
mrc("big_shorts.mrc", 6, struct.pack(">60H", *V), ">")
mrc("reals.mrc", 2, struct.pack("<60f", *V), "<")
vtk("binary.vtk", "BINARY", struct.pack(">60H", *V))
vtk("text.vtk", "ASCII", " ".join(map(str, V)).encode(), behind=b"\nMETADATA\nINFORMATION 0\n\n")
vtk("field.vtk", "BINARY", struct.pack(">60i", *V), "FIELD FieldData 1\nlabels 1 60 int\n")
amira("raw.am", "AmiraMesh BINARY-LITTLE-ENDIAN 2.1", "", bytes(V))
amira("text.am", "AmiraMesh 3D ASCII 2.0", "", " ".join(map(str, V)).encode())
runs = bytes([3, 7, 1, 9]) + bytes([128 + 56]) + bytes(V[4:])
amira("runs.am", "AmiraMesh BINARY-LITTLE-ENDIAN 2.1", f"(HxByteRLE,{len(runs)})", runs)
packed = zlib.compress(bytes(V))
amira("zip.am", "AmiraMesh BINARY-LITTLE-ENDIAN 2.1", f"(HxZip,{len(packed)})", packed)


def tesr(name, form, data):
    head = "***tesr\n **format\n   2.1\n **general\n   3\n   5 4 3\n   0.5 0.25 2\n   *origin\n   1 2 3\n **cell\n   59\n **data\n   "
    (FOLDER / name).write_bytes(head.encode() + form.encode() + b"\n" + data + b"\n***end\n")


tesr("ascii.tesr", "ascii", " ".join(map(str, V)).encode())
tesr("short.tesr", "binary16_big", struct.pack(">60h", *V))
