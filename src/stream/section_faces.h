// The faces of labelled sections (P 3.1-3.3).
#pragma once

#include <optional>

#include "cells/label_census.h"
#include "cells/strip_mesher.h"
#include "regionmesh/census.h"
#include "stream/face_source.h"
#include "volume/section_window.h"

namespace regionmesh {

/// How the faces of a volume lie; until place(), z is multiplied by `scale_z`, a power of two.
SourceShape section_shape(const VolumeInfo& info, CellKind cells, double scale_z);

/// Meshes the strips between sections as they are read. Sections that can be read twice are counted first.
class SectionFaces final : public FaceSource {
public:
    /// Until place(), z is multiplied by `scale_z`, a power of two.
    SectionFaces(SectionReader& reader, const CensusOptions& options, QuadCuts cuts = QuadCuts::kBestQuality,
                 double scale_z = 1);

    std::optional<FaceCount> count(const OnStripsCounted& on_strips) override;
    const SourceShape& shape() const override { return shape_; }
    double low_of(std::uint32_t strip) const override;
    bool advance() override;
    void make_faces(Chunk& chunk) override;
    std::uint32_t strips_read() const override { return window_ ? window_->sections_read() - 1 : 0; }
    bool rewind() override;
    const LabelTable& labels() const override { return labels_; }
    const std::vector<Label>& background() const override { return background_; }
    LabelOracle oracle() const override { return census_->oracle(); }
    void place(Mesh& mesh) const override;
    double volume_factor() const override;
    bool can_compare() const override { return options_.cap && reader_.info().can_rewind; }
    SampleAgreement compare(const Mesh& mesh, std::uint32_t threads) override;

private:
    void begin();
    StripOptions strip_options() const {
        return {.cap = options_.cap, .background = background_, .cells = options_.cells, .cuts = cuts_};
    }

    SectionReader& reader_;
    CensusOptions options_;
    QuadCuts cuts_;
    SourceShape shape_;
    LabelTable labels_;
    std::vector<Label> background_;
    std::optional<SectionWindow> window_;  // from begin() on
    std::optional<StripMesher> mesher_;
    std::optional<LabelCensus> census_;  // while meshing, where nothing was counted before
};

}  // namespace regionmesh
