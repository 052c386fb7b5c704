// The faces of labelled tetrahedra (P 3.9).
#pragma once

#include <cmath>
#include <optional>

#include "cells/ranked_tetrahedra.h"
#include "regionmesh/limits.h"
#include "stream/face_source.h"
#include "stream/spilled_strips.h"

namespace regionmesh {

/// Options of the way from tetrahedra to strips of faces.
struct TetrahedronOptions {
    bool cap = true;
    std::vector<InputLabel> background{0};
    std::optional<Sweep> sweep = {};        // along the longest side if not given
    bool for_smoothing = false;             // strips so thick that no vertex has faces in more than two
    std::uint64_t memory = kDefaultMemory;  // bytes to stay within
};

/// Ranks the tetrahedra, meshes all of them, and keeps the faces on disk; then returns them strip by strip, any number
/// of times. A thin strip is as thick as a cube that six tetrahedra fill.
class TetrahedronFaces final : public FaceSource {
public:
    TetrahedronFaces(TetrahedronReader& reader, const TetrahedronOptions& options);

    /// Makes all faces, the first time.
    std::optional<FaceCount> count(const OnStripsCounted& on_strips) override;
    const SourceShape& shape() const override { return shape_; }
    double low_of(std::uint32_t strip) const override;
    bool advance() override;
    void make_faces(Chunk& chunk) override;
    std::uint32_t strips_read() const override { return strips_read_; }
    bool rewind() override;
    const LabelTable& labels() const override { return labels_; }
    const std::vector<Label>& background() const override { return background_; }
    LabelOracle oracle() const override { return oracle_; }
    void place(Mesh& mesh) const override;

    std::uint64_t tetrahedron_count() const { return tetrahedron_count_; }
    std::uint64_t point_count() const { return point_count_; }
    /// Points by dense label, or tetrahedra where they have the labels.
    const std::vector<std::uint64_t>& samples() const { return samples_; }

private:
    void make_all();
    void require_memory(std::uint64_t held) const;
    void shape_lattice(const RankedTetrahedra& tetrahedra);
    void mesh(RankedTetrahedra& tetrahedra);
    void shape_strips_of_faces();

    TetrahedronReader& reader_;
    TetrahedronOptions options_;
    LabelTable labels_;
    std::vector<Label> background_;
    SourceShape shape_;
    LabelOracle oracle_;
    std::uint64_t point_count_ = 0, tetrahedron_count_ = 0;
    std::vector<std::uint64_t> samples_;
    double high_ = HUGE_VAL;  // end of the last strip, if the hull is a box
    SpilledStrips spilled_;
    std::vector<StripRange> strips_;  // each a range of thin strips, which have one cell of the lattice each
    std::uint32_t strips_read_ = 0;
};

}  // namespace regionmesh
