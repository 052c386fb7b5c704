#include "formats/surface/msh_elements.h"

#include <fmt/format.h>

#include <utility>

namespace regionmesh::formats {
namespace {

constexpr std::int64_t kTetrahedron = 4;

struct ElementType {
    std::int64_t number;
    std::uint64_t nodes;     // 0: a solid that is no tetrahedron of four nodes
    const char* name = "";   // of a solid
    bool is_curved = false;  // a tetrahedron of higher order
};

/// Flat elements of first and second order, and what solids are called.
constexpr ElementType kTypes[] = {
    {4, 4},
    {2, 3},
    {3, 4},
    {1, 2},
    {15, 1},
    {8, 3},
    {9, 6},
    {10, 9},
    {16, 8},
    {5, 0, "a hexahedron"},
    {6, 0, "a prism"},
    {7, 0, "a pyramid"},
    {11, 0, "a tetrahedron of 10 nodes", true},
    {29, 0, "a tetrahedron of 20 nodes", true},
    {30, 0, "a tetrahedron of 35 nodes", true},
    {31, 0, "a tetrahedron of 56 nodes", true},
};

}  // namespace

MshElements::MshElements(const std::filesystem::path& path, const MshLayout& layout) : stream_(path), layout_(layout) {
    stream_.go_to(layout.elements);
    if (!stream_.is_version_4()) {
        elements_ = stream_.count_line();
        return;
    }
    blocks_ = stream_.size();
    for (int n = 0; n < 3; ++n) stream_.size();  // how many elements, least tag, greatest
}

std::uint64_t MshElements::node_count(std::uint64_t tag) const {
    const ElementType* found = nullptr;
    for (const ElementType& type : kTypes) {
        if (type.number != type_) continue;
        if (type.nodes > 0) return type.nodes;
        found = &type;
        break;
    }
    stream_.fail(fmt::format("element {} is {}: {}", tag, found ? found->name : fmt::format("of type {}", type_),
                             !found || found->is_curved
                                 ? "write the mesh with elements of first order, gmsh -order 1"
                                 : "split the cells into tetrahedra; Gmsh meshes without recombining make them"));
}

/// False at the end.
bool MshElements::begin_block() {
    if (stream_.is_version_4()) {
        if (blocks_ == 0) return false;
        --blocks_;
        const std::int64_t dimension = stream_.integer();
        block_.entity = stream_.integer();
        type_ = stream_.integer();
        left_ = stream_.size();
        const auto physical = layout_.physical_tags.find(block_.entity);
        block_.physical = dimension == 3 && physical != layout_.physical_tags.end() ? physical->second : 0;
        return true;
    }
    if (elements_ == 0) return false;
    if (!stream_.is_binary()) {
        left_ = 1;  // the type follows the tag of each
        return true;
    }
    type_ = stream_.integer();
    left_ = stream_.size();
    tags_ = stream_.integer();
    if (left_ > elements_) stream_.fail(fmt::format("a block of {} elements, where {} are left", left_, elements_));
    return true;
}

void MshElements::read_tags(MshTetrahedron& element, std::int64_t count) {
    for (std::int64_t n = 0; n < count; ++n) {
        const std::int64_t tag = stream_.integer();
        if (n == 0) element.physical = without_sign(tag);
        if (n == 1) element.entity = tag;
    }
}

/// False at the end; only the first four nodes are kept.
bool MshElements::next_element(MshTetrahedron& element) {
    while (left_ == 0)
        if (!begin_block()) return false;
    --left_;
    element = block_;
    element.tag = stream_.size();
    if (!stream_.is_version_4()) {
        --elements_;
        if (!stream_.is_binary()) {
            type_ = stream_.integer();
            tags_ = stream_.integer();
        }
        read_tags(element, tags_);
    }
    const std::uint64_t nodes = node_count(element.tag);
    for (std::uint64_t n = 0; n < nodes; ++n) {
        const std::uint64_t node = stream_.size();
        if (n < element.nodes.size()) element.nodes[n] = node;
    }
    return true;
}

bool MshElements::next(MshTetrahedron& tetrahedron) {
    if (has_ended_) return false;
    while (next_element(tetrahedron)) {
        if (type_ != kTetrahedron) continue;
        const bool is_repeated = !stream_.is_version_4() && tetrahedron.nodes == last_;
        last_ = tetrahedron.nodes;
        if (!is_repeated) return true;
    }
    stream_.end_section("Elements");
    has_ended_ = true;
    return false;
}

}  // namespace regionmesh::formats
