#include "regionmesh/census.h"

#include "base/parallel_invoke.h"
#include "cells/label_census.h"
#include "volume/section_window.h"

namespace regionmesh {

LabelTable table_for(const VolumeInfo& volume) { return LabelTable(volume.type == SampleType::kU64); }

std::vector<Label> dense_background(const std::vector<InputLabel>& background, LabelTable& labels) {
    std::vector<Label> dense;
    for (InputLabel label : background) dense.push_back(labels.dense(label));
    return dense;
}

Census count_labels(SectionReader& reader, const CensusOptions& options) {
    if (reader.info().can_rewind) reader.rewind();
    Census census{.labels = table_for(reader.info()), .samples = {}, .strip_faces = {}, .oracle = {}};
    const std::vector<Label> background = dense_background(options.background, census.labels);
    SectionWindow window(reader, census.labels);
    LabelCensus counter(reader.info().lattice, reader.info().sweep,
                        {.cap = options.cap, .background = background, .cells = options.cells});
    const auto add_samples = [&](std::span<const Label> section) {
        census.samples.resize(census.labels.size(), 0);
        for (Label label : section) ++census.samples[label];
    };
    const auto count = [&] {
        const std::uint64_t before = counter.face_count();
        counter.add(window.low(), window.high(), window.is_last());
        census.strip_faces.push_back(counter.face_count() - before);
    };
    bool is_more = window.advance();
    if (is_more) {
        add_samples(window.low());
        add_samples(window.high());
    }
    while (is_more) {
        parallel_invoke(options.threads, count, [&] { add_samples(window.read_ahead()); });
        if (options.on_strip) options.on_strip(static_cast<std::uint32_t>(census.strip_faces.size()));
        is_more = window.advance();
    }
    census.face_count = counter.face_count();
    census.oracle = counter.oracle();
    return census;
}

}  // namespace regionmesh
