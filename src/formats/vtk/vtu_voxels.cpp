// VTK unstructured grids whose cells are the voxels of a regular grid, whole or cut into tetrahedra.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <mutex>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "formats/array/array_axes.h"
#include "formats/array/held_sections.h"
#include "formats/array/volume_formats.h"
#include "formats/array/volume_size.h"
#include "formats/codec/sample_format.h"
#include "formats/registry.h"
#include "formats/surface/tetrahedron_formats.h"
#include "formats/text/header_text.h"
#include "formats/vtk/vtk_numbers.h"
#include "regionmesh/error.h"

namespace regionmesh::formats {
namespace {

constexpr std::int64_t kTetrahedron = 10, kVoxel = 11, kHexahedron = 12;
constexpr int kVoxelVolume = 6;  // of tetrahedra
constexpr std::uint64_t kMostCells = 0x7FFFFFFF;
constexpr std::uint64_t kMostSamplesPerCell = 8;           // of a grid with holes
constexpr std::size_t kMostPlanes = std::size_t{1} << 20;  // along an axis

using Index = std::array<std::uint32_t, 3>;

/// Equally spaced planes along an axis.
struct Planes {
    double first = 0, spacing = 1;
    std::uint32_t count = 0;

    std::optional<std::uint32_t> index(double coordinate) const {
        constexpr double kRounding = 0.01;  // of the spacing; points are often in single precision
        const double place = (coordinate - first) / spacing, whole = std::round(place);
        if (!(std::abs(place - whole) < kRounding) || whole < 0 || whole >= count) return std::nullopt;
        return static_cast<std::uint32_t>(whole);
    }
};

/// None where the coordinates are not those of equally spaced planes.
std::optional<Planes> planes_of(const std::set<double>& coordinates) {
    if (coordinates.size() < 2) return std::nullopt;
    const double extent = *coordinates.rbegin() - *coordinates.begin();
    const double same = 1e-6 * extent;
    double spacing = extent, last = *coordinates.begin();
    for (const double coordinate : coordinates) {
        if (coordinate - last > same) spacing = std::min(spacing, coordinate - last);
        last = coordinate;
    }
    const double count = std::round(extent / spacing) + 1;
    if (!(count < static_cast<double>(kMaxAxisSamples))) return std::nullopt;
    Planes planes{*coordinates.begin(), extent / (count - 1), static_cast<std::uint32_t>(count)};
    for (const double coordinate : coordinates)
        if (!planes.index(coordinate)) return std::nullopt;
    return planes;
}

struct VoxelGrid {
    std::array<Planes, 3> planes;
    std::array<std::uint64_t, 3> size{};  // voxels along x, y, z
    std::vector<InputLabel> labels;       // x fastest
    SampleType type = SampleType::kI64;
    bool has_holes = false;
};

/// Reads a grid, and gives up where it is no grid of voxels.
class VoxelReader {
public:
    VoxelReader(const VtkXml& xml, pugi::xml_node piece) : xml_(xml), piece_(piece) {
        points_ = xml.count(piece, "NumberOfPoints", kMostCells);
        cells_ = xml.count(piece, "NumberOfCells", kMostCells);
    }

    /// Without labels where `wanted` is none: then only the shape of the grid counts.
    std::optional<VoxelGrid> read(const std::optional<std::string>& wanted) {
        if (cells_ == 0 || points_ < 8 || !has_types_of_voxels() || !find_planes()) return std::nullopt;
        std::uint64_t samples = 1;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            grid_.size[axis] = grid_.planes[axis].count - 1;
            if (grid_.size[axis] > kMostSamplesPerCell * cells_ / samples) return std::nullopt;
            samples *= grid_.size[axis];
        }
        pugi::xml_node labels;
        if (wanted) {
            const std::vector<pugi::xml_node> nodes = arrays_of(piece_, true);
            std::vector<MeshArray> arrays;
            for (const pugi::xml_node node : nodes) arrays.push_back(describe(node));
            const std::size_t chosen = choose_label_array(xml_.path(), arrays, *wanted);
            if (!arrays[chosen].is_cell) return std::nullopt;
            labels = nodes[chosen];
            if (const NumberType type = *vtk_type(labels); !is_real(type)) grid_.type = sample_type(type);
        }
        quantize();
        grid_.labels.assign(samples, 0);
        volume_.assign(samples, 0);
        if (!put_cells(labels)) return std::nullopt;
        for (const std::uint8_t volume : volume_) {
            if (volume != 0 && volume != kVoxelVolume) return std::nullopt;
            grid_.has_holes |= volume == 0;
        }
        return std::move(grid_);
    }

private:
    pugi::xml_node array(const char* name) const { return xml_.required_array(piece_.child("Cells"), name); }

    bool has_types_of_voxels() {
        VtkNumbers types = integers_of(xml_, array("types"), cells_);
        for (std::uint64_t n = 0; n < cells_; ++n) {
            const std::int64_t type = types.integer();
            if (type != kTetrahedron && type != kVoxel && type != kHexahedron) return false;
            if (n == 0) first_type_ = type;
        }
        return first_type_ != kTetrahedron || begins_with_cut_voxel();
    }

    /// Whether the first two tetrahedra have one box, as those of a voxel have: sure enough to go on.
    bool begins_with_cut_voxel() {
        if (cells_ < 5) return false;
        VtkNumbers connectivity = integers_of(xml_, array("connectivity"), std::nullopt);
        std::array<std::int64_t, 8> corners{};
        for (std::int64_t& corner : corners) corner = connectivity.integer();
        std::array<Vec3, 8> places{};
        const std::int64_t last = *std::ranges::max_element(corners);
        if (*std::ranges::min_element(corners) < 0 || static_cast<std::uint64_t>(last) >= points_) return false;
        VtkNumbers points = points_of(xml_, piece_, points_);
        for (std::int64_t n = 0; n <= last; ++n) {
            const Vec3 point = points.point();
            for (std::size_t c = 0; c < corners.size(); ++c)
                if (corners[c] == n) places[c] = point;
        }
        std::array<Box, 2> boxes;
        for (std::size_t c = 0; c < corners.size(); ++c) boxes[c / 4].add(places[c]);
        const auto is_same = [](Vec3 a, Vec3 b) { return a.x == b.x && a.y == b.y && a.z == b.z; };
        return is_same(boxes[0].low, boxes[1].low) && is_same(boxes[0].high, boxes[1].high);
    }

    bool find_planes() {
        std::array<std::set<double>, 3> coordinates;
        VtkNumbers points = points_of(xml_, piece_, points_);
        for (std::uint64_t n = 0; n < points_; ++n) {
            const Vec3 point = points.point();
            for (int axis = 0; axis < 3; ++axis) {
                auto& own = coordinates[static_cast<std::size_t>(axis)];
                if (!std::isfinite(point[axis])) return false;
                own.insert(point[axis]);
                if (own.size() > kMostPlanes || own.size() > 64 + points_ / 2) return false;
            }
        }
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto planes = planes_of(coordinates[axis]);
            if (!planes) return false;
            grid_.planes[axis] = *planes;
        }
        return true;
    }

    void quantize() {
        VtkNumbers points = points_of(xml_, piece_, points_);
        indices_.resize(points_);
        for (Index& index : indices_) {
            const Vec3 point = points.point();
            for (int axis = 0; axis < 3; ++axis)
                index[static_cast<std::size_t>(axis)] =
                    grid_.planes[static_cast<std::size_t>(axis)].index(point[axis]).value_or(0);
        }
    }

    bool put_cells(pugi::xml_node label_array) {
        VtkNumbers types = integers_of(xml_, array("types"), cells_),
                   offsets = integers_of(xml_, array("offsets"), cells_),
                   connectivity = integers_of(xml_, array("connectivity"), std::nullopt);
        std::optional<VtkNumbers> labels;
        if (label_array) labels.emplace(xml_, label_array, cells_);
        std::int64_t begin = 0;
        for (std::uint64_t n = 0; n < cells_; ++n) {
            const std::size_t corners = types.integer() == kTetrahedron ? 4 : 8;
            const std::int64_t end = offsets.integer();
            if (end - begin != static_cast<std::int64_t>(corners)) return false;
            begin = end;
            std::array<Index, 8> cell{};
            for (std::size_t c = 0; c < corners; ++c) {
                const std::int64_t point = connectivity.integer();
                if (point < 0 || static_cast<std::uint64_t>(point) >= points_) return false;
                cell[c] = indices_[static_cast<std::size_t>(point)];
            }
            if (!put(std::span<const Index>(cell).first(corners), labels ? labels->integer() : 0)) return false;
        }
        for (VtkNumbers* numbers : {&offsets, &connectivity, &types}) numbers->finish();
        if (labels) labels->finish();
        return true;
    }

    /// False where the cell is no voxel, or no part of one, or the voxel has another label already.
    bool put(std::span<const Index> corners, InputLabel label) {
        Index low = corners[0], high = corners[0];
        for (const Index& corner : corners)
            for (std::size_t axis = 0; axis < 3; ++axis) {
                low[axis] = std::min(low[axis], corner[axis]);
                high[axis] = std::max(high[axis], corner[axis]);
            }
        unsigned met = 0;
        for (std::size_t axis = 0; axis < 3; ++axis)
            if (high[axis] != low[axis] + 1) return false;
        for (const Index& corner : corners)
            met |= 1u << ((corner[0] - low[0]) + 2 * (corner[1] - low[1]) + 4 * (corner[2] - low[2]));
        int volume = kVoxelVolume;
        if (corners.size() == 8 && met != 0xFF) return false;
        if (corners.size() == 4) {
            std::array<std::array<int, 3>, 3> edge{};
            for (std::size_t e = 0; e < 3; ++e)
                for (std::size_t axis = 0; axis < 3; ++axis)
                    edge[e][axis] = static_cast<int>(corners[e + 1][axis]) - static_cast<int>(corners[0][axis]);
            const auto& [a, b, c] = edge;
            volume = std::abs(a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) +
                              a[2] * (b[0] * c[1] - b[1] * c[0]));
            if (volume == 0) return false;
        }
        const std::size_t at = low[0] + grid_.size[0] * (low[1] + grid_.size[1] * std::size_t{low[2]});
        if (volume_[at] != 0 && grid_.labels[at] != label) return false;
        if (volume_[at] + volume > kVoxelVolume) return false;
        volume_[at] = static_cast<std::uint8_t>(volume_[at] + volume);
        grid_.labels[at] = label;
        return true;
    }

    const VtkXml& xml_;
    pugi::xml_node piece_;
    std::uint64_t points_ = 0, cells_ = 0;
    std::int64_t first_type_ = 0;
    std::vector<Index> indices_;        // of points
    std::vector<std::uint8_t> volume_;  // of the cells in each voxel, in sixths
    VoxelGrid grid_;
};

std::optional<VoxelGrid> read_voxels(const VtkXml& xml, const std::optional<std::string>& wanted) {
    pugi::xml_node only;
    for (const pugi::xml_node piece : xml.dataset().children("Piece")) {
        if (xml.count(piece, "NumberOfCells", kMostCells) == 0) continue;
        if (only) return std::nullopt;
        only = piece;
    }
    if (!only) return std::nullopt;
    return VoxelReader(xml, only).read(wanted);
}

}  // namespace

bool holds_voxels(const std::filesystem::path& path) {
    if (extension(path) != ".vtu") return false;
    static std::mutex mutex;
    static std::optional<std::pair<std::string, bool>> last;  // commands ask several times
    std::error_code error;
    const auto written = std::filesystem::last_write_time(path, error);
    if (error) return false;
    const std::string key = fmt::format("{}\n{}", path.string(), written.time_since_epoch().count());
    const std::scoped_lock lock(mutex);
    if (last && last->first == key) return last->second;
    bool holds = false;
    try {
        const VtkXml xml(path, "UnstructuredGrid");
        try {
            holds = read_voxels(xml, "").has_value();
        } catch (const Error&) {  // of several arrays, none was chosen yet
            holds = read_voxels(xml, std::nullopt).has_value();
        }
    } catch (const Error&) {  // whoever reads the file says what is wrong with it
    }
    last.emplace(key, holds);
    return holds;
}

std::unique_ptr<SectionReader> open_vtu_voxels(const std::filesystem::path& path, const ReadOptions& options) {
    const VtkXml xml(path, "UnstructuredGrid");
    auto grid = read_voxels(xml, "");
    if (!grid) fail(path, "is no regular grid of voxels with labels of its cells; a mesh is reconstructed alone");
    VolumeInfo info = volume_info(path, "vtu", grid->type, checked_size(path, grid->size));
    Placement placement;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        placement.spacing[axis] = grid->planes[axis].spacing;
        placement.origin[axis] = grid->planes[axis].first;
        placement.steps[axis] = 0.5;
    }
    placement.metres = metres_per_unit(xml);
    if (grid->has_holes) placement.warning = "the grid has holes, whose samples have the label 0";
    place(info, placement, options);
    return open_held(std::move(grid->labels), std::move(info), options);
}

}  // namespace regionmesh::formats
