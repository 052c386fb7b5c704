"""A DICOM segmentation as a volume of labels, .seg.nrrd, with the names, colours and place of its segments."""

import argparse
import gzip
from pathlib import Path

import numpy as np
import pydicom

parser = argparse.ArgumentParser(description=__doc__)
parser.add_argument("segmentation", type=Path, help="DICOM file of a binary segmentation (DICOM-SEG)")
parser.add_argument("volume", type=Path, help="volume to write, such as labels.seg.nrrd")
arguments = parser.parse_args()


def refuse(why):
    raise SystemExit(f"{arguments.segmentation}: {why}")


def group(frame, name):
    """A functional group: that of the frame, or else the one that all frames share."""
    for groups in (frame, dataset.SharedFunctionalGroupsSequence[0]):
        if name in groups:
            return groups[name][0]
    refuse(f"a frame has no {name}")


def colour(segment):
    """Shares of red, green and blue (sRGB) of the colour recommended for display, which is CIE L*a*b* in D65."""
    stored = segment.get("RecommendedDisplayCIELabValue")
    if stored is None:
        return None
    lightness, a, b = (stored[0] / 65535 * 100, *(value / 65535 * 255 - 128 for value in stored[1:]))
    fy = (lightness + 16) / 116
    cube = np.array([fy + a / 500, fy, fy - b / 200])
    xyz = np.where(cube > 6 / 29, cube**3, 3 * (6 / 29) ** 2 * (cube - 4 / 29)) * [0.95047, 1, 1.08883]
    linear = np.clip([[3.2406, -1.5372, -0.4986], [-0.9689, 1.8758, 0.0415], [0.0557, -0.204, 1.057]] @ xyz, 0, 1)
    return np.where(linear > 0.0031308, 1.055 * linear ** (1 / 2.4) - 0.055, 12.92 * linear)


dataset = pydicom.dcmread(arguments.segmentation)
if dataset.get("SegmentationType") != "BINARY":
    refuse(f"its type is {dataset.get('SegmentationType', 'not said')}; only binary segmentations have labels")
frames = dataset.PerFrameFunctionalGroupsSequence
masks = dataset.pixel_array.reshape(len(frames), dataset.Rows, dataset.Columns).astype(bool)

directions = {tuple(group(frame, "PlaneOrientationSequence").ImageOrientationPatient) for frame in frames}
spacings = {tuple(group(frame, "PixelMeasuresSequence").PixelSpacing) for frame in frames}
if len(directions) > 1 or len(spacings) > 1:
    refuse("its frames have different directions or spacings; resample them first")
along_row, along_column = np.array(directions.pop(), float).reshape(2, 3)
between_rows, between_columns = map(float, spacings.pop())
normal = np.cross(along_row, along_column)

positions = np.array([group(frame, "PlanePositionSequence").ImagePositionPatient for frame in frames], float)
heights = positions @ normal
steps = np.diff(np.unique(heights.round(4)))
measures = group(frames[0], "PixelMeasuresSequence")
spacing = float(measures.get("SpacingBetweenSlices") or (steps.min() if steps.size else measures.SliceThickness))
places = (heights - heights.min()) / spacing
sections = places.round().astype(int)
if np.abs(places - sections).max() > 0.05:
    refuse(f"its frames are not a multiple of {spacing} mm apart; resample them first")

labels = np.zeros((sections.max() + 1, dataset.Rows, dataset.Columns), np.uint16)
lost = 0
for frame, mask, section in zip(frames, masks, sections):
    lost += np.count_nonzero(labels[section][mask])
    labels[section][mask] = group(frame, "SegmentIdentificationSequence").ReferencedSegmentNumber

vectors = [along_row * between_columns, along_column * between_rows, normal * spacing]
origin = positions[heights.argmin()]


def words(vector):
    return "(" + ",".join(repr(float(x)) for x in vector) + ")"


header = [
    "NRRD0005",
    "type: uint16",
    "dimension: 3",
    "space: left-posterior-superior",
    f"sizes: {dataset.Columns} {dataset.Rows} {len(labels)}",
    f"space directions: {' '.join(map(words, vectors))}",
    f"space origin: {words(origin)}",
    "endian: little",
    "encoding: gzip",
]
for number, segment in enumerate(dataset.SegmentSequence):
    fields = {"Name": segment.SegmentLabel, "LabelValue": segment.SegmentNumber, "Layer": 0}
    if (shares := colour(segment)) is not None:
        fields["Color"] = " ".join(f"{share:.6f}" for share in shares)
    header += [f"Segment{number}_{name}:={value}" for name, value in fields.items()]
arguments.volume.write_bytes("\n".join([*header, "", ""]).encode() + gzip.compress(labels.astype("<u2").tobytes()))

print(f"{arguments.volume}: {len(dataset.SegmentSequence)} segments, {labels.shape[::-1]} samples")
if lost:
    print(f"{lost} samples are in several segments; they have the label of the last one")
