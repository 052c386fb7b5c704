// A mesh as the writers of files see it.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "regionmesh/label.h"
#include "regionmesh/label_names.h"
#include "regionmesh/label_table.h"
#include "regionmesh/mesh.h"

namespace regionmesh {

/// A face as in files: dense vertex numbers, input labels, normal from the first label to the second.
struct FileFace {
    std::array<std::uint32_t, 3> vertices;
    std::array<InputLabel, 2> labels;
};

/// The living vertices and faces of a mesh in the order of their ids. Each face is oriented so that its labels are in
/// the order of files: ascending, then background, then the exterior. Holds references.
class FileView {
public:
    FileView(const Mesh& mesh, const LabelTable& labels, const std::vector<Label>& background);
    FileView(const Mesh& mesh, const LabelTable& labels, const std::vector<Label>& background, const LabelNames& names);

    const Mesh& mesh() const { return mesh_; }
    const LabelTable& labels() const { return labels_; }
    const LabelNames& names() const { return names_; }
    InputLabel exterior_label() const { return exterior_label_; }
    FileFace face(FaceId f) const;
    /// Whether files have the labels of the face, and so its vertices, in the opposite order of the mesh.
    bool is_turned(FaceId f) const { return rank(mesh_[f].labels[0]) > rank(mesh_[f].labels[1]); }
    /// The number of a vertex in the file.
    std::uint32_t number(VertexId v) const { return numbers_.empty() ? index(v) : numbers_[index(v)]; }
    /// The rank of a dense label in the order of files; all exterior labels have the same rank.
    std::uint32_t rank(Label label) const { return is_exterior(label) ? kFirstExterior : ranks_[label]; }
    /// Labels in the order of files, background last.
    std::vector<Label> ordered_labels() const;
    bool is_background(Label label) const { return rank(label) >= region_ranks_; }
    /// The label as text, with the sign of the input.
    std::string label_text(Label label) const;
    /// The name of a label; empty where it has none.
    std::string name(Label label) const;
    /// Calls visit(label, name) for each label that has a name, in the order of files.
    template <class Visit>
    void for_names(Visit&& visit) const {
        for (const Label label : ordered_labels())
            if (const std::string text = name(label); !text.empty()) visit(label, text);
    }
    /// The number of labels at the vertex, 2 to 4, where each side of the box counts as one; plus 10 on the box.
    std::uint8_t node_type(VertexId v) const;

    template <class Visit>
    void for_vertices(Visit&& visit) const {
        for (std::uint32_t i = 0; i < mesh_.vertex_end(); ++i)
            if (mesh_.is_alive(VertexId{i})) visit(VertexId{i});
    }
    template <class Visit>
    void for_faces(Visit&& visit) const {
        for (std::uint32_t i = 0; i < mesh_.face_end(); ++i)
            if (mesh_.is_alive(FaceId{i})) visit(FaceId{i});
    }

private:
    const Mesh& mesh_;
    const LabelTable& labels_;
    const LabelNames& names_;
    InputLabel exterior_label_;
    std::uint32_t region_ranks_ = 0;      // ranks from here on are background or exterior
    std::vector<std::uint32_t> ranks_;    // by dense label
    std::vector<std::uint32_t> numbers_;  // by vertex id; empty where numbers equal ids
};

}  // namespace regionmesh
