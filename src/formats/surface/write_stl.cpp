// STL: triangles without shared vertices, each region closed by itself.
#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <utility>

#include "formats/codec/number_writer.h"
#include "formats/registry.h"
#include "formats/surface/file_regions.h"
#include "formats/surface/mesh_formats.h"
#include "formats/surface/stl_attributes.h"
#include "formats/text/header_text.h"
#include "formats/text/text_writer.h"
#include "regionmesh/error.h"
#include "regionmesh/write_ascii_stl.h"

namespace regionmesh {
namespace {

Vec3 unit_normal(const std::array<Vec3, 3>& p) {
    const Vec3 normal = cross(p[1] - p[0], p[2] - p[0]);
    const double size = length(normal);
    return size > 0 ? normal / size : Vec3{};
}

/// " SPACE=RAS": 3D Slicer looks for it in the first line, or in the header of a binary file.
std::string space_text(const FileView& view) {
    const Space space = view.coordinates().space;
    return space == Space::kUnknown ? std::string() : std::string(" SPACE=") + space_name(space);
}

// Some programs take the highest bit of the attribute for "has a colour".
constexpr InputLabel kMostInAttribute = 0x7FFF;

std::array<Vec3, 3> corners_of(const Mesh& mesh, FaceId f, std::uint32_t side) {
    std::array<Vec3, 3> p;
    const auto vertices = turned_vertices(mesh, f, side);
    for (int place = 0; place < 3; ++place) p[place] = mesh.position(vertices[place]);
    return p;
}

void write_head(std::string head, std::uint32_t face_count, OutputFile& file, formats::NumberWriter& numbers) {
    constexpr std::size_t kHeadBytes = 80;
    head.resize(kHeadBytes);  // must not begin with "solid"
    file.write(head);
    numbers.put(face_count);
}

void put_face(const std::array<Vec3, 3>& p, std::uint16_t attribute, formats::NumberWriter& numbers) {
    const Vec3 normal = unit_normal(p);
    for (const Vec3& v : {normal, p[0], p[1], p[2]})
        for (int axis = 0; axis < 3; ++axis) numbers.put(static_cast<float>(v[axis]));
    numbers.put(attribute);
}

void write_text(const FileView& view, const FileRegions& regions, OutputFile& file) {
    const Mesh& mesh = view.mesh();
    const GroupedFaces faces = faces_by_region(view, regions);
    TextWriter text(file);
    for (std::size_t n = 0; n < regions.all().size(); ++n) {
        text.line("solid", regions.all()[n].title + (n == 0 ? space_text(view) : ""));
        faces.for_group(n, [&](FaceId f, std::uint32_t side) {
            const std::array<Vec3, 3> p = corners_of(mesh, f, side);
            text.line("facet normal", unit_normal(p));
            text.line(" outer loop");
            for (const Vec3 corner : p) text.line("  vertex", corner);
            text.line(" endloop");
            text.line("endfacet");
        });
        text.line("endsolid", regions.all()[n].title);
    }
    if (regions.all().empty()) {
        text.line("solid empty");
        text.line("endsolid empty");
    }
    text.flush();
}

bool fits_in_attributes(const FileView& view, const FileRegions& regions) {
    return !regions.all().empty() && std::ranges::all_of(regions.all(), [&](const FileRegion& region) {
        const InputLabel label = view.labels().input(region.label);
        return label >= 0 && label <= kMostInAttribute;
    });
}

}  // namespace

/// Binary, in single precision, with the label of its region as attribute of each face; text where a label does not
/// fit.
void write_stl(const FileView& view, OutputFile& file) {
    const FileRegions regions(view);
    if (!fits_in_attributes(view, regions)) return write_text(view, regions, file);
    const GroupedFaces faces = faces_by_region(view, regions);
    std::size_t count = 0;
    for (std::size_t n = 0; n < regions.all().size(); ++n) count += faces.count(n);
    formats::NumberWriter numbers(file);
    write_head("binary STL of regionmesh" + std::string(kStlAttributes) + space_text(view),
               static_cast<std::uint32_t>(count), file, numbers);
    for (std::size_t n = 0; n < regions.all().size(); ++n) {
        const auto label = static_cast<std::uint16_t>(view.labels().input(regions.all()[n].label));
        faces.for_group(
            n, [&](FaceId f, std::uint32_t side) { put_face(corners_of(view.mesh(), f, side), label, numbers); });
    }
    numbers.flush();
}

void write_ascii_stl(const Mesh& mesh, const LabelTable& labels, const std::filesystem::path& path,
                     const WriteOptions& options, OutputFiles& files) {
    if (formats::extension(path) != ".stl") throw Error(ErrorCode::kOutput, path.string() + ": text is for .stl");
    LabelNames names;
    for (const auto& [label, name] : options.names)
        if (std::string line = formats::one_line(name); !line.empty()) names.emplace(label, std::move(line));
    FileView view(mesh, labels, options.background, names);
    view.set_coordinates(options.coordinates);
    write_text(view, FileRegions(view), files.add(path));
}

/// Binary, in single precision: one solid, without attributes.
void write_region_stl(const FileView& view, const RegionStyle&, OutputFile& file) {
    formats::NumberWriter numbers(file);
    write_head("binary STL of regionmesh" + space_text(view), view.mesh().face_count(), file, numbers);
    view.for_faces([&](FaceId f) { put_face(corners_of(view.mesh(), f, view.is_turned(f)), 0, numbers); });
    numbers.flush();
}

}  // namespace regionmesh
