// A mesh as the page holds it: quantised, in an order that compresses well, as bytes.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "surface/file_view.h"

namespace regionmesh {

/// The faces between two labels.
struct PagePair {
    std::uint32_t first, second;  // places in FileView::ordered_labels(); their number stands for the exterior
    std::uint32_t faces = 0;
};

struct PageGeometry {
    Vec3 low{}, high{};
    std::uint32_t vertices = 0, faces = 0;
    std::vector<PagePair> pairs;      // pairs in the order of the faces
    std::vector<std::uint8_t> bytes;  // viewer/README.md gives the layout
    std::uint32_t index_bytes = 0;    // bytes of the part with the faces
    double largest_distance = 0;      // 0 where there are no distances
};

/// FNV-1a, 64 bits, of the exact positions, faces and labels in the order of files.
std::uint64_t model_fingerprint(const FileView& view);

/// `distances` is by vertex id, or empty.
PageGeometry page_geometry(const FileView& view, std::span<const double> distances);

}  // namespace regionmesh
