#include "surface/file_view.h"

#include <algorithm>
#include <numeric>

#include "regionmesh/error.h"

namespace regionmesh {
namespace {

const LabelNames kNoNames;
const LabelColours kNoColours;

}  // namespace

FileView::FileView(const Mesh& mesh, const LabelTable& labels, const std::vector<Label>& background)
    : FileView(mesh, labels, background, kNoNames) {}

FileView::FileView(const Mesh& mesh, const LabelTable& labels, const std::vector<Label>& background,
                   const LabelNames& names)
    : mesh_(mesh),
      labels_(labels),
      names_(names),
      colours_(&kNoColours),
      exterior_label_(labels.exterior_label()),
      ranks_(labels.size()) {
    std::vector<Label> order(labels.size());
    std::iota(order.begin(), order.end(), Label{0});
    std::ranges::sort(order, [&](Label a, Label b) { return labels.less(labels.input(a), labels.input(b)); });
    std::vector<bool> is_behind(labels.size());
    for (const Label label : background)
        if (label < is_behind.size()) is_behind[label] = true;
    const auto behind = std::ranges::stable_partition(order, [&](Label label) { return !is_behind[label]; });
    region_ranks_ = static_cast<std::uint32_t>(order.size() - behind.size());
    for (std::uint32_t rank = 0; rank < order.size(); ++rank) ranks_[order[rank]] = rank;
    if (mesh.vertex_count() == mesh.vertex_end()) return;
    numbers_.resize(mesh.vertex_end());
    for_vertices([&, number = std::uint32_t{0}](VertexId v) mutable { numbers_[index(v)] = number++; });
}

FileFace FileView::face(FaceId f) const {
    const auto input = [&](Label label) { return is_exterior(label) ? exterior_label_ : labels_.input(label); };
    const auto [first, second] = mesh_[f].labels;
    const auto [a, b, c] = mesh_[f].vertices;
    if (!is_turned(f)) return {{number(a), number(b), number(c)}, {input(first), input(second)}};
    return {{number(a), number(c), number(b)}, {input(second), input(first)}};
}

std::vector<Label> FileView::ordered_labels() const {
    std::vector<Label> order(ranks_.size());
    for (Label label = 0; label < ranks_.size(); ++label) order[ranks_[label]] = label;
    return order;
}

std::vector<InputLabel> FileView::background_labels() const {
    std::vector<InputLabel> background;
    for (const Label label : ordered_labels())
        if (is_background(label)) background.push_back(labels_.input(label));
    return background;
}

std::string FileView::label_text(Label label) const {
    return is_exterior(label) ? std::to_string(exterior_label_) : labels_.text(labels_.input(label));
}

std::string FileView::name(Label label) const {
    if (is_exterior(label)) return {};
    const auto found = names_.find(labels_.input(label));
    return found == names_.end() ? std::string() : found->second;
}

std::uint8_t FileView::node_type(VertexId v) const {
    constexpr int kMost = 4;
    std::array<Label, kMost> regions;
    int count = 0;
    mesh_.for_star(v, [&](FaceId f, int) {
        for (const Label label : mesh_[f].labels) {
            const auto end = regions.begin() + count;
            if (count < kMost && !is_exterior(label) && std::find(regions.begin(), end, label) == end)
                regions[count++] = label;
        }
    });
    const SideSet sides = mesh_[v].sides;
    for (int side = 0; side < 6; ++side) count += sides >> side & 1;
    return static_cast<std::uint8_t>(std::clamp(count, 2, kMost) + (sides != 0 ? 10 : 0));
}

void require_labels(const Mesh& mesh, const LabelTable& labels, const std::string& what) {
    for_faces(mesh, [&](FaceId f) {
        for (const Label label : mesh[f].labels)
            if (!is_exterior(label) && label >= labels.size())
                throw Error(ErrorCode::kInput, what + ": face " + std::to_string(index(f)) + " has the dense label " +
                                                   std::to_string(label) + " of a table of " +
                                                   std::to_string(labels.size()) + "; give the table of the mesh");
    });
}

}  // namespace regionmesh
