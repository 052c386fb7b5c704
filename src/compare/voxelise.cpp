#include "regionmesh/voxelise.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "mesh/sample_lines.h"

namespace regionmesh {
namespace {

/// Share of the spacing within which a vertex of an oblique model lies on a side of the box.
constexpr double kOnSide = 1e-9;

/// The inverse of the rotation of a lattice: its transpose.
Vec3 into_axes(const std::array<double, 9>& d, Vec3 p) {
    return {d[0] * p.x + d[3] * p.y + d[6] * p.z, d[1] * p.x + d[4] * p.y + d[7] * p.z,
            d[2] * p.x + d[5] * p.y + d[8] * p.z};
}

/// An oblique lattice has its vertices turned into its axes, with the origin at 0.
SampleLines lines_of(const VoxeliseOptions& options) {
    Lattice lattice = options.lattice;
    if (!lattice.is_axis_aligned()) lattice.origin = {};
    return {lattice, options.sweep.axes};
}

}  // namespace

Voxeliser::Voxeliser(const Mesh& mesh, const VoxeliseOptions& options)
    : mesh_(mesh), options_(options), lines_(std::make_shared<SampleLines>(lines_of(options))) {
    for (int n = 0; n < 3; ++n) size_[n] = lines_->size(n);
    const auto& d = options.lattice.direction;
    is_mirrored_ = dot(regionmesh::cross({d[0], d[3], d[6]}, {d[1], d[4], d[7]}), {d[2], d[5], d[8]}) < 0;
    sort_faces();
}

/// In the axes of the sweep: the line of samples along x, sections along z.
Vec3 Voxeliser::place(VertexId v) const {
    const Lattice& lattice = options_.lattice;
    Vec3 p = mesh_.position(v);
    if (!lattice.is_axis_aligned()) {
        p = into_axes(lattice.direction, p - lattice.origin);
        for (int axis = 0; axis < 3; ++axis) {
            const double far = (lattice.size[axis] - 1) * lattice.spacing[axis];
            if (std::abs(p[axis]) < kOnSide * lattice.spacing[axis]) p[axis] = 0;
            if (std::abs(p[axis] - far) < kOnSide * lattice.spacing[axis]) p[axis] = far;
        }
    }
    const auto& axes = options_.sweep.axes;
    return {p[axes[0]], p[axes[1]], p[axes[2]]};
}

bool Voxeliser::is_outside(Label label) const {
    return is_exterior(label) || std::ranges::find(options_.background, label) != options_.background.end();
}

/// Counts faces by the first section at or above their lowest corner, then puts them in that order.
void Voxeliser::sort_faces() {
    const auto first_section = [&](FaceId f) {
        double low = HUGE_VAL;
        for (const VertexId v : mesh_[f].vertices) low = std::min(low, place(v).z);
        const double guess = std::floor(lines_->index_of(2, low));
        // One section early, for rounding: a face below its plane adds no crossing there.
        return static_cast<std::uint32_t>(std::clamp(guess, 0.0, static_cast<double>(size_[2])));
    };
    start_.assign(size_[2] + 2, 0);
    for (std::uint32_t f = 0; f < mesh_.face_end(); ++f)
        if (mesh_.is_alive(FaceId{f})) ++start_[first_section(FaceId{f}) + 1];
    for (std::size_t n = 1; n < start_.size(); ++n) start_[n] += start_[n - 1];
    order_.resize(start_.back());
    std::vector<std::uint32_t> place_of(start_.begin(), start_.end());
    for (std::uint32_t f = 0; f < mesh_.face_end(); ++f)
        if (mesh_.is_alive(FaceId{f})) order_[place_of[first_section(FaceId{f})]++] = f;
}

void Voxeliser::skip_to(std::uint32_t section) {
    section = std::clamp(section, section_, size_[2]);
    active_.insert(active_.end(), order_.begin() + start_[section_], order_.begin() + start_[section]);
    section_ = section;
}

bool Voxeliser::next(std::span<Label> section) {
    if (section_ == size_[2]) return false;
    crossings_.clear();
    active_.insert(active_.end(), order_.begin() + start_[section_], order_.begin() + start_[section_ + 1]);
    const double z = lines_->at(2, section_);
    std::erase_if(active_, [&](std::uint32_t f) {
        const auto& v = mesh_[FaceId{f}].vertices;
        return place(v[0]).z < z && place(v[1]).z < z && place(v[2]).z < z;
    });
    for (const std::uint32_t f : active_) cross(FaceId{f}, section_);
    // No order among equal samples is needed: all of them are passed before the sample is labelled.
    std::ranges::sort(crossings_, {}, &Crossing::sample);
    std::size_t begin = 0;
    for (std::uint32_t row = 0; row < size_[1]; ++row) {
        const std::uint64_t first = std::uint64_t{row} * size_[0];
        std::size_t end = begin;
        while (end < crossings_.size() && crossings_[end].sample < first + size_[0]) ++end;
        label_row(std::span(crossings_).subspan(begin, end - begin), first, section.subspan(first, size_[0]));
        begin = end;
    }
    ++section_;
    return true;
}

/// The rows that the face's cut with the plane of the section may reach.
void Voxeliser::cross(FaceId f, std::uint32_t section) {
    const Face& face = mesh_[f];
    const std::array<Vec3, 3> p{place(face.vertices[0]), place(face.vertices[1]), place(face.vertices[2])};
    const double z = lines_->at(2, section);
    double low = HUGE_VAL, high = -HUGE_VAL;
    for (int n = 0; n < 3; ++n) {
        const Vec3 a = p[n], b = p[(n + 1) % 3];
        if ((a.z < z && b.z < z) || (a.z > z && b.z > z)) continue;
        const double share = a.z == b.z ? 0 : std::clamp((z - a.z) / (b.z - a.z), 0.0, 1.0);
        const double y = a.z == b.z ? std::min(a.y, b.y) : a.y + share * (b.y - a.y);
        low = std::min(low, y);
        high = std::max(high, a.z == b.z ? std::max(a.y, b.y) : y);
    }
    if (low > high) return;
    const auto row_near = [&](double y) { return std::clamp(lines_->index_of(1, y), 0.0, size_[1] - 1.0); };
    // One row more on either side, for rounding; the exact test decides.
    const auto first = static_cast<std::uint32_t>(std::max(std::floor(row_near(low)) - 1, 0.0));
    const auto last = static_cast<std::uint32_t>(std::min(std::ceil(row_near(high)) + 1, size_[1] - 1.0));
    for (std::uint32_t row = first; row <= last; ++row) cross_row(p, face, row, section);
}

void Voxeliser::cross_row(const std::array<Vec3, 3>& p, const Face& face, std::uint32_t row, std::uint32_t section) {
    const auto crossing = lines_->crossing(p, row, section);
    if (!crossing || crossing->first_beyond == size_[0]) return;
    // The normal points from the first label to the second; along it the line leaves the first.
    const int left = crossing->is_ahead == is_mirrored_;
    const Label from = face.labels[left], to = face.labels[1 - left];
    crossings_.push_back({std::uint64_t{row} * size_[0] + crossing->first_beyond, from, to});
}

void Voxeliser::label_row(std::span<const Crossing> crossings, std::uint64_t first, std::span<Label> labels) {
    const Label outside = options_.background.empty() ? kNoRegion : options_.background.front();
    std::vector<std::pair<Label, int>> entered;  // times entered less times left, of regions other than 0
    const auto add = [&](Label label, int times) {
        if (is_outside(label)) return;
        const auto known = std::ranges::find(entered, label, &std::pair<Label, int>::first);
        if (known == entered.end()) return void(entered.emplace_back(label, times));
        if ((known->second += times) == 0) entered.erase(known);
    };
    Label now = outside;
    bool contradicts = false;
    std::size_t next = 0;
    for (std::uint32_t n = 0; n < labels.size(); ++n) {
        const std::size_t before = next;
        for (; next < crossings.size() && crossings[next].sample == first + n; ++next) {
            add(crossings[next].left, -1);
            add(crossings[next].entered, 1);
        }
        if (next != before) {
            contradicts = entered.size() > 1 || (entered.size() == 1 && entered[0].second != 1);
            now = entered.empty() || contradicts ? outside : entered[0].first;
        }
        labels[n] = now;
        contradictions_ += contradicts;
    }
}

double SampleAgreement::dice() const {
    Counts all;
    for (const Counts& region : regions) {
        all.in_sections += region.in_sections;
        all.in_model += region.in_model;
        all.in_both += region.in_both;
    }
    return all.dice();
}

void add_samples(SampleAgreement& counts, LabelTable& labels, const std::vector<Label>& background,
                 std::span<const InputLabel> given, std::span<const Label> found) {
    for (std::size_t n = 0; n < given.size(); ++n) {
        Label label = labels.dense(given[n]);
        if (std::ranges::find(background, label) != background.end()) label = background.front();
        if (counts.regions.size() < labels.size()) counts.regions.resize(labels.size());
        ++counts.regions[label].in_sections;
        if (!is_exterior(found[n])) ++counts.regions[found[n]].in_model;
        if (found[n] == label)
            ++counts.regions[label].in_both;
        else
            ++counts.wrong;
    }
    counts.samples += given.size();
}

SampleAgreement compare_samples(const Mesh& mesh, LabelTable& labels, const std::vector<Label>& background,
                                SectionReader& reader) {
    const VolumeInfo& info = reader.info();
    Voxeliser voxeliser(mesh, {.lattice = info.lattice, .sweep = info.sweep, .background = background});
    const std::size_t samples = std::size_t{reader.section_width()} * reader.section_height();
    std::vector<InputLabel> given(samples);
    std::vector<Label> found(samples);
    SampleAgreement result;
    while (reader.next(given) && voxeliser.next(found)) add_samples(result, labels, background, given, found);
    result.contradictions = voxeliser.contradictions();
    return result;
}

}  // namespace regionmesh
