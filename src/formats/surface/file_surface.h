// A surface as a file brings it, and what is done to it before it becomes a model.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "mesh/assemble.h"
#include "formats/codec/byte_reader.h"
#include "regionmesh/label.h"
#include "regionmesh/label_names.h"
#include "regionmesh/limits.h"
#include "regionmesh/vec3.h"

namespace regionmesh {

/// The readers promise that the arrays fit one another and every vertex number is in range.
struct FileSurface {
    std::vector<Vec3> points = {};
    std::vector<std::array<std::uint32_t, 3>> faces = {};
    std::vector<std::array<InputLabel, 2>> labels = {};  // by face; the normal points from the first to the second
    std::vector<bool> is_on_hull = {};  // by point, as node types say: on the box, or another hull; empty: unknown
    InputLabel exterior_label = -1;
    LabelNames names = {};
    bool is_by_region = false;      // faces came region by region, each with the exterior on its other side
    bool has_shared_points = true;  // false: each face, or region, has points of its own
};

inline bool is_finite(Vec3 p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }

/// Throws Error(kInput) naming the file where a coordinate is not finite, or the model would have too many vertices.
void add_point(FileSurface& surface, Vec3 point, const std::filesystem::path& path);

/// Adds a polygon of three or more corners as triangles with these labels: a quad is cut along its shorter diagonal,
/// the others fan-wise from their first corner. Throws Error(kInput) naming the file where the model would have too
/// many faces.
void add_polygon(FileSurface& surface, std::span<const std::uint32_t> corners, const std::array<InputLabel, 2>& labels,
                 const std::filesystem::path& path);

/// Three coordinates in a line of text, taken off its front. Throws Error(kInput) that names the line.
Vec3 take_point(const formats::ByteReader& file, std::string_view& line);

/// The comments of our own text files: "exterior_label -1", "region 3 liver". Others are ignored.
void read_comment(FileSurface& surface, std::string_view comment);

/// Appends the points of `other`, and its faces with their labels.
void append(FileSurface& surface, const FileSurface& other);

/// Joins points no farther apart than `distance` (0: at one place) to the first of them, in order, and drops points
/// that are left over and faces that repeat a corner. A chain of near points is not joined as a whole: what has been
/// joined to one point lies within the distance of it.
void weld_points(FileSurface& surface, double distance);

/// Two faces on the same vertices that look opposite ways, each with the exterior behind it, become one between their
/// two regions. Where they are of one region, or not two, they stay.
void join_back_to_back(FileSurface& surface);

/// Turns faces so that a region that has two faces at an edge has them pass it in opposite directions. Which way a part
/// of the surface looks as a whole: where more than two labels meet in it, so that all volumes but one, that of what is
/// outside, are above 0; where two meet, so that the exterior, or else label 0, is outside; else as most of its faces
/// do.
void orient_faces(FileSurface& surface);

/// The labels of faces that come in groups with names: "interface_3_7" has 3 behind its faces and 7 before them;
/// "region_3", "region_3 liver" and "3" have 3 behind them and the exterior before; others likewise, with the first
/// number from 1 that no group names.
class RegionGroups {
public:
    /// The number of the group; that of an earlier one of the same name, unless each is to be apart or it has none.
    std::uint32_t add(const std::string& name, bool is_apart);
    /// Replaces group numbers, which stand first in the labels of faces, by labels, and adds the names.
    void put_labels(FileSurface& surface) const;

private:
    std::vector<std::string> names_;
    std::unordered_map<std::string, std::uint32_t> numbers_;  // of names that are not apart
};

}  // namespace regionmesh
