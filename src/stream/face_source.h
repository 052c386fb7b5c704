// Where the faces come from before smoothing and simplification: one interface for sections and tetrahedra.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "regionmesh/label_oracle.h"
#include "regionmesh/label_table.h"
#include "regionmesh/lattice.h"
#include "regionmesh/mesh.h"
#include "regionmesh/voxelise.h"
#include "surface/chunk.h"

namespace regionmesh {

using OnStripsCounted = std::function<void(std::uint32_t strips)>;

/// All that is known of the faces before the first of them is made.
struct FaceCount {
    std::vector<std::uint64_t> strip_faces;
    std::uint64_t face_count = 0;
    LabelOracle oracle;
};

/// How the faces lie in space, and the bytes that making them takes.
struct SourceShape {
    std::string name;          // for messages
    bool has_samples = false;  // at the nodes of the lattice
    CellKind cells = CellKind::kTetrahedra;
    Lattice lattice;  // round all positions, axis-aligned: tiles are blocks of its cells
    Sweep sweep;
    std::uint32_t strip_count = 0;
    double strip_thickness = 1;       // of the thinnest strip
    std::uint32_t strip_overlap = 0;  // strips that follow and begin before the end of one, at most
    double scale = 1;                 // length of a typical edge
    double scale_z = 1;               // factor by which z is multiplied until place(), a power of two
    std::uint64_t reading_bytes = 0;  // of the process and the source

    int axis() const { return sweep.axes[2]; }
};

/// Faces strip by strip along the sweep.
class FaceSource {
public:
    virtual ~FaceSource() = default;

    /// Counts all faces, where that can be done without making the mesh; to be called first. May call on_strips, if
    /// there is one, after some of the strips.
    virtual std::optional<FaceCount> count(const OnStripsCounted& on_strips) = 0;
    virtual const SourceShape& shape() const = 0;
    /// All vertices of this strip and the later ones lie here or beyond along the sweep. For the strip count it is the
    /// end of the last strip.
    virtual double low_of(std::uint32_t strip) const = 0;

    /// Reads the input of the next strip; false when there is none.
    virtual bool advance() = 0;
    /// The faces of the strip read, as the chunk that follows the one before.
    virtual void make_faces(Chunk& chunk) = 0;
    /// Strips read so far.
    virtual std::uint32_t strips_read() const = 0;
    bool is_last() const { return strips_read() == shape().strip_count; }
    /// Returns to the first strip, and to count(); false where the input can be read only once.
    virtual bool rewind() = 0;

    /// Labels met so far, and those of them that are background.
    virtual const LabelTable& labels() const = 0;
    virtual const std::vector<Label>& background() const = 0;
    /// What the labels say of the mesh, after the last strip.
    virtual LabelOracle oracle() const = 0;
    /// Moves the finished mesh to its place in space.
    virtual void place(Mesh& mesh) const = 0;
    /// How many times as large place() makes volumes.
    virtual double volume_factor() const { return 1 / shape().scale_z; }
    /// False where the input has no samples or can be read only once, and for a mesh that is open at the box.
    virtual bool can_compare() const { return false; }
    /// Reads the input again, and compares its samples with the finished mesh. Requires can_compare().
    virtual SampleAgreement compare(const Mesh&, std::uint32_t /*threads*/) { return {}; }
};

}  // namespace regionmesh
