#include "formats/registry.h"

#include <algorithm>
#include <string_view>

#include "formats/file_signature.h"
#include "formats/input_file.h"
#include "formats/surface/mesh_formats.h"
#include "formats/surface/tetrahedron_formats.h"
#include "formats/text/header_text.h"

namespace regionmesh::formats {
namespace {

constexpr Part kHdf5{"HDF5", REGIONMESH_WITH_HDF5 != 0};
constexpr Part kDicom{"DICOM", REGIONMESH_WITH_DICOM != 0};
constexpr Part kZarr{"ZARR", REGIONMESH_WITH_ZARR != 0};
constexpr Part kTiff{"TIFF", REGIONMESH_WITH_TIFF != 0};
constexpr Part kPng{"PNG", REGIONMESH_WITH_PNG != 0};
constexpr Part k3mf{"3MF", REGIONMESH_WITH_3MF != 0};
constexpr Part kTables{"TABLES", REGIONMESH_WITH_TABLES != 0};

/// The function, or null where its part is not built; then nothing refers to it.
template <const Part& kPart, auto kFunction>
constexpr auto in_part() {
    if constexpr (kPart.is_built)
        return kFunction;
    else
        return nullptr;
}

using Path = std::filesystem::path;

template <void (*kWrite)(const FileView&, OutputFile&)>
void write_one(const FileView& view, const WriteOptions&, OutputFiles& files, const Path& path) {
    kWrite(view, files.add(path));
}

template <void (*kWrite)(const FileView&, const std::vector<PointArray>&, OutputFile&)>
void write_with_arrays(const FileView& view, const WriteOptions& options, OutputFiles& files, const Path& path) {
    kWrite(view, options.point_arrays, files.add(path));
}

template <const Part& kPart>
constexpr auto write_3mf_in_part() {
    using Write = void (*)(const FileView&, const WriteOptions&, OutputFiles&, const Path&);
    if constexpr (kPart.is_built)
        return Write([](const FileView& view, const WriteOptions& options, OutputFiles& files, const Path& path) {
            write_3mf(view, options.coordinates.metres, files.add(path));
        });
    else
        return Write(nullptr);
}

void write_in_metres(const FileView& view, const WriteOptions& options, OutputFiles& files, const Path& path) {
    write_glb(view, options.coordinates.metres.value_or(1), files.add(path));
}

template <void (*kWrite)(const FileView&, OutputFiles&, const Path&)>
void write_two(const FileView& view, const WriteOptions&, OutputFiles& files, const Path& path) {
    kWrite(view, files, path);
}

template <const Part& kPart, auto kWrite>
constexpr auto write_two_in_part() {
    if constexpr (kPart.is_built)
        return write_two<kWrite>;
    else
        return nullptr;
}

constexpr const char* kStoreInFile =
    "stores in one file are not read; unpack it into a directory (unzip) and name that";

constexpr Format kFormats[] = {
    {.name = "NPY", .extensions = {".npy"}, .open_sections = open_npy},
    {.name = "NIfTI", .extensions = {".nii", ".nii.gz"}, .open_sections = open_nifti},
    {.name = "NIfTI pair", .extensions = {".hdr", ".img", ".hdr.gz", ".img.gz"}, .open_sections = open_nifti},
    {.name = "NRRD", .extensions = {".nrrd", ".nhdr"}, .open_sections = open_nrrd},
    {.name = "MetaImage", .extensions = {".mha", ".mhd"}, .open_sections = open_meta_image},
    {.name = "VTI", .extensions = {".vti"}, .open_sections = open_vti, .has_datasets = true},
    {.name = "INR", .extensions = {".inr", ".inr.gz"}, .open_sections = open_inr},
    {.name = "NPZ", .extensions = {".npz"}, .open_sections = open_npz},
    {.name = "Amira", .extensions = {".am"}, .open_sections = open_amira},
    {.name = "MRC", .extensions = {".mrc", ".map", ".rec", ".ccp4", ".mrc.gz", ".map.gz"}, .open_sections = open_mrc},
    {.name = "Neper", .extensions = {".tesr"}, .open_sections = open_tesr},
    {.name = "contours", .extensions = {".json"}, .open_sections = open_contours},
    {.name = "VTK", .extensions = {".vtk"}, .open_sections = open_legacy_vtk},
    {.name = "FreeSurfer", .extensions = {".mgz", ".mgh"}, .open_sections = open_mgh},
    {.name = "TIFF",
     .extensions = {".tif", ".tiff"},
     .part = kTiff,
     .open_sections = in_part<kTiff, open_tiff>(),
     .is_image = true,
     .read_shape = in_part<kTiff, read_tiff_shape>(),
     .read_image = in_part<kTiff, read_tiff_image>(),
     .is_tiled = in_part<kTiff, is_tiled_tiff>(),
     .read_window = in_part<kTiff, read_tiff_window>()},
    {.name = "PNG",
     .extensions = {".png"},
     .part = kPng,
     .open_sections = in_part<kPng, open_image>(),
     .is_image = true,
     .read_shape = in_part<kPng, read_png_shape>(),
     .read_image = in_part<kPng, read_png_image>()},
    {.name = "other images",
     .extensions = {".bmp", ".gif", ".jpg", ".jpeg", ".jp2", ".pbm", ".pgm", ".pnm", ".ppm", ".tga", ".webp"},
     .is_image = true},
    {.name = "other images", .extensions = {".exr", ".pcx", ".pam", ".avif"}, .is_image = true},
    {.name = "raw", .extensions = {".raw"}, .open_sections = open_raw},
    {.name = "HDF5",
     .extensions = {".h5", ".hdf5", ".hdf", ".he5", ".nxs"},
     .part = kHdf5,
     .open_sections = in_part<kHdf5, open_hdf5>(),
     .has_datasets = true},
    {.name = "DICOM",
     .extensions = {".dcm", ".dicom"},
     .part = kDicom,
     .open_sections = in_part<kDicom, open_dicom>(),
     .detect_file = is_dicom},
    {.name = "Zarr",
     .extensions = {".zarr"},
     .part = kZarr,
     .refusal = kStoreInFile,
     .open_sections = in_part<kZarr, open_zarr>(),
     .detect = in_part<kZarr, is_zarr>(),
     .is_folder = true},
    {.name = "N5",
     .extensions = {".n5"},
     .part = kZarr,
     .refusal = kStoreInFile,
     .open_sections = in_part<kZarr, open_n5>(),
     .detect = in_part<kZarr, is_n5>(),
     .is_folder = true},
    {.name = "zipped stores", .extensions = {".zip"}, .refusal = kStoreInFile},
    {.name = "tables",
     .extensions = {".csv", ".tsv"},
     .part = kTables,
     .open_tetrahedra = in_part<kTables, open_table>(),
     .is_table = true,
     .open_layers = in_part<kTables, open_layer_sections>()},
    {.name = "VTP",
     .extensions = {".vtp"},
     .read_surface = read_vtp,
     .write_surface = write_with_arrays<write_vtp>,
     .has_point_arrays = true},
    {.name = "VTU",
     .extensions = {".vtu"},
     .open_sections = open_vtu_voxels,
     .open_tetrahedra = open_vtu,
     .read_surface = read_vtu,
     .write_surface = write_with_arrays<write_vtu>,
     .has_point_arrays = true},
    {.name = "PLY",
     .extensions = {".ply"},
     .read_surface = read_ply,
     .write_surface = write_one<write_ply>,
     .write_region = write_region_ply},
    {.name = "STL",
     .extensions = {".stl"},
     .read_surface = read_stl,
     .write_surface = write_one<write_stl>,
     .write_region = write_region_stl,
     .has_single_points = true,
     .has_single_region_points = true},
    {.name = "OFF", .extensions = {".off"}, .read_surface = read_off},
    {.name = "OBJ",
     .extensions = {".obj"},
     .read_surface = read_obj,
     .write_surface = write_two<write_obj>,
     .write_region = write_region_obj,
     .write_companion = write_materials_of_regions,
     .companion = ".mtl",
     .forbidden_in_name = "\\"},
    {.name = "Gmsh",
     .extensions = {".msh"},
     .open_tetrahedra = open_msh,
     .write_surface = write_two<write_msh>,
     .needs_closed_regions = true,
     .companion = ".geo",
     .forbidden_in_name = "\"'\\"},
    {.name = "TetGen .smesh",
     .extensions = {".smesh"},
     .write_surface = write_one<write_smesh>,
     .needs_closed_regions = true},
    {.name = "TetGen .poly",
     .extensions = {".poly"},
     .write_surface = write_one<write_poly>,
     .needs_closed_regions = true},
    {.name = "Abaqus", .extensions = {".inp"}, .write_surface = write_one<write_inp>},
    {.name = "glTF", .extensions = {".glb"}, .write_surface = write_in_metres},
    {.name = "3MF",
     .extensions = {".3mf"},
     .part = k3mf,
     .holds_surface = true,
     .write_surface = write_3mf_in_part<k3mf>(),
     .needs_closed_regions = true},
    {.name = "DREAM.3D",
     .extensions = {".dream3d"},
     .part = kHdf5,
     .open_sections = in_part<kHdf5, open_hdf5>(),
     .has_datasets = true,
     .holds_surface = true,
     .read_surface = in_part<kHdf5, read_dream3d>(),
     .write_surface = write_two_in_part<kHdf5, write_dream3d>(),
     .has_single_points = true,
     .companion = ".xdmf",
     .forbidden_in_name = "\":<>&"},
};

}  // namespace

bool is_dicom(const InputFile& file) {
    constexpr std::uint64_t kPreamble = 128;
    std::array<char, 4> word{};
    return file.read(kPreamble, std::as_writable_bytes(std::span(word))) == word.size() &&
           std::string_view(word.data(), word.size()) == "DICM";
}

std::span<const Format> all_formats() { return kFormats; }

std::string extension(const std::filesystem::path& path) {
    const std::string text = lower(path.extension().string());
    return text == ".gz" ? lower(path.stem().extension().string()) + text : text;
}

const Format* find_format(const std::filesystem::path& path) {
    const std::string wanted = extension(path);
    for (const Format& format : kFormats) {
        const auto is_wanted = [&](const char* known) { return known && wanted == known; };
        if (std::ranges::any_of(format.extensions, is_wanted)) return &format;
    }
    return nullptr;
}

const Format* find_format(const InputFile& file) {
    if (const Format* format = find_format(file.path())) return format;
    for (const Format& format : kFormats)
        if (format.detect_file && format.detect_file(file)) return &format;
    if (const char* known = extension_by_content(file)) return find_format(std::filesystem::path("a").concat(known));
    return nullptr;
}

void require_readable(const std::filesystem::path& path, const Format* format) {
    if (!format) return;
    if (!format->part.is_built) {
        fail(path, "this build reads no " + std::string(format->name) + "; build with REGIONMESH_WITH_" +
                       format->part.option);
    }
    if (format->refusal) fail(path, format->refusal);
}

}  // namespace regionmesh::formats
