// A DICOM file as far as a segmentation needs it: what it says of its segments and frames, and samples frame by frame.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "formats/dicom/dicom_frame.h"

namespace regionmesh::dicom {

struct Segment {
    std::uint32_t number = 0;
    std::string label = {};                           // UTF-8, unless the file breaks its own character set
    std::vector<std::uint16_t> recommended_lab = {};  // CIE L*a*b* for display, three numbers or none
    std::vector<std::uint16_t> palette = {};          // red, green and blue of a label map's palette, or none
};

/// What the file says, uninterpreted. Empty or 0 where it says nothing.
struct Description {
    std::string sop_class, modality, syntax, kind;  // transfer syntax and SegmentationType in words
    std::uint32_t rows = 0, columns = 0, bits = 0;  // bits of a sample as stored: 1, 8, 16
    std::uint64_t frames = 0;
    std::int64_t padding = -1;     // PixelPaddingValue; -1 for none
    std::uint64_t held_bytes = 0;  // held bytes of samples, in the memory of this process
    std::string obstacle = {};     // why samples cannot be read, if so
    std::vector<Segment> segments = {};
};

using Frame = formats::DicomFrame;

/// Functions throw helper::Refusal.
class SegmentationFile {
public:
    /// Call once, before the first file and the sandbox: makes the tags known that this program reads, and no others.
    static void load_dictionary();

    explicit SegmentationFile(const char* path);
    ~SegmentationFile();

    Description description();
    /// One for each item of the functional groups, in the order of the file. They are freed: asked for once.
    std::vector<Frame> take_frames();
    /// Samples of a frame, counted from 0, row by row. Of one bit: 8 in a byte, the first in the lowest bit; of 16
    /// bits: in the byte order of the machine. After description().
    std::vector<std::byte> samples(std::uint64_t frame);

private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};

}  // namespace regionmesh::dicom
