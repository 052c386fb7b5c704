// STL, in text or binary: triangles, each with its own points; a solid is a region.
#include <bit>
#include <cmath>
#include <cstring>
#include <optional>

#include "formats/codec/byte_reader.h"
#include "formats/surface/mesh_formats.h"
#include "formats/text/header_text.h"

namespace regionmesh {
namespace {

static_assert(std::endian::native == std::endian::little, "numbers are taken as they lie in the file");

constexpr std::size_t kHeadBytes = 80, kFaceBytes = 50;

/// A binary file has the size that its number of faces calls for; many begin with "solid" all the same.
std::optional<std::uint32_t> faces_of_binary(const std::filesystem::path& path) {
    formats::ByteReader file(path);
    if (file.size() < kHeadBytes + 4) return std::nullopt;
    file.take(kHeadBytes);
    std::uint32_t count = 0;
    std::memcpy(&count, file.take(sizeof count).data(), sizeof count);
    if (file.left() != std::uint64_t{count} * kFaceBytes) return std::nullopt;
    return count;
}

void add_face(FileSurface& surface, const std::array<Vec3, 3>& corners, std::uint32_t group) {
    const auto first = static_cast<std::uint32_t>(surface.points.size());
    surface.points.insert(surface.points.end(), corners.begin(), corners.end());
    surface.faces.push_back({first, first + 1, first + 2});
    surface.labels.push_back({group, 0});
}

void read_binary(formats::ByteReader& file, std::uint32_t count, RegionGroups& groups, FileSurface& surface) {
    if (count > kMostFaces) file.fail("has more faces than a model can hold");
    file.take(kHeadBytes + 4);
    const std::uint32_t group = groups.add({}, true);
    for (std::uint32_t f = 0; f < count; ++f) {
        float numbers[12];  // the normal, which follows from the corners, and these
        std::memcpy(numbers, file.take(kFaceBytes).data(), sizeof numbers);
        for (int n = 3; n < 12; ++n)
            if (!std::isfinite(numbers[n]))
                file.fail("face " + std::to_string(f) + " has a coordinate that is not finite");
        const auto corner = [&](int n) { return Vec3{numbers[n], numbers[n + 1], numbers[n + 2]}; };
        add_face(surface, {corner(3), corner(6), corner(9)}, group);
    }
}

Vec3 read_vertex(const formats::ByteReader& file, std::string_view rest) {
    Vec3 point;
    for (int axis = 0; axis < 3; ++axis) {
        const std::string_view word = formats::take_word(rest);
        const auto value = formats::to_real(word);
        if (!value) file.fail_line("'" + std::string(word.substr(0, 40)) + "' stands where a coordinate belongs");
        point[axis] = *value;
    }
    return point;
}

void read_text(formats::ByteReader& file, RegionGroups& groups, FileSurface& surface) {
    std::optional<std::uint32_t> group;
    std::array<Vec3, 3> corners;
    int count = 0;
    while (const auto line = file.take_line()) {
        std::string_view rest = *line;
        if (rest.find('\0') != std::string_view::npos)
            file.fail_line(
                "is no text, and the file has not the size of a binary STL file with as many faces as it says");
        const std::string_view word = formats::take_word(rest);
        if (word == "solid") {
            group = groups.add(formats::one_line(rest), true);
        } else if (word == "vertex") {
            if (!group) file.fail_line("a vertex comes before the first solid");
            if (count == 3) file.fail_line("a facet has more than three vertices: write triangles");
            corners[count++] = read_vertex(file, rest);
        } else if (word == "endfacet") {
            if (count != 3) file.fail_line("a facet has " + std::to_string(count) + " vertices: three are needed");
            add_face(surface, corners, *group);
            count = 0;
        } else if (word != "facet" && word != "outer" && word != "endloop" && word != "endsolid" && !word.empty()) {
            file.fail_line("'" + std::string(word.substr(0, 40)) + "' is no word of an STL file");
        }
        if (surface.faces.size() > kMostFaces) file.fail("has more faces than a model can hold");
    }
    if (!group) file.fail("is no STL file: it has no solid");
    if (count != 0) file.fail("ends within a facet: it was cut short");
}

}  // namespace

FileSurface read_stl(const std::filesystem::path& path) {
    FileSurface surface{.is_by_region = true, .has_shared_points = false};
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
