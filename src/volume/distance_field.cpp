#include "volume/distance_field.h"

#include <algorithm>
#include <cmath>

namespace regionmesh {
namespace {

/// Distance to the nearest sample of the row that differs, at most `cap`.
void row_distances(std::span<const std::uint8_t> row, float step, float cap, std::span<float> out) {
    float far = cap;
    for (std::size_t n = 0; n < row.size(); ++n) {
        far = n > 0 && row[n] != row[n - 1] ? step : std::min(cap, far + step);
        out[n] = far;
    }
    far = cap;
    for (std::size_t n = row.size(); n-- > 0;) {
        far = n + 1 < row.size() && row[n] != row[n + 1] ? step : std::min(cap, far + step);
        out[n] = std::min(out[n], far);
    }
}

}  // namespace

void SectionBox::add(std::int32_t x, std::int32_t y) { add(SectionBox{x, y, x + 1, y + 1}); }

void SectionBox::add(const SectionBox& other) {
    if (other.is_empty()) return;
    if (is_empty()) {
        *this = other;
        return;
    }
    *this = {std::min(x0, other.x0), std::min(y0, other.y0), std::max(x1, other.x1), std::max(y1, other.y1)};
}

SectionBox SectionBox::grown(std::int32_t x, std::int32_t y, std::int32_t width, std::int32_t height) const {
    return {std::max(0, x0 - x), std::max(0, y0 - y), std::min(width, x1 + x), std::min(height, y1 + y)};
}

float DistanceField::at(float x, float y) const {
    const std::int32_t width = box.width(), height = box.height();
    x = std::clamp(x, 0.0f, static_cast<float>(width - 1));
    y = std::clamp(y, 0.0f, static_cast<float>(height - 1));
    const auto i = static_cast<std::int32_t>(x), j = static_cast<std::int32_t>(y);
    const float u = x - static_cast<float>(i), v = y - static_cast<float>(j);
    const std::int32_t right = std::min(i + 1, width - 1), below = std::min(j + 1, height - 1);
    const auto value = [&](std::int32_t column, std::int32_t row) {
        return values[std::size_t(row) * std::size_t(width) + std::size_t(column)];
    };
    const float upper = (1 - u) * value(i, j) + u * value(right, j);
    const float lower = (1 - u) * value(i, below) + u * value(right, below);
    return (1 - v) * upper + v * lower;
}

void signed_distances(std::span<const std::uint8_t> inside, SectionStep step, float cap, DistanceField& field) {
    const auto width = static_cast<std::size_t>(field.box.width());
    const auto height = static_cast<std::int64_t>(field.box.height());
    const float half = std::min(step.x, step.y) / 2, most = cap + half;
    std::vector<float> rows(inside.size());
    for (std::int64_t j = 0; j < height; ++j)
        row_distances(inside.subspan(j * width, width), step.x, most, std::span(rows).subspan(j * width, width));
    field.values.resize(inside.size());
    for (std::int64_t j = 0; j < height; ++j)
        for (std::size_t i = 0; i < width; ++i) {
            const std::size_t own = j * width + i;
            float best = rows[own];
            const auto look = [&](std::int64_t row, float away) {
                if (row < 0 || row >= height) return;
                const std::size_t other = row * width + i;
                const float along = inside[other] == inside[own] ? rows[other] : 0;
                const float far = std::sqrt(along * along + away * away);
                best = std::min(best, far);
            };
            for (std::int64_t k = 1; static_cast<float>(k) * step.y < best; ++k) {
                if (j - k < 0 && j + k >= height) break;
                look(j - k, static_cast<float>(k) * step.y);
                look(j + k, static_cast<float>(k) * step.y);
            }
            const float size = std::min(best - half, cap);
            field.values[own] = inside[own] ? size : -size;
        }
}

void smooth(DistanceField& field, int passes) {
    const std::int32_t width = field.box.width(), height = field.box.height();
    std::vector<float> line;
    const auto smooth_line = [&](std::size_t first, std::size_t stride, std::int32_t count) {
        line.resize(std::size_t(count));
        for (std::int32_t n = 0; n < count; ++n) line[n] = field.values[first + std::size_t(n) * stride];
        for (std::int32_t n = 0; n < count; ++n)
            field.values[first + std::size_t(n) * stride] =
                line[std::max(n - 1, 0)] / 4 + line[n] / 2 + line[std::min(n + 1, count - 1)] / 4;
    };
    for (int pass = 0; pass < passes; ++pass) {
        for (std::int32_t y = 0; y < height; ++y) smooth_line(std::size_t(y) * std::size_t(width), 1, width);
        for (std::int32_t x = 0; x < width; ++x) smooth_line(std::size_t(x), std::size_t(width), height);
    }
}

}  // namespace regionmesh
