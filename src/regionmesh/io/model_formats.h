// What the formats of model files share: a model as their writers see it, and a surface as their readers bring it.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "regionmesh/base/label.h"
#include "regionmesh/base/vec3.h"
#include "regionmesh/io/file_view.h"
#include "regionmesh/io/model_file.h"
#include "regionmesh/io/output_file.h"
#include "regionmesh/model/model.h"
#include "regionmesh/volume/label_table.h"

namespace regionmesh {

/// A surface as a file has it. The readers promise that the arrays fit one another and every vertex number is in range.
struct FileSurface {
    std::vector<Vec3> points;
    std::vector<std::array<std::uint32_t, 3>> faces;
    std::vector<std::array<InputLabel, 2>> labels;  // by face
    InputLabel exterior_label = -1;
    LabelNames names = {};
};

/// Most faces and vertices of a Model: a corner packs a face id and a place into 32 bits.
inline constexpr std::uint64_t kMostFaces = (std::uint64_t{1} << 30) - 1;
inline constexpr std::uint64_t kMostVertices = (std::uint64_t{1} << 32) - 1;

void write_vtp(const FileView& view, const std::vector<PointArray>& arrays, OutputFile& file);
void write_vtu(const FileView& view, const std::vector<PointArray>& arrays, OutputFile& file);
void write_ply(const FileView& view, OutputFile& file);
void write_obj(const FileView& view, OutputFile& file);
/// In text, a solid for each region.
void write_stl(const FileView& view, OutputFile& file);
/// All faces as one solid, in single precision.
void write_binary_stl(const FileView& view, OutputFile& file);
void write_smesh(const FileView& view, OutputFile& file);
void write_poly(const FileView& view, OutputFile& file);
/// The faces, and the text for Gmsh that makes volumes of them.
void write_msh(const FileView& view, OutputFiles& files, const std::filesystem::path& path);
FileSurface read_vtp(const std::filesystem::path& path);
FileSurface read_ply(const std::filesystem::path& path);

}  // namespace regionmesh
