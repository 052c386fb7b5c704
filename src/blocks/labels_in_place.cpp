#include "blocks/labels_in_place.h"

#include <vector>

#include "regionmesh/error.h"

namespace regionmesh {
namespace {

class Sections final : public BoxSections {
public:
    Sections(std::unique_ptr<SectionReader> reader, const LabelTable& labels)
        : reader_(std::move(reader)), labels_(labels) {}

    void next(std::span<Label> section) override {
        input_.resize(section.size());
        const bool is_read = reader_->next(input_);
        for (std::size_t n = 0; n < section.size(); ++n) {
            // Neighbours mostly have the same label.
            if (n == 0 || input_[n] != input_[n - 1]) last_ = labels_.find(input_[n]);
            if (!is_read || !last_)
                throw Error(ErrorCode::kInput, reader_->info().source +
                                                   ": has a label that it did not have when the run was begun; give "
                                                   "the volume that it was begun with, or another folder");
            section[n] = *last_;
        }
    }

private:
    std::unique_ptr<SectionReader> reader_;
    const LabelTable& labels_;
    std::vector<InputLabel> input_;
    std::optional<Label> last_;
};

}  // namespace

bool can_crop(SectionReader& reader) { return reader.crop({{0, 0, 0}, reader.info().lattice.size}); }

std::unique_ptr<BoxSections> LabelsInPlace::open(const IndexBox& box) const {
    std::unique_ptr<SectionReader> reader = open_();
    reader->crop(box);
    return std::make_unique<Sections>(std::move(reader), labels_);
}

}  // namespace regionmesh
