// Gmsh's MSH 4.1 with the faces, and a .geo script that makes volumes of them:
// https://gmsh.info/doc/texinfo/gmsh.html#MSH-file-format
#include <algorithm>
#include <array>
#include <map>
#include <string>
#include <vector>

#include "formats/surface/file_regions.h"
#include "formats/surface/mesh_formats.h"
#include "formats/surface/region_seeds.h"
#include "formats/text/text_writer.h"

namespace regionmesh {
namespace {

constexpr int kTriangle = 2;  // Gmsh's number for the type of element

/// A surface of Gmsh has one shell on each side, so that volumes consist of whole surfaces; it lies on at most one side
/// of the box.
struct Surface {
    std::array<std::uint32_t, 2> shells;  // of the first label and of the second, in the order of files
    int box_side;                         // -1: none
    std::uint32_t interface;              // its number
    Box box;

    friend bool operator<(const Surface& a, const Surface& b) {
        return std::tie(a.interface, a.box_side, a.shells) < std::tie(b.interface, b.box_side, b.shells);
    }
};

/// The side of the box on which all three vertices lie, if a label of the face is its exterior.
int box_side_of(const Mesh& mesh, FaceId f) {
    for (const Label label : mesh[f].labels) {
        if (!is_exterior(label)) continue;
        SideSet common = 63;
        for (const VertexId v : mesh[f].vertices) common &= mesh[v].sides;
        if (common >> side_of(label) & 1) return side_of(label);
    }
    return -1;
}

class MshWriter {
public:
    explicit MshWriter(const FileView& view)
        : view_(view), mesh_(view.mesh()), bodies_(mesh_), regions_(view), faces_(list_surfaces()) {
        require_closed_regions(view, bodies_);
    }

    void write_mesh(OutputFile& file) const;
    void write_volumes(const std::string& mesh_name, OutputFile& file) const;

private:
    Surface surface_of(FaceId f) const;
    GroupedFaces list_surfaces();
    void write_names(TextWriter& text) const;
    void write_entities(TextWriter& text) const;
    void write_nodes(TextWriter& text) const;
    void write_elements(TextWriter& text) const;
    /// Numbers of physical surfaces: interfaces, then the six sides of the box.
    std::size_t side_number(int side) const {
        return regions_.interfaces().size() + static_cast<std::size_t>(side) + 1;
    }

    const FileView& view_;
    const Mesh& mesh_;
    Bodies bodies_;
    FileRegions regions_;
    std::vector<Surface> surfaces_;  // number n + 1
    std::array<bool, 6> has_side_{};
    GroupedFaces faces_;  // by surface
};

Surface MshWriter::surface_of(FaceId f) const {
    Surface surface{{bodies_.shell(face_side(f, 0)), bodies_.shell(face_side(f, 1))},
                    box_side_of(mesh_, f),
                    regions_.interface_number(f),
                    {}};
    if (view_.is_turned(f)) std::swap(surface.shells[0], surface.shells[1]);
    return surface;
}

GroupedFaces MshWriter::list_surfaces() {
    std::map<Surface, Box> found;
    view_.for_faces([&](FaceId f) {
        Box& box = found[surface_of(f)];
        for (const Vec3 p : mesh_.corners(f)) box.add(p);
    });
    std::map<Surface, std::size_t> places;
    for (const auto& [surface, box] : found) {
        places[surface] = surfaces_.size();
        surfaces_.push_back(surface);
        surfaces_.back().box = box;
        if (surface.box_side >= 0) has_side_[surface.box_side] = true;
    }
    return GroupedFaces(view_, surfaces_.size(),
                        [&](FaceId f, auto&& add) { add(places.at(surface_of(f)), view_.is_turned(f)); });
}

void MshWriter::write_names(TextWriter& text) const {
    const auto& interfaces = regions_.interfaces();
    text.line("$PhysicalNames");
    text.line(interfaces.size() + static_cast<std::size_t>(std::ranges::count(has_side_, true)));
    for (std::size_t n = 0; n < interfaces.size(); ++n) text.line('2', n + 1, '"' + interfaces[n].name + '"');
    for (int side = 0; side < 6; ++side)
        if (has_side_[side]) text.line('2', side_number(side), '"' + std::string(kSideNames[side]) + '"');
    text.line("$EndPhysicalNames");
}

void MshWriter::write_entities(TextWriter& text) const {
    text.line("$Entities");
    text.line("0 0", surfaces_.size(), '0');
    for (std::size_t n = 0; n < surfaces_.size(); ++n) {
        const Surface& surface = surfaces_[n];
        text.add(n + 1, ' ', surface.box.low, ' ', surface.box.high);
        if (surface.box_side < 0)
            text.add(" 1 ", surface.interface);
        else
            text.add(" 2 ", surface.interface, ' ', side_number(surface.box_side));
        text.line(" 0");
    }
    text.line("$EndEntities");
}

/// Each vertex belongs to the first surface that it lies on.
void MshWriter::write_nodes(TextWriter& text) const {
    std::vector<bool> done(mesh_.vertex_end());
    std::vector<VertexId> own;
    text.line("$Nodes");
    text.line(surfaces_.size(), mesh_.vertex_count(), '1', mesh_.vertex_count());
    for (std::size_t n = 0; n < surfaces_.size(); ++n) {
        own.clear();
        faces_.for_group(n, [&](FaceId f, std::uint32_t) {
            for (const VertexId v : mesh_[f].vertices) {
                if (!done[index(v)]) own.push_back(v);
                done[index(v)] = true;
            }
        });
        text.line('2', n + 1, '0', own.size());
        for (const VertexId v : own) text.line(view_.number(v) + 1);
        for (const VertexId v : own) text.line(mesh_.position(v));
    }
    text.line("$EndNodes");
}

void MshWriter::write_elements(TextWriter& text) const {
    text.line("$Elements");
    text.line(surfaces_.size(), mesh_.face_count(), '1', mesh_.face_count());
    std::size_t number = 0;
    for (std::size_t n = 0; n < surfaces_.size(); ++n) {
        text.line('2', n + 1, kTriangle, faces_.count(n));
        faces_.for_group(n, [&](FaceId f, std::uint32_t side) {
            const auto [a, b, c] = turned_vertices(mesh_, f, side);
            text.line(++number, view_.number(a) + 1, view_.number(b) + 1, view_.number(c) + 1);
        });
    }
    text.line("$EndElements");
}

void MshWriter::write_mesh(OutputFile& file) const {
    TextWriter text(file);
    text.line("$MeshFormat");
    text.line("4.1 0 8");
    text.line("$EndMeshFormat");
    write_names(text);
    write_entities(text);
    write_nodes(text);
    write_elements(text);
    text.flush();
}

/// A loop of surfaces for each shell of a region; a volume for each body: its outer loop without those of its cavities.
void MshWriter::write_volumes(const std::string& mesh_name, OutputFile& file) const {
    std::vector<std::string> loops(bodies_.shell_count());
    for (std::size_t n = 0; n < surfaces_.size(); ++n)
        for (int side = 0; side < 2; ++side) {
            std::string& loop = loops[surfaces_[n].shells[side]];
            loop += (loop.empty() ? "" : ", ") + std::string(side == 0 ? "" : "-") + std::to_string(n + 1);
        }
    std::map<std::uint32_t, std::string> volumes;  // by number of region
    TextWriter text(file);
    text.line("// Volumes for the faces of", mesh_name + ": gmsh -3 this file");
    text.line("Merge \"" + mesh_name + "\";");
    text.line("Mesh.AngleToleranceFacetOverlap = 0.001;  // degrees; with 0.1, the default, thin regions are refused");
    std::size_t count = 0;
    for (const Body& body : bodies_.all()) {
        const std::uint32_t region = regions_.number(body.label);
        if (region == 0) continue;
        std::string shells;
        for (const std::uint32_t shell : body.shells) {
            text.line("Surface Loop(" + std::to_string(shell + 1) + ") = {" + loops[shell] + "};");
            shells += (shells.empty() ? "" : ", ") + std::to_string(shell + 1);
        }
        text.line("Volume(" + std::to_string(++count) + ") = {" + shells + "};");
        volumes[region] += (volumes[region].empty() ? "" : ", ") + std::to_string(count);
    }
    for (const auto& [number, list] : volumes)
        text.line("Physical Volume(\"" + regions_.all()[number - 1].word + "\", " +
                  std::to_string(regions_.tag(regions_.all()[number - 1])) + ") = {" + list + "};");
    text.flush();
}

}  // namespace

void write_msh(const FileView& view, OutputFiles& files, const std::filesystem::path& path) {
    const MshWriter writer(view);
    writer.write_mesh(files.add(path));
    writer.write_volumes(path.filename().string(), files.add(std::filesystem::path(path).replace_extension(".geo")));
}

}  // namespace regionmesh
