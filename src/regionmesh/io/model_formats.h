// What the formats of model files share: a model as their writers see it, and a surface as their readers bring it.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "regionmesh/base/label.h"
#include "regionmesh/base/vec3.h"
#include "regionmesh/io/file_surface.h"
#include "regionmesh/io/model_file.h"
#include "regionmesh/model/model.h"
#include "regionmesh/volume/label_table.h"

namespace regionmesh {

/// A face as files hold it: dense vertex numbers, input labels, normal from the first label to the second.
struct FileFace {
    std::array<std::uint32_t, 3> vertices;
    std::array<InputLabel, 2> labels;
};

/// The living part of a model in the order of its ids, each face turned so that its labels stand in the order of files:
/// the smaller first; background behind all others; the exterior last. Holds references.
class FileView {
public:
    FileView(const Model& model, const LabelTable& labels, const std::vector<Label>& background);

    const Model& model() const { return model_; }
    const LabelTable& labels() const { return labels_; }
    InputLabel exterior_label() const { return exterior_label_; }
    FileFace face(FaceId f) const;
    /// 2, 3 or 4 labels round the vertex, where each side of the box it lies on counts as one; 10 more on the box.
    std::uint8_t node_type(VertexId v) const;

    template <class Visit>
    void for_vertices(Visit&& visit) const {
        for (std::uint32_t i = 0; i < model_.vertex_end(); ++i)
            if (model_.is_alive(VertexId{i})) visit(VertexId{i});
    }
    template <class Visit>
    void for_faces(Visit&& visit) const {
        for (std::uint32_t i = 0; i < model_.face_end(); ++i)
            if (model_.is_alive(FaceId{i})) visit(FaceId{i});
    }

private:
    const Model& model_;
    const LabelTable& labels_;
    InputLabel exterior_label_;
    std::vector<std::uint32_t> ranks_;    // by dense label: its place in the order of files
    std::vector<std::uint32_t> numbers_;  // by vertex id: its number in the file; empty where that is the id
};

void write_vtp(const FileView& view, const std::vector<PointArray>& arrays, const std::filesystem::path& path);
void write_ply(const FileView& view, const std::filesystem::path& path);
FileSurface read_vtp(const std::filesystem::path& path);
FileSurface read_vtu(const std::filesystem::path& path);
FileSurface read_ply(const std::filesystem::path& path);
FileSurface read_stl(const std::filesystem::path& path);
FileSurface read_obj(const std::filesystem::path& path);
FileSurface read_dream3d(const std::filesystem::path& path);

}  // namespace regionmesh
