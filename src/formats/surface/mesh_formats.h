// The readers and writers of surface files, one of each per format.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "formats/surface/file_surface.h"
#include "regionmesh/label.h"
#include "regionmesh/label_table.h"
#include "regionmesh/mesh.h"
#include "regionmesh/mesh_file.h"
#include "regionmesh/output_file.h"
#include "regionmesh/vec3.h"
#include "surface/file_view.h"

namespace regionmesh {

void write_vtp(const FileView& view, const std::vector<PointArray>& arrays, OutputFile& file);
/// VTK's name for the type of labels: Int64, which every program reads, unless a label is 2^63 or more.
const char* vtk_label_type(const LabelTable& labels);
/// A part of a model. `ids` are the numbers of its vertices in the whole, by vertex id: the point array GlobalIds.
void write_vtp_part(const FileView& view, std::span<const std::uint64_t> ids, OutputFile& file);
void write_vtu(const FileView& view, const std::vector<PointArray>& arrays, OutputFile& file);
void write_ply(const FileView& view, OutputFile& file);
/// Writes the faces, and beside them a .mtl file with a colour for each region.
void write_obj(const FileView& view, OutputFiles& files, const std::filesystem::path& path);
/// What a file of one region needs of the whole model.
struct RegionStyle {
    std::uint32_t colour = 0;
    std::string material, material_file;  // of .obj files: the file for all regions is written apart
};

/// Files of one region, the first in the order of files, with normals outward.
void write_region_ply(const FileView& view, const RegionStyle& style, OutputFile& file);
void write_region_obj(const FileView& view, const RegionStyle& style, OutputFile& file);
void write_region_stl(const FileView& view, const RegionStyle& style, OutputFile& file);
/// The .mtl file of all regions, for files of one region each.
void write_materials_of_regions(const FileView& view, OutputFile& file);
/// Text with a solid for each region.
void write_stl(const FileView& view, OutputFile& file);
void write_smesh(const FileView& view, OutputFile& file);
void write_poly(const FileView& view, OutputFile& file);
/// Writes the faces, and beside them a .geo script with which Gmsh makes volumes.
void write_msh(const FileView& view, OutputFiles& files, const std::filesystem::path& path);
void write_inp(const FileView& view, OutputFile& file);
void write_glb(const FileView& view, double metres, OutputFile& file);
/// `metres` in a unit of the coordinates; none: they are taken for millimetres.
void write_3mf(const FileView& view, std::optional<double> metres, OutputFile& file);
/// Writes the model, and beside it a .xdmf file with which ParaView reads it.
void write_dream3d(const FileView& view, OutputFiles& files, const std::filesystem::path& path);
FileSurface read_vtp(const std::filesystem::path& path);
FileSurface read_vtu(const std::filesystem::path& path);
FileSurface read_ply(const std::filesystem::path& path);
FileSurface read_stl(const std::filesystem::path& path);
FileSurface read_obj(const std::filesystem::path& path);
FileSurface read_off(const std::filesystem::path& path);
FileSurface read_dream3d(const std::filesystem::path& path);

}  // namespace regionmesh
