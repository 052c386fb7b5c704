#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/add_warning.h"
#include "formats/array/layered_sections.h"
#include "formats/array/numbered_sections.h"
#include "formats/array/volume_size.h"
#include "formats/contours/contours.h"
#include "formats/input_file.h"

namespace regionmesh::formats {
namespace {

namespace fs = std::filesystem;

constexpr double kFinestShare = 1.0 / 1024, kCoarsestShare = 1.0 / 64;  // of the longer side of all contours: pitch
constexpr double kMostUneven = 0.01;                                    // of a distance of sections
constexpr double kSameSection = 1e-6;                                   // of the height of all sections
constexpr double kMostSections = 100000;

/// Contours of one section, in the order of the file.
struct ContourSection {
    double z = 0;
    std::vector<std::uint32_t> contours;
};

std::vector<ContourSection> sections_of(const std::vector<Contour>& contours) {
    std::vector<std::uint32_t> order(contours.size());
    for (std::uint32_t n = 0; n < order.size(); ++n) order[n] = n;
    std::ranges::stable_sort(order, {}, [&](std::uint32_t n) { return contours[n].z; });
    const double height = contours[order.back()].z - contours[order.front()].z;
    std::vector<ContourSection> sections;
    for (const std::uint32_t n : order) {
        if (sections.empty() || contours[n].z - sections.back().z > kSameSection * height)
            sections.push_back({contours[n].z, {}});
        sections.back().contours.push_back(n);
    }
    for (ContourSection& section : sections) std::ranges::sort(section.contours);
    return sections;
}

/// The median distance of successive points, bounded by shares of the longer side.
double usual_pitch(const std::vector<Contour>& contours, double side) {
    std::vector<double> edges;
    for (const Contour& contour : contours)
        for (std::size_t n = 0; n < contour.points.size(); ++n) {
            const auto &a = contour.points[n], &b = contour.points[(n + 1) % contour.points.size()];
            if (a != b) edges.push_back(std::hypot(b[0] - a[0], b[1] - a[1]));
        }
    if (edges.empty()) return side * kFinestShare;
    const auto middle = edges.begin() + static_cast<std::ptrdiff_t>(edges.size() / 2);
    std::ranges::nth_element(edges, middle);
    return std::clamp(*middle, side * kFinestShare, side * kCoarsestShare);
}

/// The distance of the sections of the lattice; sets a warning where those of the file are not as far apart.
double section_distance(const std::vector<ContourSection>& sections, double pitch, std::string& warning) {
    if (sections.size() == 1) return pitch;
    std::vector<double> gaps;
    for (std::size_t n = 1; n < sections.size(); ++n) gaps.push_back(sections[n].z - sections[n - 1].z);
    const double least = std::ranges::min(gaps), most = std::ranges::max(gaps);
    if (most - least <= kMostUneven * least)
        return (sections.back().z - sections.front().z) / static_cast<double>(gaps.size());
    add_warning(warning, fmt::format("its sections are {:.6g} to {:.6g} apart: they are read at {:.6g}, each as the "
                                     "nearest of the file is",
                                     least, most, least));
    return least;
}

class ContourSections final : public NumberedSections {
public:
    ContourSections(VolumeInfo info, ContourSet set, std::vector<ContourSection> sections,
                    std::vector<std::uint32_t> ranks, std::shared_ptr<Overlaps> overlaps)
        : NumberedSections(std::move(info)),
          set_(std::move(set)),
          sections_(std::move(sections)),
          ranks_(std::move(ranks)),
          by_rank_(set_.labels.size()),
          overlaps_(std::move(overlaps)) {
        for (std::size_t n = 0; n < ranks_.size(); ++n) by_rank_[ranks_[n] - 1] = set_.labels[n];
    }

private:
    void read_section(std::uint32_t number, std::span<InputLabel> section) override {
        if (number == 0) counted_.samples.clear();
        std::ranges::fill(section, 0);
        // The first and the last are the margin.
        if (number == 0 || number + 1 == section_count()) return;
        owners_.assign(section.size(), 0);
        const ContourSection& nearest = nearest_to(info_.lattice.origin.z + number * info_.lattice.spacing.z);
        for (std::uint32_t region = 0; region < set_.labels.size(); ++region) {
            rows_.assign(section_height(), {});
            bool is_there = false;
            for (const std::uint32_t n : nearest.contours)
                if (set_.contours[n].region == region) {
                    add_crossings(set_.contours[n]);
                    is_there = true;
                }
            if (is_there) fill(ranks_[region]);
        }
        for (std::size_t i = 0; i < section.size(); ++i) section[i] = owners_[i] == 0 ? 0 : by_rank_[owners_[i] - 1];
        if (counted_.total() > overlaps_->total()) *overlaps_ = counted_;
    }

    const ContourSection& nearest_to(double z) const {
        auto after = std::ranges::lower_bound(sections_, z, {}, &ContourSection::z);
        if (after == sections_.end()) return sections_.back();
        if (after == sections_.begin()) return *after;
        const auto before = std::prev(after);
        return after->z - z < z - before->z ? *after : *before;
    }

    /// Where the edges cross the rows of samples. An edge has its lower end, and not its upper one.
    void add_crossings(const Contour& contour) {
        const Lattice& lattice = info_.lattice;
        for (std::size_t n = 0; n < contour.points.size(); ++n) {
            auto a = contour.points[n], b = contour.points[(n + 1) % contour.points.size()];
            if (a[1] > b[1]) std::swap(a, b);
            const auto first = row_of(a[1]), end = row_of(b[1]);
            for (std::uint32_t row = first; row < end; ++row) {
                const double y = lattice.origin.y + row * lattice.spacing.y;
                const double x = a[0] + (b[0] - a[0]) * ((y - a[1]) / (b[1] - a[1]));
                rows_[row].push_back(std::clamp(x, std::min(a[0], b[0]), std::max(a[0], b[0])));
            }
        }
    }

    /// The first row of samples at y or above.
    std::uint32_t row_of(double y) const {
        const Lattice& lattice = info_.lattice;
        const double row = std::ceil((y - lattice.origin.y) / lattice.spacing.y);
        return static_cast<std::uint32_t>(std::clamp(row, 0.0, static_cast<double>(section_height())));
    }

    void fill(std::uint32_t rank) {
        const std::uint32_t width = section_width();
        const auto column_of = [&](double x) {
            const double column = std::ceil((x - info_.lattice.origin.x) / info_.lattice.spacing.x);
            return static_cast<std::uint32_t>(std::clamp(column, 0.0, static_cast<double>(width)));
        };
        for (std::size_t row = 0; row < rows_.size(); ++row) {
            std::vector<double>& crossings = rows_[row];
            std::ranges::sort(crossings);
            for (std::size_t n = 0; n + 1 < crossings.size(); n += 2)
                for (std::uint32_t column = column_of(crossings[n]); column < column_of(crossings[n + 1]); ++column) {
                    std::uint32_t& owner = owners_[row * width + column];
                    if (owner != 0) ++counted_.samples[std::minmax(by_rank_[owner - 1], by_rank_[rank - 1])];
                    owner = std::max(owner, rank);
                }
        }
    }

    ContourSet set_;
    std::vector<ContourSection> sections_;
    std::vector<std::uint32_t> ranks_;
    std::vector<InputLabel> by_rank_;
    std::shared_ptr<Overlaps> overlaps_;
    Overlaps counted_;                       // in this pass
    std::vector<std::uint32_t> owners_;      // ranks of the regions of samples of a section; 0: none
    std::vector<std::vector<double>> rows_;  // of one region: x where its contours cross each row
};

}  // namespace

std::unique_ptr<SectionReader> contour_sections(const fs::path& path, ContourSet set, const ReadOptions& options) {
    if (options.spacing) fail(path, "--spacing is for samples, and these are contours; give --pitch");
    std::erase_if(set.contours, [](const Contour& contour) { return contour.points.size() < 3; });
    if (set.contours.empty()) fail(path, "holds no contour of three points or more; check the file");
    Vec3 low{INFINITY, INFINITY, 0}, high{-INFINITY, -INFINITY, 0};
    std::uint64_t points = 0;
    for (const Contour& contour : set.contours)
        for (const auto& point : contour.points) {
            low = {std::min(low.x, point[0]), std::min(low.y, point[1]), 0};
            high = {std::max(high.x, point[0]), std::max(high.y, point[1]), 0};
            ++points;
        }
    const double side = std::max(high.x - low.x, high.y - low.y);
    if (!(side > 0) || !std::isfinite(side)) fail(path, "its contours enclose no area; check the coordinates");
    const std::vector<ContourSection> sections = sections_of(set.contours);
    std::string warning;
    const double pitch = options.pitch.value_or(usual_pitch(set.contours, side));
    const double step = section_distance(sections, pitch, warning);
    const double count = std::round((sections.back().z - sections.front().z) / step) + 3;
    if (!(count <= kMostSections))
        fail(path, fmt::format("its sections are {:.3g} apart and reach over {:.3g}, which would be more than 100,000; "
                               "mend the z of the nearest two",
                               step, sections.back().z - sections.front().z));
    const auto samples = [&](double length) {
        const double all = std::ceil(length / pitch) + 2;
        if (!(all < static_cast<double>(kMaxAxisSamples)))
            fail(path,
                 fmt::format("--pitch {:.3g} is too fine for {:.3g} along an axis; give a larger one", pitch, length));
        return static_cast<std::uint64_t>(all);
    };
    const auto size =
        checked_size(path, {samples(high.x - low.x), samples(high.y - low.y), static_cast<std::uint64_t>(count)});
    VolumeInfo info = volume_info(path, "contours", label_type_of(set.labels), size);
    info.lattice.spacing = {pitch, pitch, step};
    const auto first = [&](int axis) { return (low[axis] + high[axis] - (size[axis] - 1.0) * pitch) / 2; };
    info.lattice.origin = {first(0), first(1), sections.front().z - step};
    info.metres = set.metres;
    info.names = set.names;
    info.warning = warning;
    apply_options(info, options, "give --sweep z");
    const std::uint64_t section = std::uint64_t{size[0]} * size[1];
    info.held_bytes = section * (sizeof(InputLabel) + sizeof(std::uint32_t)) + points * sizeof(Contour::points[0]);
    const auto overlaps = std::make_shared<Overlaps>();
    info.overlaps = overlaps;
    std::vector<std::uint32_t> ranks = ranks_of(info, set.labels, options.priority);
    return std::make_unique<ContourSections>(std::move(info), std::move(set), sections, std::move(ranks), overlaps);
}

}  // namespace regionmesh::formats
