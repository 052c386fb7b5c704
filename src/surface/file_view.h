// A mesh as files and arrays hold it.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "mesh/alive.h"
#include "regionmesh/label.h"
#include "regionmesh/label_names.h"
#include "regionmesh/label_table.h"
#include "regionmesh/lattice.h"
#include "regionmesh/mesh.h"

namespace regionmesh {

/// A face with dense vertex numbers and input labels; its normal points from the first label to the second.
struct FileFace {
    std::array<std::uint32_t, 3> vertices;
    std::array<InputLabel, 2> labels;
};

/// The living vertices and faces in order of id. Each face is turned so that its labels are in the order of files: the
/// smaller label first, background after all others, the exterior last. Holds references to its arguments.
class FileView {
public:
    FileView(const Mesh& mesh, const LabelTable& labels, const std::vector<Label>& background);
    FileView(const Mesh& mesh, const LabelTable& labels, const std::vector<Label>& background, const LabelNames& names);

    const Mesh& mesh() const { return mesh_; }
    const LabelTable& labels() const { return labels_; }
    const LabelNames& names() const { return names_; }
    /// Colours given for some of the labels; none by default.
    const LabelColours& given_colours() const { return *colours_; }
    /// `colours` must live as long as the view.
    void set_given_colours(const LabelColours& colours) { colours_ = &colours; }
    /// The colours of all regions, by rank, where the mesh is a part of the model that decides them; none by default.
    const std::vector<std::uint32_t>& colours_of_whole() const { return colours_of_whole_; }
    void set_colours_of_whole(std::vector<std::uint32_t> colours) { colours_of_whole_ = std::move(colours); }
    InputLabel exterior_label() const { return exterior_label_; }
    const Coordinates& coordinates() const { return coordinates_; }
    void set_coordinates(const Coordinates& coordinates) { coordinates_ = coordinates; }
    /// The labels of background. Files say where there are none, too: readers take 0 for background otherwise.
    std::vector<InputLabel> background_labels() const;
    FileFace face(FaceId f) const;
    /// Do files have the labels of the face, and hence its vertices, in the opposite order?
    bool is_turned(FaceId f) const { return rank(mesh_[f].labels[0]) > rank(mesh_[f].labels[1]); }
    /// The number of a vertex in the file.
    std::uint32_t number(VertexId v) const { return numbers_.empty() ? index(v) : numbers_[index(v)]; }
    /// The rank of a dense label in the order of files; all exteriors have the same rank.
    std::uint32_t rank(Label label) const { return is_exterior(label) ? kFirstExterior : ranks_[label]; }
    /// Labels in the order of files, background last.
    std::vector<Label> ordered_labels() const;
    /// The number of ranks that regions have; those of background follow.
    std::uint32_t region_ranks() const { return region_ranks_; }
    bool is_background(Label label) const { return rank(label) >= region_ranks_; }
    /// Text of the input label, with its signedness.
    std::string label_text(Label label) const;
    /// The name of a label; empty if it has none.
    std::string name(Label label) const;
    /// Calls visit(label, name) for each label that has a name, in the order of files.
    template <class Visit>
    void for_names(Visit&& visit) const {
        for (const Label label : ordered_labels())
            if (const std::string text = name(label); !text.empty()) visit(label, text);
    }
    /// Calls visit(label, colour) for each label of the table to which a colour was given, in the order of files.
    template <class Visit>
    void for_given_colours(Visit&& visit) const {
        if (colours_->empty()) return;
        for (const Label label : ordered_labels())
            if (const auto found = colours_->find(labels_.input(label)); found != colours_->end())
                visit(label, found->second);
    }
    /// The number of labels around the vertex, 2, 3 or 4, each side of the box that it lies on included; +10 on the
    /// box.
    std::uint8_t node_type(VertexId v) const;

    template <class Visit>
    void for_vertices(Visit&& visit) const {
        regionmesh::for_vertices(mesh_, visit);
    }
    template <class Visit>
    void for_faces(Visit&& visit) const {
        regionmesh::for_faces(mesh_, visit);
    }

private:
    const Mesh& mesh_;
    const LabelTable& labels_;
    const LabelNames& names_;
    const LabelColours* colours_;
    std::vector<std::uint32_t> colours_of_whole_;
    InputLabel exterior_label_;
    Coordinates coordinates_;
    std::uint32_t region_ranks_ = 0;      // ranks from here on are background or exterior
    std::vector<std::uint32_t> ranks_;    // one per dense label: rank in the order of files
    std::vector<std::uint32_t> numbers_;  // one per vertex id: number in the file; empty if ids are the numbers
};

/// Throws Error(kInput) where a face has a label that the table has not; `what` names the model.
void require_labels(const Mesh& mesh, const LabelTable& labels, const std::string& what);

}  // namespace regionmesh
