#include "stream/section_faces.h"

#include <algorithm>
#include <cmath>

#include "regionmesh/limits.h"
#include "stream/footprint.h"
#include "stream/place_in_space.h"

namespace regionmesh {

SourceShape section_shape(const VolumeInfo& info, CellKind cells, double scale_z) {
    SourceShape shape{
        .name = info.source, .has_samples = true, .lattice = meshing_lattice(info.lattice), .sweep = info.sweep};
    shape.cells = cells;
    shape.scale_z = scale_z;
    shape.lattice.spacing.z *= scale_z;
    shape.lattice.origin.z *= scale_z;
    require_lattice(info.source + (scale_z == 1 ? "" : ", with z scaled"), shape.lattice);
    const Vec3 spacing = shape.lattice.spacing;
    shape.strip_count = std::max(info.lattice.size[shape.axis()], 1u) - 1;
    shape.strip_thickness = spacing[shape.axis()];
    shape.scale = std::cbrt(spacing.x * spacing.y * spacing.z);
    shape.reading_bytes = reading_bytes(info);
    return shape;
}

SectionFaces::SectionFaces(SectionReader& reader, const CensusOptions& options, QuadCuts cuts, double scale_z)
    : reader_(reader),
      options_(options),
      cuts_(cuts),
      shape_(section_shape(reader.info(), options.cells, scale_z)),
      labels_(table_for(reader.info())),
      background_(dense_background(options.background, labels_)) {}

std::optional<FaceCount> SectionFaces::count(const OnStripsCounted& on_strips) {
    if (!reader_.info().can_rewind) {
        begin();
        census_.emplace(shape_.lattice, shape_.sweep, strip_options());
        return {};
    }
    CensusOptions options = options_;
    options.on_strip = on_strips;
    Census census = count_labels(reader_, options);
    reader_.rewind();
    return FaceCount{std::move(census.strip_faces), census.face_count, std::move(census.oracle)};
}

double SectionFaces::low_of(std::uint32_t strip) const {
    return shape_.lattice.origin[shape_.axis()] + strip * shape_.lattice.spacing[shape_.axis()];
}

/// Called after sections were counted, since counting takes as much memory again. Refuses volumes without a cell.
void SectionFaces::begin() {
    window_.emplace(reader_, labels_);
    mesher_.emplace(shape_.lattice, shape_.sweep, strip_options());
}

bool SectionFaces::advance() {
    if (!window_) begin();
    return window_->advance();
}

void SectionFaces::make_faces(Chunk& chunk) {
    if (census_) census_->add(window_->low(), window_->high(), window_->is_last());
    chunk.clear();
    mesher_->mesh(window_->low(), window_->high(), chunk);
}

bool SectionFaces::rewind() {
    if (!reader_.info().can_rewind) return false;
    window_.reset();
    mesher_.reset();
    reader_.rewind();
    return true;
}

void SectionFaces::place(Mesh& mesh) const {
    unscale_z(mesh, shape_.scale_z);
    place_in_space(mesh, reader_.info().lattice);
}

double SectionFaces::volume_factor() const { return std::abs(reader_.info().lattice.axes_volume()) / shape_.scale_z; }

SampleAgreement SectionFaces::compare(const Mesh& mesh, std::uint32_t threads) {
    window_.reset();
    mesher_.reset();
    return compare_samples(mesh, labels_, background_, reader_, threads);
}

}  // namespace regionmesh
