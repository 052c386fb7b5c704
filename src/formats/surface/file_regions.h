// The regions and interfaces of a model as groups in a file: numbered, with names that all programs accept.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "surface/file_view.h"

namespace regionmesh {

/// A region that has faces and is no background.
struct FileRegion {
    Label label;        // dense
    std::string title;  // "region_3", or "region_3 liver" where the label has a name
    std::string word;   // unique, of at most 60 letters, digits and '_', a letter first: from the name, or "region_3"
};

/// The faces between two labels, in the order of files; the whole exterior is exterior(0).
struct FileInterface {
    std::array<Label, 2> labels;
    std::string name;  // "interface_3_7", "interface_3_exterior", "interface_minus3_7"
    std::uint32_t face_count = 0;
};

/// Names of the sets on the sides of the box, in the order of exterior labels.
inline constexpr std::array<const char*, 6> kSideNames{"XMIN", "XMAX", "YMIN", "YMAX", "ZMIN", "ZMAX"};

class FileRegions {
public:
    explicit FileRegions(const FileView& view);

    /// In the order of files.
    const std::vector<FileRegion>& all() const { return regions_; }
    /// One more than the index in all(), from 1; 0 for background and exterior.
    std::uint32_t number(Label label) const { return is_exterior(label) ? 0 : numbers_[label]; }
    /// What stands for the region where a file has one number for it: its label, if that is from 1 to 2^31 - 1; else
    /// the lowest from 1 that no label has.
    std::uint32_t tag(const FileRegion& region) const { return tags_[numbers_[region.label] - 1]; }

    const std::vector<FileInterface>& interfaces() const { return interfaces_; }
    /// From 1 to interfaces().size().
    std::uint32_t interface_number(FaceId f) const;

private:
    using Key = std::array<std::uint32_t, 2>;  // ranks

    Key key_of(FaceId f) const;
    void set_tags();

    const FileView& view_;
    std::vector<FileRegion> regions_;
    std::vector<std::uint32_t> numbers_;  // by dense label
    std::vector<std::uint32_t> tags_;     // by index of region
    std::vector<FileInterface> interfaces_;
    std::map<Key, std::uint32_t> interface_numbers_;
};

/// Faces in groups, sorted by group and then by id. Takes 8 bytes per face.
class GroupedFaces {
public:
    /// groups_of(FaceId, add) calls add(group, side) for each group of the face, at most two. Side 1 means that the
    /// group has the face reversed.
    template <class GroupsOf>
    GroupedFaces(const FileView& view, std::size_t group_count, GroupsOf&& groups_of) : starts_(group_count + 1) {
        view.for_faces(
            [&](FaceId f) { groups_of(f, [&](std::size_t group, std::uint32_t) { ++starts_[group + 1]; }); });
        for (std::size_t g = 0; g < group_count; ++g) starts_[g + 1] += starts_[g];
        entries_.resize(starts_[group_count]);
        std::vector<std::size_t> places(starts_.begin(), starts_.end());
        view.for_faces([&](FaceId f) {
            groups_of(f,
                      [&](std::size_t group, std::uint32_t side) { entries_[places[group]++] = index(f) << 1 | side; });
        });
    }

    std::size_t count(std::size_t group) const { return starts_[group + 1] - starts_[group]; }
    /// Calls visit(FaceId, side).
    template <class Visit>
    void for_group(std::size_t group, Visit&& visit) const {
        for (std::size_t n = starts_[group]; n < starts_[group + 1]; ++n)
            visit(FaceId{entries_[n] >> 1}, entries_[n] & 1);
    }

private:
    std::vector<std::size_t> starts_;
    std::vector<std::uint32_t> entries_;
};

/// The faces of each region, as group number - 1, with normals outward: side 1 where that reverses the face of the
/// model.
GroupedFaces faces_by_region(const FileView& view, const FileRegions& regions);

/// The corners of a face, in reverse order on side 1.
inline std::array<VertexId, 3> turned_vertices(const Mesh& mesh, FaceId f, std::uint32_t side) {
    const auto& [a, b, c] = mesh[f].vertices;
    return side == 0 ? std::array{a, b, c} : std::array{a, c, b};
}

}  // namespace regionmesh
