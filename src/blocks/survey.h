// One pass over the labels of a volume, before it is cut into blocks.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "blocks/labels_in_place.h"
#include "blocks/sample_hashes.h"
#include "blocks/staged_labels.h"
#include "cells/strip_mesher.h"
#include "regionmesh/label_table.h"
#include "regionmesh/section_reader.h"

namespace regionmesh {

struct Survey {
    LabelTable labels;        // the background first, then in the order in which sections have them
    SampleHashes hashes;      // of all samples
    std::uint64_t faces = 0;  // before simplification
};

struct SurveyOptions {
    StripOptions strips = {};  // but for its background
    std::vector<InputLabel> background = {};
    std::function<void(std::uint32_t done, std::uint32_t count)> on_strip = {};
};

/// Reads section by section; holds two. Writes the labels to `copy`, if given.
Survey survey_sections(SectionReader& reader, const SurveyOptions& options, StagingFile* copy);

/// Boxes of samples that cover the cells of a volume: `parts` of them or more where it has as many strips, with at most
/// `most_samples` in a section. They share the samples between them.
std::vector<IndexBox> survey_boxes(const VolumeInfo& volume, std::uint64_t most_samples, std::uint32_t parts);

/// What a box has.
struct PartSurvey {
    struct First {
        InputLabel label;
        std::uint64_t place;  // of the first sample with this label, counted along the sweep of the whole volume
    };
    std::uint64_t faces = 0;
    std::vector<First> labels;
    SampleHashes hashes;  // of those of its samples that no box after it shares
};

/// The hashes of a part, before it is surveyed.
SampleHashes hashes_of_part(const VolumeInfo& volume, const IndexBox& box);

/// Requires that can_crop() a reader.
PartSurvey survey_part(const OpenSections& open, const IndexBox& box, const SurveyOptions& options);

/// The same as survey_sections(), out of all boxes.
Survey join_surveys(const VolumeInfo& volume, const std::vector<InputLabel>& background,
                    std::span<const PartSurvey> parts);

}  // namespace regionmesh
