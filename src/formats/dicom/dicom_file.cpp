#include "formats/dicom/dicom_file.h"

#include <cstring>

#include "formats/array/volume_formats.h"
#include "formats/dicom/dicom_colour.h"
#include "formats/text/header_text.h"
#include "formats/text/json_text.h"

namespace regionmesh::formats {
namespace {

using Json = nlohmann::json;

// Processor time of one answer. The first one reads the whole file, apart from long values.
constexpr unsigned kFewSeconds = 10;
constexpr unsigned kManySeconds = 120;

constexpr Asked kDicom{.program = kDicomProgram, .letters = {'D', 'C'}, .library = "DICOM library (DCMTK)"};

void take_segment(const Json& json, DicomObject& object) {
    const InputLabel label = json.at("number").get<std::uint16_t>();
    if (const std::string name = one_line(json.at("label").get<std::string>()); !name.empty())
        object.names.emplace(label, name);
    const std::vector<std::uint16_t> lab = json.at("recommended_lab");
    const std::vector<std::uint16_t> palette = json.at("palette");
    if (lab.size() == 3) object.colours.emplace(label, colour_of_lab({lab[0], lab[1], lab[2]}));
    if (palette.size() == 3) object.colours.emplace(label, colour_of_palette({palette[0], palette[1], palette[2]}));
}

DicomObject from_json(const Json& json) {
    DicomObject object{.sop_class = json.at("sop_class"), .modality = json.at("modality"), .kind = json.at("kind")};
    json.at("rows").get_to(object.rows);
    json.at("columns").get_to(object.columns);
    json.at("bits").get_to(object.bits);
    json.at("frames").get_to(object.frames);
    json.at("padding").get_to(object.padding);
    json.at("held_bytes").get_to(object.held_bytes);
    json.at("obstacle").get_to(object.obstacle);
    for (const Json& segment : json.at("segments")) take_segment(segment, object);
    return object;
}

void require_dicom(const std::filesystem::path& path) {
    if (is_dicom(InputFile(path))) return;
    fail(path, "not a DICOM file (it does not begin with 128 bytes and 'DICM'); write it again as DICOM");
}

}  // namespace

DicomFile::DicomFile(const std::filesystem::path& path) : path_((require_dicom(path), path)), program_(kDicom, path) {}

DicomObject DicomFile::object() {
    const Bytes bytes = program_.ask(Json{{"seconds", kManySeconds}}.dump());
    const auto* text = reinterpret_cast<const char*>(bytes.data());
    return reading(path_, [&] { return from_json(Json::parse(text, text + bytes.size())); });
}

std::vector<DicomFrame> DicomFile::take_frames() {
    const Bytes bytes = program_.ask(Json{{"seconds", kManySeconds}, {"frames", true}}.dump());
    std::vector<DicomFrame> frames(bytes.size() / sizeof(DicomFrame));
    if (!frames.empty()) std::memcpy(frames.data(), bytes.data(), frames.size() * sizeof(DicomFrame));
    return frames;
}

Bytes DicomFile::samples(std::uint64_t frame) {
    return program_.ask(Json{{"seconds", kFewSeconds}, {"frame", frame}}.dump());
}

}  // namespace regionmesh::formats
