#include "formats/surface/msh_layout.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "formats/surface/file_surface.h"
#include "formats/surface/tetrahedron_formats.h"
#include "formats/text/header_text.h"
#include "formats/vtk/label_array.h"

namespace regionmesh::formats {
namespace {

/// The text between the first and the last quote of a line.
std::string quoted(std::string_view line) {
    const std::size_t begin = line.find('"'), end = line.rfind('"');
    if (begin == std::string_view::npos || begin == end) return one_line(line);
    return one_line(line.substr(begin + 1, end - begin - 1));
}

void read_names(MshStream& stream, LabelNames& names) {
    for (std::int64_t left = stream.text_integer(); left > 0; --left) {
        const std::int64_t dimension = stream.text_integer(), tag = without_sign(stream.text_integer());
        const std::string name = quoted(stream.line());
        if (dimension == 3 && !name.empty()) names[tag] = name;
    }
}

void read_entities(MshStream& stream, std::map<std::int64_t, std::int64_t>& physical_tags) {
    std::uint64_t counts[4];
    for (std::uint64_t& count : counts) count = stream.size();
    for (int dimension = 0; dimension < 4; ++dimension) {
        for (std::uint64_t left = counts[dimension]; left > 0; --left) {
            const std::int64_t tag = stream.integer();
            for (int n = dimension == 0 ? 3 : 6; n > 0; --n) stream.real();  // a point, or a bounding box
            const std::uint64_t physical_count = stream.size();
            for (std::uint64_t n = 0; n < physical_count; ++n) {
                const std::int64_t physical = stream.integer();
                if (dimension == 3 && n == 0) physical_tags[tag] = without_sign(physical);
            }
            if (dimension == 0) continue;
            for (std::uint64_t n = stream.size(); n > 0; --n) stream.integer();  // its boundary
        }
    }
}

MshView read_view(MshStream& stream, bool is_cell) {
    MshView view;
    view.is_cell = is_cell;
    const std::int64_t names = stream.text_integer();
    stream.line();
    for (std::int64_t n = 0; n < names; ++n) {
        const std::string name = quoted(stream.line());
        if (n == 0) view.name = name;
    }
    for (std::int64_t left = stream.text_integer(); left > 0; --left) stream.text_word();  // the time
    const std::int64_t integers = stream.text_integer();
    if (integers < 3) stream.fail("needs the numbers of components and of values of a view");
    for (std::int64_t n = 0; n < integers; ++n) {
        const std::int64_t number = stream.text_integer();
        if (n == 1) view.components = number;
        if (n == 2) view.records = number;
    }
    stream.line();
    view.place = stream.place();
    return view;
}

void add_position(const MshStream& stream, MshNodes& nodes, Vec3 p, double scale_z) {
    p.z *= scale_z;
    if (!is_finite(p))
        stream.fail(fmt::format("node {} has a coordinate that is not finite",
                                nodes.tags[static_cast<std::uint32_t>(nodes.positions.size())]));
    nodes.positions.push_back(p);
}

Vec3 read_place(MshStream& stream) {
    Vec3 p;
    for (int axis = 0; axis < 3; ++axis) p[axis] = stream.real();
    return p;
}

void add_tag(const MshStream& stream, MshTags& tags, std::uint64_t tag) {
    if (tags.size() == kMostPoints) stream.fail("more than 2^32 - 2 nodes or values; that many cannot be read");
    tags.add(tag);
}

void read_nodes_2(MshStream& stream, bool has_parameters, double scale_z, MshNodes& nodes) {
    for (std::uint64_t left = stream.count_line(); left > 0; --left) {
        add_tag(stream, nodes.tags, stream.size());
        add_position(stream, nodes, read_place(stream), scale_z);
        if (!has_parameters) continue;
        const std::int64_t dimension = stream.integer();
        stream.integer();  // of what curve or surface
        for (std::int64_t n = 0; n < dimension && dimension < 3; ++n) stream.real();
    }
}

void read_nodes_4(MshStream& stream, double scale_z, MshNodes& nodes) {
    std::uint64_t blocks = stream.size();
    for (int n = 0; n < 3; ++n) stream.size();  // how many nodes, least tag, greatest
    for (; blocks > 0; --blocks) {
        const std::int64_t dimension = stream.integer();
        stream.integer();  // of what entity
        const std::int64_t parameters = stream.integer() != 0 ? std::clamp<std::int64_t>(dimension, 0, 3) : 0;
        const std::uint64_t count = stream.size();
        for (std::uint64_t n = 0; n < count; ++n) add_tag(stream, nodes.tags, stream.size());
        for (std::uint64_t n = 0; n < count; ++n) {
            add_position(stream, nodes, read_place(stream), scale_z);
            for (std::int64_t m = 0; m < parameters; ++m) stream.real();
        }
    }
}

/// Notes the place of a section that must not occur twice.
void note_place(const MshStream& stream, const std::string& name, MshPlace& place) {
    if (place.byte != 0) stream.fail(fmt::format("a second ${}; write the mesh as one", name));
    place = stream.place();
}

}  // namespace

void MshTags::add(std::uint64_t tag) {
    if (count_ == 0) first_ = tag;
    if (tags_.empty() && tag != first_ + count_) {
        tags_.resize(count_);
        std::iota(tags_.begin(), tags_.end(), first_);
    }
    if (!tags_.empty()) tags_.push_back(tag);
    ++count_;
}

std::optional<std::uint64_t> MshTags::finish() {
    if (!std::is_sorted(tags_.begin(), tags_.end())) {
        order_.resize(tags_.size());
        std::iota(order_.begin(), order_.end(), 0u);
        std::sort(order_.begin(), order_.end(), [&](std::uint32_t a, std::uint32_t b) { return tags_[a] < tags_[b]; });
    }
    const auto tag_at = [&](std::size_t i) { return tags_[order_.empty() ? i : order_[i]]; };
    for (std::size_t i = 1; i < tags_.size(); ++i)
        if (tag_at(i) == tag_at(i - 1)) return tag_at(i);
    return std::nullopt;
}

std::optional<std::uint32_t> MshTags::find(std::uint64_t tag) const {
    if (tags_.empty()) {
        if (tag < first_ || tag - first_ >= count_) return std::nullopt;
        return static_cast<std::uint32_t>(tag - first_);
    }
    if (order_.empty()) {
        const auto found = std::lower_bound(tags_.begin(), tags_.end(), tag);
        if (found == tags_.end() || *found != tag) return std::nullopt;
        return static_cast<std::uint32_t>(found - tags_.begin());
    }
    const auto found = std::lower_bound(order_.begin(), order_.end(), tag,
                                        [&](std::uint32_t i, std::uint64_t wanted) { return tags_[i] < wanted; });
    if (found == order_.end() || tags_[*found] != tag) return std::nullopt;
    return *found;
}

std::int64_t without_sign(std::int64_t tag) { return tag < 0 && tag != INT64_MIN ? -tag : tag; }

MshLayout read_layout(MshStream& stream) {
    MshLayout layout;
    while (const auto section = stream.next_section()) {
        const std::string& name = *section;
        if (name == "PhysicalNames") {
            read_names(stream, layout.names);
        } else if (name == "Entities") {
            read_entities(stream, layout.physical_tags);
        } else if (name == "PartitionedEntities") {
            stream.fail("the mesh is partitioned: write it as MSH 2.2, gmsh old.msh -save -format msh22 -o new.msh");
        } else if (name == "Nodes" || name == "ParametricNodes") {
            note_place(stream, name, layout.nodes);
            layout.has_parameters = name == "ParametricNodes";
        } else if (name == "Elements") {
            note_place(stream, name, layout.elements);
        } else if (name == "NodeData" || name == "ElementData") {
            layout.views.push_back(read_view(stream, name == "ElementData"));
        }
        stream.skip_section(name);
    }
    if (layout.nodes.byte == 0 || layout.elements.byte == 0)
        fail(stream.path(), "needs $Nodes and $Elements; the file is truncated, or no mesh");
    return layout;
}

MshNodes read_nodes(MshStream& stream, const MshLayout& layout, double scale_z) {
    MshNodes nodes;
    stream.go_to(layout.nodes);
    if (stream.is_version_4())
        read_nodes_4(stream, scale_z, nodes);
    else
        read_nodes_2(stream, layout.has_parameters, scale_z, nodes);
    stream.end_section(layout.has_parameters ? "ParametricNodes" : "Nodes");
    if (const auto twice = nodes.tags.finish()) stream.fail(fmt::format("node {} stands twice in $Nodes", *twice));
    return nodes;
}

MshValues read_values(MshStream& stream, const MshView& view) {
    MshValues values;
    const char* const owner = view.is_cell ? "element" : "node";
    stream.go_to(view.place);
    for (std::int64_t left = view.records; left > 0; --left) {
        const auto tag = static_cast<std::uint64_t>(stream.integer());
        const double value = stream.real();
        const auto label = whole_number(value);
        if (!label)
            stream.fail(fmt::format("{} {} has {} in '{}': labels are whole numbers below 2^53", owner, tag, value,
                                    shown(view.name)));
        add_tag(stream, values.tags, tag);
        values.labels.push_back(*label);
    }
    if (const auto twice = values.tags.finish())
        stream.fail(fmt::format("{} {} has two values in '{}'", owner, *twice, shown(view.name)));
    return values;
}

}  // namespace regionmesh::formats
