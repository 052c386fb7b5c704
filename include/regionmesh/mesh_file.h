// Reads and writes surface models; the extension selects the format.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "regionmesh/label_names.h"
#include "regionmesh/label_table.h"
#include "regionmesh/lattice.h"
#include "regionmesh/mesh.h"
#include "regionmesh/output_file.h"

namespace regionmesh {

/// A number for each vertex, written with the model.
struct PointArray {
    std::string name;                // name of letters, digits and '_'; not NodeType, and not that of another array
    std::span<const double> values;  // one per vertex id
};

struct WriteOptions {
    std::vector<Label> background = {};         // second label of a face, like the exterior
    std::vector<PointArray> point_arrays = {};  // .vtp and .vtu only: Float64
    LabelNames names = {};                      // names of regions, in formats that can hold them
    LabelColours colours = {};                  // colours of some regions; the others get those of a palette
    bool per_region = false;                    // .stl, .obj and .ply: a file for each region, MODEL-REGION.EXTENSION;
                                                // .obj: and MODEL.mtl with their colours
    Coordinates coordinates = {};               // space: where 3D Slicer reads it; .glb are scaled to metres
    bool boundary_is_open = false;              // the box is not capped: refused where volumes are needed
    OutputOptions output = {};
};

/// Writes the living vertices and faces, numbered densely in order of id. Writes under temporary names beside `path`
/// and then renames: a failed run leaves no file and keeps an earlier one. All six exterior sides are written as
/// labels.exterior_label(). Each face is oriented so that its normal points from its first label to its second: the
/// smaller label first, background after other labels, the exterior last.
///   .vtp    VTK PolyData, inline base64 with zlib, UInt64 header. Points Float64; cell array BoundaryLabels (2
///           components of Int64, or of UInt64 where a label is 2^63 or more); point array NodeType (Int8: 2, 3 or 4
///           labels, where each side of the box counts as one; +10 on the box); cell array RGB (UInt8, 3 components);
///           field data ExteriorLabel where it is not -1, BackgroundLabels where they are known, RegionLabels and
///           RegionNames where there are names, ColourLabels and RegionColours where colours were given.
///   .vtu    the same as VTK UnstructuredGrid.
///   .ply    binary little endian: double x, y, z, uchar node_type; faces with vertex_indices (uint) and int
///           label_first, label_second; where a label needs more than 32 bits all are uint words label_first_low,
///           label_first_high, label_second_low, label_second_high; then uchar red, green, blue. Header
///           lines `comment exterior_label`, `comment background` and `comment region LABEL NAME`.
///   .obj    an object and a material for each first label, a group interface_A_B for each pair of labels; a .mtl file
///           beside it has the colours, which are those of the first labels in all formats.
///   .stl    text, a solid for each region (not the background), its normals outward. Per region: binary.
///   .msh    MSH 4.1, text: a surface for each interface of two solid parts; a .geo file beside it makes volumes.
///   .smesh .poly  for TetGen: faces with a marker for each interface, points in holes and regions.
///   .inp    for Abaqus and CalculiX: S3 elements, sets of interfaces, regions and sides of the box, surfaces.
///   .3mf    for 3D printers: an object for each region.
///   .glb    binary glTF, single precision relative to the centre of the model: a mesh for each region.
///   .dream3d  version 8, single precision: a TriangleGeom with FaceLabels (32 bits; the exterior is -1) and NodeType.
/// Doubles in text round-trip. The bytes depend only on the model, the labels and the options. Memory: a few megabytes;
/// 4 bytes per vertex where ids are not dense; 8 bytes per face for .obj and .stl, some hundred for the formats of
/// volume meshers and .dream3d. Throws Error(kOutput) for another extension and for options that the format does not
/// support, before it writes anything, for vertices that are not finite, and where the file cannot be written;
/// Error(kInput) for a table that lacks a label of the mesh; Error(kUsage) for coordinates.metres and
/// coordinates.spacing out of range.
///
/// .vtp, .vtu, .ply, .obj and .stl say the space, where it is known, as 3D Slicer reads it: SPACE=RAS. .vtp, .vtu, .ply
/// and .obj say which labels are background, and the unit of length and the spacing of samples, where they are known:
/// field data MetresPerUnit and SampleSpacing, lines `metres_per_unit` and `sample_spacing`. .3mf say the unit. .vtp
/// and .vtu have two arrays to colour by: Region, the first label of a face, and Neighbour, the second. With per_region
/// a file has the name of its region, or else its label. Returns the files written.
std::vector<std::filesystem::path> write_mesh(const Mesh& mesh, const LabelTable& labels,
                                              const std::filesystem::path& path, const WriteOptions& options = {});

/// The same into files that are committed together with others: a report. Does not commit them; their OutputOptions
/// hold, not those of `options`.
std::vector<std::filesystem::path> write_mesh(const Mesh& mesh, const LabelTable& labels,
                                              const std::filesystem::path& path, const WriteOptions& options,
                                              OutputFiles& files);

/// Throws the errors of write_mesh for the extension, the options and the folder of `path`: for a check before long
/// work.
void require_writable_mesh(const std::filesystem::path& path, const WriteOptions& options = {},
                           bool with_point_arrays = false);

/// How far the numbers of the file move a point of the mesh, at most, as a share of the mean edge; 0 where they are of
/// double precision, and for a mesh without faces. Single precision far from the origin makes faces degenerate and
/// cross.
double rounded_share_of_edge(const Mesh& mesh, const std::filesystem::path& path, const WriteOptions& options = {});

/// ".vtp .vtu .ply ...": the extensions of the formats that this build writes, and of those that it reads.
std::string writable_extensions();
std::string readable_extensions();

/// A model from a file. Labels are signed unless the file says otherwise (UInt64 in .vtp and .vtu). Faces with the
/// exterior label of the file (-1 by default) become sides of the box where all of them lie exactly in planes of the
/// bounding box of all faces, or in those of an oblique box (regionmesh/box_axes.h); their vertices get these sides.
/// Otherwise (a body of another program) all exterior faces get one side, and no vertex is on a plane.
struct MeshFile {
    Mesh mesh;
    LabelTable labels;
    LabelNames names = {};      // names of labels, from the file
    LabelColours colours = {};  // likewise: those that the input gave, not those of the palette
    Coordinates coordinates = {};
    /// Labels of empty space; none: the file does not say. Files with a region on one side of each face have no
    /// background.
    std::optional<std::vector<InputLabel>> background = {};
};

struct ReadMeshOptions {
    /// Merges points within this distance, in the unit of the file, and then opposite faces on the same vertices; 0:
    /// only points at the same place; Error(kUsage) below 0. Points of .stl files and of folders are always merged, by
    /// default with 0.
    std::optional<double> weld = {};
    /// Orients faces so that neighbours agree on the side of each region.
    bool orient = false;
    /// Turns the model into this space, if the file says another.
    Space space = Space::kUnknown;
};

/// Reads what write_mesh writes into .vtp, .ply, .stl and .obj, and surfaces of other programs:
///   .vtp .vtu  polygons with a cell array BoundaryLabels of two integers; ascii, inline or appended, raw or base64,
///              zlib or no compression; several pieces
///   .ply       text or binary, any properties; faces with two labels (label_first and label_second, label0 and label1
///              and so on), or with one (label, region), or with none: one region
///   .stl       text: each solid is a region; binary: one region
///   .obj       groups `interface_3_7` between two labels; any other group is a region
///   .dream3d   the triangle geometry with its FaceLabels, of version 6 to 8
///   a folder   a .ply, .stl or .obj for each region
/// Where each face has one label, opposite faces on the same vertices become one face between their regions; the other
/// faces have the exterior on the other side. Polygons are split into triangles. Vertices keep their order and number,
/// unless points are merged. Throws Error(kInput) that names the file. Memory is allocated only for data present in the
/// file, whatever sizes its header gives.
MeshFile read_mesh(const std::filesystem::path& path, const ReadMeshOptions& options = {});

/// Whether the file, read from `path`, may have the exterior where the model had this background: .stl files and
/// folders of regions have.
bool lacks_background(const MeshFile& file, const std::filesystem::path& path, InputLabel background);

/// Gives `background` to the faces of the exterior that do not lie on a side of the lattice, as reconstruct() had it.
/// Requires a model without that label.
void restore_background(MeshFile& file, const Lattice& lattice, InputLabel background);

}  // namespace regionmesh
