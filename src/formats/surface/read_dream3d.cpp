// The triangle geometry of a DREAM.3D file (HDF5), versions 6 to 8, with the labels on both sides of its faces.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <span>
#include <string_view>
#include <vector>

#include "formats/chunked/hdf5_reader.h"
#include "formats/codec/sample_format.h"
#include "formats/input_file.h"
#include "formats/surface/mesh_formats.h"

namespace regionmesh {
namespace {

using formats::Hdf5Entry;

constexpr std::string_view kPoints = "/SharedVertexList", kOldGroup = "/_SIMPL_GEOMETRY";
constexpr std::array<std::string_view, 3> kTriangles{"/SharedTriList", "/SharedFaceList", "/SharedTriangleList"};
constexpr std::array<std::string_view, 3> kLabels{"/FaceLabels", "/Face Labels", "/SurfaceMeshFaceLabels"};

constexpr std::uint64_t kRows = 1 << 17;        // per read
constexpr std::uint64_t kMostInflation = 1032;  // the largest ratio of zlib

/// The parts of one surface in the file.
struct TriangleGeometry {
    std::string container;  // the group of all parts
    Hdf5Entry points, triangles;
    std::vector<Hdf5Entry> labels;
};

/// Whether an entry is a table with this number of columns.
bool is_table(const Hdf5Entry& entry, std::uint64_t columns) {
    return entry.is_dataset && entry.obstacle.empty() && entry.shape.size() == 2 && entry.shape[1] == columns;
}

/// Only the groups show the version of the file: up to 7 the lists are in a separate group, from 8 beside the groups of
/// the labels.
std::vector<TriangleGeometry> triangle_geometries(const std::vector<Hdf5Entry>& entries) {
    std::vector<TriangleGeometry> geometries;
    for (const Hdf5Entry& points : entries) {
        if (!points.path.ends_with(kPoints) || !is_table(points, 3)) continue;
        const std::string group = points.path.substr(0, points.path.size() - kPoints.size());
        TriangleGeometry geometry{.container = group, .points = points, .triangles = {}, .labels = {}};
        if (group.ends_with(kOldGroup)) geometry.container.resize(group.size() - kOldGroup.size());
        for (const Hdf5Entry& entry : entries) {
            const auto is_named = [&](std::string_view name) { return entry.path.ends_with(name); };
            if (std::ranges::any_of(kTriangles,
                                    [&](std::string_view name) {
                                        return entry.path.size() == group.size() + name.size() &&
                                               entry.path.starts_with(group) && is_named(name);
                                    }) &&
                is_table(entry, 3) && entry.sample_type)
                geometry.triangles = entry;
            if (entry.path.starts_with(geometry.container + "/") && std::ranges::any_of(kLabels, is_named) &&
                is_table(entry, 2) && entry.sample_type)
                geometry.labels.push_back(entry);
        }
        if (geometry.triangles.is_dataset) geometries.push_back(std::move(geometry));
    }
    return geometries;
}

TriangleGeometry choose(const std::filesystem::path& path, std::vector<TriangleGeometry> geometries) {
    if (geometries.empty())
        formats::fail(path, "has no triangle geometry: no SharedVertexList with a SharedTriList beside it");
    std::erase_if(geometries, [](const TriangleGeometry& geometry) { return geometry.labels.empty(); });
    if (geometries.empty()) formats::fail(path, "has no FaceLabels for its triangles: two integers a face");
    const TriangleGeometry& first = geometries.front();
    if (geometries.size() > 1)
        formats::fail(path, fmt::format("has surfaces in {} and {}: a file with one is needed", first.container,
                                        geometries[1].container));
    if (first.labels.size() > 1)
        formats::fail(path, fmt::format("has labels in {} and {}: a file with one of them is needed",
                                        first.labels[0].path, first.labels[1].path));
    return first;
}

/// Reads tables in blocks of rows.
class TableReader {
public:
    explicit TableReader(const std::filesystem::path& path)
        : path_(path), file_bytes_(formats::InputFile(path).size()), file_(path) {}

    std::vector<Hdf5Entry> entries() { return file_.entries(); }

    /// Calls visit(row) with the numbers of each row; integers keep their bits.
    template <class T, std::size_t kColumns, class Visit>
    void for_rows(const Hdf5Entry& table, std::uint64_t most, Visit&& visit) {
        const std::uint64_t rows = table.shape[0];
        if (rows > most)
            formats::fail(path_, fmt::format("{}: {} rows are more than a model can hold", table.path, rows));
        if (rows > file_bytes_ * kMostInflation)
            formats::fail(path_, fmt::format("{}: {} rows are more than the file can hold", table.path, rows));
        std::vector<T> numbers;
        for (std::uint64_t first = 0; first < rows; first += kRows) {
            const std::uint64_t count = std::min(kRows, rows - first);
            const formats::Bytes bytes = file_.read(table.path, {{first, 0}, {count, kColumns}});
            numbers.resize(count * kColumns);
            const auto type =
                table.sample_type ? formats::number_type(*table.sample_type) : formats::NumberType::kFloat64;
            if (bytes.size() != numbers.size() * bytes_of(type))
                formats::fail(path_, table.path + ": changed while it was read; start again");
            formats::load_all(bytes.data(), bytes_of(type), type, false, std::span(numbers));
            for (std::size_t n = 0; n < numbers.size(); n += kColumns)
                visit(std::span<const T, kColumns>(&numbers[n], kColumns));
        }
    }

private:
    std::filesystem::path path_;
    std::uint64_t file_bytes_;
    formats::Hdf5Reader file_;
};

}  // namespace

FileSurface read_dream3d(const std::filesystem::path& path) {
    TableReader file(path);
    const TriangleGeometry geometry = choose(path, triangle_geometries(file.entries()));
    if (geometry.labels[0].shape[0] != geometry.triangles.shape[0])
        formats::fail(path,
                      fmt::format("{} has {} rows, and {} has {}", geometry.labels[0].path, geometry.labels[0].shape[0],
                                  geometry.triangles.path, geometry.triangles.shape[0]));
    FileSurface surface;
    file.for_rows<double, 3>(geometry.points, kMostVertices, [&](std::span<const double, 3> p) {
        add_point(surface, {p[0], p[1], p[2]}, path);
    });
    file.for_rows<std::int64_t, 3>(geometry.triangles, kMostFaces, [&](std::span<const std::int64_t, 3> corners) {
        for (const std::int64_t v : corners)
            if (v < 0 || static_cast<std::uint64_t>(v) >= surface.points.size())
                formats::fail(path, fmt::format("triangle {} names point {} of {}", surface.faces.size(), v,
                                                surface.points.size()));
        surface.faces.push_back({static_cast<std::uint32_t>(corners[0]), static_cast<std::uint32_t>(corners[1]),
                                 static_cast<std::uint32_t>(corners[2])});
    });
    file.for_rows<std::int64_t, 2>(geometry.labels[0], kMostFaces, [&](std::span<const std::int64_t, 2> labels) {
        surface.labels.push_back({labels[0], labels[1]});
    });
    if (surface.labels.size() != surface.faces.size()) formats::fail(path, "changed while it was read; start again");
    return surface;
}

}  // namespace regionmesh
