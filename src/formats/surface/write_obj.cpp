// Wavefront OBJ: shared vertices, an object for each region, a group for each interface; colours in a .mtl file.
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "formats/surface/file_regions.h"
#include "formats/surface/file_surface.h"
#include "formats/surface/mesh_formats.h"
#include "formats/text/text_writer.h"
#include "surface/region_colours.h"

namespace regionmesh {
namespace {

void add_coordinates(const FileView& view, TextWriter& text) {
    for (const std::string& comment : coordinate_comments(view.coordinates())) text.line("#", comment);
}

/// The name of an object and its material: both programs and people read it.
std::string object_of(const FileView& view, const FileRegions& regions, Label label) {
    const std::uint32_t number = regions.number(label);
    return number > 0 ? regions.all()[number - 1].word : "background_" + view.label_text(label);
}

/// The object that each interface belongs to, as a place in `labels`: a region, or a background label.
struct Objects {
    explicit Objects(const FileRegions& regions);

    std::vector<Label> labels;              // the regions in the order of files, then background
    std::vector<std::uint32_t> interfaces;  // by interface

private:
    void share_out(const std::vector<std::array<std::uint32_t, 2>>& both);
};

/// An interface with background or the exterior belongs to its region.
Objects::Objects(const FileRegions& regions) {
    std::vector<std::array<std::uint32_t, 2>> both;  // regions by interface, twice the same where there is no choice
    for (const FileRegion& region : regions.all()) labels.push_back(region.label);
    for (const FileInterface& interface : regions.interfaces()) {
        const auto& [first, second] = interface.labels;
        const std::uint32_t a = regions.number(first), b = regions.number(second);
        if (a == 0 && b == 0 && (labels.size() == regions.all().size() || labels.back() != first))
            labels.push_back(first);
        const auto none = static_cast<std::uint32_t>(labels.size());
        both.push_back(a == 0 && b == 0 ? std::array{none - 1, none - 1}
                                        : std::array{(a > 0 ? a : b) - 1, (b > 0 ? b : a) - 1});
    }
    share_out(both);
}

/// Of two regions, an interface belongs to the one that has no interface yet and fewer left. So a region without one
/// remains only where, in a connected part of the model, there are fewer interfaces than regions.
void Objects::share_out(const std::vector<std::array<std::uint32_t, 2>>& both) {
    constexpr std::uint32_t kNone = UINT32_MAX;
    std::vector<std::vector<std::uint32_t>> shared(labels.size());
    std::vector<std::size_t> left(labels.size()), next(labels.size());
    std::vector<bool> has_own(labels.size());
    interfaces.assign(both.size(), kNone);
    for (std::uint32_t n = 0; n < both.size(); ++n) {
        const auto [a, b] = both[n];
        if (a == b) {
            interfaces[n] = a;
            has_own[a] = true;
            continue;
        }
        for (const std::uint32_t region : both[n]) shared[region].push_back(n), ++left[region];
    }
    const auto key = [&](std::uint32_t region) { return std::tuple(has_own[region], left[region], region); };
    std::set<std::tuple<bool, std::size_t, std::uint32_t>> order;
    for (std::uint32_t region = 0; region < labels.size(); ++region)
        if (left[region] > 0) order.insert(key(region));
    while (!order.empty()) {
        const std::uint32_t owner = std::get<2>(*order.begin());
        while (interfaces[shared[owner][next[owner]]] != kNone) ++next[owner];
        const std::uint32_t n = shared[owner][next[owner]];
        for (const std::uint32_t region : both[n]) order.erase(key(region));
        interfaces[n] = owner;
        has_own[owner] = true;
        for (const std::uint32_t region : both[n])
            if (--left[region] > 0) order.insert(key(region));
    }
}

void write_comments(const FileView& view, const FileRegions& regions, TextWriter& text) {
    text.line("# o REGION: interfaces of this region, normals outward; each interface is in one of its two regions");
    text.line("# g interface_A_B: faces whose normals point from label A to label B");
    add_coordinates(view, text);
    text.line("# exterior_label", view.exterior_label());
    const std::vector<InputLabel> background = view.background_labels();
    if (background.empty()) text.line("# no_background 0");
    for (const InputLabel label : background) text.line("# background", view.labels().text(label));
    view.for_names([&](Label label, const std::string& name) {
        if (regions.number(label) == 0) return;
        // A line that ends in a backslash goes on in the next one.
        text.line("# region", view.label_text(label), name.ends_with('\\') ? name + ' ' : name);
    });
    view.for_given_colours(
        [&](Label label, std::uint32_t colour) { text.line("# colour", view.label_text(label), hex_of(colour)); });
}

/// A material is a diffuse colour, in shares of red, green and blue.
void write_materials(const FileView& view, const FileRegions& regions, const Objects& objects, OutputFile& file) {
    const std::vector<std::uint32_t> colours = region_colours(view);
    TextWriter text(file);
    for (const Label label : objects.labels) {
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
    const Objects objects(regions);
    const auto& interfaces = regions.interfaces();
    const std::filesystem::path materials = std::filesystem::path(path).replace_extension(".mtl");
    TextWriter text(files.add(path));
    write_comments(view, regions, text);
    text.line("mtllib", materials.filename().string());
    view.for_vertices([&](VertexId v) { text.line("v", view.mesh().position(v)); });
    const GroupedFaces faces(view, interfaces.size(),
                             [&](FaceId f, auto&& add) { add(regions.interface_number(f) - 1, view.is_turned(f)); });
    std::vector<std::uint32_t> order(interfaces.size());
    std::iota(order.begin(), order.end(), std::uint32_t{0});
    std::ranges::stable_sort(order, {}, [&](std::uint32_t n) { return objects.interfaces[n]; });
    std::uint32_t last = UINT32_MAX;
    for (const std::uint32_t n : order) {
        if (const std::uint32_t object = objects.interfaces[n]; object != last) {
            text.line("o", object_of(view, regions, objects.labels[object]));
            text.line("usemtl", object_of(view, regions, objects.labels[object]));
            last = object;
        }
        auto [first, second] = interfaces[n].labels;
        const bool is_outward = second != objects.labels[last];
        if (!is_outward) std::swap(first, second);
        text.add("g interface_", view.label_text(first), '_', view.label_text(second));
        text.end_line();
        faces.for_group(n, [&](FaceId f, std::uint32_t side) {
            const auto [a, b, c] = turned_vertices(view.mesh(), f, is_outward ? side : 1 - side);
            text.line("f", view.number(a) + 1, view.number(b) + 1, view.number(c) + 1);
        });
    }
    text.flush();
    write_materials(view, regions, objects, files.add(materials));
}

void write_materials_of_regions(const FileView& view, OutputFile& file) {
    const FileRegions regions(view);
    write_materials(view, regions, Objects(regions), file);
}

/// The group has no second label: the file has one region, with normals outward.
void write_region_obj(const FileView& view, const RegionStyle& style, OutputFile& file) {
    TextWriter text(file);
    add_coordinates(view, text);
    text.line("mtllib", style.material_file);
    text.line("g", FileRegions(view).all().front().title);
    text.line("usemtl", style.material);
    view.for_vertices([&](VertexId v) { text.line("v", view.mesh().position(v)); });
    view.for_faces([&](FaceId f) {
        const auto [a, b, c] = view.face(f).vertices;
        text.line("f", a + 1, b + 1, c + 1);
    });
    text.flush();
}

}  // namespace regionmesh
