// What a Gmsh mesh holds, and where.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "formats/surface/msh_stream.h"
#include "regionmesh/tetrahedron_reader.h"

namespace regionmesh::formats {

/// Tags in the order in which they come; holds none of them while each is one more than the one before.
class MshTags {
public:
    void add(std::uint64_t tag);
    /// To be called before find. Returns a tag that was added twice, if there is one.
    std::optional<std::uint64_t> finish();

    std::uint64_t size() const { return count_; }
    std::uint64_t operator[](std::uint32_t index) const { return tags_.empty() ? first_ + index : tags_[index]; }
    /// The place of a tag among all.
    std::optional<std::uint32_t> find(std::uint64_t tag) const;

private:
    std::uint64_t first_ = 0, count_ = 0;
    std::vector<std::uint64_t> tags_;   // none while they are first_, first_ + 1, ...
    std::vector<std::uint32_t> order_;  // by rising tag; none where that is the order of tags_
};

/// $NodeData or $ElementData.
struct MshView {
    std::string name;
    bool is_cell = false;
    std::int64_t components = 1;
    std::int64_t records = 0;
    MshPlace place;  // of the first record
};

struct MshLayout {
    MshPlace nodes, elements;
    bool has_parameters = false;                         // of nodes: MSH 2 has a section of its own for these
    std::map<std::int64_t, std::int64_t> physical_tags;  // the first one of a volume, MSH 4.1 only
    LabelNames names;                                    // of physical groups of volumes
    std::vector<MshView> views;
};

/// Gmsh turns an entity inside out by a negative sign of its physical tag: it is the same group.
std::int64_t without_sign(std::int64_t tag);

/// Goes through the whole file, and behind its sections without looking into the long ones.
MshLayout read_layout(MshStream& stream);

/// Nodes and what they are called.
struct MshNodes {
    std::vector<Vec3> positions;
    MshTags tags;
};
MshNodes read_nodes(MshStream& stream, const MshLayout& layout, double scale_z);

/// The values of a view, which must be whole numbers, and what they belong to.
struct MshValues {
    std::vector<InputLabel> labels;
    MshTags tags;
};
MshValues read_values(MshStream& stream, const MshView& view);

}  // namespace regionmesh::formats
