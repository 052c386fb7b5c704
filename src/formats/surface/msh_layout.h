// The contents of a Gmsh mesh and their places in the file.
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

/// Tags of nodes or elements in file order. Stores nothing while each tag is the one before plus one.
class MshTags {
public:
    void add(std::uint64_t tag);
    /// Must be called before find. Returns a tag that was added twice, if there is one.
    std::optional<std::uint64_t> finish();

    std::uint64_t size() const { return count_; }
    std::uint64_t operator[](std::uint32_t index) const { return tags_.empty() ? first_ + index : tags_[index]; }
    /// The index of a tag.
    std::optional<std::uint32_t> find(std::uint64_t tag) const;

private:
    std::uint64_t first_ = 0, count_ = 0;
    std::vector<std::uint64_t> tags_;   // empty while they are first_, first_ + 1, ...
    std::vector<std::uint32_t> order_;  // by ascending tag; empty where tags_ is sorted
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
    bool has_parameters = false;                         // of nodes: MSH 2 has a separate section for these
    std::map<std::int64_t, std::int64_t> physical_tags;  // first tag of each volume, MSH 4.1 only
    LabelNames names;                                    // of physical groups of volumes
    std::vector<MshView> views;
};

/// A negative physical tag means that Gmsh reverses the entity; the group is the same.
std::int64_t without_sign(std::int64_t tag);

/// Scans the whole file; skips the long sections without parsing them.
MshLayout read_layout(MshStream& stream);

/// Nodes and their tags.
struct MshNodes {
    std::vector<Vec3> positions;
    MshTags tags;
};
MshNodes read_nodes(MshStream& stream, const MshLayout& layout, double scale_z);

/// The values of a view, which must be whole numbers, and the tags of their nodes or elements.
struct MshValues {
    std::vector<InputLabel> labels;
    MshTags tags;
};
MshValues read_values(MshStream& stream, const MshView& view);

}  // namespace regionmesh::formats
