#!/usr/bin/python3
"""Writes the label volumes beside this file that the readers are tested on, with programs other than ours.

Debian: python3-numpy python3-nibabel python3-pil python3-tifffile. Sample (x, y, z) of the 5 x 4 x 3 volumes is
v = x + 5 y + 20 z, or what each line below makes of it; the tests know the same rules.
"""
import os
import struct
import zlib

import nibabel
import numpy
import tifffile
from PIL import Image

HERE = os.path.dirname(os.path.abspath(__file__))
V = numpy.arange(60, dtype=numpy.int64).reshape(3, 4, 5)  # [z][y][x]
NAMES = ["s1", "s2", "s10"]


def place(*parts):
    path = os.path.join(HERE, *parts)
    os.makedirs(os.path.dirname(path), exist_ok=True)
    return path


def samples(dtype):
    dtype = numpy.dtype(dtype)
    if dtype.kind == "b":
        return V % 3 == 0
    if dtype.kind == "i":
        return (V - 30).astype(dtype)
    if dtype == numpy.uint64:
        return V.astype(dtype) + numpy.uint64(2**63)
    return V.astype(dtype)


def npy():
    for name in "bool int8 uint8 int16 uint16 int32 uint32 int64 uint64".split():
        numpy.save(place("npy", f"{name}.npy"), samples(name))
    numpy.save(place("npy", "big_int32.npy"), samples("int32").astype(">i4"))
    numpy.save(place("npy", "big_fortran_uint64.npy"), numpy.asfortranarray(samples("uint64").astype(">u8")))
    numpy.save(place("npy", "fortran_uint16.npy"), numpy.asfortranarray(samples("uint16")))
    for version in (2, 3):
        with open(place("npy", f"version{version}_uint8.npy"), "wb") as file:
            numpy.lib.format.write_array(file, samples("uint8"), version=(version, 0))
    numpy.save(place("npy", "bad", "float32.npy"), V.astype("float32"))
    numpy.save(place("npy", "bad", "complex64.npy"), V.astype("complex64"))
    numpy.save(place("npy", "bad", "structured.npy"), numpy.zeros((3, 4, 5), [("a", "i4"), ("b", "i2")]))
    numpy.save(place("npy", "bad", "text.npy"), V.astype("U2"))
    numpy.save(place("npy", "bad", "one_axis.npy"), V[0, 0])
    numpy.save(place("npy", "bad", "four_axes.npy"), V.reshape(3, 2, 2, 5))
    numpy.save(place("npy", "bad", "empty.npy"), V[:, :0])
    numpy.save(place("npy", "one_section_uint8.npy"), samples("uint8")[0])


def nifti():
    turn = nibabel.eulerangles.euler2mat(0.3, -0.2, 0.5)
    sheared = numpy.array([[-2, 0.25, 0, 90], [0.5, 0.5, 0, -126], [0, 0, 3, -72], [0, 0, 0, 1]])
    oblique = numpy.eye(4)
    oblique[:3, :3] = turn @ numpy.diag([0.5, 1.25, -3])
    oblique[:3, 3] = [10, -20, 30]
    affines = {}

    def write(name, dtype, affine, code="sform", kind=nibabel.Nifti1Image, array=None, **header):
        data = (samples(dtype) if array is None else array).transpose().astype(dtype)
        image = kind(data, None if affine is None else affine, dtype=dtype) if dtype.endswith("64") else kind(data, affine)
        image.header.set_xyzt_units("micron")
        if affine is not None:
            image.set_sform(affine, 2 if code == "sform" else 0)
            if code == "qform":
                image.set_qform(affine, 1)
            else:
                image.set_qform(numpy.eye(4), 1)  # not to be used: the sform comes first
        else:
            image.header.set_zooms((0.5, 0.75, 2) + (1,) * (data.ndim - 3))
            image.header["qform_code"] = image.header["sform_code"] = 0
        for key, value in header.items():
            image.header[key] = value
        nibabel.save(image, place("nifti", name))
        if affine is not None and "bad" not in name:
            affines[name] = nibabel.load(place("nifti", name)).affine

    write("sform_uint8.nii", "uint8", sheared)
    write("sform_uint8.nii.gz", "uint8", sheared)
    write("qform_int16.nii", "int16", oblique, "qform")
    write("qform_int16.nii.gz", "int16", oblique, "qform")
    write("zooms_uint16.nii", "uint16", None)
    write("half_turn_int8.nii.gz", "int8", numpy.diag([-1.0, -1, 2, 1]), "qform")
    write("version2_int64.nii.gz", "int64", sheared, kind=nibabel.Nifti2Image)
    write("version2_uint64.nii", "uint64", oblique, "qform", kind=nibabel.Nifti2Image)
    write("one_volume_uint32.nii", "uint32", None, array=samples("uint32")[None])
    write("bad/two_volumes.nii", "uint8", None, array=numpy.stack([V, V]))
    write("bad/float32.nii", "float32", sheared)
    write("bad/float64.nii.gz", "float64", sheared)
    write("bad/complex64.nii", "complex64", None)
    for suffix, order in (("1", nibabel.Nifti1Header), ("2", nibabel.Nifti2Header)):
        big = order(endianness=">")
        big.set_data_dtype(">i4")
        image = (nibabel.Nifti1Image if suffix == "1" else nibabel.Nifti2Image)(samples("int32").transpose(), sheared, big)
        nibabel.save(image, place("nifti", f"big_endian{suffix}_int32.nii"))
        affines[f"big_endian{suffix}_int32.nii"] = sheared
    image = nibabel.Nifti1Image(samples("uint8").transpose(), sheared)
    image.header.extensions.append(nibabel.nifti1.Nifti1Extension("comment", b"samples begin after this"))
    nibabel.save(image, place("nifti", "extension_uint8.nii.gz"))
    affines["extension_uint8.nii.gz"] = sheared
    with open(place("nifti", "affines.txt"), "w") as file:
        for name in sorted(affines):
            print(name, *(repr(float(a)) for a in affines[name][:3].ravel()), file=file)


def png_chunk(kind, data):
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))


def write_png(path, pixels, bits, colour_type, is_interlaced=False):
    """For what PIL cannot write: 16 bits in colour, and interlaced images. pixels[y][x][channel]."""
    passes = [(0, 0, 1, 1)]
    if is_interlaced:
        passes = [(0, 0, 8, 8), (4, 0, 8, 8), (0, 4, 4, 8), (2, 0, 4, 4), (0, 2, 2, 4), (1, 0, 2, 2), (0, 1, 1, 2)]
    data = b""
    for x, y, step_x, step_y in passes:
        part = pixels[y::step_y, x::step_x].astype(">u2" if bits == 16 else "u1")
        if part.size:
            data += b"".join(b"\0" + row.tobytes() for row in part)
    header = struct.pack(">IIBBBBB", pixels.shape[1], pixels.shape[0], bits, colour_type, 0, 0, int(is_interlaced))
    with open(path, "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n" + png_chunk(b"IHDR", header) + png_chunk(b"IDAT", zlib.compress(data)) + png_chunk(b"IEND", b""))


def channels(z, count, scale=1):
    v = V[z] * scale
    top = 256 * scale - scale
    return numpy.stack([v, 2 * v, top - v, top - 3 * v], axis=-1)[..., :count]


def png():
    for z, name in enumerate(NAMES):
        def path(kind):
            return place("png", kind, name + ".png")
        Image.fromarray(V[z].astype("uint8")).save(path("gray8"))
        Image.fromarray(V[z] % 3 == 0).save(path("gray1"))
        Image.fromarray((V[z] * 1000).astype("uint16")).save(path("gray16"))
        for bits in (2, 8):
            image = Image.fromarray((V[z] % 4).astype("uint8"), mode="P")
            image.putpalette([200, 0, 0, 150, 9, 9, 100, 7, 7, 50, 3, 3])
            image.save(path(f"palette{bits}"), bits=bits, transparency=1)
        Image.fromarray(channels(z, 3).astype("uint8")).save(path("rgb8"))
        Image.fromarray(channels(z, 4).astype("uint8")).save(path("rgba8"))
        Image.fromarray(channels(z, 2).astype("uint8"), mode="LA").save(path("gray_alpha8"))
        write_png(path("rgb16"), channels(z, 3, 256), 16, 2)
        write_png(path("rgba16"), channels(z, 4, 256), 16, 6)
        write_png(path("interlaced_rgb8"), channels(z, 3), 8, 2, is_interlaced=True)


def tiff():
    pages = [Image.fromarray(page.astype("uint8")) for page in V]
    for name, compression in dict(plain="raw", lzw="tiff_lzw", deflate="tiff_adobe_deflate", packbits="packbits").items():
        pages[0].save(place("tiff", f"{name}_uint8.tif"), save_all=True, append_images=pages[1:], compression=compression)
    bits = [Image.fromarray(page % 3 == 0) for page in V]
    bits[0].save(place("tiff", "group4_bool.tif"), save_all=True, append_images=bits[1:], compression="group4")

    def write(name, array, **options):
        tifffile.imwrite(place("tiff", name), array, metadata=None, **options)

    for name in "int8 uint16 int16 int32 uint32 int64 uint64".split():
        write(f"plain_{name}.tif", samples(name), photometric="minisblack")
    write("big_endian_int16.tif", samples("int16"), byteorder=">", photometric="minisblack")
    write("bigtiff_uint16.tif", samples("uint16"), bigtiff=True, photometric="minisblack")
    write("white_is_zero_uint8.tif", samples("uint8"), photometric="miniswhite")
    write("strips_uint16.tif", samples("uint16"), rowsperstrip=3, photometric="minisblack")
    rgb = numpy.stack([channels(z, 3) for z in range(3)]).astype("uint8")
    write("beside_rgb8.tif", rgb, photometric="rgb")
    write("planes_rgb8.tif", numpy.moveaxis(rgb, -1, 1), photometric="rgb", planarconfig="separate")
    wide = numpy.add.outer(numpy.arange(3) * 1000, numpy.add.outer(numpy.arange(35) * 20, numpy.arange(20))).astype("uint16")
    write("tiles_uint16.tif", wide, tile=(16, 16), photometric="minisblack", compression="zlib")
    write("bad/float32.tif", V.astype("float32"), photometric="minisblack")
    tifffile.imwrite(place("tiff", "imagej_uint16.tif"), samples("uint16"), imagej=True, truncate=True, resolution=(4, 2),
                     metadata={"axes": "ZYX", "spacing": 3.5, "unit": "um"})
    tifffile.imwrite(place("tiff", "imagej_pages_uint8.tif"), samples("uint8"), imagej=True, metadata={"axes": "ZYX"})
    tifffile.imwrite(place("tiff", "bad", "imagej_channels.tif"), samples("uint8"), imagej=True, truncate=True, metadata={"axes": "CYX"})
    with tifffile.TiffWriter(place("tiff", "preview_uint8.tif")) as file:
        for z in range(3):
            file.write(samples("uint8")[z], photometric="minisblack", metadata=None)
            file.write(samples("uint8")[z, :2, :2], photometric="minisblack", metadata=None, subfiletype=1)
    with tifffile.TiffWriter(place("tiff", "bad", "page_sizes.tif")) as file:
        file.write(samples("uint8")[0], photometric="minisblack", metadata=None)
        file.write(samples("uint8")[1, :3], photometric="minisblack", metadata=None)
    for z, name in enumerate(NAMES):
        tifffile.imwrite(place("tiff", "sections", name + ".tif"), samples("uint16")[z], metadata=None, photometric="minisblack")
        image = Image.fromarray((V[z] % 4).astype("uint8"), mode="P")
        image.putpalette([200, 0, 0, 150, 9, 9, 100, 7, 7, 50, 3, 3])
        image.save(place("tiff", "palette8", name + ".tif"))


if __name__ == "__main__":
    npy()
    nifti()
    png()
    tiff()
