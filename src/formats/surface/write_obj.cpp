// Wavefront OBJ: shared vertices, an object for each region, a group for each interface; colours in a .mtl file.
#include <cmath>
#include <string>
#include <vector>

#include "formats/surface/file_regions.h"
#include "formats/surface/mesh_formats.h"
#include "formats/text/text_writer.h"
#include "mesh/region_colours.h"

namespace regionmesh {
namespace {

/// As signed numbers, like all labels in files that we read.
InputLabel number_of(const FileView& view, Label label) {
    return is_exterior(label) ? view.exterior_label() : view.labels().input(label);
}

void add_space(const FileView& view, TextWriter& text) {
    if (view.space() != Space::kUnknown) text.line(std::string("# SPACE=") + space_name(view.space()));
}

/// The name of an object and its material: both programs and people read it.
std::string object_of(const FileView& view, const FileRegions& regions, Label label) {
    const std::uint32_t number = regions.number(label);
    return number > 0 ? regions.all()[number - 1].word : "background_" + std::to_string(number_of(view, label));
}

/// All regions, then the first labels of interfaces that are no regions.
std::vector<Label> material_labels(const FileRegions& regions) {
    std::vector<Label> labels;
    for (const FileRegion& region : regions.all()) labels.push_back(region.label);
    for (const FileInterface& interface : regions.interfaces())
        if (regions.number(interface.labels[0]) == 0 && (labels.empty() || labels.back() != interface.labels[0]))
            labels.push_back(interface.labels[0]);
    return labels;
}

void write_comments(const FileView& view, const FileRegions& regions, TextWriter& text) {
    text.line("# o REGION: faces with this region behind them");
    text.line("# g interface_A_B: faces whose normals point from label A to label B");
    add_space(view, text);
    text.line("# exterior_label", view.exterior_label());
    if (const auto background = view.background_labels()) {
        if (background->empty()) text.line("# no_background 0");
        for (const InputLabel label : *background) text.line("# background", label);
    }
    view.for_names([&](Label label, const std::string& name) {
        if (regions.number(label) > 0) text.line("# region", number_of(view, label), name);
    });
    view.for_given_colours(
        [&](Label label, std::uint32_t colour) { text.line("# colour", number_of(view, label), hex_of(colour)); });
}

/// A material is a diffuse colour, in shares of red, green and blue.
void write_materials(const FileView& view, const FileRegions& regions, OutputFile& file) {
    const std::vector<std::uint32_t> colours = region_colours(view);
    TextWriter text(file);
    for (const Label label : material_labels(regions)) {
        text.line("newmtl", object_of(view, regions, label));
        const auto [red, green, blue] = is_exterior(label) ? rgb_of(0x808080) : rgb_of(colours[view.rank(label)]);
        const auto share = [](std::uint8_t part) { return std::round(1e4 * part / 255) / 1e4; };
        text.line("Kd", share(red), share(green), share(blue));
    }
    text.flush();
}

}  // namespace

void write_obj(const FileView& view, OutputFiles& files, const std::filesystem::path& path) {
    const FileRegions regions(view);
    const auto& interfaces = regions.interfaces();
    const std::filesystem::path materials = std::filesystem::path(path).replace_extension(".mtl");
    TextWriter text(files.add(path));
    write_comments(view, regions, text);
    text.line("mtllib", materials.filename().string());
    view.for_vertices([&](VertexId v) { text.line("v", view.mesh().position(v)); });
    const GroupedFaces faces(view, interfaces.size(),
                             [&](FaceId f, auto&& add) { add(regions.interface_number(f) - 1, view.is_turned(f)); });
    for (std::size_t n = 0; n < interfaces.size(); ++n) {
        const auto& [first, second] = interfaces[n].labels;
        if (n == 0 || interfaces[n - 1].labels[0] != first) {
            text.line("o", object_of(view, regions, first));
            text.line("usemtl", object_of(view, regions, first));
        }
        text.add("g interface_", number_of(view, first), '_', number_of(view, second));
        text.end_line();
        faces.for_group(n, [&](FaceId f, std::uint32_t side) {
            const auto [a, b, c] = turned_vertices(view.mesh(), f, side);
            text.line("f", view.number(a) + 1, view.number(b) + 1, view.number(c) + 1);
        });
    }
    text.flush();
    write_materials(view, regions, files.add(materials));
}

/// The group has no second label: the file has one region, with normals outward.
void write_region_obj(const FileView& view, std::uint32_t, OutputFile& file) {
    TextWriter text(file);
    add_space(view, text);
    text.line("g", FileRegions(view).all().front().title);
    view.for_vertices([&](VertexId v) { text.line("v", view.mesh().position(v)); });
    view.for_faces([&](FaceId f) {
        const auto [a, b, c] = view.face(f).vertices;
        text.line("f", a + 1, b + 1, c + 1);
    });
    text.flush();
}

}  // namespace regionmesh
