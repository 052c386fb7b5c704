"""DICOM segmentations, written by pydicom and read by the module."""

import numpy as np
import pytest
import regionmesh
from regionmesh import _programs

pydicom = pytest.importorskip("pydicom")
from pydicom.dataset import Dataset, FileMetaDataset  # noqa: E402
from pydicom.pixel_data_handlers.numpy_handler import pack_bits  # noqa: E402

pytestmark = pytest.mark.skipif(_programs.path_of("regionmesh-dicom") is None, reason="regionmesh-dicom is not built")


def write_segmentation(path, masks, frames, spacing=(2.0, 0.5, 0.25), kind="BINARY"):
    """A DICOM segmentation of masks [segment, z, y, x] with the given frames (segment, z), in that order."""
    def item(**values):
        made = Dataset()
        for name, value in values.items():
            setattr(made, name, value)
        return made

    made = item(
        SOPClassUID="1.2.840.10008.5.1.4.1.1.66.4",
        SOPInstanceUID="1.2.3.4",
        Modality="SEG",
        SegmentationType=kind,
        SamplesPerPixel=1,
        PhotometricInterpretation="MONOCHROME2",
        PixelRepresentation=0,
        Rows=masks.shape[2],
        Columns=masks.shape[3],
        NumberOfFrames=len(frames),
        BitsAllocated=1,
        BitsStored=1,
        HighBit=0,
        SegmentSequence=[
            item(SegmentNumber=1, SegmentLabel="liver", RecommendedDisplayCIELabValue=[34885, 53486, 50171]),  # red
            item(SegmentNumber=2, SegmentLabel="left kidney"),
        ],
        SharedFunctionalGroupsSequence=[
            item(
                PixelMeasuresSequence=[item(PixelSpacing=list(spacing[1:]), SliceThickness=spacing[0])],
                PlaneOrientationSequence=[item(ImageOrientationPatient=[1, 0, 0, 0, -1, 0])],  # sections go to the feet
            )
        ],
        PerFrameFunctionalGroupsSequence=[
            item(
                SegmentIdentificationSequence=[item(ReferencedSegmentNumber=segment + 1)],
                PlanePositionSequence=[item(ImagePositionPatient=[-10.0, 20.0, 30.0 - z * spacing[0]])],
            )
            for segment, z in frames
        ],
    )
    packed = pack_bits(np.concatenate([masks[segment, z].ravel() for segment, z in frames]).astype(np.uint8))
    made.PixelData = packed + b"\0" * (len(packed) % 2)
    made.is_little_endian, made.is_implicit_VR = True, False
    made.file_meta = FileMetaDataset()
    made.file_meta.MediaStorageSOPClassUID = made.SOPClassUID
    made.file_meta.MediaStorageSOPInstanceUID = made.SOPInstanceUID
    made.file_meta.TransferSyntaxUID = "1.2.840.10008.1.2.1"
    pydicom.dcmwrite(path, made, write_like_original=False)


def test_segmentation_is_the_model_of_its_labels(two_boxes, tmp_path):
    masks = np.stack([two_boxes == 1, two_boxes == 2])
    frames = [(segment, z) for segment in (1, 0) for z in range(14) if masks[segment, z].any()][::-1]
    write_segmentation(tmp_path / "seg.dcm", masks, frames)
    mesh = regionmesh.reconstruct(tmp_path / "seg.dcm")
    assert sorted(mesh.regions["name"]) == ["left kidney", "liver"]
    assert mesh.space == "LPS" and mesh.certified
    # Sections go to the feet: the lowest along the normal is the first of the labels.
    low, high = np.array([-10, 20, 26]), np.array([-10 + 9 * 0.25, 20 - 11 * 0.5, 26 - 8 * 2])
    points = mesh.points
    assert (points >= np.minimum(low, high) - 1e-9).all() and (points <= np.maximum(low, high) + 1e-9).all()


def test_overlap_is_a_warning_and_a_fractional_segmentation_an_error(two_boxes, tmp_path):
    masks = np.stack([two_boxes == 1, two_boxes > 0])
    frames = [(segment, z) for segment in (0, 1) for z in range(2, 11) if masks[segment, z].any()]
    write_segmentation(tmp_path / "seg.dcm", masks, frames)
    with pytest.warns(UserWarning, match=f"{np.count_nonzero(two_boxes == 1)} samples are in several segments"):
        mesh = regionmesh.reconstruct(tmp_path / "seg.dcm")
    assert list(mesh.regions["name"]) == ["left kidney"]
    write_segmentation(tmp_path / "seg.dcm", masks, frames, kind="FRACTIONAL")
    with pytest.raises(ValueError, match="fractional"):
        regionmesh.reconstruct(tmp_path / "seg.dcm")
