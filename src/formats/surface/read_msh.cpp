// Labelled tetrahedra in a Gmsh mesh.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <utility>

#include "formats/surface/msh_layout.h"
#include "formats/surface/tetrahedron_formats.h"
#include "formats/text/header_text.h"
#include "formats/vtk/label_array.h"
#include "regionmesh/error.h"

namespace regionmesh::formats {
namespace {

constexpr std::int64_t kTetrahedron = 4;

struct ElementType {
    std::int64_t number;
    std::uint64_t nodes;     // 0: a solid other than the tetrahedron of four nodes
    const char* name = "";   // of a solid
    bool is_curved = false;  // a tetrahedron of higher order
};

/// Elements of at most two dimensions, of first and second order, and solids with their names.
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

struct MshTetrahedron {
    std::uint64_t tag = 0;
    std::int64_t physical = 0;  // tag of the first physical group; 0 where there is none
    std::int64_t entity = 0;    // tag of the volume
    std::array<std::uint64_t, 4> nodes{};
};

/// Iterates over $Elements. Skips elements of fewer than three dimensions and refuses other solids. In MSH 2 Gmsh
/// writes an element of several physical groups once per group: only the first copy is returned.
class MshElements {
public:
    /// Holds a reference to the layout.
    MshElements(const std::filesystem::path& path, const MshLayout& layout);

    /// False once there are no more.
    bool next(MshTetrahedron& tetrahedron);

private:
    bool next_element(MshTetrahedron& element);
    bool begin_block();
    void read_tags(MshTetrahedron& element, std::int64_t count);
    std::uint64_t node_count(std::uint64_t tag) const;

    MshStream stream_;
    const MshLayout& layout_;
    std::uint64_t blocks_ = 0;          // MSH 4: not yet begun
    std::uint64_t elements_ = 0;        // MSH 2: not yet read
    std::uint64_t left_ = 0;            // of the block
    std::int64_t type_ = 0, tags_ = 0;  // type of the elements of the block; tags per element, MSH 2
    MshTetrahedron block_;              // the values that all elements of the block share
    std::array<std::uint64_t, 4> last_{};
    bool has_ended_ = false;
};

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
                                 ? "mesh the geometry again with elements of first order, gmsh -order 1"
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

constexpr const char* kPhysical = "gmsh:physical";
constexpr const char* kGeometrical = "gmsh:geometrical";

/// Reads the elements when a file is opened, to refuse other solids before long work; and again for the name of a
/// tetrahedron: names are for messages only.
class MshReader final : public TetrahedronReader {
public:
    MshReader(const std::filesystem::path& path, const TetrahedraOptions& options);

    const TetrahedraInfo& info() const override { return info_; }
    LabelledPoints take_points() override;
    std::string name_of_point(std::uint32_t point) const override { return fmt::format("node {}", nodes_.tags[point]); }
    std::string name_of_tetrahedron(std::uint64_t tetrahedron) const override;
    std::size_t next(std::span<LabelledTetrahedron> tetrahedra) override;

private:
    enum class Source { kGroups, kVolumes, kViews };

    /// What the tags of tetrahedra tell apart.
    struct Tags {
        bool has_physical = false;  // any is in a physical group
        bool has_one_volume = true;
    };
    Tags look_at_tags() const;
    bool has_whole_values(const MshView& view);
    void choose_labels(const std::string& wanted);
    void take(const MshTetrahedron& from, LabelledTetrahedron& tetrahedron) const;
    InputLabel label_of(const MshTetrahedron& tetrahedron) const;
    [[noreturn]] void fail(const MshTetrahedron& tetrahedron, const std::string& text) const;

    std::filesystem::path path_;
    MshStream stream_;
    MshLayout layout_;
    MshNodes nodes_;
    std::optional<MshElements> elements_;
    Source source_ = Source::kGroups;
    const MshView* view_ = nullptr;
    MshValues values_;  // of the view
    TetrahedraInfo info_;
};

MshReader::MshReader(const std::filesystem::path& path, const TetrahedraOptions& options)
    : path_(path), stream_(path), layout_(read_layout(stream_)) {
    choose_labels(options.array);
    info_ = {.source = path.string(),
             .format = "msh",
             .has_cell_labels = !view_ || view_->is_cell,
             .scale_z = options.scale_z};
    if (source_ == Source::kGroups) info_.names = layout_.names;
    nodes_ = read_nodes(stream_, layout_, options.scale_z);
    if (view_) values_ = read_values(stream_, *view_);
    elements_.emplace(path, layout_);
}

MshReader::Tags MshReader::look_at_tags() const {
    std::uint64_t count = 0;
    std::optional<std::int64_t> volume;
    Tags tags;
    MshElements elements(path_, layout_);
    for (MshTetrahedron tetrahedron; elements.next(tetrahedron); ++count) {
        tags.has_physical |= tetrahedron.physical != 0;
        tags.has_one_volume &= tetrahedron.entity == volume.value_or(tetrahedron.entity);
        volume = tetrahedron.entity;
    }
    if (count == 0) formats::fail(path_, "has no tetrahedra: a surface model? mesh its volumes with Gmsh, gmsh -3");
    return tags;
}

bool MshReader::has_whole_values(const MshView& view) {
    try {
        read_values(stream_, view);
        return true;
    } catch (const Error&) {
        return false;
    }
}

/// Physical groups first, then a view whose name means regions, or else the only view of elements where its values are
/// whole and there is one volume, then volumes.
void MshReader::choose_labels(const std::string& wanted) {
    const auto [has_physical, has_one_volume] = look_at_tags();
    std::vector<MeshArray> arrays;
    if (has_physical) arrays.push_back({.name = kPhysical, .type = "tags"});
    arrays.push_back({.name = kGeometrical, .type = "tags"});
    const std::size_t tag_arrays = arrays.size();
    for (const MshView& view : layout_.views)
        arrays.push_back({view.name, view.is_cell, false, "view", static_cast<std::uint64_t>(view.components)});
    std::size_t chosen = 0;
    if (!wanted.empty()) {
        chosen = choose_label_array(path_, arrays, wanted);
    } else if (!has_physical) {
        std::optional<std::size_t> best;
        for (std::size_t i = tag_arrays; i < arrays.size(); ++i)
            if (arrays[i].components == 1 && region_rank(arrays[i].name) &&
                (!best || *region_rank(arrays[i].name) < *region_rank(arrays[*best].name)))
                best = i;
        chosen = best.value_or(0);
        // meshio writes the tags of other formats as views, and 0 as those of Gmsh: the only view is the labels.
        std::size_t single = 0, only = 0;
        for (std::size_t i = tag_arrays; i < arrays.size(); ++i)
            if (arrays[i].components == 1 && arrays[i].is_cell) ++single, only = i;
        if (!best && has_one_volume && single == 1 && has_whole_values(layout_.views[only - tag_arrays])) chosen = only;
    }
    if (chosen >= tag_arrays) {
        source_ = Source::kViews;
        view_ = &layout_.views[chosen - tag_arrays];
    } else {
        source_ = arrays[chosen].name == kPhysical ? Source::kGroups : Source::kVolumes;
    }
}

LabelledPoints MshReader::take_points() {
    LabelledPoints points{std::move(nodes_.positions), {}};
    if (info_.has_cell_labels) return points;
    points.labels.resize(points.positions.size());
    for (std::uint32_t i = 0; i < points.labels.size(); ++i)
        if (const auto value = values_.tags.find(nodes_.tags[i])) points.labels[i] = values_.labels[*value];
    values_.labels = {};
    return points;
}

std::string MshReader::name_of_tetrahedron(std::uint64_t tetrahedron) const {
    MshElements elements(path_, layout_);
    MshTetrahedron found;
    for (std::uint64_t i = 0; i <= tetrahedron; ++i)
        if (!elements.next(found)) return fmt::format("tetrahedron {}", tetrahedron);
    return fmt::format("element {}", found.tag);
}

void MshReader::fail(const MshTetrahedron& tetrahedron, const std::string& text) const {
    formats::fail(path_, fmt::format("element {} {}", tetrahedron.tag, text));
}

InputLabel MshReader::label_of(const MshTetrahedron& tetrahedron) const {
    if (source_ == Source::kGroups) return tetrahedron.physical;
    if (source_ == Source::kVolumes) return tetrahedron.entity;
    if (!view_->is_cell) return 0;
    const auto value = values_.tags.find(tetrahedron.tag);
    if (!value) fail(tetrahedron, fmt::format("has no value in '{}'", shown(view_->name)));
    return values_.labels[*value];
}

void MshReader::take(const MshTetrahedron& from, LabelledTetrahedron& tetrahedron) const {
    for (std::size_t n = 0; n < 4; ++n) {
        const auto point = nodes_.tags.find(from.nodes[n]);
        if (!point) fail(from, fmt::format("names node {}, which $Nodes has not", from.nodes[n]));
        if (!info_.has_cell_labels && !values_.tags.find(from.nodes[n]))
            fail(from, fmt::format("has node {}, which has no value in '{}'", from.nodes[n], shown(view_->name)));
        tetrahedron.corners[n] = *point;
    }
    if (has_repeated_corner(tetrahedron.corners)) fail(from, "names a node twice; mend or drop it");
    tetrahedron.label = label_of(from);
}

std::size_t MshReader::next(std::span<LabelledTetrahedron> tetrahedra) {
    std::size_t count = 0;
    for (MshTetrahedron from; count < tetrahedra.size() && elements_->next(from); ++count)
        take(from, tetrahedra[count]);
    return count;
}

}  // namespace

std::unique_ptr<TetrahedronReader> open_msh(const std::filesystem::path& path, const TetrahedraOptions& options) {
    return std::make_unique<MshReader>(path, options);
}

}  // namespace regionmesh::formats
