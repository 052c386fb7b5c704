// NRRD: https://teem.sourceforge.net/nrrd/format.html
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/add_warning.h"
#include "formats/array/affine.h"
#include "formats/array/array_file.h"
#include "formats/array/header_fields.h"
#include "formats/array/nrrd_segments.h"
#include "formats/array/volume_formats.h"
#include "formats/array/volume_size.h"
#include "formats/text/header_text.h"
#include "formats/text/length_unit.h"
#include "regionmesh/label_names_file.h"

namespace regionmesh::formats {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostHeaderBytes = std::size_t{4} << 20;
constexpr std::size_t kMostAxes = 16;

struct NrrdText {
    HeaderFields fields;    // "Data File" is "datafile"
    HeaderFields values;    // of keys, which the writer chooses
    std::string behind;     // lines after the field that ends the header
    std::uint64_t end = 0;  // of the header, where attached samples begin

    std::string_view field(std::string_view name) const { return fields.text({name}); }
};

/// The bytes up to a blank line, or all of them.
std::string header_bytes(const InputFile& file) {
    std::string text;
    for (std::size_t searched = 0; text.size() < file.size();) {
        if (text.size() >= kMostHeaderBytes) fail(file.path(), "has a header of more than 4 MiB; check the file");
        const std::size_t held = text.size();
        text.resize(std::min<std::uint64_t>(file.size(), held + (std::size_t{64} << 10)));
        text.resize(held + file.read(held, std::as_writable_bytes(std::span(text).subspan(held))));
        if (text.size() == held) break;
        const std::size_t end = std::min(text.find("\n\n", searched), text.find("\n\r\n", searched));
        if (end != std::string::npos) return text.substr(0, text.find('\n', end + 1) + 1);
        searched = text.size() - 2;
    }
    return text;
}

NrrdText read_text(const InputFile& file) {
    const std::string bytes = header_bytes(file);
    if (!bytes.starts_with("NRRD0")) fail(file.path(), "not a NRRD file (it does not begin as one); check the file");
    NrrdText text{HeaderFields(file.path()), HeaderFields(file.path()), {}, bytes.size()};
    std::string_view rest = bytes;
    take_line(rest);
    while (!rest.empty()) {
        const std::string_view line = take_line(rest);
        const std::size_t colon = line.find(':');
        if (line.empty()) break;
        if (line[0] == '#' || colon == std::string_view::npos) continue;
        if (line.substr(colon).starts_with(":=")) {
            text.values.add(line.substr(0, colon), line.substr(colon + 2));
            continue;
        }
        std::string name;
        for (const char c : lower(line.substr(0, colon)))
            if (c != ' ') name += c;
        const std::string_view value = trim(line.substr(colon + 1));
        text.fields.add(name, value);
        if (name == "datafile" && value.starts_with("LIST")) {
            text.behind = rest;
            break;
        }
    }
    return text;
}

SampleType sample_type(const fs::path& path, std::string_view word) {
    static const std::map<std::string, SampleType, std::less<>> kTypes = [] {
        std::map<std::string, SampleType, std::less<>> types;
        const auto add = [&](SampleType is_signed, SampleType is_unsigned, const char* name) {
            for (const char* end : {"", " int"}) {
                types[std::string(name) + end] = types[std::string("signed ") + name + end] = is_signed;
                types[std::string("unsigned ") + name + end] = is_unsigned;
            }
        };
        add(SampleType::kI8, SampleType::kU8, "char");
        add(SampleType::kI16, SampleType::kU16, "short");
        add(SampleType::kI32, SampleType::kU32, "int");
        add(SampleType::kI64, SampleType::kU64, "long long");
        add(SampleType::kI64, SampleType::kU64, "longlong");
        for (const SampleType type : {SampleType::kI8, SampleType::kU8, SampleType::kI16, SampleType::kU16,
                                      SampleType::kI32, SampleType::kU32, SampleType::kI64, SampleType::kU64}) {
            types[to_string(type)] = types[to_string(type) + "_t"] = type;
        }
        types["uchar"] = SampleType::kU8, types["ushort"] = SampleType::kU16;
        types["uint"] = SampleType::kU32, types["ulonglong"] = SampleType::kU64;
        return types;
    }();
    const auto found = kTypes.find(lower(word));
    if (found == kTypes.end())
        fail(path, fmt::format("samples are '{}'; labels must be integers: convert them, to int say", shown(word)));
    return found->second;
}

Encoding encoding_of(const fs::path& path, std::string_view word) {
    const std::string name = lower(word);
    if (name == "raw") return Encoding::kRaw;
    if (name == "gzip" || name == "gz") return Encoding::kDeflated;
    if (name == "ascii" || name == "text" || name == "txt") return Encoding::kAscii;
    fail(path, fmt::format("encoding '{}' is not read; write it with gzip or raw", shown(word)));
}

/// An axis of the array, the fastest first.
struct Axis {
    std::uint64_t size = 0;
    std::string kind;
    std::optional<std::vector<double>> direction;  // none for axes that are not in space
    double spacing = 1, low = NAN, high = NAN;
    bool is_node_centered = false;

    /// Where the first sample lies and how far the next is, for axes that have no direction.
    double step() const {
        const double parts = static_cast<double>(is_node_centered ? size - 1 : size);
        return std::isnan(spacing) && parts > 0 ? (high - low) / parts : spacing;
    }
};

using Vectors = std::vector<std::optional<std::vector<double>>>;

/// "(1,0,0) (0,1,0) none"
std::optional<Vectors> parse_vectors(std::string_view text) {
    Vectors vectors;
    for (text = trim(text); !text.empty() && vectors.size() < kMostAxes; text = trim(text)) {
        if (text[0] != '(') {
            const std::string_view word = text.substr(0, text.find_first_of(" \t("));
            if (lower(word) != "none") return std::nullopt;
            vectors.emplace_back();
            text.remove_prefix(word.size());
            continue;
        }
        const std::size_t end = text.find(')');
        if (end == std::string_view::npos) return std::nullopt;
        std::vector<double> vector;
        for (const std::string_view word : split_words(text.substr(1, end - 1), ", \t")) {
            const auto number = parse_real(word);
            if (!number) return std::nullopt;
            vector.push_back(*number);
        }
        vectors.emplace_back(std::move(vector));
        text.remove_prefix(end + 1);
    }
    return vectors;
}

/// Calls take(axis, word) with one word of the field for each axis, unless the field is empty.
template <class Take>
void for_words(const HeaderFields& fields, std::string_view name, std::vector<Axis>& axes, Take&& take) {
    const auto words = split_words(fields.text({name}));
    if (!words.empty() && words.size() != axes.size()) fields.refuse(name, "one entry for each axis is needed");
    for (std::size_t i = 0; i < axes.size() && i < words.size(); ++i) take(axes[i], words[i]);
}

std::vector<Axis> read_axes(const HeaderFields& fields) {
    const auto dimension = parse_size(fields.text({"dimension"}));
    if (!dimension || *dimension < 1 || *dimension > kMostAxes)
        fields.refuse("dimension", "a number from 1 to 16 is needed");
    std::vector<Axis> axes(*dimension);
    if (fields.text({"sizes"}).empty()) fail(fields.path(), "has no sizes; write the header again");
    for_words(fields, "sizes", axes, [&](Axis& axis, std::string_view word) {
        axis.size = parse_size(word).value_or(0);
        if (axis.size == 0) fields.refuse("sizes", "a positive number for each axis is needed");
    });
    for_words(fields, "kinds", axes, [](Axis& axis, std::string_view word) { axis.kind = word; });
    const bool has_ends = !fields.text({"axismins"}).empty() && !fields.text({"axismaxs"}).empty();
    for (Axis& axis : axes) axis.spacing = has_ends ? NAN : 1;
    for (const auto& [name, member] :
         {std::pair("spacings", &Axis::spacing), {"axismins", &Axis::low}, {"axismaxs", &Axis::high}}) {
        for_words(fields, name, axes, [&, name = name, member = member](Axis& axis, std::string_view word) {
            const auto number = parse_real(word);
            if (!number) fields.refuse(name, "numbers are needed");
            axis.*member = *number;
        });
    }
    const char* const centers = fields.text({"centers"}).empty() ? "centerings" : "centers";
    for_words(fields, centers, axes,
              [](Axis& axis, std::string_view word) { axis.is_node_centered = lower(word) == "node"; });
    if (const std::string_view field = fields.text({"spacedirections"}); !field.empty()) {
        const auto directions = parse_vectors(field);
        if (!directions || directions->size() != axes.size())
            fields.refuse("spacedirections", "a vector or 'none' for each axis is needed");
        for (std::size_t i = 0; i < axes.size(); ++i) axes[i].direction = (*directions)[i];
    }
    return axes;
}

/// Which axes span the volume, and which one, if any, its layers. An axis of one sample that is not in space is none.
struct Roles {
    std::vector<Axis> space;
    std::optional<Axis> layers;
    bool has_layers_first = true;
};

bool is_in_space(const Axis& axis, bool has_directions) {
    if (has_directions) return axis.direction.has_value();
    const std::string kind = lower(axis.kind);
    return kind.empty() || kind == "domain" || kind == "space" || kind == "none" || kind == "???";
}

Roles find_roles(const fs::path& path, std::vector<Axis> axes) {
    const bool has_directions =
        std::any_of(axes.begin(), axes.end(), [](const Axis& axis) { return axis.direction.has_value(); });
    Roles roles;
    std::size_t place = 0, layer_place = 0, layer_axes = 0;
    for (Axis& axis : axes) {
        const bool is_space = is_in_space(axis, has_directions);
        if (!is_space && axis.size == 1) continue;
        if (is_space) {
            roles.space.push_back(std::move(axis));
        } else {
            roles.layers = std::move(axis);
            layer_place = place;
            ++layer_axes;
        }
        ++place;
    }
    while (roles.space.size() > 3 && roles.space.back().size == 1) roles.space.pop_back();
    if (roles.space.size() < 2 || roles.space.size() > 3 || layer_axes > 1) {
        fail(path, fmt::format("has {} axes in space and {} others of more than one sample; a volume has three, and "
                               "one for its layers at most",
                               roles.space.size(), layer_axes));
    }
    roles.has_layers_first = layer_place == 0;
    if (layer_axes == 1 && layer_place > 0 && layer_place < roles.space.size())
        fail(path, "has its layers between two axes in space; put them first or last");
    return roles;
}

Vec3 vector3(const fs::path& path, const std::vector<double>& vector, std::size_t space_dimension) {
    if (vector.size() != space_dimension || vector.size() < 2 || vector.size() > 3)
        fail(path, "has vectors in space that are not all of two numbers, or of three; write the header again");
    return {vector[0], vector[1], vector.size() > 2 ? vector[2] : 0};
}

/// LAS is turned into LPS. Of other spaces the numbers are kept.
Space place_in_named_space(std::string_view name, Lattice& lattice) {
    const std::string word = lower(trim(name));
    if (word == "ras" || word == "right-anterior-superior") return Space::kRas;
    if (word == "lps" || word == "left-posterior-superior") return Space::kLps;
    if (word != "las" && word != "left-anterior-superior") return Space::kUnknown;
    lattice.origin.y = -lattice.origin.y;
    for (int axis = 0; axis < 3; ++axis) lattice.direction[3 + axis] = -lattice.direction[3 + axis];
    return Space::kLps;
}

/// With the numbers of the header.
void place_in_space(const HeaderFields& fields, const std::vector<Axis>& axes, const ReadOptions& options,
                    ArrayFile& array) {
    Lattice& lattice = array.lattice;
    const fs::path& path = fields.path();
    constexpr const char* kRemedy = "mend space directions, spacings or origin";
    Columns columns{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
    Vec3 origin{0, 0, 0}, steps{0, 0, 0};
    std::string unknown;  // axes
    if (!axes[0].direction) {
        for (std::size_t i = 0; i < axes.size(); ++i) {
            const double step = axes[i].step(), low = axes[i].low;
            columns[i][static_cast<int>(i)] = std::isnan(step) ? 1 : step;
            if (std::isnan(step) && !options.spacing && axes[i].size > 1) unknown += "xyz"[i];
            if (std::isnan(low)) continue;
            origin[static_cast<int>(i)] = low;
            steps[static_cast<int>(i)] = axes[i].is_node_centered ? 0 : 0.5;
        }
        set_affine(path, "map to space", kRemedy, columns, first_sample(columns, origin, steps, options), lattice);
        if (!unknown.empty())
            add_warning(array.warning,
                        fmt::format("the spacing along {} is not known (NaN in the file), and taken as 1; "
                                    "give the right one with --spacing X,Y,Z",
                                    unknown));
        return;
    }
    const std::size_t dimension = axes[0].direction->size();
    for (std::size_t i = 0; i < axes.size(); ++i) columns[i] = vector3(path, *axes[i].direction, dimension);
    if (axes.size() == 2) {
        const Vec3 normal = cross(columns[0], columns[1]);
        columns[2] = normal / length(normal);
    }
    if (const std::string_view field = fields.text({"spaceorigin"}); !field.empty()) {
        const auto vectors = parse_vectors(field);
        if (!vectors || vectors->size() != 1 || !(*vectors)[0])
            fail(path, fmt::format("space origin is '{}': one vector is needed", shown(field)));
        origin = vector3(path, *(*vectors)[0], dimension);
    }
    set_affine(path, "map to space", kRemedy, columns, origin, lattice);
}

void set_files(const NrrdText& text, ArrayFile& array) {
    const std::string_view data = text.field("datafile");
    if (data.empty()) {
        array.begin = text.end;
    } else if (data.starts_with("LIST")) {
        array.files = listed_files(array.source, text.behind);
    } else if (is_pattern(data)) {
        array.files = numbered_files(array.source, data);
    } else {
        array.files = {file_beside(array.source, data)};
    }
    const auto take = [&](const char* field, std::int64_t least) {
        const auto number = text.field(field).empty() ? 0 : parse_integer(text.field(field));
        if (!number || *number < least) text.fields.refuse(field, "a count is needed");
        return *number;
    };
    array.skipped_lines = static_cast<std::uint64_t>(take("lineskip", 0));
    array.skipped_bytes = take("byteskip", -1);
}

void set_format(const NrrdText& text, ArrayFile& array) {
    for (const char* name : {"type", "encoding"})
        if (text.field(name).empty()) fail(array.source, fmt::format("has no {}; write the header again", name));
    const std::string type = lower(text.field("type"));
    if (type == "float" || type == "double")
        array.sample = real_format(type == "float" ? NumberType::kFloat32 : NumberType::kFloat64, false);
    else
        array.sample.type = sample_type(array.source, text.field("type"));
    array.encoding = encoding_of(array.source, text.field("encoding"));
    const std::string endian = lower(text.field("endian"));
    if (sample_bytes(array.sample) > 1 && array.encoding != Encoding::kAscii && endian != "little" && endian != "big")
        text.fields.refuse("endian", "'little' or 'big' is needed");
    array.sample.is_big_endian = endian == "big";
}

std::uint32_t chosen_layer(const fs::path& path, const std::optional<Axis>& layers, const ReadOptions& options) {
    const std::uint64_t count = layers ? layers->size : 1;
    if (count > kMostLayers) fail(path, fmt::format("has {} layers, more than {}", count, kMostLayers));
    if (count == 1 && !options.layer) return 0;
    if (!options.layer) {
        const std::string kind = layers->kind.empty() ? "" : fmt::format(" (kind '{}')", layers->kind);
        fail(path, fmt::format("holds {} layers{}, each with labels of its own; give --layer 0 to --layer {}", count,
                               kind, count - 1));
    }
    if (*options.layer >= count)
        fail(path, fmt::format("has layers 0 to {}; --layer {} is none of them", count - 1, *options.layer));
    return *options.layer;
}

/// One of the layers.
std::unique_ptr<SectionReader> open_layer(ArrayFile array, const Roles& roles, const std::vector<NrrdSegment>& segments,
                                          std::uint32_t layer, const ReadOptions& options) {
    (roles.has_layers_first ? array.components : array.blocks) =
        static_cast<std::uint32_t>(roles.layers ? roles.layers->size : 1);
    (roles.has_layers_first ? array.component : array.block) = layer;
    take_segments(segments, layer, array);
    if (array.names.empty()) take_table_beside(array);
    return open_array(array, without_choice(options));
}

}  // namespace

std::unique_ptr<SectionReader> open_nrrd(const fs::path& path, const ReadOptions& options) {
    const NrrdText text = read_text(InputFile(path));
    ArrayFile array{.format = "nrrd", .source = path};
    set_format(text, array);
    const Roles roles = find_roles(path, read_axes(text.fields));
    std::array<std::uint64_t, 3> size{1, 1, 1};
    for (std::size_t i = 0; i < roles.space.size(); ++i) size[i] = roles.space[i].size;
    array.lattice.size = checked_size(path, size);
    place_in_space(text.fields, roles.space, options, array);
    array.space = place_in_named_space(text.fields.text({"space"}), array.lattice);
    array.metres = metres_in_quoted(text.fields.text({"spaceunits", "units"}));
    set_files(text, array);
    const std::vector<NrrdSegment> segments = segments_of(text.values);
    const std::uint64_t layers = roles.layers ? roles.layers->size : 1;
    if (layers > 1 && layers <= kMostLayers && !segments.empty() && !options.layer && options.threshold.empty())
        return join_segments(
            segments, layers, array, [&](std::uint32_t layer) { return open_layer(array, roles, {}, layer, options); },
            options.priority);
    return open_layer(array, roles, segments, chosen_layer(path, roles.layers, options), options);
}

}  // namespace regionmesh::formats
