// A DICOM segmentation, read by the program regionmesh-dicom.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "formats/asked_program.h"
#include "formats/dicom/dicom_frame.h"
#include "regionmesh/label_names.h"

namespace regionmesh::formats {

/// What the file says of the object and its samples; empty or 0 where it says nothing.
struct DicomObject {
    std::string sop_class, modality, kind;          // kind: SegmentationType
    std::uint32_t rows = 0, columns = 0, bits = 0;  // bits of a sample: 1, 8 or 16
    std::uint64_t frames = 0;
    std::int64_t padding = -1;     // value of samples without a label; -1 for none
    std::uint64_t held_bytes = 0;  // of samples, in the memory of the program
    std::string obstacle = {};     // why the samples cannot be read, if so
    LabelNames names = {};
    LabelColours colours = {};
};

/// Asks regionmesh-dicom (apps/dicom/README.md). Throws Error(kInput) that names the file.
class DicomFile {
public:
    explicit DicomFile(const std::filesystem::path& path);

    const std::filesystem::path& path() const { return path_; }
    DicomObject object();
    /// In the order of the file; once.
    std::vector<DicomFrame> take_frames();
    /// Samples of a frame, counted from 0, row by row. Of one bit: 8 in a byte, the first in the lowest bit; of 16
    /// bits: in the byte order of this machine.
    Bytes samples(std::uint64_t frame);

private:
    std::filesystem::path path_;
    AskedProgram program_;
};

}  // namespace regionmesh::formats
