// Signed distances to the boundary of a set of samples in a section.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace regionmesh {

/// Lengths of one sample along the two axes of a section.
struct SectionStep {
    float x = 1, y = 1;
};

/// Samples of a section from `x0`, `y0` to `x1` - 1, `y1` - 1.
struct SectionBox {
    std::int32_t x0 = 0, y0 = 0, x1 = 0, y1 = 0;

    std::int32_t width() const { return x1 - x0; }
    std::int32_t height() const { return y1 - y0; }
    std::size_t samples() const { return std::size_t(width()) * std::size_t(height()); }
    bool is_empty() const { return x1 <= x0 || y1 <= y0; }
    void add(std::int32_t x, std::int32_t y);
    void add(const SectionBox& other);
    /// Larger by x and y samples on every side, as far as a section of width x height goes.
    SectionBox grown(std::int32_t x, std::int32_t y, std::int32_t width, std::int32_t height) const;
};

/// Values of the samples of a box, row by row.
struct DistanceField {
    SectionBox box;
    std::vector<float> values;

    /// Bilinear, clamped to the box; positions are in samples from its corner.
    float at(float x, float y) const;
};

/// Fills `field.values`: positive inside the set, negative outside, at most `cap` in size. The boundary runs half a
/// step from the outermost samples. Exact up to the cap; the sides of the box are no boundary. `inside` has one byte
/// for each sample of the box.
void signed_distances(std::span<const std::uint8_t> inside, SectionStep step, float cap, DistanceField& field);

/// Averages each value with its neighbours in the box by weights 1, 2, 1 along both axes, `passes` times: boundaries of
/// samples are off by up to half a step, and this evens out.
void smooth(DistanceField& field, int passes);

}  // namespace regionmesh
