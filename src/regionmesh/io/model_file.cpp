#include "regionmesh/io/model_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <optional>
#include <string>

#include "regionmesh/base/error.h"
#include "regionmesh/io/model_formats.h"
#include "regionmesh/io/output_file.h"

namespace regionmesh {
namespace {

std::string extension_of(const std::filesystem::path& path) {
    std::string extension = path.extension().string();
    std::ranges::transform(extension, extension.begin(),
                           [](unsigned char c) { return static_cast<char>(c >= 'A' && c <= 'Z' ? c + 32 : c); });
    return extension;
}

[[noreturn]] void refuse_extension(ErrorCode code, const std::filesystem::path& path) {
    throw Error(code, fmt::format("{}: no model format has the extension '{}': use .vtp or .ply", path.string(),
                                  path.extension().string()));
}

// The extension of a format that models are written in.
std::string writable_extension(const std::filesystem::path& path, bool with_point_arrays) {
    const std::string extension = extension_of(path);
    if (extension != ".vtp" && extension != ".ply") refuse_extension(ErrorCode::kOutput, path);
    if (with_point_arrays && extension != ".vtp")
        throw Error(ErrorCode::kOutput,
                    fmt::format("{}: only .vtp files hold a number for each vertex", path.string()));
    return extension;
}

Box bounding_box(const FileSurface& surface) {
    Box box;
    for (const auto& face : surface.faces)
        for (const std::uint32_t v : face) box.add(surface.points[v]);
    return box;
}

// The side of the box in whose plane the face lies, exactly.
std::optional<int> side_of_face(const FileSurface& surface, const std::array<std::uint32_t, 3>& face, const Box& box) {
    for (int side = 0; side < 6; ++side) {
        const int axis = side / 2;
        const double plane = (side % 2 == 0 ? box.low : box.high)[axis];
        if (std::ranges::all_of(face, [&](std::uint32_t v) { return surface.points[v][axis] == plane; })) return side;
    }
    return std::nullopt;
}

// Whether all faces with the exterior lie in the planes of the box. Where one does not (the lattice was turned), the
// exterior is taken as a whole: side 0, and no vertex is on a side.
bool exterior_is_box(const FileSurface& surface, const Box& box) {
    for (std::size_t f = 0; f < surface.faces.size(); ++f)
        if (std::ranges::count(surface.labels[f], surface.exterior_label) > 0 &&
            !side_of_face(surface, surface.faces[f], box))
            return false;
    return true;
}

ModelFile assemble(const FileSurface& surface) {
    ModelFile file;
    Model& model = file.model;
    model.reserve(surface.points.size(), surface.faces.size());
    for (const Vec3& point : surface.points) model.add_vertex(point);
    const Box box = bounding_box(surface);
    const bool has_sides = exterior_is_box(surface, box);
    for (std::size_t f = 0; f < surface.faces.size(); ++f) {
        const auto& [a, b, c] = surface.faces[f];
        std::array<Label, 2> labels;
        for (int i = 0; i < 2; ++i) {
            const InputLabel label = surface.labels[f][i];
            if (label != surface.exterior_label) {
                labels[i] = file.labels.dense(label);
                continue;
            }
            if (!has_sides) {
                labels[i] = exterior(0);
                continue;
            }
            const int side = *side_of_face(surface, surface.faces[f], box);
            labels[i] = exterior(side);
            for (const std::uint32_t v : surface.faces[f]) model[VertexId{v}].sides |= static_cast<SideSet>(1u << side);
        }
        model.add_face(VertexId{a}, VertexId{b}, VertexId{c}, labels[0], labels[1]);
    }
    return file;
}

}  // namespace

FileView::FileView(const Model& model, const LabelTable& labels, const std::vector<Label>& background)
    : model_(model), labels_(labels), exterior_label_(labels.exterior_label()), ranks_(labels.size()) {
    std::vector<Label> order(labels.size());
    std::iota(order.begin(), order.end(), Label{0});
    std::ranges::sort(order, [&](Label a, Label b) { return labels.less(labels.input(a), labels.input(b)); });
    std::ranges::stable_partition(
        order, [&](Label label) { return std::ranges::find(background, label) == background.end(); });
    for (std::uint32_t rank = 0; rank < order.size(); ++rank) ranks_[order[rank]] = rank;
    if (model.vertex_count() == model.vertex_end()) return;
    numbers_.resize(model.vertex_end());
    for_vertices([&, number = std::uint32_t{0}](VertexId v) mutable { numbers_[index(v)] = number++; });
}

FileFace FileView::face(FaceId f) const {
    const auto rank = [&](Label label) { return is_exterior(label) ? kFirstExterior : ranks_[label]; };
    const auto input = [&](Label label) { return is_exterior(label) ? exterior_label_ : labels_.input(label); };
    const auto number = [&](VertexId v) { return numbers_.empty() ? index(v) : numbers_[index(v)]; };
    const auto [first, second] = model_[f].labels;
    const auto [a, b, c] = model_[f].vertices;
    if (rank(first) <= rank(second)) return {{number(a), number(b), number(c)}, {input(first), input(second)}};
    return {{number(a), number(c), number(b)}, {input(second), input(first)}};
}

std::uint8_t FileView::node_type(VertexId v) const {
    constexpr int kMost = 4;
    std::array<Label, kMost> regions;
    int count = 0;
    model_.for_star(v, [&](FaceId f, int) {
        for (const Label label : model_[f].labels) {
            const auto end = regions.begin() + count;
            if (count < kMost && !is_exterior(label) && std::find(regions.begin(), end, label) == end)
                regions[count++] = label;
        }
    });
    const SideSet sides = model_[v].sides;
    for (int side = 0; side < 6; ++side) count += sides >> side & 1;
    return static_cast<std::uint8_t>(std::clamp(count, 2, kMost) + (sides != 0 ? 10 : 0));
}

void write_model(const Model& model, const LabelTable& labels, const std::filesystem::path& path,
                 const WriteOptions& options) {
    const std::string extension = writable_extension(path, !options.point_arrays.empty());
    const FileView view(model, labels, options.background);
    extension == ".vtp" ? write_vtp(view, options.point_arrays, path) : write_ply(view, path);
}

void require_writable_model(const std::filesystem::path& path, bool with_point_arrays) {
    writable_extension(path, with_point_arrays);
    require_writable(path);
}

ModelFile read_model(const std::filesystem::path& path) {
    const std::string extension = extension_of(path);
    if (extension == ".vtp") return assemble(read_vtp(path));
    if (extension == ".ply") return assemble(read_ply(path));
    refuse_extension(ErrorCode::kInput, path);
}

}  // namespace regionmesh
