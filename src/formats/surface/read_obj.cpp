// Wavefront OBJ: shared points, polygons in groups.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <vector>

#include "formats/codec/byte_reader.h"
#include "formats/surface/mesh_formats.h"
#include "formats/text/header_text.h"

namespace regionmesh {
namespace {

using formats::kByteOrderMark, formats::shown;

/// The words that begin a group; the first of these that the file has decides.
constexpr std::array<std::string_view, 3> kGroupWords{"g", "o", "usemtl"};

/// Words of models that are not read.
constexpr std::array<std::string_view, 12> kOtherWords{"vt", "vn", "vp",  "s",      "mg",     "mtllib",
                                                       "l",  "p",  "lod", "maplib", "usemap", "bevel"};

class ObjReader {
public:
    explicit ObjReader(const std::filesystem::path& path) : file_(path) {
        for (std::uint32_t& group : current_) group = groups_.add({}, true);
    }

    FileSurface read() {
        if (file_.size() == 0) file_.fail("is empty; write the model again");
        if (file_.size() >= kByteOrderMark.size() && file_.peek(kByteOrderMark.size()) == kByteOrderMark)
            file_.take(kByteOrderMark.size());
        std::string whole;
        while (const auto line = file_.take_line()) {
            file_.require_line_ends(*line);
            whole += *line;
            if (whole.ends_with('\\')) {  // continued on the next line
                whole.back() = ' ';
                if (whole.size() > kLongest) file_.fail_line("is longer than a line of such a file can be");
                continue;
            }
            read_line(whole);
            whole.clear();
        }
        if (!whole.empty()) read_line(whole);
        return finish();
    }

private:
    static constexpr std::size_t kLongest = 1 << 24;

    void read_line(std::string_view rest) {
        const std::string_view word = formats::take_word(rest);
        if (word == "v") return add_point(surface_, take_point(file_, rest), file_.path());
        if (word == "f") return read_face(rest);
        if (word == "#") return read_comment(surface_, rest);
        const auto at = std::find(kGroupWords.begin(), kGroupWords.end(), word);
        if (at == kGroupWords.end()) {
            // Programs have words of their own: a file with points may have them.
            const bool is_known = word.empty() || word[0] == '#' || std::ranges::count(kOtherWords, word) > 0;
            if (!is_known && strange_.empty()) strange_ = fmt::format("line {}: '{}'", file_.lines(), shown(word));
            return;
        }
        const std::size_t kind = static_cast<std::size_t>(at - kGroupWords.begin());
        has_[kind] = true;
        current_[kind] = groups_.add(formats::one_line(rest), false);
    }

    /// Corners are "7", "7/1", "7/1/2" or "7//2", counted from 1; negative numbers count back from the last point.
    void read_face(std::string_view rest) {
        corners_.clear();
        rest = rest.substr(0, rest.find('#'));
        for (std::string_view word = formats::take_word(rest); !word.empty(); word = formats::take_word(rest)) {
            const auto number = formats::parse_label(word.substr(0, word.find('/')));
            const auto count = static_cast<std::int64_t>(surface_.points.size());
            if (!number || *number == 0 || *number > count || *number < -count)
                file_.fail_line(fmt::format("a face names point '{}' of {}", shown(word), count));
            corners_.push_back(static_cast<std::uint32_t>(*number > 0 ? *number - 1 : count + *number));
        }
        if (corners_.size() < 3) file_.fail_line("a face has fewer than three corners");
        add_polygon(surface_, corners_, {0, 0}, file_.path());
        kinds_.resize(surface_.faces.size(), current_);
    }

    FileSurface finish() {
        if (surface_.points.empty() && !strange_.empty())
            file_.fail("is no OBJ file: it has no points, and a word of another kind of file in " + strange_);
        std::size_t kind = 0;
        while (kind + 1 < kGroupWords.size() && !has_[kind]) ++kind;
        for (std::size_t f = 0; f < kinds_.size(); ++f) surface_.labels[f] = {kinds_[f][kind], 0};
        surface_.is_by_region = true;
        groups_.put_labels(surface_);
        return std::move(surface_);
    }

    formats::ByteReader file_;
    FileSurface surface_;
    RegionGroups groups_;
    std::string strange_;                              // the first word that is none of OBJ, and its line
    std::array<std::uint32_t, 3> current_;             // current group, by word
    std::array<bool, 3> has_{};                        // words seen
    std::vector<std::array<std::uint32_t, 3>> kinds_;  // by face
    std::vector<std::uint32_t> corners_;
};

}  // namespace

FileSurface read_obj(const std::filesystem::path& path) { return ObjReader(path).read(); }

}  // namespace regionmesh
