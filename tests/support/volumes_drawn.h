// Small volumes for property tests: RapidCheck shrinks them to the fewest samples and labels that still fail.
#pragma once

#include <rapidcheck.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "support/volumes.h"

namespace regionmesh::test {

/// Two to `longest` samples along each axis, labels 0 to 2.
inline rc::Gen<ArrayVolume> drawn_volume(std::uint32_t longest) {
    const auto side = rc::gen::inRange<std::uint32_t>(2, longest + 1);
    return rc::gen::mapcat(
        rc::gen::tuple(side, side, side), [](const std::tuple<std::uint32_t, std::uint32_t, std::uint32_t>& sides) {
            const Size size{std::get<0>(sides), std::get<1>(sides), std::get<2>(sides)};
            const std::size_t samples = std::size_t{size[0]} * size[1] * size[2];
            const auto labels =
                rc::gen::container<std::vector<InputLabel>>(samples, rc::gen::inRange<InputLabel>(0, 3));
            return rc::gen::map(labels,
                                [size](std::vector<InputLabel> drawn) { return ArrayVolume(size, std::move(drawn)); });
        });
}

inline void showValue(const ArrayVolume& volume, std::ostream& out) {
    const Size& size = volume.size();
    out << size[0] << " x " << size[1] << " x " << size[2] << ":";
    for (const InputLabel label : volume.labels()) out << ' ' << label;
}

}  // namespace regionmesh::test
