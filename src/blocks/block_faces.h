// The faces of a box of a volume, with the positions and labels that they have in the whole.
#pragma once

#include "blocks/label_boxes.h"
#include "cells/strip_mesher.h"
#include "stream/face_source.h"

namespace regionmesh {

/// What all blocks of a volume share.
struct BlockVolume {
    const LabelBoxes& boxes;        // of dense labels
    SourceShape shape;              // of the whole
    StripOptions strips;            // likewise; `first` and `whole` are set for each box
    const LabelTable& labels;       // of the whole
    std::vector<Label> background;  // dense
};

/// Meshes the samples of a box strip by strip. Faces near a side of the box that is not one of the volume are those of
/// the whole, too, as all others, but vertices there lack the faces beyond.
class BlockFaces final : public FaceSource {
public:
    /// The volume must outlive it. Requires a box of two samples along every axis.
    BlockFaces(const BlockVolume& volume, const IndexBox& samples);

    std::optional<FaceCount> count(const OnStripsCounted& /*on_strips*/) override { return {}; }
    const SourceShape& shape() const override { return shape_; }
    double low_of(std::uint32_t strip) const override;
    bool advance() override;
    void make_faces(Chunk& chunk) override;
    std::uint32_t strips_read() const override { return strips_; }
    bool rewind() override { return false; }
    const LabelTable& labels() const override { return volume_.labels; }
    const std::vector<Label>& background() const override { return volume_.background; }
    LabelOracle oracle() const override { return {}; }
    void place(Mesh&) const override {}

private:
    const BlockVolume& volume_;
    IndexBox samples_;
    std::unique_ptr<BoxSections> sections_;
    SourceShape shape_;  // origin and spacing of the whole, size of the box
    StripMesher mesher_;
    std::vector<Label> low_, high_;
    std::uint32_t strips_ = 0;
};

}  // namespace regionmesh
