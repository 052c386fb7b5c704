// Labels read where they are: out of an input from which any box can be read.
#pragma once

#include <functional>

#include "blocks/label_boxes.h"
#include "regionmesh/label_table.h"
#include "regionmesh/section_reader.h"

namespace regionmesh {

using OpenSections = std::function<std::unique_ptr<SectionReader>()>;

/// Whether a reader can leave out all samples but those of a box.
bool can_crop(SectionReader& reader);

/// Opens the input once for every box.
class LabelsInPlace final : public LabelBoxes {
public:
    /// Requires that can_crop() a reader. `labels` has all labels of the input. Both must outlive this.
    LabelsInPlace(const OpenSections& open, const LabelTable& labels) : open_(open), labels_(labels) {}

    std::unique_ptr<BoxSections> open(const IndexBox& box) const override;

private:
    const OpenSections& open_;
    const LabelTable& labels_;
};

}  // namespace regionmesh
