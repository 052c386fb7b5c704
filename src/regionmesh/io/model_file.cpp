#include "regionmesh/io/model_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
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

[[noreturn]] void refuse_extension(const std::filesystem::path& path) {
    throw Error(ErrorCode::kOutput, fmt::format("{}: no model format has the extension '{}': use .vtp or .ply",
                                                path.string(), path.extension().string()));
}

// The extension of a format that models are written in.
std::string writable_extension(const std::filesystem::path& path, bool with_point_arrays) {
    const std::string extension = extension_of(path);
    if (extension != ".vtp" && extension != ".ply") refuse_extension(path);
    if (with_point_arrays && extension != ".vtp")
        throw Error(ErrorCode::kOutput,
                    fmt::format("{}: only .vtp files hold a number for each vertex", path.string()));
    return extension;
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

}  // namespace regionmesh
