// STL in text or binary: triangles, each with its own points; a solid is a region.
#include <array>
#include <optional>

#include "formats/codec/byte_reader.h"
#include "formats/surface/mesh_formats.h"
#include "formats/surface/stl_attributes.h"
#include "formats/text/header_text.h"

namespace regionmesh {
namespace {

constexpr std::size_t kHeadBytes = 80, kFaceBytes = 50;
constexpr bool kIsBigEndian = false;

/// Recognises a binary file by its size, which follows from its number of faces; some begin with "solid", too.
std::optional<std::uint32_t> faces_of_binary(const std::filesystem::path& path) {
    formats::ByteReader file(path);
    if (file.size() < kHeadBytes + 4) return std::nullopt;
    file.take(kHeadBytes);
    const auto count = file.take_number<std::uint32_t>(kIsBigEndian);
    if (file.left() != std::uint64_t{count} * kFaceBytes) return std::nullopt;
    return count;
}

void add_face(FileSurface& surface, const std::array<Vec3, 3>& points, std::uint32_t group,
              const std::filesystem::path& path) {
    const auto first = static_cast<std::uint32_t>(surface.points.size());
    for (const Vec3& point : points) add_point(surface, point, path);
    add_polygon(surface, std::array{first, first + 1, first + 2}, {group, 0}, path);
}

void read_binary(formats::ByteReader& file, std::uint32_t count, RegionGroups& groups, FileSurface& surface) {
    const auto bytes = file.take(kHeadBytes);
    const std::string head(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    read_space(surface, head);
    const bool has_labels = head.starts_with("binary STL of regionmesh") && head.find(kStlAttributes) != head.npos;
    file.take(4);
    std::optional<std::uint32_t> group;
    for (std::uint32_t f = 0; f < count; ++f) {
        file.take(3 * sizeof(float));  // the normal; it follows from the corners
        std::array<Vec3, 3> points;
        for (Vec3& point : points)
            for (int axis = 0; axis < 3; ++axis) point[axis] = file.take_number<float>(kIsBigEndian);
        const auto attribute = file.take_number<std::uint16_t>(kIsBigEndian);
        if (has_labels)
            group = groups.add("region_" + std::to_string(attribute), false);
        else if (!group)
            group = groups.add({}, true);
        add_face(surface, points, *group, file.path());
    }
}

void read_text(formats::ByteReader& file, RegionGroups& groups, FileSurface& surface) {
    std::optional<std::uint32_t> group;
    std::array<Vec3, 3> corners;
    int count = 0;
    bool is_open = false;
    while (const auto line = file.take_line()) {
        std::string_view rest = *line;
        if (rest.find('\0') != std::string_view::npos)
            file.fail_line(
                "is no text, and the file has not the size of a binary STL file with as many faces as it says");
        file.require_line_ends(rest);
        const std::string word = formats::lower(formats::take_word(rest));
        if (word == "solid") {
            read_space(surface, rest);
            rest = rest.substr(0, rest.find(" SPACE="));
            group = groups.add(formats::one_line(rest), true);
            is_open = true;
        } else if (word == "vertex") {
            if (!group) file.fail_line("a vertex comes before the first solid");
            if (count == 3) file.fail_line("a facet has more than three vertices: write triangles");
            corners[count++] = take_point(file, rest);
        } else if (word == "endfacet") {
            if (count != 3) file.fail_line("a facet has " + std::to_string(count) + " vertices: three are needed");
            add_face(surface, corners, *group, file.path());
            count = 0;
        } else if (word == "endsolid") {
            is_open = false;
        } else if (word != "facet" && word != "outer" && word != "endloop" && !word.empty()) {
            file.fail_line("'" + formats::shown(word) + "' is no word of an STL file");
        }
    }
    if (!group) file.fail("is no STL file: it has no solid");
    if (is_open || count != 0) file.fail("ends within a solid: it was cut short");
}

}  // namespace

FileSurface read_stl(const std::filesystem::path& path) {
    FileSurface surface{.background = std::vector<InputLabel>{}, .is_by_region = true, .has_shared_points = false};
    RegionGroups groups;
    const auto count = faces_of_binary(path);
    formats::ByteReader file(path);
    if (count)
        read_binary(file, *count, groups, surface);
    else
        read_text(file, groups, surface);
    groups.put_labels(surface);
    return surface;
}

}  // namespace regionmesh
