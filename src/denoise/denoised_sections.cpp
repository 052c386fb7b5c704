// Measures, removes specks, finds the smoother labels, sweeps; then hands out the sections with what changed.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>
#include <vector>

#include "base/megabytes.h"
#include "base/option_range.h"
#include "base/parallel_for.h"
#include "denoise/candidates.h"
#include "denoise/coarse_lattice.h"
#include "denoise/coarse_surface.h"
#include "denoise/smooth_labels.h"
#include "denoise/sweep_window.h"
#include "denoise/tuning.h"
#include "regionmesh/denoise.h"
#include "regionmesh/error.h"
#include "regionmesh/label_table.h"
#include "volume/chosen_sections.h"

namespace regionmesh {
namespace {

/// Spacings along the axes of the sweep, in finest spacings.
Vec3 steps_of(const VolumeInfo& info) {
    const Vec3 spacing = info.lattice.spacing;
    const double finest = std::min({spacing.x, spacing.y, spacing.z});
    const auto& axes = info.sweep.axes;
    return Vec3{spacing[axes[0]], spacing[axes[1]], spacing[axes[2]]} / finest;
}

std::string number_text(double number) {
    char text[32];
    std::snprintf(text, sizeof text, "%.3g", number);
    return text;
}

std::string counted(std::uint64_t count, const char* noun) {
    return std::to_string(count) + " " + noun + (count == 1 ? "" : "s");
}

/// What is asked of the labels, from their roughness.
struct Plan {
    double distance = 0;   // 0: no sample changes
    double deviation = 0;  // of the weights round a sample; 0: the surface of the coarser lattice
    bool has_specks = false, cuts = false;
    int sweeps = 6;
};

Plan make_plan(const DenoiseOptions& options, const Roughness& roughness, Vec3 steps, const VolumeInfo& info) {
    Plan plan;
    const bool is_auto = options.distance == kAutoDenoise;
    const bool is_noisy = !roughness.is_enlarged() && (roughness.is_ragged() || roughness.is_speckled());
    plan.has_specks = options.specks > 0 || (options.specks == kAutoSpecks && is_noisy);
    plan.cuts = plan.has_specks && is_noisy &&
                (roughness.ragged >= denoising::kCutRagged || roughness.stray >= denoising::kManyStrays);
    if (roughness.is_enlarged()) {
        for (std::size_t n = 0; n < 3; ++n) {
            const double factor = roughness.enlarged[static_cast<std::size_t>(info.sweep.axes[n])];
            if (factor > 1) plan.distance = std::max(plan.distance, factor * steps[static_cast<int>(n)]);
            plan.sweeps = std::max(plan.sweeps, 4 + 2 * static_cast<int>(std::ceil(factor)));
        }
        if (!is_auto) plan.distance = std::min(plan.distance, options.distance);
    } else if (!is_auto) {
        plan.distance = plan.deviation = options.distance;
    } else if (roughness.is_ragged()) {
        plan.distance = plan.deviation =
            roughness.ragged >= denoising::kVeryRagged ? denoising::kWideDeviation : denoising::kDeviation;
    }
    return plan;
}

SweepOptions sweep_options(const Plan& plan, const VolumeInfo& info, std::uint32_t threads) {
    const auto along = [&](std::size_t axis) {
        return info.lattice.size[static_cast<std::size_t>(info.sweep.axes[axis])];
    };
    return {.width = along(0),
            .height = along(1),
            .count = along(2),
            .sweeps = plan.distance > 0 ? plan.sweeps : 0,
            .cuts = plan.cuts,
            .threads = threads};
}

/// Sections on each side of one whose candidates are looked for.
std::uint32_t reach_of(const Plan& plan, Vec3 steps) {
    const std::uint32_t reach = BoundaryDistance(steps, plan.distance).reach();
    return plan.deviation > 0 ? std::max(reach, SmoothLabels::reach_of(steps, plan.deviation)) : reach;
}

}  // namespace

std::uint64_t bytes_to_denoise(const VolumeInfo& volume, const Roughness& roughness, const DenoiseOptions& options) {
    const Vec3 steps = steps_of(volume);
    const Plan plan = make_plan(options, roughness, steps, volume);
    if (plan.distance == 0 && !plan.has_specks) return 0;
    const SweepOptions sweeps = sweep_options(plan, volume, 1);
    const SweepWindow window(sweeps, reach_of(plan, steps), {}, {});
    // The section as read, twice with specks; candidates are few.
    const std::uint64_t per_sample = window.sections() * (sizeof(Label) + 1) + 3 * sizeof(InputLabel);
    return kProcessBytes + volume.held_bytes + std::uint64_t{sweeps.width} * sweeps.height * per_sample;
}

void require_in_range(const DenoiseOptions& options) {
    if (options.distance != kAutoDenoise)
        require_number("denoise", options.distance, {0, kMostDenoise, "auto, or 0 to 8"});
    if (options.specks != kAutoSpecks)
        require_number("specks", static_cast<double>(options.specks),
                       {0, static_cast<double>(kMostSpeck), "auto, or 0 to 1000000"});
}

struct DenoisedSections::State {
    State(SectionReader& sections, const DenoiseOptions& given) : reader(sections), options(given) {
        require_in_range(options);
        if (options.distance == 0) return;
        const VolumeInfo& info = reader.info();
        if (!info.can_rewind) {
            report.refused = "the input can be read once only";
            return;
        }
        report.samples = std::uint64_t{reader.section_width()} * reader.section_height() * reader.section_count();
        report.roughness = measure_roughness(reader, options.threads);
        const Plan plan = make_plan(options, *report.roughness, steps_of(info), info);
        if (plan.distance > 0 || plan.has_specks) {
            require_memory(bytes_to_denoise(info, *report.roughness, options));
            denoise(plan);
        }
        reader.rewind();
    }

    void require_memory(std::uint64_t needed) const {
        if (options.memory == 0 || needed <= options.memory) return;
        throw Error(ErrorCode::kInput, memory_limit_text(options.memory) + ": " + reader.info().source +
                                           " needs at least " + megabytes(needed) + ", since its labels are " +
                                           report.roughness->text() +
                                           "; raise --memory, or keep them with --denoise off");
    }

    void denoise(const Plan& plan) {
        std::unique_ptr<SpecklessSections> speckless;
        if (plan.has_specks) {
            speckless = merge_specks(
                reader, {options.specks > 0 ? static_cast<std::uint64_t>(options.specks) : std::uint64_t{0}});
            report.specks = speckless->counts().specks;
            report.speck_samples = speckless->counts().samples;
            report.largest_speck = speckless->counts().largest;
            if (report.specks == 0) speckless.reset();
        }
        if (plan.distance == 0 && !speckless) return;
        SectionReader& from = speckless ? static_cast<SectionReader&>(*speckless) : reader;
        LabelTable labels(reader.info().type == SampleType::kU64);
        ItemsBySection<Candidate> candidates;
        if (plan.distance > 0 && plan.deviation == 0) find_on_coarse_lattice(from, labels, candidates);
        sweep(plan, from, speckless.get(), labels, candidates);
    }

    /// The coarse labels may be rough, too.
    void find_on_coarse_lattice(SectionReader& from, LabelTable& labels, ItemsBySection<Candidate>& candidates) const {
        const auto axes = coarse_axes(reader.info(), *report.roughness);
        CoarseSections coarse(from, axes);
        DenoisedSections smoother(coarse, {.specks = 0, .threads = options.threads});
        find_candidates(smoother, axes, labels, options.threads, candidates);
    }

    void sweep(const Plan& plan, SectionReader& from, SpecklessSections* speckless, LabelTable& labels,
               const ItemsBySection<Candidate>& candidates) {
        from.rewind();
        const Vec3 steps = steps_of(reader.info());
        const std::uint32_t width = reader.section_width(), height = reader.section_height();
        const BoundaryDistance distance(steps, plan.distance);
        const SmoothLabels smooth(steps, std::max(plan.deviation, 0.1), labels);
        std::vector<Candidate> listed;
        const auto find = [&](const LabelWindow& window, std::uint32_t s, std::vector<Moving>& found) {
            if (plan.distance == 0) return;
            if (plan.deviation == 0) {
                candidates.read(s, listed);
                find_listed(window, s, distance, listed, found);
            } else {
                find_smooth(window, s, distance, smooth, found);
            }
        };
        std::deque<std::vector<std::uint32_t>> specks;  // of sections not handed out yet
        std::vector<SampleChange> changed;
        std::vector<bool> is_left;  // by label
        const auto hand_out = [&](std::uint32_t, const std::vector<Label>& section, const std::vector<Moving>& moving) {
            changed.clear();
            for (const std::uint32_t sample : specks.front())
                changed.push_back({sample, labels.input(section[sample])});
            for (const Moving& candidate : moving) {
                if (!candidate.is_changed) continue;
                note(candidate, labels);
                if (!std::ranges::binary_search(specks.front(), candidate.sample))
                    changed.push_back({candidate.sample, labels.input(candidate.to)});
            }
            specks.pop_front();
            changes.append(changed);
            is_left.resize(labels.size());
            for (const Label label : section)
                if (!is_left[label]) is_left[label] = true;
        };
        SweepWindow window(sweep_options(plan, reader.info(), options.threads), reach_of(plan, steps), find, hand_out);
        std::vector<InputLabel> input(std::size_t{width} * height);
        for (std::uint32_t s = 0; s < reader.section_count(); ++s) {
            require_section(from.next(input), from.info(), s);
            specks.emplace_back();
            if (speckless) specks.back().assign(speckless->changed().begin(), speckless->changed().end());
            std::vector<Label> section(input.size());
            labels.dense(input, section);
            window.add(std::move(section));
        }
        report.labels = labels.size();
        report.labels_left = static_cast<std::uint64_t>(std::ranges::count(is_left, true));
    }

    void find_listed(const LabelWindow& window, std::uint32_t s, const BoundaryDistance& distance,
                     const std::vector<Candidate>& listed, std::vector<Moving>& found) const {
        const std::vector<Label>& own = window.section(s);
        for (const Candidate& candidate : listed) {
            if (own[candidate.sample] == candidate.to) continue;
            const float far = distance.of(window, candidate.sample % window.width, candidate.sample / window.width, s);
            if (far >= 0) found.push_back({candidate.sample, own[candidate.sample], candidate.to, far});
        }
    }

    void find_smooth(const LabelWindow& window, std::uint32_t s, const BoundaryDistance& distance,
                     const SmoothLabels& smooth, std::vector<Moving>& found) const {
        std::vector<std::vector<Moving>> rows(window.height);
        parallel_for(window.height, options.threads, [&](std::uint32_t j) {
            SmoothLabels::Weights weights;
            const Label* own = &window.section(s)[std::size_t{j} * window.width];
            for (std::uint32_t i = 0; i < window.width; ++i) {
                const float far = distance.of(window, i, j, s);
                if (far < 0) continue;
                if (const Label to = smooth.of(window, i, j, s, weights); to != own[i])
                    rows[j].push_back({j * window.width + i, own[i], to, far});
            }
        });
        for (const auto& row : rows) found.insert(found.end(), row.begin(), row.end());
    }

    void note(const Moving& candidate, const LabelTable& labels) {
        ++report.changed;
        report.cut_samples += candidate.is_cut;
        report.largest_distance = std::max(report.largest_distance, candidate.distance * finest());
        ++report.regions[labels.input(candidate.from)].lost;
        ++report.regions[labels.input(candidate.to)].gained;
    }

    double finest() const {
        const Vec3 spacing = reader.info().lattice.spacing;
        return std::min({spacing.x, spacing.y, spacing.z});
    }

    SectionReader& reader;
    DenoiseOptions options;
    DenoiseReport report;
    ItemsBySection<SampleChange> changes;  // none: nothing changed
    std::vector<SampleChange> of_section;
    std::uint32_t read = 0;  // sections
};

DenoisedSections::DenoisedSections(SectionReader& reader, const DenoiseOptions& options)
    : state_(std::make_unique<State>(reader, options)) {}

DenoisedSections::DenoisedSections(std::unique_ptr<SectionReader> reader, const DenoiseOptions& options)
    : own_(std::move(reader)), state_(std::make_unique<State>(*own_, options)) {}

DenoisedSections::~DenoisedSections() = default;

const VolumeInfo& DenoisedSections::info() const { return state_->reader.info(); }

bool DenoisedSections::next(std::span<InputLabel> section) {
    State& state = *state_;
    if (!state.reader.next(section)) return false;
    if (state.read < state.changes.sections()) {
        state.changes.read(state.read, state.of_section);
        for (const SampleChange& change : state.of_section) section[change.sample] = change.to;
    }
    ++state.read;
    return true;
}

void DenoisedSections::rewind() {
    state_->reader.rewind();
    state_->read = 0;
}

const DenoiseReport& DenoisedSections::report() const { return state_->report; }

std::unique_ptr<SectionReader> denoise_sections(std::unique_ptr<SectionReader> reader, const DenoiseOptions& options) {
    require_in_range(options);
    if (options.distance == 0) return reader;
    return std::make_unique<DenoisedSections>(std::move(reader), options);
}

std::string DenoiseReport::text() const {
    if (!refused.empty()) return "labels were not measured: " + refused;
    if (!roughness) return "labels were kept";
    std::string text = "labels are " + roughness->text();
    if (specks > 0)
        text += "; " + counted(specks, "speck") + " of at most " + counted(largest_speck, "sample") +
                (specks == 1 ? " was given to its neighbour" : " were given to their neighbours");
    if (changed > 0)
        text +=
            "; " + counted(changed, "sample") + " at most " + number_text(largest_distance) + " deep changed the label";
    return text;
}

}  // namespace regionmesh
