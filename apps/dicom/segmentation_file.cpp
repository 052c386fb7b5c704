#include "segmentation_file.h"

#include <dcmtk/config/osconfig.h>  // before all others of DCMTK
#include <dcmtk/dcmdata/dcdeftag.h>
#include <dcmtk/dcmdata/dcdicent.h>
#include <dcmtk/dcmdata/dcdict.h>
#include <dcmtk/dcmdata/dcfcache.h>
#include <dcmtk/dcmdata/dcfilefo.h>
#include <dcmtk/dcmdata/dcpixel.h>
#include <dcmtk/dcmdata/dcrledrg.h>
#include <dcmtk/dcmdata/dcsequen.h>
#include <dcmtk/dcmdata/dcspchrs.h>
#include <dcmtk/oflog/oflog.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <optional>
#include <span>

#include "helper/serve.h"

namespace regionmesh::dicom {
namespace {

using helper::Refusal;

constexpr const char* kUnreadable = "its samples cannot be read";
constexpr std::uint64_t kMostGrowth = 64;  // most growth of samples in RLE: two bytes become 128
constexpr Uint32 kMostLoaded = 1 << 16;    // bytes of a value; longer ones stay in the file where it allows

struct KnownTag {
    DcmTagKey key;
    DcmEVR type;
};

/// Implicit VR does not say the types of values: these are all that are read here. Independent of the dictionary that
/// DCMTK finds on the machine.
auto known_tags() {
    return std::to_array<KnownTag>({{DCM_SpecificCharacterSet, EVR_CS},
                                    {DCM_SOPClassUID, EVR_UI},
                                    {DCM_Modality, EVR_CS},
                                    {DCM_SegmentationType, EVR_CS},
                                    {DCM_NumberOfFrames, EVR_IS},
                                    {DCM_Rows, EVR_US},
                                    {DCM_Columns, EVR_US},
                                    {DCM_BitsAllocated, EVR_US},
                                    {DCM_BitsStored, EVR_US},
                                    {DCM_HighBit, EVR_US},
                                    {DCM_SamplesPerPixel, EVR_US},
                                    {DCM_PixelRepresentation, EVR_US},
                                    {DCM_PhotometricInterpretation, EVR_CS},
                                    {DCM_PlanarConfiguration, EVR_US},
                                    {DCM_PixelPaddingValue, EVR_US},
                                    {DCM_RedPaletteColorLookupTableDescriptor, EVR_US},
                                    {DCM_GreenPaletteColorLookupTableDescriptor, EVR_US},
                                    {DCM_BluePaletteColorLookupTableDescriptor, EVR_US},
                                    {DCM_RedPaletteColorLookupTableData, EVR_OW},
                                    {DCM_GreenPaletteColorLookupTableData, EVR_OW},
                                    {DCM_BluePaletteColorLookupTableData, EVR_OW},
                                    {DCM_PixelData, EVR_PixelData},
                                    {DCM_InConcatenationNumber, EVR_US},
                                    {DCM_InConcatenationTotalNumber, EVR_US},
                                    {DCM_SegmentSequence, EVR_SQ},
                                    {DCM_SegmentNumber, EVR_US},
                                    {DCM_SegmentLabel, EVR_LO},
                                    {DCM_RecommendedDisplayCIELabValue, EVR_US},
                                    {DCM_SharedFunctionalGroupsSequence, EVR_SQ},
                                    {DCM_PerFrameFunctionalGroupsSequence, EVR_SQ},
                                    {DCM_SegmentIdentificationSequence, EVR_SQ},
                                    {DCM_ReferencedSegmentNumber, EVR_US},
                                    {DCM_PlanePositionSequence, EVR_SQ},
                                    {DCM_ImagePositionPatient, EVR_DS},
                                    {DCM_PlaneOrientationSequence, EVR_SQ},
                                    {DCM_ImageOrientationPatient, EVR_DS},
                                    {DCM_PixelMeasuresSequence, EVR_SQ},
                                    {DCM_PixelSpacing, EVR_DS},
                                    {DCM_SpacingBetweenSlices, EVR_DS},
                                    {DCM_SliceThickness, EVR_DS}});
}

std::string text_of(DcmItem& item, const DcmTagKey& key) {
    OFString text;
    item.findAndGetOFStringArray(key, text);
    return {text.begin(), text.end()};
}

template <std::size_t kCount>
std::array<double, kCount> numbers_of(DcmItem* item, const DcmTagKey& key) {
    std::array<double, kCount> numbers;
    numbers.fill(std::numeric_limits<double>::quiet_NaN());
    for (std::size_t i = 0; item != nullptr && i < kCount; ++i) {
        Float64 number = 0;
        if (item->findAndGetFloat64(key, number, i).bad()) break;
        numbers[i] = number;
    }
    return numbers;
}

/// The first item of a sequence; null where there is none.
DcmItem* first_item(DcmItem* item, const DcmTagKey& sequence) {
    DcmItem* found = nullptr;
    if (item != nullptr) item->findAndGetSequenceItem(sequence, found, 0);
    return found;
}

/// A functional group of a frame, or else the one that all frames share.
DcmItem* group_of(DcmItem* frame, DcmItem* shared, const DcmTagKey& sequence) {
    DcmItem* own = first_item(frame, sequence);
    return own != nullptr ? own : first_item(shared, sequence);
}

Frame read_frame(DcmItem* item, DcmItem* shared) {
    DcmItem* const measures = group_of(item, shared, DCM_PixelMeasuresSequence);
    Frame frame{};
    frame.segment = std::numeric_limits<double>::quiet_NaN();
    Uint16 number = 0;
    DcmItem* const segment = group_of(item, shared, DCM_SegmentIdentificationSequence);
    if (segment != nullptr && segment->findAndGetUint16(DCM_ReferencedSegmentNumber, number).good())
        frame.segment = number;
    frame.position = numbers_of<3>(group_of(item, shared, DCM_PlanePositionSequence), DCM_ImagePositionPatient);
    frame.orientation =
        numbers_of<6>(group_of(item, shared, DCM_PlaneOrientationSequence), DCM_ImageOrientationPatient);
    frame.pixel_spacing = numbers_of<2>(measures, DCM_PixelSpacing);
    frame.between_slices = numbers_of<1>(measures, DCM_SpacingBetweenSlices)[0];
    frame.thickness = numbers_of<1>(measures, DCM_SliceThickness)[0];
    return frame;
}

/// The entry of a value in one of the three tables, as 16 bits; nothing where the file has no such table or entry.
std::optional<std::uint16_t> palette_entry(DcmItem& dataset, const DcmTagKey& descriptor, const DcmTagKey& table,
                                           std::uint32_t value) {
    Uint16 size = 0, first = 0, bits = 0;
    const Uint16* words = nullptr;
    unsigned long count = 0;
    if (dataset.findAndGetUint16(descriptor, size, 0).bad() || dataset.findAndGetUint16(descriptor, first, 1).bad() ||
        dataset.findAndGetUint16(descriptor, bits, 2).bad() || value < first ||
        dataset.findAndGetUint16Array(table, words, &count).bad() || words == nullptr) {
        return {};
    }
    const std::uint32_t entry = value - first, entries = size == 0 ? 65536 : size;
    const bool has_words = bits == 16 || count >= entries;  // else two entries of 8 bits in a word
    if (entry >= entries || (has_words ? entry : entry / 2) >= count) return {};
    const std::uint16_t stored = has_words ? words[entry] : words[entry / 2] >> entry % 2 * 8 & 0xFF;
    return bits == 16 ? stored : static_cast<std::uint16_t>((stored & 0xFF) * 257);
}

std::vector<std::uint16_t> palette_colour(DcmItem& dataset, std::uint32_t value) {
    const std::array<std::optional<std::uint16_t>, 3> colour{
        palette_entry(dataset, DCM_RedPaletteColorLookupTableDescriptor, DCM_RedPaletteColorLookupTableData, value),
        palette_entry(dataset, DCM_GreenPaletteColorLookupTableDescriptor, DCM_GreenPaletteColorLookupTableData, value),
        palette_entry(dataset, DCM_BluePaletteColorLookupTableDescriptor, DCM_BluePaletteColorLookupTableData, value)};
    if (!colour[0] || !colour[1] || !colour[2]) return {};
    return {*colour[0], *colour[1], *colour[2]};
}

void require(const OFCondition& condition, const std::string& what) {
    if (condition.bad()) throw Refusal(what + " (" + condition.text() + "); the file is damaged, fetch it again");
}

/// Items go into a linked list, of which only the next one is found at once.
template <class Visit>
void for_items(DcmItem& dataset, const DcmTagKey& key, Visit&& visit) {
    DcmSequenceOfItems* sequence = nullptr;
    if (dataset.findAndGetSequence(key, sequence).bad() || sequence == nullptr) return;
    for (DcmObject* item = sequence->nextInContainer(nullptr); item != nullptr; item = sequence->nextInContainer(item))
        visit(static_cast<DcmItem&>(*item));
}

}  // namespace

struct SegmentationFile::Parts {
    DcmFileFormat file;
    DcmFileCache cache;
    std::uint64_t stored_bytes = 0;  // size of the file
    std::uint64_t rows = 0, columns = 0, bits = 0, frames = 0;

    DcmDataset& dataset() { return *file.getDataset(); }
    DcmXfer syntax() { return DcmXfer(dataset().getOriginalXfer()); }
    std::uint64_t frame_bits() const { return rows * columns * bits; }
    bool is_native() { return !syntax().isEncapsulated(); }
    DcmPixelData* pixels();
    std::string obstacle();
    /// Bytes of the samples as they are stored, from `begin` on.
    void copy_stored(std::uint64_t begin, std::span<std::byte> bytes, E_ByteOrder order);
    std::vector<std::byte> packed_bits(std::uint64_t frame);
    std::vector<std::byte> decoded(std::uint64_t frame);
};

DcmPixelData* SegmentationFile::Parts::pixels() {
    DcmElement* element = nullptr;
    if (dataset().findAndGetElement(DCM_PixelData, element).bad()) return nullptr;
    return dynamic_cast<DcmPixelData*>(element);
}

/// Why samples cannot be read; empty where they can.
std::string SegmentationFile::Parts::obstacle() {
    if (pixels() == nullptr) return "holds no samples (Pixel Data); fetch it again";
    Uint16 channels = 1;
    dataset().findAndGetUint16(DCM_SamplesPerPixel, channels);
    Uint16 part = 1, parts = 0;
    const bool is_part = dataset().findAndGetUint16(DCM_InConcatenationNumber, part).good();
    dataset().findAndGetUint16(DCM_InConcatenationTotalNumber, parts);  // may be missing
    if (is_part && parts != 1)
        return "is part " + std::to_string(part) +
               " of a segmentation in several files (a concatenation); write its frames into one file";
    if (channels != 1) return "has " + std::to_string(channels) + " numbers at each sample; export it with labels";
    if (is_native()) {
        const std::uint64_t stored = pixels()->getLength(dataset().getOriginalXfer());
        const std::uint64_t needed = (frames * frame_bits() + 7) / 8;
        if (needed == 0 || stored == needed || stored == needed + needed % 2) return "";  // odd ones get a byte
        return "holds " + std::to_string(stored) + " bytes of samples where " + std::to_string(needed) +
               " are needed; " +
               (stored < needed
                    ? "the file is truncated, fetch it again"
                    : "its number of frames, rows or columns is wrong, or frames are padded; export it again");
    }
    if (dataset().getOriginalXfer() != EXS_RLELossless || bits == 1) {
        return "its samples are compressed as " + std::string(syntax().getXferName()) +
               ", which is not read; write them uncompressed, with gdcmconv --raw, or with dcmdjpls or dcmdjpeg of "
               "DCMTK";
    }
    if (frames * frame_bits() / 8 / kMostGrowth > stored_bytes)
        return "is too small for the samples that it describes; it is truncated, fetch it again";
    return "";
}

void SegmentationFile::Parts::copy_stored(std::uint64_t begin, std::span<std::byte> bytes, E_ByteOrder order) {
    require(pixels()->getPartialValue(bytes.data(), static_cast<Uint32>(begin), static_cast<Uint32>(bytes.size()),
                                      &cache, order),
            kUnreadable);
}

/// Frames of single bits follow one another without gaps: one may begin within a byte.
std::vector<std::byte> SegmentationFile::Parts::packed_bits(std::uint64_t frame) {
    const std::uint64_t first = frame * frame_bits(), last = first + frame_bits();
    const std::uint64_t begin = first / 8, end = (last + 7) / 8;
    std::vector<std::byte> bytes(end - begin + 1);  // a zero byte behind the last
    copy_stored(begin, std::span(bytes).first(end - begin), EBO_LittleEndian);
    const unsigned shift = first % 8;
    for (std::size_t i = 0; shift != 0 && i + 1 < bytes.size(); ++i)
        bytes[i] = bytes[i] >> shift | bytes[i + 1] << (8 - shift);
    bytes.resize((frame_bits() + 7) / 8);
    const unsigned used = frame_bits() % 8;
    if (used != 0) bytes.back() &= static_cast<std::byte>((1u << used) - 1);
    return bytes;
}

std::vector<std::byte> SegmentationFile::Parts::decoded(std::uint64_t frame) {
    const std::uint64_t size = frame_bits() / 8;
    std::vector<std::byte> bytes(size + size % 2);  // DCMTK swaps bytes in pairs
    Uint32 fragment = 0;
    OFString colours;
    require(pixels()->getUncompressedFrame(&dataset(), static_cast<Uint32>(frame), fragment, bytes.data(),
                                           static_cast<Uint32>(bytes.size()), colours, &cache),
            kUnreadable);
    bytes.resize(size);
    return bytes;
}

void SegmentationFile::load_dictionary() {
    OFLog::configure(OFLogger::OFF_LOG_LEVEL);
    ::setenv("DCMDICTPATH", "/dev/null", 1);
    DcmDataDictionary& dictionary = dcmDataDict.wrlock();
    for (const auto& [key, type] : known_tags())
        dictionary.addEntry(new DcmDictEntry(key.getGroup(), key.getElement(), DcmVR(type), "x", 1, DcmVariableVM,
                                             nullptr, OFFalse, nullptr));
    dcmDataDict.wrunlock();
    DcmRLEDecoderRegistration::registerCodecs();
}

SegmentationFile::SegmentationFile(const char* path) : parts_(std::make_unique<Parts>()) {
    require(parts_->file.loadFile(path, EXS_Unknown, EGL_noChange, kMostLoaded, ERM_fileOnly),
            "cannot be read as a DICOM file");
    parts_->stored_bytes = std::filesystem::file_size(path);
}

SegmentationFile::~SegmentationFile() = default;

Description SegmentationFile::description() {
    DcmDataset& dataset = parts_->dataset();
    Description said{.sop_class = text_of(dataset, DCM_SOPClassUID),
                     .modality = text_of(dataset, DCM_Modality),
                     .syntax = parts_->syntax().getXferName(),
                     .kind = text_of(dataset, DCM_SegmentationType)};
    const auto number = [&](const DcmTagKey& key) {
        Uint16 value = 0;
        dataset.findAndGetUint16(key, value);
        return value;
    };
    parts_->rows = said.rows = number(DCM_Rows);
    parts_->columns = said.columns = number(DCM_Columns);
    parts_->bits = said.bits = number(DCM_BitsAllocated);
    Sint32 frames = 0;
    dataset.findAndGetSint32(DCM_NumberOfFrames, frames);
    parts_->frames = said.frames = static_cast<std::uint64_t>(std::max<Sint32>(frames, 0));
    if (dataset.tagExists(DCM_PixelPaddingValue)) said.padding = number(DCM_PixelPaddingValue);
    DcmSpecificCharacterSet characters;
    const bool converts = characters.selectCharacterSet(dataset).good();
    for_items(dataset, DCM_SegmentSequence, [&](DcmItem& item) {
        Segment segment;
        Uint16 value = 0;
        if (item.findAndGetUint16(DCM_SegmentNumber, value).bad()) return;
        segment.number = value;
        const std::string stored = text_of(item, DCM_SegmentLabel);
        OFString label;
        if (converts && characters.convertString(stored.c_str(), stored.size(), label).good())
            segment.label.assign(label.begin(), label.end());
        else if (constexpr char kEscape = 27; stored.find(kEscape) == std::string::npos)
            segment.label = stored;  // else in characters that cannot be read
        for (unsigned i = 0; i < 3 && item.findAndGetUint16(DCM_RecommendedDisplayCIELabValue, value, i).good(); ++i)
            segment.recommended_lab.push_back(value);
        segment.palette = palette_colour(dataset, segment.number);
        said.segments.push_back(segment);
    });
    said.obstacle = parts_->obstacle();
    const bool is_inflated = parts_->syntax().getStreamCompression() != ESC_none;
    if (is_inflated && said.obstacle.empty()) said.held_bytes = parts_->pixels()->getLength();
    if (!parts_->is_native()) said.held_bytes = parts_->stored_bytes;
    return said;
}

std::vector<Frame> SegmentationFile::take_frames() {
    DcmDataset& dataset = parts_->dataset();
    DcmItem* const shared = first_item(&dataset, DCM_SharedFunctionalGroupsSequence);
    std::vector<Frame> frames;
    for_items(dataset, DCM_PerFrameFunctionalGroupsSequence,
              [&](DcmItem& item) { frames.push_back(read_frame(&item, shared)); });
    dataset.findAndDeleteElement(DCM_PerFrameFunctionalGroupsSequence);
    return frames;
}

std::vector<std::byte> SegmentationFile::samples(std::uint64_t frame) {
    if (frame >= parts_->frames || parts_->rows * parts_->columns == 0) throw Refusal("has no such frame");
    if (const std::string obstacle = parts_->obstacle(); !obstacle.empty()) throw Refusal(obstacle);
    if (parts_->bits == 1) return parts_->packed_bits(frame);
    if (!parts_->is_native()) return parts_->decoded(frame);
    const std::uint64_t size = parts_->frame_bits() / 8;
    std::vector<std::byte> bytes(size);
    parts_->copy_stored(frame * size, bytes, parts_->bits == 16 ? gLocalByteOrder : EBO_LittleEndian);
    return bytes;
}

}  // namespace regionmesh::dicom
