#include "advice.h"

#include <fmt/core.h>

#include <algorithm>
#include <functional>
#include <set>
#include <unordered_set>
#include <utility>
#include <vector>

#include "messages.h"
#include "output.h"
#include "printable.h"

namespace regionmesh::cli {
namespace {

// Noise of a few grey values leaves more than half of the samples alone; thin regions leave a few per cent of labels
// so.
constexpr double kGreyShare = 0.25;
constexpr std::size_t kGreyValues = 24;
constexpr std::uint64_t kGreySamples = 200'000;  // that are not background: enough to judge
constexpr std::uint32_t kGreySections = 1000;

/// Input labels on the faces: all that the input has, unless one fills it.
std::set<InputLabel> labels_on(const Mesh& mesh, const LabelTable& labels) {
    std::vector<bool> is_there(labels.size());
    for (std::uint32_t f = 0; f < mesh.face_end(); ++f)
        if (mesh.is_alive(FaceId{f}))
            for (const Label label : mesh[FaceId{f}].labels)
                if (!is_exterior(label)) is_there[label] = true;
    std::set<InputLabel> found;
    for (Label label = 0; label < labels.size(); ++label)
        if (is_there[label]) found.insert(labels.input(label));
    return found;
}

/// Samples of a section that differ from their neighbours in it.
struct GreyCount {
    std::unordered_set<InputLabel> values;
    std::uint64_t samples = 0, alone = 0;

    void add(const std::vector<InputLabel>& section, std::uint32_t width, const std::vector<InputLabel>& background) {
        for (std::size_t n = 0; n < section.size(); ++n) {
            const InputLabel value = section[n];
            if (std::ranges::find(background, value) != background.end()) continue;
            const std::size_t column = n % width;
            const bool has_like = (column > 0 && section[n - 1] == value) ||
                                  (column + 1 < width && section[n + 1] == value) ||
                                  (n >= width && section[n - width] == value) ||
                                  (n + width < section.size() && section[n + width] == value);
            ++samples;
            alone += !has_like;
            if (!has_like) values.insert(value);
        }
    }
    bool is_grey() const {
        return values.size() >= kGreyValues && static_cast<double>(alone) > kGreyShare * static_cast<double>(samples);
    }
};

}  // namespace

void require_regions(const Settings& settings, const CheckReport& report) {
    if (!report.regions.empty()) return;
    const ReconstructOptions& options = settings.reconstruct;
    const bool has_smallest = settings.volume.select.min_region > 1;
    const std::string what = options.room > 0 ? "what --room left of it"
                             : has_smallest   ? "what --min-region left of it"
                                              : "it";
    std::string why = what + " has one label only, which has no face with --boundary open; give --boundary cap";
    if (options.cap) {
        why = "all of " + what + " is background";
        why += given_text(settings, "labels") ? ": it has none of the --labels; regionmesh info lists those that it has"
               : has_smallest                 ? "; give a smaller --min-region"
                                              : "; give another --background, or --no-background";
    }
    throw Error(ErrorCode::kInput, settings.inputs.front() + ": there is no region to model: " + why);
}

void warn_of_absent_labels(const Settings& settings, const Mesh& mesh, const LabelTable& labels) {
    const bool has_background = given_text(settings, "background"), has_labels = given_text(settings, "labels");
    if (!has_background && !has_labels) return;
    const std::set<InputLabel> found = labels_on(mesh, labels);
    const auto warn_of = [&](const char* option, const std::string& label) {
        warn(fmt::format("--{} {}: {} has no such label; regionmesh info lists those that it has", option, label,
                         settings.inputs.front()));
    };
    if (has_background) {
        std::vector<InputLabel> absent;
        for (const InputLabel label : settings.reconstruct.background)
            if (!found.contains(label)) absent.push_back(label);
        const std::string more = absent.size() > 1 ? fmt::format(" and {} more", grouped(absent.size() - 1)) : "";
        if (!absent.empty()) warn_of("background", labels.text(absent.front()) + more);
    }
    for (const LabelRange& range : settings.volume.select.labels) {
        const bool occurs = std::ranges::any_of(found, [&](InputLabel label) {
            return !labels.less(label, range.first) && !labels.less(range.last, label);
        });
        const std::string last = range.first == range.last ? "" : '-' + labels.text(range.last);
        if (!occurs) warn_of("labels", labels.text(range.first) + last);
    }
}

void warn_of_units(const std::string& a, const std::optional<double>& metres_a, const std::string& b,
                   const std::optional<double>& metres_b) {
    if (metres_a && metres_b && *metres_a != *metres_b)
        warn(fmt::format("{} is in {} and {} in {}: they are compared as they are", a, length_symbol(*metres_a), b,
                         length_symbol(*metres_b)));
}

void warn_of_passes(const Settings& settings) {
    const SmoothOptions& smooth = settings.reconstruct.smooth;
    const bool is_lattice = smooth.filter == SmoothFilter::kAuto || smooth.filter == SmoothFilter::kLattice;
    if (smooth.passes == 0 || !is_lattice) return;
    const auto warn_of = [](const std::string& option, const char* what) {
        warn(fmt::format("{}: without effect, since the filter lattice {}; --smooth-filter taubin uses it", option,
                         what));
    };
    const std::string* const much = given_text(settings, "smooth");
    const bool is_number = much && much->find_first_not_of("0123456789") == std::string::npos;
    if (is_number && smooth.passes != SmoothOptions{}.passes)
        warn_of("--smooth " + *much, "has no passes: this is --smooth normal");
    if (smooth.move_points) warn_of("--smooth-points", "always moves quadruple points");
    if (given_text(settings, "smooth-lambda")) warn_of("--smooth-lambda", "has no passes");
}

void warn_of_same_smoothing(const Settings& settings, const Vec3& spacing) {
    const std::string* const much = given_text(settings, "smooth");
    if (!much || !is_usual_smoothing(settings, spacing)) return;
    warn(fmt::format(
        "--smooth {}: without effect, since it is what normal does where sections are far apart; --denoise 1 lets more "
        "change",
        *much));
}

namespace {

/// What a refusal means, and what helps.
std::string remedy_of(Verdict verdict, bool has_samples) {
    switch (verdict) {
        case Verdict::kSamples:
            return "a sample would lie in another region: labels that are rough need many faces; try --denoise 1, "
                   "--downsample 2, or --no-keep-samples";
        case Verdict::kQuality:
            return "a face would be of low quality; try a lower --min-quality";
        case Verdict::kIntersect:
            return "faces would cross: regions are packed or thin; try a lower reduction";
        case Verdict::kError:
            return "the surface would be off by more than --max-error; try a larger one";
        case Verdict::kFold:
        case Verdict::kPinch:
            return "a face would turn over: the surface is rough or thin; try --smooth strong";
        case Verdict::kStrata:
        case Verdict::kLink:
        case Verdict::kAccepted:
            break;
    }
    return std::string("the topology of a region, interface or line would change: there are many small ones; try ") +
           (has_samples ? "--min-region 100 or --downsample 2" : "a lower reduction");
}

}  // namespace

std::string missed_text(const Settings& settings, const VerdictCounts& verdicts) {
    std::uint64_t refused = 0;
    std::size_t most = static_cast<std::size_t>(Verdict::kStrata);
    for (std::size_t n = most; n < verdicts.size(); ++n) {
        refused += verdicts[n];
        if (verdicts[n] > verdicts[most]) most = n;
    }
    const bool has_samples = !settings.inputs.empty() && is_lattice(settings, settings.inputs);
    return fmt::format(
        "{}: {:.0f} % of the refusals: {}", kVerdictNames[most],
        100 * static_cast<double>(verdicts[most]) / static_cast<double>(std::max<std::uint64_t>(refused, 1)),
        remedy_of(static_cast<Verdict>(most), has_samples));
}

void warn_of_grey_scale(const Settings& settings, SectionReader& reader) {
    if (!reader.info().can_rewind) return;
    const std::uint64_t samples = std::uint64_t{reader.section_width()} * reader.section_height();
    // A section that leaves no room for reconstruct() is refused there, before it is read.
    constexpr std::uint64_t kBytesPerSample = 64;
    if (samples > settings.reconstruct.memory / kBytesPerSample) return;
    reader.rewind();
    GreyCount count;
    std::vector<InputLabel> section(samples);
    for (std::uint32_t n = 0; n < kGreySections && count.samples < kGreySamples && reader.next(section); ++n)
        count.add(section, reader.section_width(), settings.reconstruct.background);
    reader.rewind();
    if (!count.is_grey()) return;
    warn(fmt::format(
        "{} looks like a grey-scale image, not like labels: {} values and more, and {:.0f} % of the samples "
        "differ from their neighbours; segment it first, and give the labels",
        reader.info().source, count.values.size(),
        100 * static_cast<double>(count.alone) / static_cast<double>(count.samples)));
}

std::string background_text(const Settings& settings, const Reconstruction& made) {
    if (!made.report.samples || made.report.samples->samples == 0) return {};
    std::uint64_t samples = 0;
    std::string labels;
    std::size_t count = 0;
    for (const Label label : made.background) {
        if (label >= made.report.samples->regions.size()) continue;
        const std::uint64_t own = made.report.samples->regions[label].in_sections;
        if (own == 0) continue;
        samples += own;
        constexpr std::size_t kShown = 5;
        if (count++ < kShown) labels += (labels.empty() ? "" : ", ") + made.labels.text(made.labels.input(label));
        if (count == kShown + 1) labels += ", ...";
    }
    if (samples == 0) return {};
    const double share = 100 * static_cast<double>(samples) / static_cast<double>(made.report.samples->samples);
    return fmt::format("; {:.3g} % of the samples are background, label {} ({})", share, labels,
                       has_background(settings) ? "as --background says" : "--no-background makes it a region");
}

void warn_of_overlaps(const Overlaps& overlaps, const LabelTable& labels, const LabelNames& names) {
    if (overlaps.samples.empty()) return;
    std::vector<std::pair<std::uint64_t, std::pair<InputLabel, InputLabel>>> pairs;
    for (const auto& [pair, samples] : overlaps.samples) pairs.emplace_back(samples, pair);
    std::ranges::stable_sort(pairs, std::greater<>(), [](const auto& entry) { return entry.first; });
    const auto name_of = [&](InputLabel label) {
        const auto name = names.find(label);
        return name == names.end() ? labels.text(label) : printable(name->second);
    };
    constexpr std::size_t kShown = 3;
    std::string text;
    for (std::size_t n = 0; n < std::min(kShown, pairs.size()); ++n)
        text += fmt::format("{}{} and {} in {}", n == 0 ? "" : ", ", name_of(pairs[n].second.first),
                            name_of(pairs[n].second.second), counted(pairs[n].first, "sample"));
    if (pairs.size() > kShown)
        text += fmt::format(", and {}, which --report lists", counted(pairs.size() - kShown, "more pair"));
    warn(fmt::format("regions overlap: {}; the later region has them, unless --priority says otherwise", text));
}

}  // namespace regionmesh::cli
