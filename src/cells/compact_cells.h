// Cells meshed whole, from a table, instead of in six tetrahedra: the same sheets and lines with a third of the faces
// (docs/explanation/compact-cells.md).
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "cells/cell_partition.h"
#include "cells/marching_tetrahedra.h"

namespace regionmesh {

/// The table is text: faces of four letters each, three vertices (indices in kCellSimplices) and, as 8 * first +
/// second, the nodes whose labels the face separates. The faces of a class of partitions end with kEndOfClass.
inline constexpr std::string_view kCompactAlphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+-";
inline constexpr char kEndOfClass = ' ';

/// A face in a cell; its normal points from the label of node `first` to that of node `second`.
struct CompactFace {
    std::array<std::uint8_t, 3> vertices;  // indices in kCellSimplices
    std::uint8_t first, second;            // nodes
};

/// The faces of a side of the box that drops_diagonal(), anticlockwise as seen from the high end of its axis; corners
/// are those of corners_of_side(). Wherever vertices go on their edges, the faces cover the side once.
const std::array<CaseFace, 4>& compact_cap(const std::array<Label, 4>& labels);
/// All that compact_cap() returns: by whether corners 1 and 2 have the label of corner 3, or that of corner 0.
extern const std::array<std::array<CaseFace, 4>, 4> kCompactCaps;

/// The faces of all partitions. They stay embedded wherever vertices go in their lattice simplices; in triangles on the
/// main diagonal of a cell weights stay above kInnerMargin.
class CompactCells {
public:
    static constexpr double kInnerMargin = 0.3;

    /// Made from the table at the first call.
    static const CompactCells& get();

    struct Counts {
        int faces, labels;
    };
    /// The faces of a cell with these labels.
    Counts counts(const std::array<Label, 8>& labels) const {
        const Entry& entry = class_of(labels);
        return {entry.face_count, entry.label_count};
    }

    /// Calls visit(face) for each face of a cell with these labels.
    template <class Visit>
    void for_each_face(const std::array<Label, 8>& labels, Visit&& visit) const {
        const Entry& entry = class_of(labels);
        const Image& image = images_[entry.symmetry];
        for (std::uint32_t f = entry.first_face; f < entry.first_face + entry.face_count; ++f) {
            const CompactFace& face = faces_[f];
            const auto& [a, b, c] = face.vertices;
            visit(
                CompactFace{{image.vertex[a], image.vertex[image.mirrors ? c : b], image.vertex[image.mirrors ? b : c]},
                            image.node[face.first],
                            image.node[face.second]});
        }
    }

private:
    /// The faces of a partition: those of the first of its class, after a symmetry.
    struct Entry {
        std::uint32_t first_face = 0;
        std::uint16_t face_count = 0;
        std::uint8_t symmetry = 0;
        std::uint8_t label_count = 0;
    };
    struct Image {
        std::array<std::uint8_t, kCellSimplexCount> vertex;
        std::array<std::uint8_t, 8> node;
        bool mirrors;
    };

    CompactCells();
    /// Cells of at most two labels, which most are, have a table of their own.
    const Entry& class_of(const std::array<Label, 8>& labels) const {
        unsigned others = 0;  // the nodes that differ from the first
        for (int n = 1; n < 8; ++n) others |= unsigned(labels[n] != labels[0]) << n;
        const Label other = labels[std::countr_zero(others | 1u << 7)];  // node 7 if none differs
        bool is_third = false;
        for (Label label : labels) is_third |= (label != labels[0]) & (label != other);
        return is_third ? entries_[number_of(partition_of(labels))] : two_labels_[others >> 1];
    }

    std::vector<CompactFace> faces_;
    std::vector<Entry> entries_;              // index: number_of()
    std::array<Entry, 128> two_labels_ = {};  // index: set of the nodes 1 to 7 that differ from node 0
    std::array<Image, 12> images_;
};

}  // namespace regionmesh
