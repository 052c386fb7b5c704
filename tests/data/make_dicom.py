#!/usr/bin/python3
"""Writes the DICOM segmentations beside this file that the reader is tested on, with pydicom.

Debian: python3-numpy python3-pydicom. Sample (x, y, z) of the 5 x 3 x 6 volumes has label (x + 2 y + 3 z) mod 4, but 0 in
section 2, which has no frame; the tests know the same rule. Frames of 15 bits begin within a byte.
"""
import functools
import os
import random
import shutil
import zlib

import numpy
from pydicom import dcmwrite
from pydicom.dataset import Dataset, FileMetaDataset
from pydicom.encaps import encapsulate
from pydicom.pixel_data_handlers.numpy_handler import pack_bits
from pydicom.pixel_data_handlers.rle_handler import rle_encode_frame

ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "dicom")
IMPLICIT, EXPLICIT = "1.2.840.10008.1.2", "1.2.840.10008.1.2.1"
DEFLATED, BIG_ENDIAN, RLE = EXPLICIT + ".99", "1.2.840.10008.1.2.2", "1.2.840.10008.1.2.5"
JPEG_LS = "1.2.840.10008.1.2.4.80"
SEGMENTATION, LABEL_MAP = "1.2.840.10008.5.1.4.1.1.66.4", "1.2.840.10008.5.1.4.1.1.66.7"
CT = "1.2.840.10008.5.1.4.1.1.2"

Z, Y, X = numpy.indices((6, 3, 5))
LABELS = numpy.where(Z == 2, 0, (X + 2 * Y + 3 * Z) % 4)
ROW, COLUMN, NORMAL = (0.36, 0.48, -0.8), (-0.8, 0.6, 0), (0.48, 0.64, 0.6)
ORIGIN, SPACING = (-10.5, 20.25, 30), (0.5, 0.75, 2.5)  # along x, y, z
NAMES = {1: "liver", 2: "left kidney", 3: "spleen"}
COLOURS = {1: (34885, 53486, 50171), 2: (57498, 10747, 54273)}  # red, green


def item(**values):
    made = Dataset()
    for name, value in values.items():
        setattr(made, name, value)
    return made


def position(z, off=0):
    return [round(start + z * SPACING[2] * step + off * along, 6) for start, step, along in zip(ORIGIN, NORMAL, ROW)]


def groups(segment=None, place=None, orientation=None, spacing=None):
    """Functional groups of a frame, or those that all share."""
    made = Dataset()
    if segment is not None:
        made.SegmentIdentificationSequence = [item(ReferencedSegmentNumber=segment)]
    if place is not None:
        made.PlanePositionSequence = [item(ImagePositionPatient=place)]
    if orientation is not None:
        made.PlaneOrientationSequence = [item(ImageOrientationPatient=list(orientation))]
    if spacing is not None:
        made.PixelMeasuresSequence = [item(**spacing)]
    return made


def measures(**more):
    return {"PixelSpacing": [SPACING[1], SPACING[0]], "SliceThickness": SPACING[2], **more}


class Segmentation:
    def __init__(self, kind, masks, frames, bits=1):
        self.masks = masks
        shared = groups(orientation=ROW + COLUMN, spacing=measures(SpacingBetweenSlices=SPACING[2]))
        self.set = item(
            SOPClassUID=LABEL_MAP if kind == "LABELMAP" else SEGMENTATION, SOPInstanceUID="1.2.3.4", Modality="SEG",
            SegmentationType=kind, SamplesPerPixel=1, PhotometricInterpretation="MONOCHROME2", PixelRepresentation=0,
            Rows=masks[0].shape[0], Columns=masks[0].shape[1], NumberOfFrames=len(masks), BitsAllocated=bits,
            BitsStored=bits, HighBit=bits - 1, SharedFunctionalGroupsSequence=[shared],
            PerFrameFunctionalGroupsSequence=frames, SegmentSequence=[])
        for number, name in NAMES.items():
            segment = item(SegmentNumber=number, SegmentLabel=name)
            if number in COLOURS:
                segment.RecommendedDisplayCIELabValue = list(COLOURS[number])
            self.set.SegmentSequence.append(segment)

    def samples(self, syntax):
        bits = self.set.BitsAllocated
        if syntax == RLE:
            return encapsulate([rle_encode_frame(mask.astype(f"u{bits // 8}")) for mask in self.masks])
        if bits == 1:
            stored = pack_bits(numpy.concatenate([mask.ravel() for mask in self.masks]).astype("u1"))
        else:
            stored = numpy.concatenate([mask.ravel() for mask in self.masks]).astype(f"<u{bits // 8}").tobytes()
        stored += b"\0" * (len(stored) % 2)
        return numpy.frombuffer(stored, "<u2").byteswap().tobytes() if syntax == BIG_ENDIAN else stored

    def write(self, *parts, syntax=EXPLICIT, says=None):
        """`says`: the transfer syntax that the file names, if it lies."""
        path = os.path.join(ROOT, *parts)
        os.makedirs(os.path.dirname(path), exist_ok=True)
        if "PixelData" not in self.set:
            self.set.PixelData = self.samples(syntax)
        self.set["PixelData"].VR = "OB" if syntax == RLE else "OW"
        self.set["PixelData"].is_undefined_length = syntax == RLE
        self.set.is_little_endian, self.set.is_implicit_VR = syntax != BIG_ENDIAN, syntax == IMPLICIT
        meta = FileMetaDataset()
        meta.MediaStorageSOPClassUID, meta.MediaStorageSOPInstanceUID = self.set.SOPClassUID, "1.2.3.4"
        meta.TransferSyntaxUID, meta.ImplementationClassUID = says or syntax, "1.2.3"
        self.set.file_meta = meta
        dcmwrite(path, self.set, write_like_original=False)


def binary(labels=LABELS, overlap=False, places=None):
    """A frame for each segment in each section, where it has samples, in an order of no meaning."""
    pairs = [(segment, z) for segment in NAMES for z in range(len(labels)) if (labels[z] == segment).any()]
    random.Random(1).shuffle(pairs)
    masks = [(labels[z] == segment) | (overlap and segment == 3 and labels[z] == 1) for segment, z in pairs]
    return Segmentation("BINARY", masks, [groups(segment, place=(places or position)(z)) for segment, z in pairs])


def label_map(bits=8, labels=LABELS):
    order = [4, 0, 5, 1, 3]
    return Segmentation("LABELMAP", [labels[z] for z in order], [groups(place=position(z)) for z in order], bits)


def changed(change, made=None):
    made = made or binary()
    change(made.set)
    return made


def good():
    binary().write("explicit.dcm")
    binary().write("implicit.dcm", syntax=IMPLICIT)
    binary().write("big_endian.dcm", syntax=BIG_ENDIAN)
    binary().write("deflated.dcm", syntax=DEFLATED)
    for bits in (8, 16):
        label_map(bits).write(f"map_{bits}.dcm")
        label_map(bits).write(f"map_{bits}_rle.dcm", syntax=RLE)
    label_map(16).write("map_16_big_endian.dcm", syntax=BIG_ENDIAN)
    changed(lambda d: setattr(d, "PixelPaddingValue", 255), label_map(8, numpy.where(LABELS == 0, 255, LABELS))).write(
        "map_8_padding.dcm")
    binary(overlap=True).write("other", "overlap.dcm")


def latin(data):
    data.SpecificCharacterSet = "ISO_IR 100"
    data.SegmentSequence[0].SegmentLabel = "Nebenhöhle"


def segment_zero(data):
    data.SegmentSequence[0].SegmentNumber, data.SegmentSequence[0].SegmentLabel = 0, "fluid"
    data.PixelPaddingValue = 255


def palette(bits, data):
    """Entries from 1 to 3: dark red, green, blue."""
    data.PhotometricInterpretation = "PALETTE COLOR"
    for name, entries in (("Red", (128, 0, 0)), ("Green", (0, 255, 0)), ("Blue", (0, 0, 64))):
        setattr(data, f"{name}PaletteColorLookupTableDescriptor", [3, 1, bits])
        stored = bytes([*entries, 0]) if bits == 8 else numpy.array([257 * entry for entry in entries], "<u2").tobytes()
        setattr(data, f"{name}PaletteColorLookupTableData", stored)
    del data.SegmentSequence[0].RecommendedDisplayCIELabValue


def nothing_between(data):
    del data.SharedFunctionalGroupsSequence[0].PixelMeasuresSequence[0].SpacingBetweenSlices


def no_distance(data):
    nothing_between(data)
    del data.SharedFunctionalGroupsSequence[0].PixelMeasuresSequence[0].SliceThickness


def wrong_between(data):
    data.SharedFunctionalGroupsSequence[0].PixelMeasuresSequence[0].SpacingBetweenSlices = 1


def rounded_between(data):
    data.SharedFunctionalGroupsSequence[0].PixelMeasuresSequence[0].SpacingBetweenSlices = 2.5001


def other():
    changed(latin).write("other", "latin1.dcm")
    changed(lambda d: setattr(d, "SpecificCharacterSet", "ISO_IR 192") or
            setattr(d.SegmentSequence[0], "SegmentLabel", "肝")).write("other", "utf8.dcm")
    changed(segment_zero, label_map()).write("other", "map_zero.dcm")
    for bits in (8, 16):
        changed(functools.partial(palette, bits), label_map()).write("other", f"palette_{bits}.dcm")
    changed(no_distance).write("other", "no_distance.dcm")
    changed(wrong_between).write("other", "wrong_between.dcm")
    changed(rounded_between).write("other", "rounded_between.dcm")
    changed(no_distance, binary(LABELS[:1])).write("other", "one_section.dcm")
    sparse = LABELS.copy()
    sparse[[1, 3]] = 0
    binary(sparse).write("other", "sparse.dcm")  # sections 0, 4 and 5
    shutil.copy(os.path.join(ROOT, "explicit.dcm"), os.path.join(ROOT, "other", "1.2.3.4"))


def frame_of(data, number):
    return data.PerFrameFunctionalGroupsSequence[number - 1]


def bad():
    Segmentation("FRACTIONAL", [LABELS[0] * 50], [groups(1, place=position(0))], 8).write("bad", "fractional.dcm")
    changed(lambda d: setattr(d, "SegmentationType", "SOLID")).write("bad", "kind.dcm")
    label_map().write("bad", "jpeg_ls.dcm", syntax=RLE, says=JPEG_LS)
    changed(lambda d: setattr(d, "BitsAllocated", 8)).write("bad", "bits.dcm")
    changed(lambda d: d.update(item(InConcatenationNumber=1, InConcatenationTotalNumber=2))).write("bad", "part.dcm")

    def image(data):
        data.SOPClassUID, data.Modality = CT, "CT"
        for name in ("SegmentationType", "SegmentSequence", "PerFrameFunctionalGroupsSequence"):
            delattr(data, name)
    changed(image).write("bad", "image.dcm")
    changed(lambda d: setattr(frame_of(d, 3).PlanePositionSequence[0], "ImagePositionPatient", position(1, 0.2))).write(
        "bad", "beside.dcm")
    changed(lambda d: setattr(frame_of(d, 3).PlanePositionSequence[0], "ImagePositionPatient", position(1.4))).write(
        "bad", "between.dcm")
    changed(lambda d: frame_of(d, 2).__delattr__("PlanePositionSequence")).write("bad", "no_position.dcm")
    changed(lambda d: frame_of(d, 4).PlanePositionSequence[0].__setattr__(
        "ImagePositionPatient", [0, 0, 1e12])).write("bad", "far.dcm")
    changed(lambda d: frame_of(d, 2).__delattr__("SegmentIdentificationSequence")).write("bad", "no_segment.dcm")
    changed(lambda d: d.SharedFunctionalGroupsSequence[0].__delattr__("PlaneOrientationSequence")).write(
        "bad", "no_orientation.dcm")
    changed(lambda d: setattr(frame_of(d, 5), "PlaneOrientationSequence",
                              [item(ImageOrientationPatient=[1, 0, 0, 0, 1, 0])])).write("bad", "orientation.dcm")
    changed(lambda d: setattr(d.SharedFunctionalGroupsSequence[0].PlaneOrientationSequence[0], "ImageOrientationPatient",
                              [1, 0, 0, 1, 0, 0])).write("bad", "flat.dcm")
    changed(lambda d: setattr(frame_of(d, 5), "PixelMeasuresSequence", [item(**measures(PixelSpacing=[1, 1]))])).write(
        "bad", "spacing.dcm")
    changed(lambda d: setattr(d.SharedFunctionalGroupsSequence[0].PixelMeasuresSequence[0], "PixelSpacing", [0, 1])).write(
        "bad", "no_spacing.dcm")

    def twice(data):
        first, second = frame_of(data, 1), frame_of(data, 2)
        second.PlanePositionSequence = first.PlanePositionSequence
        second.SegmentIdentificationSequence = first.SegmentIdentificationSequence
    changed(twice).write("bad", "twice.dcm")
    changed(lambda d: setattr(d, "PerFrameFunctionalGroupsSequence", d.PerFrameFunctionalGroupsSequence[:4])).write(
        "bad", "groups.dcm")
    changed(lambda d: setattr(d, "PixelData", b"\0" * 4)).write("bad", "short.dcm")
    changed(lambda d: setattr(d, "PixelData", b"\0" * 32)).write("bad", "long.dcm")
    changed(lambda d: setattr(d, "Rows", 0)).write("bad", "empty.dcm")
    large = label_map(16)
    large.set.PixelData = large.samples(RLE)
    changed(lambda d: setattr(d, "Rows", 30000) or setattr(d, "Columns", 30000), large).write(
        "bad", "large.dcm", syntax=RLE)
    with open(os.path.join(ROOT, "explicit.dcm"), "rb") as file:
        whole = file.read()
    for name, text in (("cut.dcm", whole[:900]), ("head.dcm", whole[:140]), ("text.dcm", b"no DICOM file")):
        with open(os.path.join(ROOT, "bad", name), "wb") as file:
            file.write(text)


def nrrd():
    """The labels of explicit.dcm, where a reader of NRRD finds them."""
    def words(vector, length):
        return "(" + ",".join(repr(float(number) * length) for number in vector) + ")"

    header = ["NRRD0005", "type: uint16", "dimension: 3", "space: left-posterior-superior",
              f"sizes: {LABELS.shape[2]} {LABELS.shape[1]} {LABELS.shape[0]}",
              "space directions: " + " ".join(map(words, (ROW, COLUMN, numpy.cross(ROW, COLUMN)), SPACING)),
              f"space origin: {words(ORIGIN, 1)}", "endian: little", "encoding: gzip"]
    colours = {1: "1 0 0", 2: "0.0 1.0 0.0"}
    for number, name in NAMES.items():
        header += [f"Segment{number}_Name:={name}", f"Segment{number}_LabelValue:={number}", f"Segment{number}_Layer:=0"]
        if number in colours:
            header.append(f"Segment{number}_Color:={colours[number]}")
    pack = zlib.compressobj(wbits=31)
    with open(os.path.join(ROOT, "same.seg.nrrd"), "wb") as file:
        file.write("\n".join([*header, "", ""]).encode() + pack.compress(LABELS.astype("<u2").tobytes()) + pack.flush())


if __name__ == "__main__":
    shutil.rmtree(ROOT, ignore_errors=True)
    good()
    other()
    bad()
    nrrd()
