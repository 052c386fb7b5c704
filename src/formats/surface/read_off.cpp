// Object file format: points and polygons of one region.
#include <fmt/format.h>

#include <string>
#include <vector>

#include "formats/codec/byte_reader.h"
#include "formats/surface/mesh_formats.h"
#include "formats/text/header_text.h"

namespace regionmesh {
namespace {

using formats::shown;

class OffReader {
public:
    explicit OffReader(const std::filesystem::path& path) : file_(path) {}

    FileSurface read() {
        std::string_view rest = next_line("first line");
        std::string_view counts = rest;
        const std::string_view word = formats::take_word(counts);
        if (word != "OFF" && word != "COFF" && word != "NOFF" && word != "CNOFF")
            file_.fail(fmt::format("begins with '{}', and OFF files of text with OFF; convert it", shown(word)));
        if (formats::trim(counts).empty()) counts = next_line("counts");
        const std::uint64_t points = count(counts, "points"), faces = count(counts, "faces");
        // Each point takes six bytes or more, and each face eight.
        if (points > file_.size() / 6 || faces > file_.size() / 8)
            file_.fail(
                fmt::format("is too short for {} points and {} faces; it is truncated, fetch it again", points, faces));
        // Normals and colours follow the coordinates.
        for (std::uint64_t n = 0; n < points; ++n) {
            std::string_view line = next_line("points");
            add_point(surface_, take_point(file_, line), file_.path());
        }
        for (std::uint64_t n = 0; n < faces; ++n) add_face(next_line("faces"));
        surface_.is_by_region = true;
        return std::move(surface_);
    }

private:
    /// The next line that is neither blank nor a comment.
    std::string_view next_line(const char* what) {
        while (const auto line = file_.take_line()) {
            file_.require_line_ends(*line);
            line_ = line->substr(0, line->find('#'));
            if (!formats::trim(line_).empty()) return line_;
        }
        file_.fail(fmt::format("ends before its {}; it is truncated, fetch it again", what));
    }

    std::uint64_t count(std::string_view& line, const char* what) {
        const auto number = formats::parse_size(formats::take_word(line));
        if (!number) file_.fail_line(fmt::format("has no number of {}", what));
        return *number;
    }

    void add_face(std::string_view line) {
        const std::uint64_t corners = count(line, "corners");
        if (corners > line.size()) file_.fail_line(fmt::format("is too short for {} corners", corners));
        corners_.clear();
        for (std::uint64_t n = 0; n < corners; ++n) {
            const std::string_view word = formats::take_word(line);
            const auto point = formats::parse_size(word);
            if (!point || *point >= surface_.points.size())
                file_.fail_line(fmt::format("a face names point '{}' of {}", shown(word), surface_.points.size()));
            corners_.push_back(static_cast<std::uint32_t>(*point));
        }
        if (corners < 3) file_.fail_line("a face has fewer than three corners");
        add_polygon(surface_, corners_, {1, surface_.exterior_label}, file_.path());
    }

    formats::ByteReader file_;
    std::string line_;
    FileSurface surface_;
    std::vector<std::uint32_t> corners_;
};

}  // namespace

FileSurface read_off(const std::filesystem::path& path) { return OffReader(path).read(); }

}  // namespace regionmesh
