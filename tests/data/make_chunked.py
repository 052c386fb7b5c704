#!/usr/bin/python3
"""Writes the HDF5, DREAM.3D, Zarr and N5 volumes beside this file that the readers are tested on.

Debian: python3-numpy python3-h5py python3-zarr python3-numcodecs python3-lz4. Samples are those of make_data.py. h5py
and zarr-python (2.13: Zarr version 2 and N5) write what they can. Zarr version 3, OME-Zarr, the blocks of lz4-java and
short N5 blocks are put together here after the specifications, with compressors of numcodecs; DREAM.3D files likewise,
after real ones (version 7) and the DREAM3D-NX file specification (version 8).
"""
import itertools
import json
import os
import shutil
import struct

import h5py
import lz4.block
import numcodecs
import numpy
import zarr

from make_data import HERE, V, samples

TYPES = "bool int8 uint8 int16 uint16 int32 uint32 int64 uint64".split()
ROOT = os.path.join(HERE, "chunked")


def place(*parts):
    path = os.path.join(ROOT, *parts)
    os.makedirs(os.path.dirname(path), exist_ok=True)
    return path


def hdf5():
    with h5py.File(place("types.h5"), "w") as file:
        for name in TYPES:
            file[f"contiguous/{name}"] = samples(name)
            big = numpy.dtype(name).newbyteorder(">")
            file.create_dataset(f"big/gzip_{name}", data=samples(name).astype(big), chunks=(2, 3, 4), compression="gzip")
        file["contiguous"].attrs["note"] = "x" * 100
        options = dict(shape=V.shape, chunks=(2, 3, 4), dtype="u2")
        for name, extra in dict(plain={}, shuffle=dict(shuffle=True, compression="gzip"), sums=dict(fletcher32=True),
                                offset=dict(scaleoffset=True), deep=dict(chunks=(3, 4, 5))).items():
            file.create_dataset(f"packed/{name}_uint16", data=V, **{**options, **extra})
        file.create_dataset("missing", shape=V.shape, chunks=(2, 3, 4), dtype="i4", fillvalue=7)[0, 0] = 9
        file.create_dataset("lzf", data=V.astype("u2"), compression="lzf", chunks=(2, 3, 4))
        file.create_dataset("enum", data=V % 3, dtype=h5py.enum_dtype({"a": 0, "b": 1, "c": 2}, basetype="u1"))
        file["floats"] = V.astype("f4")
        file["words"] = numpy.array([["a", "b"], ["c", "d"]], dtype="S1")
        file["records"] = numpy.zeros((3, 4, 5), [("a", "i4"), ("b", "i2")])
        file["four"] = numpy.zeros((2, 3, 4, 5), "u1")
        file["line"] = numpy.arange(5)
        file["empty"] = numpy.zeros((3, 0, 5), "u1")
        space = h5py.h5s.create_simple(V.shape)
        narrow = h5py.h5t.STD_I32LE.copy()
        narrow.set_size(3)  # 24 bits
        for name, kind, data in (("int24", narrow, V - 30), ("bits", h5py.h5t.STD_B16LE, V)):
            at = h5py.h5d.create(file.id, name.encode(), kind, space)
            memory = h5py.h5t.NATIVE_INT32 if name == "int24" else h5py.h5t.NATIVE_B64
            at.write(h5py.h5s.ALL, h5py.h5s.ALL, data.astype("i4" if name == "int24" else "i8"), mtype=memory)
        file["soft"] = h5py.SoftLink("/contiguous/uint16")
    with h5py.File(place("one.h5"), "w", userblock_size=512) as file:
        data = file.create_dataset("exported_data", data=samples("uint16").transpose()[..., None], chunks=(5, 4, 3, 1))
        data.attrs["axistags"] = json.dumps({"axes": [{"key": key, "typeFlags": 2} for key in "xyzc"]})
        file["prediction"] = V.astype("f4")
        file["ids"] = numpy.arange(9)
    with h5py.File(place("spaced.h5"), "w") as file:
        for name, spacing in dict(element_size_um=[5.0, 2.0, 0.5], resolution=[5, 2, 0.5], voxel_size=[5, -2, 0.5],
                                  spacing=[0.0, 1.0, 1.0]).items():
            file[name] = samples("uint8")
            file[name].attrs[name] = spacing
        file["element_size_um"].attrs["resolution"] = [9, 9, 9]
        file["resolution"].attrs["offset"] = [30.0, 20.0, 10.0]
        file["beside"] = samples("uint8")
        file["beside"].attrs["spacing"] = [1.0, 2.0]
        file["two"] = samples("uint8")[0]
        file["LabDCT/Spacing"] = numpy.array([0.25, 0.5, 0.75])
        file["LabDCT/Data/GrainId"] = samples("int64")
    with h5py.File(place("virtual.h5"), "w") as file:
        file["part"] = samples("uint16")
        file["away"] = h5py.ExternalLink("other.h5", "/part")
        for name, source, part in (("inside", ".", "part"), ("elsewhere", "other.h5", "part"),
                                   ("chained", ".", "elsewhere"), ("linked", ".", "away"), ("itself", ".", "itself")):
            layout = h5py.VirtualLayout(V.shape, "u2")
            layout[...] = h5py.VirtualSource(source, part, shape=V.shape)
            file.create_virtual_dataset(name, layout)
    with h5py.File(place("channels.h5"), "w") as file:
        for name, axes in dict(one="czyx", two="tczyx").items():
            stack = numpy.stack([V, V + 100])
            file[name] = (stack if name == "one" else numpy.stack([stack, stack])).astype("u1")
            file[name].attrs["axistags"] = json.dumps({"axes": [{"key": key} for key in axes]})


def dream3d_7(file, name, array, ids):
    group = file.create_group(f"DataContainers/{name}")
    for key, numbers in dict(DIMENSIONS=numpy.array([5, 4, 3], "i8"), SPACING=numpy.array([0.5, 1, 2], "f4"),
                             ORIGIN=numpy.array([10, 20, 30], "f4")).items():
        group[f"_SIMPL_GEOMETRY/{key}"] = numbers
    group["CellData/" + array] = ids
    group["CellData/Phases"] = numpy.ones((3, 4, 5, 1), "i4")
    group["CellData/EulerAngles"] = numpy.zeros((3, 4, 5, 3), "f4")
    group["CellFeatureData/Active"] = numpy.ones((60, 1), "u1")
    group["CellFeatureData/FeatureIds"] = numpy.ones((3, 2), "i4")


def dream3d_8(file, name):
    group = file.create_group(f"DataStructure/{name}")
    group.attrs["ObjectType"] = numpy.bytes_("ImageGeom")
    group.attrs["_DIMENSIONS"] = numpy.array([5, 4, 3], "u8")
    group.attrs["_SPACING"] = numpy.array([0.5, 1, 2], "f4")
    group.attrs["_ORIGIN"] = numpy.array([10, 20, 30], "f4")
    ids = group.create_dataset("Cell Data/FeatureIds", data=samples("int32")[..., None])
    ids.attrs["ObjectType"] = numpy.bytes_("DataArray<int32>")
    ids.attrs["TupleDimensions"] = numpy.array([3, 4, 5], "u8")
    ids.attrs["ComponentDimensions"] = numpy.array([1], "u8")
    group["Cell Data"].attrs["ObjectType"] = numpy.bytes_("AttributeMatrix")
    group["Cell Data/Mask"] = (V % 3 == 0)[..., None].astype("u1")
    file["DataStructure/Triangles/SharedTriangleList"] = numpy.zeros((6, 3), "u8")


def dream3d():
    with h5py.File(place("version7.dream3d"), "w") as file:
        file.attrs["FileVersion"] = numpy.bytes_("7.0")
        dream3d_7(file, "Image", "FeatureIds", samples("int32")[..., None])
    with h5py.File(place("flat.dream3d"), "w") as file:
        dream3d_7(file, "Image", "GrainIds", samples("int32").ravel())
        file["DataContainers/Image/CellData/Wrong"] = numpy.zeros((5, 4, 3), "i4")
    with h5py.File(place("version8.dream3d"), "w") as file:
        file.attrs["FileVersion"] = numpy.bytes_("8.0")
        dream3d_8(file, "Image Geometry")
    with h5py.File(place("two.dream3d"), "w") as file:
        dream3d_7(file, "First", "FeatureIds", samples("int32")[..., None])
        dream3d_7(file, "Second", "FeatureIds", samples("int32")[..., None] + 100)


def zarr_2():
    def write(name, data, **options):
        array = zarr.open(place("zarr2", name + ".zarr"), mode="w", shape=data.shape, dtype=data.dtype,
                          **{"chunks": (2, 3, 5), **options})
        array[:] = data
        return array

    for name in TYPES:
        write(f"type_{name}", samples(name), chunks=(2, 4, 5))
        big = samples(name).astype(numpy.dtype(name).newbyteorder(">"))
        write(f"big_order_f_{name}", big, order="F", chunks=(3, 4, 5))
    packed = dict(none=None, zlib=numcodecs.Zlib(), gzip=numcodecs.GZip(), zstd=numcodecs.Zstd(), lz4=numcodecs.LZ4())
    for inner in numcodecs.blosc.list_compressors():
        for shuffle in (0, 1, 2):
            packed[f"blosc_{inner}_{shuffle}"] = numcodecs.Blosc(inner, shuffle=shuffle)
    for name, compressor in packed.items():
        write(f"packed_{name}_uint16", samples("uint16"), chunks=(2, 4, 5), compressor=compressor)
    write("ragged_uint16", samples("uint16"))
    write("slash_uint16", samples("uint16"), chunks=(2, 3, 4), dimension_separator="/")
    missing = zarr.open(place("zarr2", "bad", "missing_int16.zarr"), mode="w", shape=(3, 4, 5), chunks=(2, 2, 2),
                        dtype=">i2", fill_value=-7)
    missing[0, 0, 0] = 5
    write("bad/float32", V.astype("f4"))
    write("bad/delta", samples("uint16"), filters=[numcodecs.Delta(dtype="u2")])
    write("bad/bz2", samples("uint16"), compressor=numcodecs.BZ2())
    write("bad/plain_uint16", samples("uint16"), compressor=None)
    group = zarr.open_group(place("zarr2", "bad", "several.zarr"), mode="w")
    for name in ("a", "b/c"):
        group.create_dataset(name, data=samples("uint16"), chunks=(3, 4, 5))
    group.create_dataset("line", data=numpy.arange(5))
    group.create_dataset("real", data=V.astype("f4"), chunks=(3, 4, 5))
    spaced = write("spaced_uint8", samples("uint8"), chunks=(3, 4, 5))
    spaced.attrs.update(resolution=[5, 2, 0.5], offset=[30, 20, 10])


def crc32c(data):
    rest = 0xFFFFFFFF
    for byte in data:
        rest ^= byte
        for _ in range(8):
            rest = rest >> 1 ^ (0x82F63B78 if rest & 1 else 0)
    return struct.pack("<I", rest ^ 0xFFFFFFFF)


PACK = dict(gzip=numcodecs.GZip(), zstd=numcodecs.Zstd(), blosc=numcodecs.Blosc("zstd", shuffle=1), crc32c=None)


def codec(name, **configuration):
    return {"name": name, "configuration": configuration}


def encode(chunk, codecs):
    """The bytes of a chunk of samples, after version 3."""
    for step in codecs:
        name, options = step["name"], step.get("configuration", {})
        if name == "transpose":
            chunk = chunk.transpose(options["order"])
        elif name == "bytes":
            order = ">" if options.get("endian") == "big" else "<"
            chunk = numpy.ascontiguousarray(chunk).astype(chunk.dtype.newbyteorder(order)).tobytes()
        elif name == "sharding_indexed":
            chunk = encode_shard(chunk, options)
        elif name == "crc32c":
            chunk += crc32c(chunk)
        else:
            chunk = bytes(PACK[name].encode(chunk))
    return chunk


def encode_shard(shard, options, missing=(1,)):
    """Chunks back to front, so that their order is not that of the index; one of them is left out."""
    inner = options["chunk_shape"]
    grid = [range(size // part) for size, part in zip(shard.shape, inner)]
    cells = list(itertools.product(*grid))
    index_bytes = 16 * len(cells) + (4 if len(options["index_codecs"]) > 1 else 0)
    is_first = options.get("index_location") == "start"
    data, places = b"", {}
    for number, cell in reversed(list(enumerate(cells))):
        if number in missing:
            places[number] = (2**64 - 1, 2**64 - 1)
            continue
        part = shard[tuple(slice(i * size, (i + 1) * size) for i, size in zip(cell, inner))]
        chunk = encode(part, options["codecs"])
        places[number] = (len(data) + (index_bytes if is_first else 0), len(chunk))
        data += chunk
    index = b"".join(struct.pack("<QQ", *places[number]) for number in range(len(cells)))
    if len(options["index_codecs"]) > 1:
        index += crc32c(index)
    return index + data if is_first else data + index


def write_zarr_3(path, data, chunks, codecs, fill=0, names=None, **more):
    names = names or codec("default", separator="/")
    shutil.rmtree(path, ignore_errors=True)
    os.makedirs(path)
    metadata = {"zarr_format": 3, "node_type": "array", "shape": data.shape, "data_type": data.dtype.name,
                "chunk_grid": codec("regular", chunk_shape=chunks), "chunk_key_encoding": names, "fill_value": fill,
                "codecs": codecs, **more}
    with open(os.path.join(path, "zarr.json"), "w") as file:
        json.dump(metadata, file, indent=1)
    separator = names["configuration"]["separator"]
    prefix = "c" + separator if names["name"] == "default" else ""
    for cell in itertools.product(*(range(-(-size // part)) for size, part in zip(data.shape, chunks))):
        chunk = numpy.full(chunks, fill, data.dtype)
        part = data[tuple(slice(i * size, (i + 1) * size) for i, size in zip(cell, chunks))]
        chunk[tuple(slice(0, size) for size in part.shape)] = part
        file = os.path.join(path, prefix + separator.join(map(str, cell)))
        os.makedirs(os.path.dirname(file), exist_ok=True)
        with open(file, "wb") as out:
            out.write(encode(chunk, codecs))


def zarr_3():
    little, big = codec("bytes", endian="little"), codec("bytes", endian="big")
    for name in TYPES:
        write_zarr_3(place("zarr3", f"type_{name}.zarr"), samples(name), (2, 4, 5), [little], fill=name == "bool" or 0)
    chains = dict(big=[big], gzip=[little, codec("gzip", level=5)], zstd=[little, codec("zstd", level=0, checksum=False)],
                  blosc=[little, codec("blosc", cname="zstd", clevel=5, shuffle="shuffle", typesize=2, blocksize=0)],
                  sums=[little, {"name": "crc32c"}, codec("zstd", level=0), {"name": "crc32c"}],
                  transpose=[codec("transpose", order=[2, 0, 1]), little],
                  twice=[codec("transpose", order=[2, 0, 1]), codec("transpose", order=[0, 2, 1]), big])
    for name, chain in chains.items():
        write_zarr_3(place("zarr3", f"{name}_uint16.zarr"), samples("uint16"), (2, 3, 4), chain)
    write_zarr_3(place("zarr3", "names_v2_uint16.zarr"), samples("uint16"), (2, 4, 5), [little],
                 names=codec("v2", separator="."))
    write_zarr_3(place("zarr3", "names_dot_uint16.zarr"), samples("uint16"), (2, 4, 5), [little],
                 names=codec("default", separator="."), dimension_names=["z", "y", "x"])
    for name, where, inner in (("shard_end", "end", [big, codec("zstd", level=0)]),
                               ("shard_start", "start", [codec("transpose", order=[1, 2, 0]), little, {"name": "crc32c"}])):
        sharding = codec("sharding_indexed", chunk_shape=[2, 2, 3], codecs=inner, index_location=where,
                         index_codecs=[little, {"name": "crc32c"}])
        write_zarr_3(place("zarr3", "bad", f"{name}_uint16.zarr"), samples("uint16"), (2, 4, 6), [sharding], fill=500)
    write_zarr_3(place("zarr3", "bad", "float32.zarr"), V.astype("f4"), (2, 4, 5), [little])


def image(path, version, shape_axes, levels, labels=None, scale=(5.0, 2.0, 0.5), translation=(30.0, 20.0, 10.0)):
    """An OME-Zarr image: `levels` of arrays with the axes of shape_axes, the coarser ones half as fine."""
    shutil.rmtree(path, ignore_errors=True)
    os.makedirs(path)
    extra = len(shape_axes) - 3
    datasets = []
    for number, data in enumerate(levels):
        steps = [{"type": "scale", "scale": [1.0] * extra + [s * 2**number for s in scale]}]
        steps.append({"type": "translation", "translation": [0.0] * extra + list(translation)})
        datasets.append({"path": str(number), "coordinateTransformations": steps})
    kinds = {"t": "time", "c": "channel"}
    axes = [{"name": name, "type": kinds.get(name, "space")} for name in shape_axes]
    attributes = {"multiscales": [{"axes": axes, "datasets": datasets, "name": "image", "version": version}]}
    if labels:
        attributes["image-label"] = labels
    for number, data in enumerate(levels):
        where = os.path.join(path, str(number))
        chunks = (1,) * extra + (2, 4, 5)
        if version == "0.4":
            store = zarr.NestedDirectoryStore(where)
            array = zarr.open(store, mode="w", shape=data.shape, chunks=chunks, dtype=data.dtype, dimension_separator="/")
            array[:] = data
        else:
            write_zarr_3(where, data, chunks, [codec("bytes", endian="little"), codec("zstd", level=0)],
                         dimension_names=list(shape_axes))
    if version == "0.4":
        files = {".zgroup": {"zarr_format": 2}, ".zattrs": attributes}
    else:
        files = {"zarr.json": {"zarr_format": 3, "node_type": "group", "attributes": {"ome": attributes}}}
    for name, text in files.items():
        with open(os.path.join(path, name), "w") as file:
            json.dump(text, file, indent=1)


def ome():
    labels = {"colors": [{"label-value": 1, "rgba": [255, 0, 0, 255]}],
              "properties": [{"label-value": 1, "name": "nucleus"}, {"label-value": 2, "class": "membrane", "area": 3},
                             {"label-value": 3, "area": 4}]}
    for version in ("0.4", "0.5"):
        root = place("ome", f"image_{version.replace('.', '')}.zarr")
        fine, coarse = samples("uint16")[None, None], samples("uint16")[None, None, ::2, ::2, ::2]
        image(root, version, "tczyx", [fine, coarse])
        image(os.path.join(root, "labels", "cells"), version, "zyx", [samples("uint16")], labels)
    two = numpy.stack([V, V + 100]).astype("u1")
    image(place("ome", "channels.zarr"), "0.4", "czyx", [two])
    image(place("ome", "times.zarr"), "0.4", "tczyx", [numpy.stack([two, two])])
    image(place("ome", "flipped.zarr"), "0.4", "zyx", [samples("uint8")], scale=(5.0, -2.0, 0.5))


def write_n5_block(path, block, compress, mode=0):
    """`block` as numpy has it, [z][y][x]; sizes are written fastest first."""
    os.makedirs(os.path.dirname(path), exist_ok=True)
    head = struct.pack(">HH", mode, block.ndim) + struct.pack(f">{block.ndim}I", *reversed(block.shape))
    if mode == 1:
        head += struct.pack(">I", block.size)
    with open(path, "wb") as file:
        file.write(head + compress(block.astype(block.dtype.newbyteorder(">")).tobytes()))


def lz4_java(data, block=16):
    """Blocks of lz4-java's LZ4BlockOutputStream; every other one is stored. Check sums are left at 0."""
    out = b""
    for number, start in enumerate(range(0, len(data), block)):
        part = data[start:start + block]
        packed = part if number % 2 else lz4.block.compress(part, store_size=False)
        out += b"LZ4Block" + struct.pack("<BIII", 0x10 if number % 2 else 0x20, len(packed), len(part), 0) + packed
    return out + b"LZ4Block" + struct.pack("<BIII", 0x10, 0, 0, 0)


def write_n5(path, data, block, compression, compress, mode=0, **attributes):
    shutil.rmtree(path, ignore_errors=True)
    os.makedirs(path)
    with open(os.path.join(path, "attributes.json"), "w") as file:
        json.dump({"dimensions": data.shape[::-1], "blockSize": block[::-1], "dataType": data.dtype.name,
                   "compression": compression, **attributes}, file, indent=1)
    for cell in itertools.product(*(range(-(-size // part)) for size, part in zip(data.shape, block))):
        part = data[tuple(slice(i * size, (i + 1) * size) for i, size in zip(cell, block))]
        write_n5_block(os.path.join(path, *map(str, reversed(cell))), part, compress, mode)


def n5():
    packed = dict(raw=None, zlib=numcodecs.Zlib(), gzip=numcodecs.GZip(), zstd=numcodecs.Zstd(), lz4=numcodecs.LZ4(),
                  blosc=numcodecs.Blosc("lz4"))
    for name, compressor in packed.items():
        store = zarr.n5.N5Store(place("n5", f"{name}_uint16.n5"))
        zarr.open(store, mode="w", shape=V.shape, chunks=(2, 3, 4), dtype="u2", compressor=compressor)[:] = V
    for name in TYPES[1:]:
        store = zarr.n5.N5Store(place("n5", f"type_{name}.n5"))
        zarr.open(store, mode="w", shape=V.shape, chunks=(2, 4, 5), dtype=name)[:] = samples(name)
    write_n5(place("n5", "lz4java_uint16.n5"), samples("uint16"), (2, 4, 4), {"type": "lz4", "blockSize": 16}, lz4_java)
    write_n5(place("n5", "short_uint16.n5"), samples("uint16"), (2, 3, 4), {"type": "raw"}, bytes, mode=1)
    write_n5(place("n5", "bad", "float32.n5"), V.astype("f4"), (2, 4, 5), {"type": "raw"}, bytes)
    write_n5(place("n5", "bad", "bzip2.n5"), samples("uint16"), (2, 4, 5), {"type": "bzip2", "blockSize": 9}, bytes)
    root = place("n5", "bad", "levels.n5")
    for level, data in enumerate((samples("uint16"), samples("uint16")[::2, ::2, ::2])):
        more = {"downsamplingFactors": [2**level] * 3} if level else {}
        write_n5(os.path.join(root, "volume", f"s{level}"), data, (2, 4, 5), {"type": "raw"}, bytes, **more)
    for folder, text in (("", {"n5": "2.5.0"}), ("volume", {"resolution": [0.5, 2, 5], "offset": [10, 20, 30]})):
        with open(os.path.join(root, folder, "attributes.json"), "w") as file:
            json.dump(text, file, indent=1)
    write_n5(place("n5", "bad", "cosem.n5"), samples("uint16"), (3, 4, 5), {"type": "raw"}, bytes,
             pixelResolution={"dimensions": [9, 9, 9], "unit": "nm"},
             transform={"axes": ["z", "y", "x"], "scale": [5, 2, 0.5], "translate": [30, 20, 10]})


if __name__ == "__main__":
    shutil.rmtree(ROOT, ignore_errors=True)
    hdf5()
    dream3d()
    zarr_2()
    zarr_3()
    ome()
    n5()
