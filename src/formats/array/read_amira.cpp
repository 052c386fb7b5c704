// Amira's and Avizo's label fields, as ASCII or binary with uniform coordinates.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/add_warning.h"
#include "formats/array/array_file.h"
#include "formats/array/stream_reader.h"
#include "formats/array/volume_formats.h"
#include "formats/array/volume_size.h"
#include "formats/codec/byte_reader.h"
#include "formats/text/header_text.h"

namespace regionmesh::formats {
namespace {

constexpr std::size_t kMostHeaderBytes = std::size_t{4} << 20;

/// Runs of bytes: a count below 128 and the byte that is repeated, or 128 and more and so many bytes as they are.
class RunStream final : public ByteStream {
public:
    RunStream(InputFile file, std::uint64_t begin, std::uint64_t end) : packed_(std::move(file), begin, end) {}

    std::size_t read(std::span<std::byte> bytes) override {
        std::size_t done = 0;
        while (done < bytes.size()) {
            if (left_ == 0 && !begin_run()) break;
            const std::size_t count = std::min<std::size_t>(left_, bytes.size() - done);
            const auto part = bytes.subspan(done, count);
            if (!is_literal_) {
                std::ranges::fill(part, value_);
            } else if (packed_.read(part) < count) {
                problem_ = kEnds;
                break;
            }
            left_ -= static_cast<unsigned>(count);
            done += count;
        }
        return done;
    }
    void rewind() override {
        packed_.rewind();
        left_ = 0;
        problem_.clear();
    }
    const std::string& problem() const override { return problem_; }

private:
    static constexpr const char* kEnds = "the runs end before the last sample; the file is truncated, fetch it again";

    bool begin_run() {
        constexpr unsigned kLiteral = 128;
        std::byte control;
        problem_ = kEnds;
        do {
            if (packed_.read(std::span(&control, 1)) == 0) return false;
            is_literal_ = std::to_integer<unsigned>(control) >= kLiteral;
            left_ = std::to_integer<unsigned>(control) % kLiteral;
            if (!is_literal_ && packed_.read(std::span(&value_, 1)) == 0) return false;
        } while (left_ == 0);
        problem_.clear();
        return true;
    }

    PlainStream packed_;
    bool is_literal_ = false;
    unsigned left_ = 0;
    std::byte value_{};
    std::string problem_;
};

/// What the header says.
struct AmiraHeader {
    bool is_text = false, is_big_endian = false;
    std::array<std::uint64_t, 3> size{};
    std::optional<std::array<double, 6>> box = {};
    std::vector<std::string> materials = {};                 // by label
    std::vector<std::optional<std::uint32_t>> colours = {};  // likewise
    std::string type = {}, number = {}, coding = {};         // of the data: "byte", "@1", "HxByteRLE"
    std::optional<std::uint64_t> packed_bytes = {};
    std::uint64_t begin = 0;  // of the data
};

/// Words of the header: braces stand alone, commas separate, and what is in quotes is one word.
std::vector<std::string> words_of(std::string_view text) {
    std::vector<std::string> words;
    std::string word;
    const auto end_word = [&] {
        if (!word.empty()) words.push_back(std::exchange(word, {}));
    };
    bool is_quoted = false, is_comment = false;
    for (const char c : text) {
        if (c == '\n') is_comment = false;
        if (is_comment) continue;
        if (c == '"') {
            is_quoted = !is_quoted;
        } else if (is_quoted) {
            word += c;
        } else if (c == '#') {
            end_word();
            is_comment = true;
        } else if (c == '{' || c == '}' || c == '[' || c == ']') {
            end_word();
            words.emplace_back(1, c);
        } else if (kBlanksAndCommas.find(c) != std::string_view::npos) {
            end_word();
        } else {
            word += c;
        }
    }
    end_word();
    return words;
}

std::optional<std::uint32_t> colour_of(const std::vector<std::string>& words, std::size_t at) {
    std::uint32_t colour = 0;
    for (std::size_t n = 1; n <= 3; ++n) {
        const auto share = at + n < words.size() ? parse_finite(words[at + n]) : std::nullopt;
        if (!share || !(*share >= 0 && *share <= 1)) return {};
        colour = colour << 8 | static_cast<std::uint32_t>(255 * *share + 0.5);
    }
    return colour;
}

/// Takes the materials that begin behind an opening brace; returns the word behind the closing one.
std::size_t take_materials(const std::vector<std::string>& words, std::size_t at, AmiraHeader& header) {
    int depth = 1;
    for (; at < words.size() && depth > 0; ++at) {
        if (words[at] == "{") {
            ++depth;
        } else if (words[at] == "}") {
            --depth;
        } else if (depth == 1 && at + 1 < words.size() && words[at + 1] == "{") {
            header.materials.push_back(one_line(words[at]));
            header.colours.emplace_back();
        } else if (depth == 2 && words[at] == "Color" && !header.colours.empty()) {
            header.colours.back() = colour_of(words, at);
        }
    }
    return at;
}

AmiraHeader read_amira_header(const std::filesystem::path& path) {
    ByteReader file(path);
    AmiraHeader header;
    const std::string first(file.take_line().value_or(""));
    if (!first.starts_with("# AmiraMesh") && !first.starts_with("# Avizo"))
        fail(path, "is no Amira mesh (it does not begin as one); check the file");
    header.is_text = first.find("ASCII") != std::string::npos;
    header.is_big_endian = !header.is_text && first.find("LITTLE-ENDIAN") == std::string::npos;
    std::string text;
    while (true) {
        const auto line = file.take_line();
        if (!line || text.size() > kMostHeaderBytes) fail(path, "has no data section; it is truncated, fetch it again");
        if (trim(*line) == "@1") break;
        text.append(*line).append("\n");
    }
    header.begin = file.place();
    const std::vector<std::string> words = words_of(text);
    const auto refuse = [&](const std::string& what) { fail(path, what); };
    for (std::size_t n = 0; n < words.size(); ++n) {
        if (words[n] == "define" && n + 4 < words.size() && words[n + 1] == "Lattice") {
            for (std::size_t axis = 0; axis < 3; ++axis)
                header.size[axis] = parse_size(words[n + 2 + axis]).value_or(0);
        } else if (words[n] == "BoundingBox" && n + 6 < words.size()) {
            std::array<double, 6> box;
            for (std::size_t side = 0; side < 6; ++side) {
                const auto number = parse_finite(words[n + 1 + side]);
                if (!number) refuse("BoundingBox has something that is no number; mend it");
                box[side] = *number;
            }
            header.box = box;
        } else if (words[n] == "CoordType" && n + 1 < words.size() && lower(words[n + 1]) != "uniform") {
            refuse("has coordinates of the type '" + shown(words[n + 1]) + "'; uniform ones are read: resample it");
        } else if (words[n] == "Materials" && n + 1 < words.size() && words[n + 1] == "{") {
            n = take_materials(words, n + 2, header) - 1;
        } else if (words[n] == "Lattice" && n + 1 < words.size() && words[n + 1] == "{" && header.type.empty()) {
            if (n + 5 >= words.size() || words[n + 3] == "[" || words[n + 4] != "}")
                refuse("has a field of several values at each sample; labels are one: save it alone");
            header.type = words[n + 2];
            header.number = words[n + 5];
            if (header.number == "=" && n + 6 < words.size()) header.number = words[n + 6];
        }
    }
    if (header.type.empty() || header.size[0] == 0) refuse("holds no lattice; a volume of labels is needed");
    // "@1(HxByteRLE,1234)": the comma has parted it.
    const std::size_t bracket = header.number.find('(');
    if (bracket != std::string::npos) {
        header.coding = header.number.substr(bracket + 1);
        std::erase(header.coding, ')');
        const auto at = std::ranges::find(words, header.number);
        if (at != words.end() && at + 1 != words.end()) {
            std::string count = *(at + 1);
            std::erase(count, ')');
            header.packed_bytes = parse_size(count);
        }
        header.number.resize(bracket);
    }
    if (header.number != "@1") refuse("has its labels behind other data; save the label field alone");
    return header;
}

SampleFormat format_of(const std::filesystem::path& path, const AmiraHeader& header) {
    const std::string type = lower(header.type);
    if (type == "byte") return {SampleType::kU8, false};
    if (type == "short") return {SampleType::kI16, header.is_big_endian};
    if (type == "ushort") return {SampleType::kU16, header.is_big_endian};
    if (type == "int" || type == "int32") return {SampleType::kI32, header.is_big_endian};
    if (type == "float") return real_format(NumberType::kFloat32, header.is_big_endian);
    if (type == "double") return real_format(NumberType::kFloat64, header.is_big_endian);
    fail(path, "has samples of type '" + shown(header.type) + "', which is not read; labels are bytes or integers");
}

}  // namespace

std::unique_ptr<SectionReader> open_amira(const std::filesystem::path& path, const ReadOptions& options) {
    const AmiraHeader header = read_amira_header(path);
    ArrayFile array{.format = "amira", .source = path, .sample = format_of(path, header)};
    array.lattice.size = checked_size(path, header.size);
    for (std::size_t axis = 0; header.box && axis < 3; ++axis) {
        const double low = (*header.box)[2 * axis], high = (*header.box)[2 * axis + 1];
        const double parts = static_cast<double>(header.size[axis]) - 1;
        if (parts > 0 && !(high > low))
            fail(path, "has a BoundingBox without extent; give --spacing X,Y,Z, or mend it");
        if (parts > 0) array.lattice.spacing[static_cast<int>(axis)] = (high - low) / parts;
        array.lattice.origin[static_cast<int>(axis)] = low;
    }
    if (!header.box && !options.spacing)
        add_warning(array.warning, "it has no BoundingBox, so that spacings are taken as 1; give --spacing X,Y,Z");
    for (std::size_t label = 0; label < header.materials.size(); ++label) {
        const auto own = static_cast<InputLabel>(label);
        if (!header.materials[label].empty()) array.names.emplace(own, header.materials[label]);
        if (header.colours[label]) array.colours.emplace(own, *header.colours[label]);
    }
    array.begin = header.begin;
    array.remedy = "save it as raw binary";
    const bool is_in_runs = header.coding == "HxByteRLE";
    if (!header.coding.empty() && !is_in_runs && header.coding != "HxZip")
        fail(path, "is packed as '" + shown(header.coding) + "'; HxByteRLE and HxZip are read: save it as raw binary");
    if (header.is_text) array.encoding = Encoding::kAscii;
    if (header.coding == "HxZip") array.encoding = Encoding::kDeflated;
    if (!is_in_runs) return open_array(array, options);
    const InputFile file(path);
    const std::uint64_t needed = volume_bytes(path, array.lattice.size, sample_bytes(array.sample));
    const std::uint64_t packed = std::min(header.packed_bytes.value_or(file.size()), file.size() - header.begin);
    constexpr std::uint64_t kMostRun = 64;  // two bytes make at most 127
    if (needed / kMostRun > packed) fail(path, "has fewer runs than its samples need; it is truncated, fetch it again");
    VolumeInfo info = volume_info(path, array.format, array.sample.type, array.lattice.size);
    info.lattice = array.lattice;
    info.names = array.names;
    info.colours = array.colours;
    info.warning = array.warning;
    SampleFormat format = array.sample;
    return open_stream(std::make_unique<RunStream>(InputFile(path), header.begin, header.begin + packed),
                       std::move(info), {.format = format}, options, "give --sweep z, or save it as raw binary");
}

}  // namespace regionmesh::formats
