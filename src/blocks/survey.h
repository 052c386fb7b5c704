// One pass over the labels of a volume, before it is cut into blocks.
#pragma once

#include <cstdint>
#include <functional>

#include "blocks/labels_in_place.h"
#include "blocks/staged_labels.h"
#include "cells/strip_mesher.h"
#include "regionmesh/label_table.h"
#include "regionmesh/section_reader.h"

namespace regionmesh {

struct Survey {
    LabelTable labels;        // the background first, then in the order in which sections have them
    std::uint64_t faces = 0;  // before simplification
};

struct SurveyOptions {
    StripOptions strips = {};  // but for its background
    std::vector<InputLabel> background = {};
    std::function<void(std::uint32_t done, std::uint32_t count)> on_strip = {};
};

/// Reads section by section; holds two. Writes the labels to `copy`, if given.
Survey survey_sections(SectionReader& reader, const SurveyOptions& options, StagingFile* copy);

/// The same by columns of at most `most_samples` samples of a section, for sections that memory does not hold. Reads
/// samples between two columns twice. Requires that can_crop() a reader.
Survey survey_columns(const OpenSections& open, std::uint64_t most_samples, const SurveyOptions& options);

}  // namespace regionmesh
