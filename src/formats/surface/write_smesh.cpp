// TetGen's .smesh and .poly: https://wias-berlin.de/software/tetgen/fformats.html
#include <bit>
#include <vector>

#include "base/exact_predicates.h"
#include "formats/surface/file_regions.h"
#include "formats/surface/mesh_formats.h"
#include "formats/surface/region_seeds.h"
#include "formats/text/text_writer.h"

namespace regionmesh {
namespace {

void write_tables(const FileView& view, const FileRegions& regions, TextWriter& text) {
    text.line("# attribute of tetrahedra, label, name");
    for (const FileRegion& region : regions.all())
        text.line("# region", regions.tag(region), view.label_text(region.label), region.word);
    text.line("# marker of faces, labels on both sides; a marker above", regions.interfaces().size(),
              "stands for itself less a multiple of that");
    for (std::size_t n = 0; n < regions.interfaces().size(); ++n) {
        const auto& [first, second] = regions.interfaces()[n].labels;
        text.line("# interface", n + 1, view.label_text(first), view.label_text(second));
    }
}

/// TetGen merges neighbouring faces with the same marker into one facet where they are flat within a tenth of a degree,
/// and so moves volume between regions. Neighbours that are nearly but not exactly flat therefore get different
/// markers: the number of their interface, plus a multiple of the number of interfaces.
class FaceMarkers {
public:
    FaceMarkers(const FileView& view, const FileRegions& regions)
        : mesh_(view.mesh()), regions_(regions), rounds_(mesh_.face_end()) {
        view.for_faces([&](FaceId f) { rounds_[index(f)] = round_of(f); });
    }

    std::size_t operator[](FaceId f) const {
        return regions_.interface_number(f) + rounds_[index(f)] * regions_.interfaces().size();
    }

private:
    /// The first multiple that no earlier neighbour has.
    std::uint8_t round_of(FaceId f) const {
        unsigned taken = 0;
        for (int place = 0; place < 3; ++place) {
            const VertexId a = mesh_[f].vertices[place], b = mesh_[f].vertices[place_after(place)],
                           c = mesh_[f].vertices[place_before(place)];
            mesh_.for_star(a, [&](FaceId g, int at) {
                if (!(g < f) || mesh_[g].labels != mesh_[f].labels) return;
                for (const int step : {1, 2})
                    if (mesh_[g].vertices[(at + step) % 3] == b && is_nearly_flat(f, g) &&
                        orientation(mesh_.position(a), mesh_.position(b), mesh_.position(c),
                                    mesh_.position(mesh_[g].vertices[(at + 3 - step) % 3])) != 0)
                        taken |= 1u << rounds_[index(g)];
            });
        }
        return static_cast<std::uint8_t>(std::countr_one(taken));
    }

    bool is_nearly_flat(FaceId f, FaceId g) const {
        constexpr double kSine = 0.02;  // about one degree
        const auto p = mesh_.corners(f), q = mesh_.corners(g);
        const Vec3 m = cross(p[1] - p[0], p[2] - p[0]), n = cross(q[1] - q[0], q[2] - q[0]);
        return length(cross(m, n)) < kSine * length(m) * length(n);
    }

    const Mesh& mesh_;
    const FileRegions& regions_;
    std::vector<std::uint8_t> rounds_;
};

/// In a .poly file each facet is a list of polygons, here one.
enum class Facets { kTriangles, kPolygonLists };

void write_tetgen(const FileView& view, Facets facets, OutputFile& file) {
    const Bodies bodies(view.mesh());
    require_closed_regions(view, bodies);
    const Seeds seeds = find_seeds(view, bodies);
    const FileRegions regions(view);
    TextWriter text(file);
    write_tables(view, regions, text);
    text.line("# vertices");
    text.line(view.mesh().vertex_count(), "3 0 0");
    view.for_vertices([&](VertexId v) { text.line(view.number(v) + 1, view.mesh().position(v)); });
    text.line("# faces");
    text.line(view.mesh().face_count(), '1');
    const FaceMarkers markers(view, regions);
    view.for_faces([&](FaceId f) {
        const auto [a, b, c] = view.face(f).vertices;
        const std::size_t marker = markers[f];
        if (facets == Facets::kPolygonLists) {
            text.line("1 0", marker);
            text.line('3', a + 1, b + 1, c + 1);
        } else {
            text.line('3', a + 1, b + 1, c + 1, marker);
        }
    });
    text.line("# holes: a point in each part of the background that is enclosed");
    text.line(seeds.holes.size());
    for (std::size_t n = 0; n < seeds.holes.size(); ++n) text.line(n + 1, seeds.holes[n].point);
    text.line("# regions: a point in each of their parts, attribute, no bound of the volume");
    text.line(seeds.regions.size());
    for (std::size_t n = 0; n < seeds.regions.size(); ++n)
        text.line(n + 1, seeds.regions[n].point, regions.tag(regions.all()[regions.number(seeds.regions[n].label) - 1]),
                  "-1");
    text.flush();
}

}  // namespace

void write_smesh(const FileView& view, OutputFile& file) { write_tetgen(view, Facets::kTriangles, file); }

void write_poly(const FileView& view, OutputFile& file) { write_tetgen(view, Facets::kPolygonLists, file); }

}  // namespace regionmesh
