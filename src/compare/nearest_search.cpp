#include "compare/nearest_search.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/box.h"
#include "base/parallel_for.h"

namespace regionmesh {
namespace {

constexpr std::uint32_t kChunk = 4096;  // points per task; each search starts at the result before
constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr std::uint32_t kNoPart = 0xFFFFFFFFu;

std::uint32_t chunks_of(std::size_t count) { return static_cast<std::uint32_t>((count + kChunk - 1) / kChunk); }

/// Calls work(first, end) for chunks of [0, count).
template <class Work>
void in_chunks(std::size_t count, std::uint32_t threads, Work&& work) {
    parallel_for(chunks_of(count), threads, [&](std::uint32_t chunk) {
        const std::size_t first = std::size_t{chunk} * kChunk;
        work(first, std::min(count, first + kChunk));
    });
}

/// The numbers below `count` that are wanted, in ascending order.
template <class IsWanted>
std::vector<std::uint64_t> those_of(std::size_t count, std::uint32_t threads, IsWanted&& is_wanted) {
    std::vector<std::uint64_t> all;
    const auto find = [&](std::uint32_t chunk, std::uint32_t) {
        std::vector<std::uint64_t> found;
        const std::size_t first = std::size_t{chunk} * kChunk, end = std::min(count, first + kChunk);
        for (std::size_t n = first; n < end; ++n)
            if (is_wanted(n)) found.push_back(n);
        return found;
    };
    for_chunks(chunks_of(count), 1, threads, find,
               [&](const std::vector<std::uint64_t>& found) { all.insert(all.end(), found.begin(), found.end()); });
    return all;
}

std::uint32_t nearest_box(const std::vector<Box>& boxes, Vec3 p) {
    double least = HUGE_VAL;
    std::uint32_t nearest = kNoPart;
    for (std::uint32_t n = 0; n < boxes.size() && least > 0; ++n)
        if (const double squared = squared_distance(boxes[n], p); squared < least) {
            least = squared;
            nearest = n;
        }
    return nearest;
}

bool has(const Goals& goals, Goal goal) {
    switch (goal) {
        case Goal::kAll:
            return goals.all;
        case Goal::kFirstRegion:
            return !is_exterior(goals.regions[0]);
        case Goal::kSecondRegion:
            return !is_exterior(goals.regions[1]);
        case Goal::kStratum:
            return goals.stratum != kNoStratum;
    }
    return false;
}

/// Looks for the nearest simplices in a part.
class Look {
public:
    Look(const StrataTree& tree, std::span<const std::uint32_t> numbers) : tree_(tree), numbers_(numbers) {}

    /// Lowers the squared distances of a point with these goals: of all, of regions, of the stratum.
    void operator()(Vec3 p, const Goals& goals, const std::array<double*, kGoalCount>& squared) {
        Nearest found;
        if (goals.all) {
            found = tree_.nearest(p, guess_, *squared[0]);
            *squared[0] = found.squared;
            if (found.simplex != kNoSimplex) guess_ = found;
        }
        // The nearest simplex of all is also the nearest of its region and interface.
        const Stratum* const there = found.simplex != kNoSimplex ? &tree_.sorted().strata[found.stratum] : nullptr;
        for (int n = 0; n < 2; ++n) {
            const Label label = goals.regions[n];
            if (is_exterior(label)) continue;
            double& least = *squared[1 + n];
            least = there && there->contains(label) ? found.squared : tree_.nearest_of_label(p, label, least).squared;
        }
        if (goals.stratum == kNoStratum) return;
        double& least = *squared[3];
        least = there && numbers_[found.stratum] == goals.stratum
                    ? found.squared
                    : tree_.nearest_of_stratum(p, place_of(goals.stratum), least).squared;
    }

private:
    /// The stratum of the part with a number of the model, or kNoStratum.
    std::uint32_t place_of(std::uint32_t number) {
        if (number != last_number_) {
            const auto at = std::ranges::lower_bound(numbers_, number);
            last_number_ = number;
            last_place_ =
                at != numbers_.end() && *at == number ? static_cast<std::uint32_t>(at - numbers_.begin()) : kNoStratum;
        }
        return last_place_;
    }

    const StrataTree& tree_;
    std::span<const std::uint32_t> numbers_;  // ascending
    Nearest guess_;
    std::uint32_t last_number_ = kNoStratum, last_place_ = kNoStratum;
};

}  // namespace

NearestSearch::NearestSearch(std::span<const Vec3> points, const Samples& samples, std::vector<Goals> goals)
    : points_(points), samples_(&samples), goals_(std::move(goals)) {
    set_goals();
}

NearestSearch::NearestSearch(std::span<const Vec3> points) : points_(points), goals_{{.all = true}} { set_goals(); }

void NearestSearch::set_goals() {
    for (int n = 0; n < kGoalCount; ++n) {
        const auto has_goal = [&](const Goals& goals) { return has(goals, Goal{n}); };
        if (std::ranges::none_of(goals_, has_goal)) continue;
        squared_[n].assign(points_.size(), samples_ ? kNone : HUGE_VAL);
        for (std::uint32_t stratum = 0; samples_ && stratum < goals_.size(); ++stratum)
            if (has_goal(goals_[stratum]))
                std::fill(squared_[n].begin() + static_cast<std::ptrdiff_t>(samples_->begin(stratum)),
                          squared_[n].begin() + static_cast<std::ptrdiff_t>(samples_->end(stratum)), HUGE_VAL);
    }
}

void NearestSearch::begin(const std::vector<Box>& boxes, std::uint32_t threads) {
    homes_.resize(points_.size());
    in_chunks(points_.size(), threads, [&](std::size_t first, std::size_t end) {
        std::uint32_t home = kNoPart;
        for (std::size_t n = first; n < end; ++n) {
            if (home == kNoPart || squared_distance(boxes[home], points_[n]) > 0) home = nearest_box(boxes, points_[n]);
            homes_[n] = home;
        }
    });
}

std::vector<std::uint64_t> NearestSearch::beginners(std::uint32_t part, std::uint32_t threads) const {
    return those_of(points_.size(), threads, [&](std::size_t n) { return homes_[n] == part; });
}

std::vector<std::uint64_t> NearestSearch::seekers(std::uint32_t part, const Box& box, std::uint32_t threads) const {
    return those_of(points_.size(), threads, [&](std::size_t n) {
        if (homes_[n] == part) return false;
        const double squared = squared_distance(box, points_[n]);
        return std::ranges::any_of(
            squared_, [&](const std::vector<double>& found) { return !found.empty() && squared < found[n]; });
    });
}

void NearestSearch::look(const StrataTree& tree, std::span<const std::uint32_t> numbers,
                         std::span<const std::uint64_t> some, std::uint32_t threads) {
    in_chunks(some.size(), threads, [&](std::size_t first, std::size_t end) {
        Look search(tree, numbers);
        std::uint32_t stratum = samples_ ? samples_->stratum_of(some[first]) : 0;
        for (const std::uint64_t n : some.subspan(first, end - first)) {
            if (samples_ && n >= samples_->end(stratum)) stratum = samples_->stratum_of(n);
            std::array<double*, kGoalCount> squared{};
            for (int goal = 0; goal < kGoalCount; ++goal)
                if (!squared_[goal].empty()) squared[goal] = &squared_[goal][n];
            search(points_[n], goals_[stratum], squared);
        }
    });
}

std::vector<double> NearestSearch::take(Goal goal, double rounding) {
    std::vector<double> distances = std::move(squared_[static_cast<int>(goal)]);
    if (distances.empty()) distances.assign(points_.size(), kNone);
    for (double& distance : distances) {
        distance = distance < HUGE_VAL ? std::sqrt(distance) : kNone;
        if (distance <= rounding) distance = 0;
    }
    return distances;
}

void search(ModelSide& model, NearestSearch& faces, NearestSearch& lines, std::uint32_t threads) {
    const std::vector<Box>&face_boxes = model.interfaces().boxes, &line_boxes = model.lines().boxes;
    faces.begin(face_boxes, threads);
    lines.begin(line_boxes, threads);
    for (const bool is_first : {true, false})
        for (std::uint32_t part = 0; part < model.part_count(); ++part) {
            const auto wanted = [&](const NearestSearch& points, const Box& box) {
                return is_first ? points.beginners(part, threads) : points.seekers(part, box, threads);
            };
            const std::vector<std::uint64_t> of_faces = wanted(faces, face_boxes[part]),
                                             of_lines = wanted(lines, line_boxes[part]);
            if (of_faces.empty() && of_lines.empty()) continue;
            const SearchedPart& there = model.searched(part);
            faces.look(*there.face_tree, model.interfaces().numbers_of(there.interfaces), of_faces, threads);
            lines.look(*there.line_tree, model.lines().numbers_of(there.lines), of_lines, threads);
        }
}

}  // namespace regionmesh
