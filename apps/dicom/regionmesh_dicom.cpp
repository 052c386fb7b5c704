// Reads one DICOM segmentation for another process; README.md describes the protocol.
#include <cstdio>
#include <cstring>
#include <optional>

#include "helper/serve.h"
#include "regionmesh/sandbox.h"
#include "segmentation_file.h"

namespace regionmesh::dicom {
namespace {

using Json = nlohmann::json;

constexpr helper::Program kProgram{.name = "regionmesh-dicom", .letters = {'D', 'C'}};

Json to_json(const Description& said) {
    Json segments = Json::array();
    for (const Segment& segment : said.segments) {
        segments.push_back({{"number", segment.number},
                            {"label", segment.label},
                            {"recommended_lab", segment.recommended_lab},
                            {"palette", segment.palette}});
    }
    return {{"sop_class", said.sop_class}, {"modality", said.modality},
            {"syntax", said.syntax},       {"kind", said.kind},
            {"rows", said.rows},           {"columns", said.columns},
            {"bits", said.bits},           {"frames", said.frames},
            {"padding", said.padding},     {"held_bytes", said.held_bytes},
            {"obstacle", said.obstacle},   {"segments", segments}};
}

/// To the file, and to what the C library converts texts to UTF-8 with.
void confine(const char* path) {
    enter_sandbox(
        {.reads_anything = false, .readable = {path, "/usr/lib", "/usr/lib64", "/lib", "/lib64", "/etc/ld.so.cache"}});
}

int serve(const char* path) {
    std::optional<SegmentationFile> file;
    return helper::serve(kProgram, [&](const Json& request) {
        if (!file) file.emplace(path);
        if (request.contains("frame")) {
            helper::send_answer(kProgram, file->samples(request.at("frame")));
        } else if (request.contains("frames")) {
            const std::vector<Frame> frames = file->take_frames();
            helper::send_answer(kProgram, std::as_bytes(std::span(frames)));
        } else {
            helper::send_answer(kProgram, std::string_view(helper::to_text(to_json(file->description()))));
        }
    });
}

}  // namespace
}  // namespace regionmesh::dicom

int main(int count, char** words) {
    using namespace regionmesh;
    if (count == 2 && std::strcmp(words[1], "--version") == 0)
        return std::puts("regionmesh-dicom " REGIONMESH_VERSION), 0;
    if (count != 2) {
        std::fputs("regionmesh-dicom FILE: reads DICOM segmentations for regionmesh, which starts it\n", stderr);
        return helper::kUsage;
    }
    helper::prepare_process();
    helper::run(dicom::kProgram, [&] {
        dicom::SegmentationFile::load_dictionary();
        helper::limit_memory();
        dicom::confine(words[1]);
        return dicom::serve(words[1]);
    });
}
