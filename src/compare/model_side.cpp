#include "compare/model_side.h"

#include <algorithm>
#include <map>

namespace regionmesh {
namespace {

using Sums = std::map<std::vector<Label>, double>;  // key: labels; area or length

void add(const SortedStrata& part, Sums& sums, ModelStrata& model) {
    for (const Stratum& stratum : part.strata) sums[stratum.labels] += part.measure(stratum);
    Box& box = model.boxes.emplace_back();
    for (const Vec3& point : part.points) box.add(point);
}

void put(Sums&& sums, ModelStrata& model) {
    for (const auto& [labels, measure] : sums) {
        model.labels.push_back(labels);
        model.measures.push_back(measure);
    }
}

}  // namespace

std::uint32_t ModelStrata::find(const std::vector<Label>& of_stratum) const {
    const auto at = std::ranges::lower_bound(labels, of_stratum);
    return at != labels.end() && *at == of_stratum ? static_cast<std::uint32_t>(at - labels.begin()) : kNoStratum;
}

std::vector<std::uint32_t> ModelStrata::numbers_of(const SortedStrata& part) const {
    std::vector<std::uint32_t> numbers;
    for (const Stratum& stratum : part.strata) numbers.push_back(find(stratum.labels));
    return numbers;
}

ModelSide::ModelSide(const ComparedModel& model, const CommonLabels& labels, int which, const SideOptions& options)
    : model_(model), labels_(labels), which_(which), options_(options) {
    Sums areas, lengths;
    for (std::uint32_t n = 0; n < part_count(); ++n) {
        const SearchedPart& part = read(n);
        add(part.interfaces, areas, interfaces_);
        add(part.lines, lengths, lines_);
        if (!part.interfaces.points.empty()) bounds_.join(part.interfaces.bounds);
    }
    put(std::move(areas), interfaces_);
    put(std::move(lengths), lines_);
    face_samples_.emplace(interfaces_.measures, options.samples);
    line_samples_.emplace(lines_.measures, options.samples / 10);
}

SearchedPart& ModelSide::read(std::uint32_t part) {
    if (part_ && number_ == part) return *part_;
    part_.reset();
    model_.read(part, [&](const Mesh& mesh, const MeshPart* own) {
        const CommonView view{mesh, labels_, which_, options_.background, own};
        part_.reset(new SearchedPart{.interfaces = interfaces_of(view, options_.threads),
                                     .lines = lines_of(view, options_.sides_apart, options_.threads),
                                     .face_tree = {},
                                     .line_tree = {}});
    });
    number_ = part;
    return *part_;
}

ModelSide::Points ModelSide::sample() {
    SamplePoints faces(*face_samples_), lines(*line_samples_);
    for (std::uint32_t n = 0; n < part_count(); ++n) {
        const SearchedPart& part = read(n);
        faces.add(part.interfaces, interfaces_.numbers_of(part.interfaces), options_.threads);
        lines.add(part.lines, lines_.numbers_of(part.lines), options_.threads);
    }
    return {faces.take(), lines.take()};
}

const SearchedPart& ModelSide::searched(std::uint32_t part) {
    SearchedPart& found = read(part);
    if (!found.face_tree) {
        found.face_tree.emplace(found.interfaces, options_.threads);
        found.line_tree.emplace(found.lines, options_.threads);
    }
    return found;
}

void ModelSide::drop_trees() {
    if (!part_) return;
    part_->face_tree.reset();
    part_->line_tree.reset();
}

}  // namespace regionmesh
