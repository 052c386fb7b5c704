// Colours of regions, in files and on the page.
#pragma once

#include <array>
#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "surface/file_view.h"

namespace regionmesh {

/// A colour as 0xRRGGBB (sRGB) for each region of FileView::ordered_labels(): the given one, or else one of a fixed
/// palette. There regions with a common interface get different colours, as far apart as possible for normal,
/// protanopic and deuteranopic eyes. Depends on the mesh, the labels and the given colours only.
std::vector<std::uint32_t> region_colours(const FileView& view);

/// One list per region: indices of the regions with a common interface.
using RegionNeighbours = std::vector<std::set<std::uint32_t>>;

/// Adds those in a part of a model. All parts have the same labels and background.
void add_neighbours(const FileView& part, RegionNeighbours& neighbours);

/// The same for a model in parts, any of which is `part`.
std::vector<std::uint32_t> region_colours(const FileView& part, const RegionNeighbours& neighbours);

/// Red, green and blue.
std::array<std::uint8_t, 3> rgb_of(std::uint32_t colour);

/// "#ff8000".
std::string hex_of(std::uint32_t colour);

/// The colours of faces: of the region behind a face, its first label in files.
class FaceColours {
public:
    explicit FaceColours(const FileView& view) : view_(view), colours_(region_colours(view)) {}

    std::array<std::uint8_t, 3> operator()(FaceId f) const;

private:
    const FileView& view_;
    std::vector<std::uint32_t> colours_;
};

}  // namespace regionmesh
