// Wavefront OBJ: shared vertices, a group for each interface.
#include <string>

#include "formats/surface/file_regions.h"
#include "formats/surface/mesh_formats.h"
#include "formats/text/text_writer.h"

namespace regionmesh {
namespace {

/// As signed numbers, like all labels in files that we read.
InputLabel number_of(const FileView& view, Label label) {
    return is_exterior(label) ? view.exterior_label() : view.labels().input(label);
}

void add_space(const FileView& view, TextWriter& text) {
    if (view.space() != Space::kUnknown) text.line(std::string("# SPACE=") + space_name(view.space()));
}

}  // namespace

void write_obj(const FileView& view, OutputFile& file) {
    const FileRegions regions(view);
    const auto& interfaces = regions.interfaces();
    TextWriter text(file);
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
    view.for_vertices([&](VertexId v) { text.line("v", view.mesh().position(v)); });
    const GroupedFaces faces(view, interfaces.size(),
                             [&](FaceId f, auto&& add) { add(regions.interface_number(f) - 1, view.is_turned(f)); });
    for (std::size_t n = 0; n < interfaces.size(); ++n) {
        const auto& [first, second] = interfaces[n].labels;
        text.add("g interface_", number_of(view, first), '_', number_of(view, second));
        text.end_line();
        faces.for_group(n, [&](FaceId f, std::uint32_t side) {
            const auto [a, b, c] = turned_vertices(view.mesh(), f, side);
            text.line("f", view.number(a) + 1, view.number(b) + 1, view.number(c) + 1);
        });
    }
    text.flush();
}

/// The group has no second label: the file has one region, with normals outward.
void write_region_obj(const FileView& view, OutputFile& file) {
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
