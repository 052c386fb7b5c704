// Surface models in files, by extension.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "regionmesh/label_names.h"
#include "regionmesh/label_table.h"
#include "regionmesh/mesh.h"

namespace regionmesh {

/// A number for each vertex, to be written beside the model.
struct PointArray {
    std::string name;                // of letters, digits and '_'
    std::span<const double> values;  // by vertex id
};

struct WriteOptions {
    std::vector<Label> background = {};         // written second in a pair, as the exterior is
    std::vector<PointArray> point_arrays = {};  // .vtp and .vtu only: Float64
    LabelNames names = {};                      // of regions, in formats that can hold them
    bool per_region = false;                    // .stl, .obj and .ply: a file for each region, NAME-LABEL.EXTENSION
    bool boundary_is_open = false;              // the box is not capped: refused where volumes are needed
};

/// Writes the living vertices and faces, numbered densely in order of id. First under temporary names beside `path`,
/// then renamed: a failed run leaves nothing, and what stood there before still stands. All six exterior sides are
/// written as labels.exterior_label(). Each face is turned so that its normal points from its first label to its
/// second: the smaller label first, background or exterior second; of these two the background first.
///   .vtp    VTK PolyData, inline base64 with zlib, UInt64 header. Points Float64; cell array BoundaryLabels (Int64,
///   two
///           components; unsigned labels keep their bits); point array NodeType (Int8: 2, 3, 4 labels, where each side
///           of the box a vertex lies on counts as one; +10 on the box); field data ExteriorLabel where it is not -1,
///           RegionLabels and RegionNames where there are names.
///   .vtu    the same as VTK UnstructuredGrid.
///   .ply    binary little endian: double x, y, z, uchar node_type; faces with vertex_indices (uint) and int
///           label_first, label_second; where a label needs more than 32 bits all are uint words label_first_low,
///           label_first_high, label_second_low, label_second_high. Header lines `comment exterior_label` and `comment
///           region LABEL NAME`; background is not named.
///   .obj    a group interface_A_B for each pair of labels.
///   .stl    text, a solid for each region (not the background), its normals outward. Per region: binary.
///   .msh    MSH 4.1, text: a surface for each interface of two solid parts; and beside it a .geo that makes volumes.
///   .smesh .poly  for TetGen: faces with a marker for each interface, points in holes and regions.
///   .inp    for Abaqus and CalculiX: S3 elements, sets of interfaces, regions and sides of the box, surfaces.
///   .glb    binary glTF, single precision round the middle of the model: a mesh for each region.
///   .dream3d  version 8, single precision: a TriangleGeom with FaceLabels (32 bits; the exterior is -1) and NodeType.
/// Text holds doubles to the last bit. The bytes depend on the model, the labels and the options only. Memory: a few
/// megabytes, and 4 bytes a vertex where some were removed; 8 bytes a face for .obj and .stl, some hundred for those
/// that volume meshers read and for .dream3d. Throws Error(kOutput) for another extension and for options that its
/// format cannot hold, before anything is written, and Error(kOutput) when the file cannot be written or the disk is
/// full.
void write_mesh(const Mesh& mesh, const LabelTable& labels, const std::filesystem::path& path,
                const WriteOptions& options = {});

/// Throws what write_mesh would for the extension, the options and the folder of `path`: before the work, not after
/// it.
void require_writable_mesh(const std::filesystem::path& path, const WriteOptions& options = {},
                           bool with_point_arrays = false);

/// ".vtp .vtu .ply ...": the extensions of the formats that this build writes, and of those that it reads.
std::string writable_extensions();
std::string readable_extensions();

/// A model read from a file, with its labels, as signed numbers. The file's exterior label (-1 if it names none)
/// becomes the sides of the box again where every face with it lies exactly in a plane of the bounding box of all
/// faces; vertices get the sides of their exterior faces. Where one does not (an oblique volume, another program's
/// box), all exterior faces get side 0, and no vertex lies on a side.
struct MeshFile {
    Mesh mesh;
    LabelTable labels;
    LabelNames names = {};  // that the file gives to labels
};

struct ReadMeshOptions {
    /// Joins points no farther apart than this, in the unit of the file, and then faces that lie back to back; 0:
    /// points at one place. Points of .stl files, and of several files in a folder, are joined at 0 without being
    /// asked.
    std::optional<double> weld = {};
    /// Turns faces so that neighbours agree on which side each region lies (io/file_surface.h).
    bool orient = false;
};

/// Reads what write_mesh writes into .vtp, .ply, .stl and .obj, and surfaces of other programs:
///   .vtp .vtu  polygons, and a cell array BoundaryLabels of two integers; ascii, inline or appended, raw or base64,
///              zlib or no compression; several pieces
///   .ply       text or binary, any properties; faces with two labels (label_first and label_second, label0 and label1
///              and so on), or with one (label, region), or with none: one region
///   .stl       text: each solid is a region; binary: one region
///   .obj       groups `interface_3_7` between two labels; any other group is a region
///   .dream3d   the triangle geometry with its FaceLabels, of version 6 to 8
///   a folder   a .ply, .stl or .obj for each region
/// Where a surface comes region by region, faces that lie back to back become one face between their regions; the
/// others bound region and exterior. Polygons are cut into triangles. Vertices keep their order and number, but where
/// points are joined. Throws Error(kInput) naming the file and what is wrong; sizes in the file are believed only as
/// far as its bytes go.
MeshFile read_mesh(const std::filesystem::path& path, const ReadMeshOptions& options = {});

}  // namespace regionmesh
