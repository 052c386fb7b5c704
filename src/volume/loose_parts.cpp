#include "volume/loose_parts.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

namespace regionmesh {
namespace {

/// Numbers of samples through all layers.
class Samples {
public:
    Samples(const std::vector<std::vector<std::uint32_t>>& layers, std::int32_t width)
        : layers_(layers), width_(static_cast<std::size_t>(width)), area_(layers.front().size()) {}

    std::size_t count() const { return layers_.size() * area_; }
    std::size_t area() const { return area_; }
    std::uint32_t label(std::size_t n) const { return layers_[n / area_][n % area_]; }

    /// Calls visit(other) for the neighbours with smaller numbers over the edges of Kuhn's tetrahedra.
    template <class Visit>
    void visit_before(std::size_t n, Visit&& visit) const {
        const std::size_t in_layer = n % area_;
        const bool has_x = in_layer % width_ > 0, has_y = in_layer >= width_, has_z = n >= area_;
        for (int step = 1; step < 8; ++step) {
            const bool x = step & 1, y = step & 2, z = step & 4;
            if ((x && !has_x) || (y && !has_y) || (z && !has_z)) continue;
            visit(n - (x ? 1 : 0) - (y ? width_ : 0) - (z ? area_ : 0));
        }
    }

    /// The same for neighbours along the axes.
    template <class Visit>
    void visit_nearest(std::size_t n, Visit&& visit) const {
        const std::size_t in_layer = n % area_;
        if (in_layer % width_ > 0) visit(n - 1);
        if ((in_layer + 1) % width_ > 0) visit(n + 1);
        if (in_layer >= width_) visit(n - width_);
        if (in_layer + width_ < area_) visit(n + width_);
        if (n >= area_) visit(n - area_);
        if (n + area_ < count()) visit(n + area_);
    }

private:
    const std::vector<std::vector<std::uint32_t>>& layers_;
    std::size_t width_, area_;
};

/// The first sample of the first layer stands for all that reaches a section, so that its number is the smallest.
std::vector<bool> find_loose(const Samples& samples) {
    std::vector<std::uint32_t> parent(samples.count() + 1);
    std::iota(parent.begin(), parent.end(), 0u);
    const auto root = [&](std::uint32_t n) {
        while (parent[n] != n) n = parent[n] = parent[parent[n]];
        return n;
    };
    const auto join = [&](std::uint32_t a, std::uint32_t b) {
        a = root(a), b = root(b);
        parent[std::max(a, b)] = std::min(a, b);
    };
    constexpr std::uint32_t kReaches = 0;  // samples are numbered from 1
    const std::size_t last = samples.count() - samples.area();
    for (std::size_t n = 0; n < samples.count(); ++n) {
        const auto own = static_cast<std::uint32_t>(n + 1);
        if (n < samples.area() || n >= last) join(own, kReaches);
        samples.visit_before(n, [&](std::size_t other) {
            if (samples.label(other) == samples.label(n)) join(own, static_cast<std::uint32_t>(other + 1));
        });
    }
    std::vector<bool> loose(samples.count());
    for (std::size_t n = samples.area(); n < last; ++n) loose[n] = root(static_cast<std::uint32_t>(n + 1)) != kReaches;
    return loose;
}

}  // namespace

std::uint64_t give_away_loose_parts(std::vector<std::vector<std::uint32_t>>& layers, std::int32_t width) {
    const Samples samples(layers, width);
    std::vector<bool> loose = find_loose(samples);
    std::vector<std::size_t> left;
    for (std::size_t n = 0; n < loose.size(); ++n)
        if (loose[n]) left.push_back(n);
    const std::uint64_t count = left.size();
    std::vector<std::pair<std::size_t, std::uint32_t>> found;
    while (!left.empty()) {
        found.clear();
        std::erase_if(left, [&](std::size_t n) {
            std::array<std::uint32_t, 6> labels{};
            std::size_t size = 0;
            samples.visit_nearest(n, [&](std::size_t other) {
                if (!loose[other]) labels[size++] = samples.label(other);
            });
            if (size == 0) return false;
            const auto end = labels.begin() + static_cast<std::ptrdiff_t>(size);
            std::sort(labels.begin(), end);
            const auto best = std::max_element(labels.begin(), end, [&](std::uint32_t a, std::uint32_t b) {
                const auto times = [&](std::uint32_t label) { return std::count(labels.begin(), end, label); };
                return times(a) < times(b);
            });
            found.emplace_back(n, *best);
            return true;
        });
        for (const auto& [n, label] : found) {
            layers[n / samples.area()][n % samples.area()] = label;
            loose[n] = false;
        }
    }
    return count;
}

}  // namespace regionmesh
