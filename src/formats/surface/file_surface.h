// A surface as read from a file, and the operations on it before it becomes a mesh.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "formats/codec/byte_reader.h"
#include "regionmesh/label.h"
#include "regionmesh/label_names.h"
#include "regionmesh/lattice.h"
#include "regionmesh/limits.h"
#include "regionmesh/vec3.h"
#include "surface/assemble.h"

namespace regionmesh {

/// Readers guarantee that the sizes of the arrays agree and all vertex numbers are in range.
struct FileSurface {
    std::vector<Vec3> points = {};
    std::vector<std::array<std::uint32_t, 3>> faces = {};
    std::vector<std::array<InputLabel, 2>> labels = {};  // by face; the normal points from the first to the second
    std::vector<bool> is_on_hull = {};  // by point, from node types: on the box or another hull; empty: unknown
    InputLabel exterior_label = -1;
    bool is_unsigned = false;  // labels are unsigned 64-bit numbers
    LabelNames names = {};
    LabelColours colours = {};
    Coordinates coordinates = {};
    std::optional<std::vector<InputLabel>> background = {};  // none: the file does not say
    bool is_by_region = false;      // each face has a region on one side and the exterior on the other
    bool has_shared_points = true;  // false: each face or region has its own points
};

/// Throws Error(kInput) naming the file where a coordinate is not finite, or the model would have too many vertices.
void add_point(FileSurface& surface, Vec3 point, const std::filesystem::path& path);

/// Adds a polygon of three or more corners as triangles with these labels, cut as by cut_polygon(). Throws
/// Error(kInput) naming the file where the model would have too many faces.
void add_polygon(FileSurface& surface, std::span<const std::uint32_t> corners, const std::array<InputLabel, 2>& labels,
                 const std::filesystem::path& path);

/// Takes three coordinates off the front of a line of text. Throws Error(kInput) that names the line.
Vec3 take_point(const formats::ByteReader& file, std::string_view& line);

/// Takes "SPACE=RAS", as 3D Slicer writes it, out of a text; ignores others.
void read_space(FileSurface& surface, std::string_view text);

/// Evaluates a comment of our own files, "exterior_label -1", "unsigned_labels 1", "background 2", "region 3 liver",
/// "colour 3 #ff8000", "metres_per_unit 0.001" or "sample_spacing 1 1 4", and that of read_space(); ignores others.
void read_comment(FileSurface& surface, std::string_view comment);

/// Comments of our files that say what is known of the coordinates, one a line, as read_comment() takes them.
std::vector<std::string> coordinate_comments(const Coordinates& coordinates);

/// What a file says of its coordinates. Lengths that cannot be computed with are ignored.
void set_metres(FileSurface& surface, double metres);
void set_spacing(FileSurface& surface, Vec3 spacing);

/// Appends the points and the labelled faces of `other`.
void append(FileSurface& surface, const FileSurface& other);

/// Merges each point into an earlier kept point within `distance` (0: at the same place), then removes unused points
/// and faces that repeat a corner. A chain of near points is not merged as a whole: every point merged into another
/// lies within the distance of it.
void weld_points(FileSurface& surface, double distance);

/// Merges each pair of opposite faces on the same vertices, both with the exterior on one side, into one face between
/// their two regions. Faces of the same region, and three or more faces on the same vertices, stay.
void join_back_to_back(FileSurface& surface);

/// Orients faces consistently: where a region has two faces at an edge, they traverse it in opposite directions. The
/// orientation of each part of the surface as a whole: with more than two labels, the one in which the volumes of all
/// closed regions but the outer one are positive; with two, the one in which the label is outside that a larger part
/// round it has, too, or else the exterior, or else label 0; otherwise that of the majority of its faces.
void orient_faces(FileSurface& surface);

/// Labels of faces that come in named groups. "interface_3_7" has 3 behind its faces and 7 in front of them;
/// "region_3", "region_3 liver" and "3" have 3 behind and the exterior in front; any other group is a region with the
/// lowest unused label from 1.
class RegionGroups {
public:
    /// The number of a group. Groups of the same name are one, unless `is_apart` or the name is empty.
    std::uint32_t add(const std::string& name, bool is_apart);
    /// Replaces the group numbers, the first labels of the faces, by labels, and adds the names.
    void put_labels(FileSurface& surface) const;

private:
    std::vector<std::string> names_;
    std::unordered_map<std::string, std::uint32_t> numbers_;  // of groups by name
};

}  // namespace regionmesh
