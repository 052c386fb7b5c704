// STL: triangles without shared vertices, each region a solid of its own.
#include <array>
#include <cstdint>
#include <string>

#include "formats/codec/number_writer.h"
#include "formats/surface/file_regions.h"
#include "formats/surface/mesh_formats.h"
#include "formats/text/text_writer.h"

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

}  // namespace

void write_stl(const FileView& view, OutputFile& file) {
    const Mesh& mesh = view.mesh();
    const FileRegions regions(view);
    const GroupedFaces faces = faces_by_region(view, regions);
    TextWriter text(file);
    for (std::size_t n = 0; n < regions.all().size(); ++n) {
        text.line("solid", regions.all()[n].title + (n == 0 ? space_text(view) : ""));
        faces.for_group(n, [&](FaceId f, std::uint32_t side) {
            std::array<Vec3, 3> p;
            const auto vertices = turned_vertices(mesh, f, side);
            for (int place = 0; place < 3; ++place) p[place] = mesh.position(vertices[place]);
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

/// Binary, in single precision: one solid.
void write_region_stl(const FileView& view, const RegionStyle&, OutputFile& file) {
    constexpr std::size_t kHeadBytes = 80;
    std::string head = "binary STL of regionmesh" + space_text(view);  // must not begin with "solid"
    head.resize(kHeadBytes);
    file.write(head);
    formats::NumberWriter numbers(file);
    numbers.put(std::uint32_t{view.mesh().face_count()});
    view.for_faces([&](FaceId f) {
        std::array<Vec3, 4> p;
        const auto vertices = turned_vertices(view.mesh(), f, view.is_turned(f));
        for (int place = 0; place < 3; ++place) p[place + 1] = view.mesh().position(vertices[place]);
        p[0] = unit_normal({p[1], p[2], p[3]});
        for (const Vec3& v : p)
            for (int axis = 0; axis < 3; ++axis) numbers.put(static_cast<float>(v[axis]));
        numbers.put(std::uint16_t{0});  // attributes: none
    });
    numbers.flush();
}

}  // namespace regionmesh
