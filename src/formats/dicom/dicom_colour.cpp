#include "formats/dicom/dicom_colour.h"

#include <algorithm>
#include <cmath>

namespace regionmesh::formats {
namespace {

constexpr std::array<double, 3> kWhite{0.95047, 1, 1.08883};  // D65
constexpr std::array<std::array<double, 3>, 3> kLinearOfXyz{
    {{3.2406, -1.5372, -0.4986}, {-0.9689, 1.8758, 0.0415}, {0.0557, -0.204, 1.057}}};  // IEC 61966-2-1

double xyz_share(double f) { return f > 6.0 / 29 ? f * f * f : 3 * (6.0 / 29) * (6.0 / 29) * (f - 4.0 / 29); }

std::uint32_t encoded(double linear) {
    linear = std::clamp(linear, 0.0, 1.0);
    const double share = linear > 0.0031308 ? 1.055 * std::pow(linear, 1 / 2.4) - 0.055 : 12.92 * linear;
    return static_cast<std::uint32_t>(std::lround(255 * share));
}

}  // namespace

std::uint32_t colour_of_lab(const std::array<std::uint16_t, 3>& stored) {
    const double fy = (stored[0] / 65535.0 * 100 + 16) / 116;
    const double a = stored[1] / 65535.0 * 255 - 128, b = stored[2] / 65535.0 * 255 - 128;
    const std::array<double, 3> f{fy + a / 500, fy, fy - b / 200};
    std::uint32_t colour = 0;
    for (const auto& row : kLinearOfXyz) {
        double linear = 0;
        for (std::size_t i = 0; i < 3; ++i) linear += row[i] * kWhite[i] * xyz_share(f[i]);
        colour = colour << 8 | encoded(linear);
    }
    return colour;
}

std::uint32_t colour_of_palette(const std::array<std::uint16_t, 3>& stored) {
    std::uint32_t colour = 0;
    for (const std::uint32_t share : stored) colour = colour << 8 | (share * 255 + 32767) / 65535;
    return colour;
}

}  // namespace regionmesh::formats
