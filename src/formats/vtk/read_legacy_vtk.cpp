// VTK's files from before XML, of structured points: https://docs.vtk.org/en/latest/vtk_file_formats
#include <fmt/format.h>

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "formats/array/affine.h"
#include "formats/array/array_file.h"
#include "formats/array/volume_formats.h"
#include "formats/array/volume_size.h"
#include "formats/codec/byte_reader.h"
#include "formats/text/header_text.h"
#include "formats/vtk/label_array.h"

namespace regionmesh::formats {
namespace {

const std::map<std::string, NumberType, std::less<>>& types() {
    static const std::map<std::string, NumberType, std::less<>> kTypes{
        {"bit", NumberType::kUint8},          {"char", NumberType::kInt8},
        {"signed_char", NumberType::kInt8},   {"unsigned_char", NumberType::kUint8},
        {"short", NumberType::kInt16},        {"unsigned_short", NumberType::kUint16},
        {"int", NumberType::kInt32},          {"unsigned_int", NumberType::kUint32},
        {"long", NumberType::kInt64},         {"unsigned_long", NumberType::kUint64},
        {"vtktypeint64", NumberType::kInt64}, {"vtktypeuint64", NumberType::kUint64},
        {"vtkidtype", NumberType::kInt32},    {"float", NumberType::kFloat32},
        {"double", NumberType::kFloat64}};
    return kTypes;
}

struct LegacyArray {
    MeshArray description;
    NumberType type = NumberType::kUint8;
    std::uint64_t begin = 0, end = 0;
};

/// The parts of a file, in order.
class LegacyReader {
public:
    explicit LegacyReader(const std::filesystem::path& path) : file_(path) {
        const auto version = file_.take_line();
        if (!version || !version->starts_with("# vtk DataFile"))
            fail(path, "is no VTK file (it does not begin as one); check the file");
        file_.take_line();  // a title
        const std::string kind = lower(trim(file_.take_line().value_or("")));
        if (kind != "binary" && kind != "ascii") file_.fail_line("neither BINARY nor ASCII; the file is damaged");
        is_text = kind == "ascii";
        while (const auto line = file_.take_line()) take(*line);
        if (!has_dataset_) file_.fail("has no DATASET; the file is cut short");
    }

    std::array<std::uint64_t, 3> dimensions{};
    Vec3 spacing{1, 1, 1}, origin{0, 0, 0};
    std::vector<LegacyArray> arrays;
    bool is_text = false;

private:
    void take(std::string_view line) {
        const std::string text(line);  // the next call to the file may move its bytes
        const auto words = split_words(text);
        if (words.empty()) return;
        const std::string key = lower(words[0]);
        if (key == "dataset") {
            const std::string kind = words.size() > 1 ? lower(words[1]) : "";
            if (kind != "structured_points")
                file_.fail(
                    fmt::format("holds a {}, where a volume of labels is STRUCTURED_POINTS; save image data, or "
                                "a surface as .vtp, cells as .vtu",
                                shown(kind)));
            has_dataset_ = true;
        } else if (key == "dimensions") {
            for (std::size_t axis = 0; axis < 3; ++axis)
                dimensions[axis] = words.size() > axis + 1 ? parse_size(words[axis + 1]).value_or(0) : 0;
        } else if (key == "spacing" || key == "aspect_ratio" || key == "origin") {
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const auto number = words.size() > axis + 1 ? parse_finite(words[axis + 1]) : std::nullopt;
                if (!number) file_.fail_line("three numbers are needed");
                (key == "origin" ? origin : spacing)[static_cast<int>(axis)] = *number;
            }
        } else if (key == "point_data" || key == "cell_data") {
            is_cell_ = key == "cell_data";
            tuples_ = words.size() > 1 ? parse_size(words[1]).value_or(0) : 0;
        } else if (key == "scalars") {
            take_scalars(words);
        } else if (key == "field") {
            fields_ = words.size() > 2 ? parse_size(words[2]).value_or(0) : 0;
        } else if (fields_ > 0 && words.size() == 4) {
            --fields_;
            add(words[0], parse_size(words[1]).value_or(0), parse_size(words[2]).value_or(0), words[3]);
        } else if (key == "lookup_table" && words.size() > 2) {
            skip(4 * parse_size(words[2]).value_or(0), 1);
        } else if (key == "metadata") {
            while (const auto more = file_.take_line())  // up to an empty line
                if (trim(*more).empty()) break;
        }
    }

    void take_scalars(const std::vector<std::string_view>& words) {
        if (words.size() < 3) file_.fail_line("SCALARS needs a name and a type");
        const std::string name(words[1]), type(words[2]);
        const std::uint64_t components = words.size() > 3 ? parse_size(words[3]).value_or(1) : 1;
        const std::uint64_t before = file_.place(), lines = file_.lines();
        const auto next = file_.take_line();  // LOOKUP_TABLE name, which some leave out
        if (!next || !lower(*next).starts_with("lookup_table")) file_.go_to(before, lines);
        add(name, components, tuples_, type);
    }

    void add(std::string_view name, std::uint64_t components, std::uint64_t tuples, std::string_view type) {
        const std::string own_name(name);
        const auto found = types().find(lower(type));
        if (found == types().end() || lower(type) == "bit")
            return file_.fail(fmt::format("array '{}' is of type '{}', which is not read", shown(name), shown(type)));
        constexpr std::uint64_t kMost = std::uint64_t{1} << 50;
        if (components == 0 || components > 4096 || tuples > kMost / components)
            file_.fail(
                fmt::format("array '{}' has {} tuples of {}; the header is damaged", shown(name), tuples, components));
        LegacyArray array{.description = {.name = own_name,
                                          .is_cell = is_cell_,
                                          .is_integer = !is_real(found->second),
                                          .type = found->first,
                                          .components = components},
                          .type = found->second};
        array.begin = file_.place();
        skip(components * tuples, bytes_of(array.type));
        array.end = file_.place();
        arrays.push_back(std::move(array));
    }

    void skip(std::uint64_t numbers, std::size_t bytes) {
        if (!is_text) {
            if (file_.left() / bytes < numbers) file_.fail("ends within an array; it is truncated, fetch it again");
            file_.go_to(file_.place() + numbers * bytes, file_.lines());
            return;
        }
        for (std::uint64_t n = 0; n < numbers; ++n)
            if (!file_.take_word()) file_.fail("ends within an array; it is truncated, fetch it again");
    }

    ByteReader file_;
    bool has_dataset_ = false, is_cell_ = false;
    std::uint64_t tuples_ = 0, fields_ = 0;
};

/// The only array of single integers, or of single reals.
const LegacyArray& choose(const std::filesystem::path& path, const LegacyReader& file) {
    std::vector<MeshArray> descriptions;
    for (const LegacyArray& array : file.arrays) descriptions.push_back(array.description);
    for (const bool is_integer : {true, false}) {
        const LegacyArray* only = nullptr;
        std::size_t count = 0;
        for (const LegacyArray& array : file.arrays)
            if (array.description.is_integer == is_integer && array.description.components == 1) only = &array, ++count;
        if (count == 1) return *only;
        if (count > 1) break;
    }
    fail(path, fmt::format("has no array that alone could be labels; write a file with the labels only; its arrays: {}",
                           list_of(descriptions)));
}

}  // namespace

std::unique_ptr<SectionReader> open_legacy_vtk(const std::filesystem::path& path, const ReadOptions& options) {
    const LegacyReader file(path);
    const LegacyArray& chosen = choose(path, file);
    ArrayFile array{.format = "vtk", .source = path};
    if (is_real(chosen.type))
        array.sample = real_format(chosen.type, true);
    else
        array.sample = {sample_type(chosen.type), true};
    Columns columns;
    Vec3 steps;
    std::array<std::uint64_t, 3> size = file.dimensions;
    for (int axis = 0; axis < 3; ++axis) {
        columns[static_cast<std::size_t>(axis)][axis] = file.spacing[axis];
        std::uint64_t& count = size[static_cast<std::size_t>(axis)];
        const bool is_between = chosen.description.is_cell && count > 1;
        if (is_between) --count;
        steps[axis] = is_between ? 0.5 : 0;
    }
    array.lattice.size = checked_size(path, size);
    set_affine(path, "map to space", "mend SPACING or ORIGIN", columns,
               first_sample(columns, file.origin, steps, options), array.lattice);
    if (file.is_text) array.encoding = Encoding::kAscii;
    array.begin = chosen.begin;
    array.end = chosen.end;
    take_table_beside(array);
    return open_array(array, options);
}

}  // namespace regionmesh::formats
