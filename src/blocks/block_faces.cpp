#include "blocks/block_faces.h"

namespace regionmesh {
namespace {

SourceShape shape_of(const BlockVolume& volume, const IndexBox& samples) {
    SourceShape shape = volume.shape;
    shape.lattice.size = samples.size();
    shape.strip_count = shape.lattice.size[shape.axis()] - 1;
    return shape;
}

StripOptions strips_of(const BlockVolume& volume, const IndexBox& samples) {
    StripOptions strips = volume.strips;
    strips.first = samples.low;
    strips.whole = volume.shape.lattice.size;
    return strips;
}

}  // namespace

BlockFaces::BlockFaces(const BlockVolume& volume, const IndexBox& samples)
    : volume_(volume),
      samples_(samples),
      sections_(volume.boxes.open(samples)),
      shape_(shape_of(volume, samples)),
      mesher_(shape_.lattice, shape_.sweep, strips_of(volume, samples)) {
    const auto& size = shape_.lattice.size;
    low_.resize(std::size_t{size[shape_.sweep.axes[0]]} * size[shape_.sweep.axes[1]]);
    high_.resize(low_.size());
}

double BlockFaces::low_of(std::uint32_t strip) const {
    const int axis = shape_.axis();
    return shape_.lattice.origin[axis] + (samples_.low[axis] + strip) * shape_.lattice.spacing[axis];
}

bool BlockFaces::advance() {
    if (strips_ == shape_.strip_count) return false;
    if (strips_ == 0) sections_->next(high_);
    low_.swap(high_);
    sections_->next(high_);
    ++strips_;
    return true;
}

void BlockFaces::make_faces(Chunk& chunk) {
    chunk.clear();
    mesher_.mesh(low_, high_, chunk);
}

}  // namespace regionmesh
