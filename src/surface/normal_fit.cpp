#include "surface/normal_fit.h"

#include <array>
#include <cstddef>
#include <vector>

namespace regionmesh {
namespace {

/// Added to the mean square of positions, in reaches: what is taken for a slope must be seen over a wide part.
constexpr double kLeastSpread = 0.002;

/// A residual as large as this many times the mean square counts a fourth.
constexpr double kOutlier = 2;

/// A mean of normals shorter than this has no direction to rely on.
constexpr double kLeastNormal = 0.3;

using NearFaces = std::span<const NearFace>;

/// A normal as a linear function of position.
struct LinearNormal {
    Vec3 at_place{};
    std::array<Vec3, 3> slopes{};  // along x, y and z

    Vec3 operator()(Vec3 at) const { return at_place + at.x * slopes[0] + at.y * slopes[1] + at.z * slopes[2]; }
};

/// Least squares, by area and weight. `spread` is added to the mean square of positions.
LinearNormal fit_once(NearFaces faces, const std::vector<double>& weights, double spread) {
    double all = 0;
    Vec3 middle{}, mean{};
    for (std::size_t n = 0; n < faces.size(); ++n) {
        const double weight = weights[n] * faces[n].area;
        all += weight;
        middle += weight * faces[n].at;
        mean += weight * faces[n].normal;
    }
    middle = (1 / all) * middle;
    mean = (1 / all) * mean;
    std::array<Vec3, 3> square{}, mixed{};
    for (int axis = 0; axis < 3; ++axis) square[axis][axis] = all * spread;
    for (std::size_t n = 0; n < faces.size(); ++n) {
        const Vec3 at = faces[n].at - middle, normal = (weights[n] * faces[n].area) * (faces[n].normal - mean);
        for (int axis = 0; axis < 3; ++axis) {
            square[axis] += (weights[n] * faces[n].area * at[axis]) * at;
            mixed[axis] += at[axis] * normal;
        }
    }
    const auto& [x, y, z] = square;
    const std::array<Vec3, 3> inverse{cross(y, z), cross(z, x), cross(x, y)};
    const double scale = 1 / dot(x, inverse[0]);
    LinearNormal fit{mean};
    for (int axis = 0; axis < 3; ++axis) {
        const Vec3& row = inverse[axis];
        fit.slopes[axis] = scale * (row.x * mixed[0] + row.y * mixed[1] + row.z * mixed[2]);
        fit.at_place = fit.at_place - middle[axis] * fit.slopes[axis];
    }
    return length(fit.at_place) > kLeastNormal ? fit : LinearNormal{mean};
}

/// The error of a fit at each face, squared.
void find_squares(NearFaces faces, const LinearNormal& fit, std::vector<double>& squares) {
    squares.clear();
    for (const auto& [at, normal, area] : faces) squares.push_back(length2(normal - fit(at)));
}

double mean_by_area(NearFaces faces, const std::vector<double>& weights, const std::vector<double>& values) {
    double sum = 0, all = 0;
    for (std::size_t n = 0; n < faces.size(); ++n) {
        sum += weights[n] * faces[n].area * values[n];
        all += weights[n] * faces[n].area;
    }
    return sum / all;
}

}  // namespace

/// Weights of Geman and McClure: a wedge that is thinner than a sample near the line has faces there that have
/// nothing to do with its interfaces.
FittedNormal fit_normal(NearFaces faces, double reach, int rounds) {
    if (faces.empty()) return {};
    const double spread = kLeastSpread * reach * reach;
    std::vector<double> weights(faces.size(), 1.0), squares;
    LinearNormal fit = fit_once(faces, weights, spread);
    find_squares(faces, fit, squares);
    const double error = mean_by_area(faces, weights, squares);
    for (int round = 1; round < rounds; ++round) {
        constexpr double kRounding = 1e-6;
        const double outlier = kOutlier * mean_by_area(faces, weights, squares) + kRounding;
        for (std::size_t n = 0; n < faces.size(); ++n) {
            const double share = 1 / (1 + squares[n] / outlier);
            weights[n] = share * share;
        }
        fit = fit_once(faces, weights, spread);
        find_squares(faces, fit, squares);
    }
    return {fit.at_place, error};
}

}  // namespace regionmesh
