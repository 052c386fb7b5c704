// Small surfaces as readers bring them, in words that do not depend on numbers.
#pragma once

#include <algorithm>
#include <array>
#include <set>
#include <string>
#include <utility>

#include "regionmesh/mesh_file.h"

namespace regionmesh {

/// A face: the places of its corners, the least first, and its labels as text, in the order in which the normal passes
/// them from the lower text to the higher.
using FaceWords = std::pair<std::array<std::array<double, 3>, 3>, std::array<std::string, 2>>;

template <class TextOf>
std::multiset<FaceWords> faces_in_words(const Mesh& mesh, TextOf&& text_of) {
    std::multiset<FaceWords> faces;
    for (std::uint32_t f = 0; f < mesh.face_end(); ++f) {
        if (!mesh.is_alive(FaceId{f})) continue;
        FaceWords words;
        const auto corners = mesh.corners(FaceId{f});
        for (int n = 0; n < 3; ++n) words.first[n] = {corners[n].x, corners[n].y, corners[n].z};
        for (int side = 0; side < 2; ++side) words.second[side] = text_of(mesh[FaceId{f}].labels[side]);
        if (words.second[0] > words.second[1]) {
            std::swap(words.second[0], words.second[1]);
            std::swap(words.first[1], words.first[2]);
        }
        std::rotate(words.first.begin(), std::ranges::min_element(words.first), words.first.end());
        faces.insert(words);
    }
    return faces;
}

/// Labels are those of the file; all of the exterior is one.
inline std::multiset<FaceWords> faces_of(const MeshFile& file) {
    return faces_in_words(file.mesh, [&](Label label) {
        return is_exterior(label) ? "exterior" : file.labels.text(file.labels.input(label));
    });
}

/// The region's volume, positive where its faces look outward.
inline double volume_of(const MeshFile& file, InputLabel region) {
    double volume = 0;
    for (std::uint32_t f = 0; f < file.mesh.face_end(); ++f) {
        const auto p = file.mesh.corners(FaceId{f});
        const double cone = dot(p[0], cross(p[1], p[2])) / 6;
        for (int side = 0; side < 2; ++side) {
            const Label label = file.mesh[FaceId{f}].labels[side];
            if (!is_exterior(label) && file.labels.input(label) == region) volume += side == 0 ? cone : -cone;
        }
    }
    return volume;
}

}  // namespace regionmesh
