// The tetrahedra of a Gmsh mesh.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>

#include "formats/surface/msh_layout.h"

namespace regionmesh::formats {

struct MshTetrahedron {
    std::uint64_t tag = 0;
    std::int64_t physical = 0;  // tag of the first physical group; 0 where there is none
    std::int64_t entity = 0;    // tag of the volume
    std::array<std::uint64_t, 4> nodes{};
};

/// Passes through $Elements. Elements of less than three dimensions are passed over, other solids refused. Gmsh writes
/// an element of several physical groups once for each in MSH 2: only the first of these is handed out.
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
    std::int64_t type_ = 0, tags_ = 0;  // of the elements of the block; how many tags each has, MSH 2
    MshTetrahedron block_;              // what all elements of the block have
    std::array<std::uint64_t, 4> last_{};
    bool has_ended_ = false;
};

}  // namespace regionmesh::formats
