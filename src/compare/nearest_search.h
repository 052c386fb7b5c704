// The distances from many points to a model in parts.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "compare/model_side.h"
#include "regionmesh/vec3.h"

namespace regionmesh {

/// Goals of points, besides the nearest of all faces.
enum class Goal { kAll, kFirstRegion, kSecondRegion, kStratum };
inline constexpr int kGoalCount = 4;

/// The goals of the samples of a stratum: distances that the other model has.
struct Goals {
    bool all = false;
    std::array<Label, 2> regions{exterior(0), exterior(0)};  // regions whose boundaries are looked for; exterior: none
    std::uint32_t stratum = kNoStratum;                      // stratum of the other model
};

/// Points and the squared distances found so far. Memory: 12 bytes a point, and 8 for each goal that a point has.
class NearestSearch {
public:
    /// Points of all samples. `goals` is by stratum. Holds references to the points and the samples.
    NearestSearch(std::span<const Vec3> points, const Samples& samples, std::vector<Goals> goals);
    /// Points that look for the nearest of all.
    explicit NearestSearch(std::span<const Vec3> points);

    /// Chooses for each point the part of the model that it is searched in first: the one with the nearest box.
    void begin(const std::vector<Box>& boxes, std::uint32_t threads);
    /// The points that begin in the part.
    std::vector<std::uint64_t> beginners(std::uint32_t part, std::uint32_t threads) const;
    /// The other points for which the part may hold a nearer simplex than those found so far.
    std::vector<std::uint64_t> seekers(std::uint32_t part, const Box& box, std::uint32_t threads) const;
    /// Searches a part for some points, in ascending order. `numbers` are those of its strata in the model.
    void look(const StrataTree& tree, std::span<const std::uint32_t> numbers, std::span<const std::uint64_t> some,
              std::uint32_t threads);
    /// Distances of the points, 0 if not greater than `rounding`; NaN where a point has no such goal.
    std::vector<double> take(Goal goal, double rounding);

private:
    void set_goals();

    std::span<const Vec3> points_;
    const Samples* samples_ = nullptr;
    std::vector<Goals> goals_;  // one per stratum of the samples, or one
    std::array<std::vector<double>, kGoalCount>
        squared_;                       // squares of distances; infinite: not found yet, NaN: no goal
    std::vector<std::uint32_t> homes_;  // part where the search of each point begins
};

/// Searches all parts of the model that may hold the nearest, one at a time: each point first in one part, then in
/// those whose boxes are nearer than what it has found. The results are those of a search in the whole model.
void search(ModelSide& model, NearestSearch& faces, NearestSearch& lines, std::uint32_t threads);

}  // namespace regionmesh
