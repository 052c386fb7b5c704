#include "fuzz/fuzz_formats.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>

#include "boreholes/point_table.h"
#include "formats/registry.h"
#include "formats/surface/tetrahedron_formats.h"
#include "regionmesh/blocks.h"
#include "regionmesh/check.h"
#include "regionmesh/label_names_file.h"
#include "regionmesh/mesh_file.h"
#include "regionmesh/read_layers.h"
#include "regionmesh/read_sections.h"
#include "regionmesh/reconstruct.h"
#include "regionmesh/simplify.h"
#include "support/paths.h"

namespace regionmesh::fuzz {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostSections = 40;
constexpr std::size_t kMostSamples = std::size_t{1} << 20;  // a section's own memory is the caller's choice

void pull_sections(SectionReader& reader) {
    const std::size_t samples = std::size_t{reader.section_width()} * reader.section_height();
    if (samples > kMostSamples) return;
    std::vector<InputLabel> section(samples);
    for (std::size_t count = 0; count < kMostSections && reader.next(section); ++count) continue;
}

void read_volume(const fs::path& path, ReadOptions options, Random& random) {
    constexpr std::array kSweeps{SweepChoice::kX, SweepChoice::kY, SweepChoice::kZ};
    if (random.one_in(2)) options.sweep = kSweeps[random.below(3)];
    if (random.one_in(4)) options.layer = static_cast<std::uint32_t>(random.below(3));
    const auto reader = open_sections({path}, options);
    pull_sections(*reader);
    if (!reader->info().can_rewind) return;
    reader->rewind();
    pull_sections(*reader);
}

void volume(const fs::path& path, Random& random) { read_volume(path, {}, random); }

/// One of the datasets of the seeds, which hold several.
void hdf5(const fs::path& path, Random& random) {
    constexpr std::array kDatasets{"",
                                   "/contiguous/uint16",
                                   "/big/gzip_int32",
                                   "/packed/offset_uint16",
                                   "/missing",
                                   "/enum",
                                   "/int24",
                                   "/exported_data",
                                   "/resolution",
                                   "/one",
                                   "/contiguous",
                                   "/packed/sums_uint16"};
    const std::string dataset = kDatasets[random.below(kDatasets.size())];
    read_volume(dataset.empty() ? path : fs::path(path.string() + ":" + dataset), {}, random);
}

/// Bare samples: what may be wrong is what the options say.
void raw(const fs::path& path, Random& random) {
    ReadOptions options;
    options.raw_type = static_cast<SampleType>(random.below(9));
    options.raw_size.emplace();
    for (std::uint32_t& size : *options.raw_size)
        size = static_cast<std::uint32_t>(random.one_in(8) ? random.next() >> random.below(64) : 1 + random.below(6));
    if (random.one_in(2)) {
        options.raw_type = SampleType::kU8;
        options.raw_size = {static_cast<std::uint32_t>(fs::file_size(path)), 1, 1};
    }
    read_volume(path, options, random);
}

constexpr std::uint32_t kMostFaces = 2000;  // of what is worked on

/// What can be read is also checked and decimated: no surface may be too odd.
void mesh(const fs::path& path, Random& random) {
    ReadMeshOptions options{.orient = random.one_in(2)};
    if (random.one_in(2)) options.weld = random.one_in(2) ? 0 : 0.01;
    MeshFile file = read_mesh(path, options);
    if (file.mesh.face_count() > kMostFaces) return;
    check(file.mesh, {.threads = 1});
    file.mesh.sort_spatially();
    lock_violations(file.mesh, {.threads = 1});
    simplify(file.mesh, {.target_faces = file.mesh.face_count() / 4});
}

/// Checksums that fit: what the pieces hold comes before the reader then.
void mend_checksums(const fs::path& folder) {
    const fs::path manifest = folder / "manifest.json";
    nlohmann::json json = nlohmann::json::parse(text_of(manifest), nullptr, false);
    if (!json.is_object() || !json.contains("pieces") || !json["pieces"].is_array()) return;
    for (const auto& entry : fs::directory_iterator(folder)) {
        std::string piece = text_of(entry.path());
        const std::string name = entry.path().stem();
        if (entry.path().extension() != ".piece" || piece.size() < 4) continue;
        const auto end = static_cast<uInt>(piece.size() - 4);
        const auto checksum = static_cast<std::uint32_t>(crc32(0, reinterpret_cast<const Bytef*>(piece.data()), end));
        std::memcpy(piece.data() + end, &checksum, sizeof checksum);
        std::ofstream(entry.path(), std::ios::binary) << piece;
        const std::size_t number = std::strtoul(name.substr(name.rfind('-') + 1).c_str(), nullptr, 10);
        if (number < json["pieces"].size() && json["pieces"][number].is_object())
            json["pieces"][number]["crc32"] = checksum;
    }
    std::ofstream(manifest, std::ios::binary) << json;
}

/// A folder that is complete is read in every way, another one goes on.
void pieces(const fs::path& path, Random& random) {
    if (random.one_in(2)) mend_checksums(path);
    if (random.one_in(2)) {
        BlockTasks alone;
        ReconstructOptions options{.reduce = 0.5, .memory = std::uint64_t{256} << 20, .threads = 1};
        const auto open = [] { return open_sections({fs::path(test::data_folder()) / "pieces/grains.npy"}); };
        reconstruct_blocks(open, options, {.folder = path, .block_cells = 2, .output = {.sync = false}}, alone);
    }
    VolumeInfo info;
    info.lattice.size = {5, 4, 4};
    describe_block_folder(path);
    size_of_block_folder(path);
    check_block_folder(path, {.threads = 1});
    if (has_lattice_of(path, info)) voxelise_block_folder(path, info, {}, [](std::span<const Label>) {});
    read_block_folder(path);
}

constexpr std::size_t kMostTetrahedra = std::size_t{1} << 22;

/// Labels by the reader's choice, or by a name that some seeds have.
void tetrahedra(const fs::path& path, Random& random) {
    constexpr std::array kArrays{"region", "tissue", "gmsh:geometrical", "label", "temperature"};
    TetrahedraOptions options;
    if (random.one_in(3)) options.array = kArrays[random.below(kArrays.size())];
    if (random.one_in(4)) options.scale_z = 1e300;
    const auto reader =
        path.extension() == ".msh" ? formats::open_msh(path, options) : formats::open_vtu(path, options);
    const LabelledPoints points = reader->take_points();
    if (!points.positions.empty()) reader->name_of_point(static_cast<std::uint32_t>(points.positions.size() - 1));
    std::vector<LabelledTetrahedron> some(1 + random.below(1000));
    std::size_t count = 0;
    while (const std::size_t got = count < kMostTetrahedra ? reader->next(some) : 0) {
        for (std::size_t i = 0; i < got; ++i)
            for (const std::uint32_t corner : some[i].corners)
                if (corner >= points.positions.size()) std::abort();
        count += got;
    }
    if (count > 0) reader->name_of_tetrahedron(count - 1);
}

void names(const fs::path& path, Random&) {
    read_label_colours(path);  // takes any text
    read_label_names(path);
}

#if REGIONMESH_WITH_TABLES
/// Drill holes are cut by a step that makes few points of them.
void points(const fs::path& path, Random& random) {
    constexpr std::array kColumns{"1,2,3,4", "x=1,y=2,label=4",        "z=1,x=4", "hole=1,top=5,bottom=6",
                                  "name=5",  "label=lith,hole=Hole_ID"};
    TetrahedraOptions options;
    if (random.one_in(2)) options.columns = kColumns[random.below(kColumns.size())];
    const formats::PointTable table = formats::read_point_table(path, options);
    if (random.one_in(2)) return;
    double farthest = 0;
    for (const Vec3& position : table.points.positions) farthest = std::max(farthest, std::abs(position.z));
    options.step = farthest / 20;
    formats::read_point_table(path, options);
}

/// One of the files that a model of layers is read from: the intervals, by places or with a table of collars; that
/// table, one of stations, or a terrain. The others are whole.
void layers(const fs::path& path, Random& random) {
    constexpr std::array kUnits{"auto", "auto,-clay", "clay,auto", "sand,clay,chalk", "3,2,1"};
    const fs::path folder = path.parent_path();
    const std::string extension = path.extension();
    TetrahedraOptions table;
    LayerOptions options{.memory = std::uint64_t{64} << 20, .max_work = 2'000'000, .threads = 1};
    const bool is_table = extension == ".csv";
    if (extension == ".collars" || extension == ".surveys" || (is_table && random.one_in(2))) {
        table.collars = extension == ".collars" ? path : folder / "collars.collars";
        if (extension == ".surveys" || random.one_in(2))
            table.surveys = extension == ".surveys" ? path : folder / "dips.surveys";
    }
    if (extension == ".asc" || random.one_in(4)) options.terrain = extension == ".asc" ? path : folder / "corner.asc";
    if (random.one_in(8)) options.units = kUnits[random.below(kUnits.size())];
    options.spacing = random.one_in(8) ? Vec3{1e-3, 1, 1e5} : Vec3{50, 50, 5};
    if (random.one_in(8)) options.box[2] = {-1e9, 1e9};
    const char* const whole = table.collars.empty() ? "holes.csv" : "intervals.csv";
    pull_sections(*open_layers(is_table ? path : folder / whole, table, options));
    if (!table.collars.empty()) formats::read_point_table(is_table ? path : folder / whole, table);
}
#endif

/// Without the formats that the build leaves out.
std::vector<Format> in_this_build(std::vector<Format> all) {
    std::erase_if(all, [](const Format& format) {
        const auto* row = formats::find_format("a" + (*format.store ? format.store : format.extensions[0]));
        return row && !row->part.is_built;
    });
    return all;
}

}  // namespace

std::span<const Format> formats() {
    static const std::vector<Format> kFormats = in_this_build({
        Format{"npy", "npy", {".npy"}, volume}, Format{"nifti", "nifti", {".nii", ".gz"}, volume},
            Format{"tiff", "tiff", {".tif"}, volume}, Format{"png", "png", {".png"}, volume},
            Format{"raw", "nrrd", {".raw"}, raw}, Format{"nrrd", "nrrd", {".nrrd", ".nhdr"}, volume},
            Format{"meta", "meta", {".mha", ".mhd"}, volume}, Format{"vti", "vti", {".vti"}, volume},
            Format{"more", "more", {".npz", ".mrc", ".vtk", ".am", ".tesr"}, volume},
            Format{"contours", "contours", {".csv", ".json"}, volume}, Format{"off", "off", {".off"}, mesh},
            Format{"voxels", "reports", {".vtu"}, volume}, Format{"inr", "inr", {".inr", ".gz"}, volume},
            Format{"mgh", "mgh", {".mgh", ".mgz"}, volume},
            Format{"names", "names", {".txt", ".csv", ".tsv", ".label", ".ctbl", ".xml"}, names},
#if REGIONMESH_WITH_TABLES
            Format{"points", "points", {".csv", ".tsv"}, points},
            Format{"layers", "layers", {".csv", ".collars", ".surveys", ".asc"}, layers},
#endif
            Format{"hdf5", "chunked", {".h5"}, hdf5}, Format{"dream3d", "chunked", {".dream3d"}, volume},
            Format{"dicom", "dicom", {".dcm"}, volume}, Format{"zarr2", "chunked/zarr2", {}, volume, ".zarr"},
            Format{"zarr3", "chunked/zarr3", {}, volume, ".zarr"}, Format{"ome", "chunked/ome", {}, volume, ".zarr"},
            Format{"n5", "chunked/n5", {}, volume, ".n5"}, Format{"pieces", "pieces", {}, pieces, ".pieces"},
            Format{"vtp", "", {".vtp"}, mesh}, Format{"vtu", "surfaces", {".vtu"}, mesh},
            Format{"vtu_mesh", "meshes", {".vtu"}, tetrahedra}, Format{"msh_mesh", "meshes", {".msh"}, tetrahedra},
            Format{"ply", "ply", {".ply"}, mesh}, Format{"plies", "surfaces", {".ply"}, mesh},
            Format{"stl", "surfaces", {".stl"}, mesh}, Format{"obj", "surfaces", {".obj"}, mesh},
            Format{"dream3d_faces", "surfaces", {".dream3d"}, mesh},
    });
    return kFormats;
}

}  // namespace regionmesh::fuzz
