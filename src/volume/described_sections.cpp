#include <utility>

#include "regionmesh/select_sections.h"
#include "volume/chosen_sections.h"

namespace regionmesh {
namespace {

class DescribedSections : public SectionReader {
public:
    DescribedSections(ReaderPointer reader, VolumeInfo info) : reader_(std::move(reader)), info_(std::move(info)) {}

    const VolumeInfo& info() const override { return info_; }
    bool next(std::span<InputLabel> section) override { return reader_->next(section); }
    void rewind() override { reader_->rewind(); }
    bool crop(const IndexBox& box) override {
        if (!reader_->crop(box)) return false;
        info_.lattice = cropped(info_.lattice, box);
        return true;
    }

private:
    ReaderPointer reader_;
    VolumeInfo info_;
};

}  // namespace

ReaderPointer describe_sections(ReaderPointer reader, VolumeInfo info) {
    return std::make_unique<DescribedSections>(std::move(reader), std::move(info));
}

ReaderPointer turn_sections(ReaderPointer reader, Space space) {
    if (space == Space::kUnknown || reader->info().space == space) return reader;
    VolumeInfo info = reader->info();
    const bool is_turned = info.space != Space::kUnknown;
    info.space = space;
    if (!is_turned) return describe_sections(std::move(reader), std::move(info));
    Lattice& lattice = info.lattice;
    lattice.origin.x = -lattice.origin.x;
    lattice.origin.y = -lattice.origin.y;
    for (int entry = 0; entry < 6; ++entry) lattice.direction[entry] = -lattice.direction[entry];  // rows of x and y
    return describe_sections(std::move(reader), std::move(info));
}

}  // namespace regionmesh
