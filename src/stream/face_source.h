// Where the faces of the unsimplified model come from: sections and tetrahedra become one here.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "mesh/chunk.h"
#include "regionmesh/label_oracle.h"
#include "regionmesh/label_table.h"
#include "regionmesh/lattice.h"
#include "regionmesh/mesh.h"

namespace regionmesh {

/// What is known of all faces before the first of them is made.
struct FaceCount {
    std::vector<std::uint64_t> strip_faces;
    std::uint64_t face_count = 0;
    LabelOracle oracle;
};

/// How the faces lie in space, and what they take.
struct SourceShape {
    std::string name;  // for messages
    Lattice lattice;   // round all positions, axis-aligned: tiles are so many of its cells
    Sweep sweep;
    std::uint32_t strip_count = 0;
    double strip_thickness = 1;       // of the thinnest: vertices of later strips lie so much further along the sweep
    std::uint32_t strip_overlap = 0;  // so many strips that follow begin before the end of one
    double scale = 1;                 // length of a typical edge
    std::uint64_t reading_bytes = 0;  // that the process and the source take

    int axis() const { return sweep.axes[2]; }
};

/// Strip by strip along the sweep. Vertices of a strip lie at its plane or beyond.
class FaceSource {
public:
    virtual ~FaceSource() = default;

    /// Counts all faces, where that can be done without making the model; to be called first.
    virtual std::optional<FaceCount> count() = 0;
    virtual const SourceShape& shape() const = 0;
    /// Where the plane of a strip lies along the sweep; of the one behind the last, where all ends.
    virtual double plane_of(std::uint32_t strip) const = 0;

    /// Reads what the next strip is made of; false when there are no more.
    virtual bool advance() = 0;
    /// The faces of the strip read, as the batch that follows on the one before.
    virtual void make_faces(Chunk& batch) = 0;
    /// Strips read so far.
    virtual std::uint32_t strips_read() const = 0;
    bool is_last() const { return strips_read() == shape().strip_count; }

    /// Labels met so far, and those of them that are background.
    virtual const LabelTable& labels() const = 0;
    virtual const std::vector<Label>& background() const = 0;
    /// What the labels say of the model, after the last strip.
    virtual LabelOracle oracle() const = 0;
    /// Puts the finished model where it belongs in space.
    virtual void place(Mesh& mesh) const = 0;
};

}  // namespace regionmesh
