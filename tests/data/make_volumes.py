#!/usr/bin/python3
"""Writes the NRRD, MetaImage, VTK, INR and MGH volumes beside this file that the readers are tested on.

Debian: python3-numpy python3-vtk9 teem-apps plastimatch. NRRDs are written by teem's unu, MetaImages by VTK and, through
plastimatch, by ITK, image data by VTK; INR and MGH files, for which no such program is packaged, and files that only their
formats' pages describe are made by hand. Samples are those of make_data.py: v = x + 5 y + 20 z.
"""
import gzip
import itertools
import os
import shutil
import struct
import subprocess
import tempfile
import zlib

import numpy
import vtk
from vtk.util import numpy_support

from make_data import V, place, samples

TYPES = "int8 uint8 int16 uint16 int32 uint32 int64 uint64".split()
OBLIQUE = numpy.array([[0.6, -0.8, 0], [0.8, 0.6, 0], [0, 0, -1]])  # columns are the directions of x, y, z
SPACING = numpy.array([0.5, 0.75, 2])
ORIGIN = numpy.array([10, -20, 30])


def run(*words, **options):
    subprocess.run(words, check=True, stdout=subprocess.DEVNULL, **options)


def write_bytes(path, data):
    with open(path, "wb") as file:
        file.write(data)


def vectors(columns):
    return [f"({','.join(repr(float(a)) for a in column)})" for column in columns]


def nrrd():
    scratch = tempfile.mkdtemp()

    def make(name, array, encoding="raw", endian="little", **more):
        """A header of unu's for the array, then saved by unu as asked."""
        data = os.path.join(scratch, "data")
        write_bytes(data, array.astype(array.dtype.newbyteorder("<")).tobytes())
        words = ["teem-unu", "make", "-i", data, "-t", array.dtype.name.removesuffix("32") if array.dtype.kind == "f" else array.dtype.name, "-e", "raw", "-en", "little",
                 "-s", *map(str, reversed(array.shape)), "-o", os.path.join(scratch, "made.nrrd")]
        for flag, values in more.items():
            words += ["-" + flag] + ([values] if isinstance(values, str) else list(values))
        run(*words)
        run("teem-unu", "save", "-f", "nrrd", "-e", encoding, "-en", endian,
            "-i", os.path.join(scratch, "made.nrrd"), "-o", place("nrrd", name))

    for name in TYPES:
        make(f"raw_{name}.nrrd", samples(name))
    for name in ("int16", "uint32", "uint64"):
        make(f"big_{name}.nrrd", samples(name), endian="big")
        make(f"big_gzip_{name}.nrrd", samples(name), "gzip", "big")
        make(f"ascii_{name}.nrrd", samples(name), "ascii")
    in_space = {"spc": "LPS", "orig": vectors([ORIGIN])[0]}
    flipped = numpy.diag([-1, -1, 1]) * SPACING
    make("flipped_uint8.nrrd", samples("uint8"), "gzip", dirs=" ".join(vectors(flipped.T)), **in_space)
    make("oblique_uint16.nrrd", samples("uint16"), dirs=" ".join(vectors((OBLIQUE * SPACING).T)), **in_space)
    run("plastimatch", "convert", "--input", place("nrrd", "oblique_uint16.nrrd"), "--output-type", "ushort",
        "--output-img", place("nrrd", "itk_uint16.nrrd"))
    make("spacings_int8.nrrd", samples("int8"), sp=["0.5", "0.75", "2"])
    make("two_axes_uint8.nrrd", samples("uint8")[0], spc="right-up", orig="(1,2)", dirs="(0,2) (-3,0)")
    make("detached_int16.nhdr", samples("int16"))
    make("detached_gzip_uint32.nhdr", samples("uint32"), "gzip")
    layers = numpy.stack([samples("uint8"), 100 + samples("uint8")])
    names = ["Segment0_Name:=low", "Segment0_LabelValue:=1", "Segment0_Layer:=0", "Segment1_Name:=next",
             "Segment1_LabelValue:=2", "Segment1_Layer:=0", "Segment2_Name:=high", "Segment2_LabelValue:=101",
             "Segment2_Layer:=1"]
    directions = vectors(flipped.T)
    make("layers_first_uint8.seg.nrrd", numpy.moveaxis(layers, 0, -1).copy(), "gzip", k="list domain domain domain".split(),
         dirs=" ".join(["none"] + directions), kv=names, **in_space)
    make("layers_raw_uint8.seg.nrrd", numpy.moveaxis(layers, 0, -1).copy(), k="list domain domain domain".split(),
         dirs=" ".join(["none"] + directions), kv=names, **in_space)
    make("layers_last_uint8.nrrd", layers, k="domain domain domain list".split(), dirs=" ".join(directions + ["none"]),
         **in_space)
    make("one_layer_uint8.seg.nrrd", samples("uint8")[..., None], "gzip", k="list domain domain domain".split(),
         dirs=" ".join(["none"] + directions), kv=names[:6], **in_space)
    make("bad/float32.nrrd", samples("float32"))
    make("bad/bzip2.nrrd", samples("uint8"), "bzip2")
    make("bad/hex.nrrd", samples("uint8"), "hex")
    make("bad/time.nrrd", numpy.stack([samples("uint8")] * 2), k="domain domain domain time".split())
    for z in range(3):
        write_bytes(place("nrrd", f"z{z + 8:02}_uint16.raw"), b"line\n??" + samples("uint16")[z].tobytes())
    files = [f"z{z:02}_uint16.raw" for z in (8, 9, 10)]
    for name, inputs in (("list_uint16.nhdr", files), ("pattern_uint16.nhdr", ["z%02d_uint16.raw", "8", "10", "1"])):
        run("teem-unu", "make", "-h", "-i", *inputs, "-t", "uint16", "-s", "5", "4", "3", "-e", "raw", "-en", "little",
            "-ls", "1", "-bs", "2", "-o", name, cwd=place("nrrd", ""))
    head = b"NRRD0001\r\n# by hand\r\ntype: uchar\r\ndimension: 3\r\nsizes: 5 4 3\r\nencoding: gz\r\n"
    data = samples("uint8").tobytes()
    write_bytes(place("nrrd", "hand_skips_uint8.nrrd"),
                head + b"line skip: 2\r\nbyte skip: 7\r\n\r\na\nb\n" + gzip.compress(b"7 bytes" + data, mtime=0))
    write_bytes(place("nrrd", "hand_from_end_uint8.nrrd"),
                head.replace(b"gz", b"raw") + b"byte skip: -1\r\naxis mins: 0 10 nan\r\naxis maxs: 2.5 14 nan\r\n"
                b"centers: cell node ???\r\n\r\nwho knows" + data)
    shutil.rmtree(scratch)


def image(array, name="labels", kind=None):
    made = vtk.vtkImageData()
    made.SetDimensions(*reversed(array.shape))
    made.SetSpacing(*SPACING)
    made.SetOrigin(*ORIGIN)
    scalars = numpy_support.numpy_to_vtk(array.ravel(), deep=True, array_type=kind)
    scalars.SetName(name)
    made.GetPointData().SetScalars(scalars)
    return made


def meta():
    def write(name, array, compressed=False):
        writer = vtk.vtkMetaImageWriter()
        writer.SetFileName(place("meta", name))
        writer.SetInputData(image(array, kind=vtk.VTK_SIGNED_CHAR if array.dtype == "int8" else None))
        writer.SetCompression(compressed)
        writer.Write()
        assert os.path.exists(place("meta", name))

    for name in "int8 uint8 int16 uint16 int32 uint32".split():
        write(f"vtk_{name}.mha", samples(name))
    write("vtk_zlib_uint16.mha", samples("uint16"), compressed=True)
    write("vtk_int16.mhd", samples("int16"))
    write("vtk_zlib_uint32.mhd", samples("uint32"), compressed=True)
    write("bad/float32.mha", samples("float32"))
    # ITK wrote these from what unu wrote: the same places in space.
    run("plastimatch", "convert", "--input", place("nrrd", "oblique_uint16.nrrd"), "--output-type", "ushort",
        "--output-img", place("meta", "itk_oblique_uint16.mha"))
    run("plastimatch", "convert", "--input", place("nrrd", "flipped_uint8.nrrd"), "--output-type", "uchar",
        "--output-img", place("meta", "itk_flipped_uint8.mhd"))

    def by_hand(name, data="", file="LOCAL", **more):
        """`file` may hold lines for more than one."""
        fields = dict(ObjectType="Image", NDims=3, BinaryData=True, BinaryDataByteOrderMSB=False, DimSize="5 4 3",
                      ElementType="MET_UCHAR")
        fields.update(more)
        text = "".join(f"{key} = {value}\n" for key, value in fields.items()) + f"ElementDataFile = {file}\n"
        write_bytes(place("meta", name), text.encode() + (data if isinstance(data, bytes) else data.encode()))

    for name, word in (("int64", "MET_LONG_LONG"), ("uint64", "MET_ULONG_LONG")):
        array = samples(name)
        by_hand(f"hand_{name}.mha", array.tobytes(), ElementType=word)
        by_hand(f"hand_big_gzip_{name}.mha", gzip.compress(array.astype(array.dtype.newbyteorder(">")).tobytes(), mtime=0),
                ElementType=word, BinaryDataByteOrderMSB=True, CompressedData=True)
    by_hand("hand_big_int16.mha", samples("int16").astype(">i2").tobytes(), ElementType="MET_SHORT",
            BinaryDataByteOrderMSB=True)
    by_hand("hand_ascii_int16.mha", " ".join(map(str, samples("int16").ravel())), ElementType="MET_SHORT", BinaryData=False)
    for z in range(3):
        write_bytes(place("meta", f"z{z + 8}_uint8.raw"), b"skipped" + samples("uint8")[z].tobytes())
        write_bytes(place("meta", f"z{z + 8}_uint8.zraw"), zlib.compress(samples("uint8")[z].tobytes()))
    by_hand("hand_pattern_uint8.mhd", file="z%d_uint8.raw 8 10 1", HeaderSize=7)
    by_hand("hand_list_uint8.mhd", file="LIST\nz8_uint8.raw\nz9_uint8.raw\nz10_uint8.raw", HeaderSize=-1)
    by_hand("hand_zlib_list_uint8.mhd", file="LIST 2\nz8_uint8.zraw\nz9_uint8.zraw\nz10_uint8.zraw", CompressedData=True)
    by_hand("hand_one_volume_uint8.mha", samples("uint8").tobytes(), NDims=4, DimSize="5 4 3 1",
            ElementSpacing="0.5 0.75 2 9", Origin="10 -20 30 0")
    by_hand("hand_one_section_uint8.mha", samples("uint8")[0].tobytes(), NDims=2, DimSize="5 4", Rotation="0 1 -1 0")
    by_hand("bad/channels.mha", samples("uint8").tobytes() * 3, ElementNumberOfChannels=3)
    by_hand("bad/two_volumes.mha", samples("uint8").tobytes() * 2, NDims=4, DimSize="5 4 3 2")


def vti():
    def write(name, data, mode="raw", compressed=False, words=64, big_endian=False):
        writer = vtk.vtkXMLImageDataWriter()
        writer.SetFileName(place("vti", f"{name}.vti"))
        writer.SetInputData(data)
        writer.SetDataMode({"ascii": writer.Ascii, "binary": writer.Binary, "raw": writer.Appended,
                            "base64": writer.Appended}[mode])
        writer.SetEncodeAppendedData(mode == "base64")
        writer.SetCompressorType({False: writer.NONE, True: writer.ZLIB, "lz4": writer.LZ4}[compressed])
        writer.SetHeaderType(writer.UInt32 if words == 32 else writer.UInt64)
        writer.SetBlockSize(40)  # several blocks, the last one shorter
        if big_endian:
            writer.SetByteOrderToBigEndian()
        assert writer.Write()

    for mode, compressed, words in itertools.product(("binary", "raw", "base64"), (False, True), (32, 64)):
        write(f"{mode}_{'zlib' if compressed else 'plain'}_{words}_uint8", image(samples("uint8")), mode, compressed, words)
    for name in TYPES:
        data = image(samples(name), kind=vtk.VTK_SIGNED_CHAR if name == "int8" else None)
        write(f"raw_{name}", data)
        write(f"zlib_{name}", data, compressed=True)
        write(f"ascii_{name}", data, "ascii")
        write(f"big_zlib_{name}", data, compressed=True, words=32, big_endian=True)
        write(f"big_raw_{name}", data, big_endian=True)
    turned = image(samples("uint8"))
    turned.SetExtent(-2, 2, 10, 13, 7, 9)
    turned.SetDirectionMatrix(*OBLIQUE.ravel())
    write("turned_uint8", turned)

    def add(where, name, array):
        values = numpy_support.numpy_to_vtk(numpy.ascontiguousarray(array.reshape(-1, *array.shape[3:])), deep=True)
        values.SetName(name)
        where.AddArray(values)

    cells = image(numpy.zeros((4, 5, 6), "float32"), "ct")
    cells.SetDirectionMatrix(*OBLIQUE.ravel())
    add(cells.GetCellData(), "grains", samples("uint16"))
    write("cells_uint16", cells, compressed=True)
    flat = vtk.vtkImageData()
    flat.SetDimensions(6, 5, 1)
    add(flat.GetCellData(), "grains", samples("uint16")[:1])
    write("flat_cells_uint16", flat)
    several = image(samples("float32"), "ct")
    add(several.GetPointData(), "first", samples("uint16"))
    add(several.GetPointData(), "second", samples("uint8"))
    write("bad/several", several)
    several.GetPointData().SetActiveScalars("second")
    write("active_uint8", several)
    reals = image(samples("float32"), "ct")
    add(reals.GetPointData(), "colours", numpy.stack([samples("uint8")] * 3, axis=-1))
    write("bad/float32", reals)
    write("bad/lz4", image(samples("uint8")), compressed="lz4")


def inr():
    def write(name, array, kind, cpu="decm", extra="", packed=False):
        z, y, x = array.shape
        text = (f"#INRIMAGE-4#{{\nXDIM={x}\nYDIM={y}\nZDIM={z}\nVDIM=1\nTYPE={kind}\nPIXSIZE={8 * array.itemsize} bits\n"
                f"CPU={cpu}\nVX=0.5\nVY=0.75\nVZ=2\n{extra}")
        head = text.ljust(252, "\n") + "##}\n"
        assert len(head) == 256
        data = array.astype(array.dtype.newbyteorder(">" if cpu in ("sun", "sgi") else "<")).tobytes()
        whole = head.encode() + data
        write_bytes(place("inr", name), gzip.compress(whole, mtime=0) if packed else whole)

    for name in TYPES:
        kind = "unsigned fixed" if name[0] == "u" else "signed fixed"
        write(f"{name}.inr", samples(name), kind)
        write(f"big_{name}.inr.gz", samples(name), kind, "sun", packed=True)
    write("placed_uint8.inr", samples("uint8"), "unsigned fixed", "pc", "SCALE=2**0\nTX=10\nTY=-20\nTZ=30\n#GEOMETRY=CARTESIAN\n")
    write("bad/float32.inr", samples("float32"), "float")
    write("bad/turned.inr", samples("uint8"), "unsigned fixed", extra="RX=0.5\n")
    write("bad/scaled.inr", samples("uint8"), "unsigned fixed", extra="SCALE=2**-3\n")


def mgh():
    """By the format's page; nibabel reads the same samples, and the same places where the header has one."""
    codes = {"uint8": 0, "int32": 1, "float32": 3, "int16": 4, "uint16": 10}

    def write(name, array, directions=None, frames=1):
        z, y, x = array.shape
        head = struct.pack(">7i", 1, x, y, z, frames, codes[array.dtype.name], 0)
        if directions is None:
            head += struct.pack(">h15f", 0, *[0] * 15)
        else:
            centre = ORIGIN + (directions * SPACING) @ (numpy.array([x, y, z]) / 2)
            head += struct.pack(">h15f", 1, *SPACING, *directions.T.ravel(), *centre)
        whole = head.ljust(284, b"\0") + array.astype(array.dtype.newbyteorder(">")).tobytes() * frames
        write_bytes(place("mgh", name), gzip.compress(whole, mtime=0) if name.endswith("z") else whole)

    turned = numpy.array([[-1, 0, 0], [0, 0, 1], [0, -1, 0]])
    for name in ("uint8", "int16", "uint16", "int32"):
        write(f"{name}.mgh", samples(name))
        write(f"turned_{name}.mgz", samples(name), turned)
    write("bad/float32.mgz", samples("float32"), turned)
    write("bad/frames.mgz", samples("uint8"), turned, 2)


if __name__ == "__main__":
    nrrd()
    meta()
    vti()
    inr()
    mgh()
