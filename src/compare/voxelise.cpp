#include "regionmesh/voxelise.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "base/exact_predicates.h"

namespace regionmesh {
namespace {

/// Share of the spacing within which a vertex of an oblique model lies on a side of the box.
constexpr double kOnSide = 1e-9;

int sign(double x) { return (x > 0) - (x < 0); }

struct Point2 {
    double x, y;
};

/// Sign of the area of a, b, c: +1 counter-clockwise. Exact.
int orientation(Point2 a, Point2 b, Point2 c) {
    const double left = (a.x - c.x) * (b.y - c.y), right = (a.y - c.y) * (b.x - c.x), area = left - right;
    const double bound = 3.3306690738754716e-16 * (std::abs(left) + std::abs(right));  // Shewchuk (1997), orient2d A
    if (area > bound || -area > bound) return sign(area);
    return exact_orientation({a.x, a.y, 0}, {b.x, b.y, 0}, {c.x, c.y, 0}, {c.x, c.y, 1});
}

/// The same with c moved by (nudge.x e, nudge.y e^2); 0 only where a is b.
int orientation(Point2 a, Point2 b, Point2 c, Point2 nudge) {
    if (const int plain = orientation(a, b, c)) return plain;
    if (const int first = sign(a.y - b.y) * sign(nudge.x)) return first;
    return sign(b.x - a.x) * sign(nudge.y);
}

/// Signs of the normal of a triangle, exact.
std::array<int, 3> normal_signs(const std::array<Vec3, 3>& p) {
    const auto side = [&](int u, int v) {
        return orientation(Point2{p[0][u], p[0][v]}, Point2{p[1][u], p[1][v]}, Point2{p[2][u], p[2][v]});
    };
    return {side(1, 2), side(2, 0), side(0, 1)};
}

/// The inverse of the rotation of a lattice: its transpose.
Vec3 into_axes(const std::array<double, 9>& d, Vec3 p) {
    return {d[0] * p.x + d[3] * p.y + d[6] * p.z, d[1] * p.x + d[4] * p.y + d[7] * p.z,
            d[2] * p.x + d[5] * p.y + d[8] * p.z};
}

}  // namespace

Voxeliser::Voxeliser(const Mesh& mesh, const VoxeliseOptions& options) : mesh_(mesh), options_(options) {
    for (int n = 0; n < 3; ++n) size_[n] = options.lattice.size[options.sweep.axes[n]];
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

/// Where the mesher puts node n (strip_mesher.cpp): the same rounding.
double Voxeliser::sample_at(int axis, std::uint32_t n) const {
    const Lattice& lattice = options_.lattice;
    const int own = options_.sweep.axes[axis];
    return (lattice.is_axis_aligned() ? lattice.origin[own] : 0) + n * lattice.spacing[own];
}

double Voxeliser::inward(int axis, std::uint32_t n) const { return n + 1 == size_[axis] ? -1 : 1; }

bool Voxeliser::is_outside(Label label) const {
    return is_exterior(label) || std::ranges::find(options_.background, label) != options_.background.end();
}

/// Counts faces by the first section at or above their lowest corner, then puts them in that order.
void Voxeliser::sort_faces() {
    const auto first_section = [&](FaceId f) {
        double low = HUGE_VAL;
        for (const VertexId v : mesh_[f].vertices) low = std::min(low, place(v).z);
        const double guess = std::floor((low - sample_at(2, 0)) / options_.lattice.spacing[options_.sweep.axes[2]]);
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

bool Voxeliser::next(std::span<Label> section) {
    if (section_ == size_[2]) return false;
    crossings_.clear();
    active_.insert(active_.end(), order_.begin() + start_[section_], order_.begin() + start_[section_ + 1]);
    const double z = sample_at(2, section_);
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
    const double z = sample_at(2, section);
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
    const double spacing = options_.lattice.spacing[options_.sweep.axes[1]], origin = sample_at(1, 0);
    const auto row_near = [&](double y) { return std::clamp((y - origin) / spacing, 0.0, size_[1] - 1.0); };
    // One row more on either side, for rounding; the exact test decides.
    const auto first = static_cast<std::uint32_t>(std::max(std::floor(row_near(low)) - 1, 0.0));
    const auto last = static_cast<std::uint32_t>(std::min(std::ceil(row_near(high)) + 1, size_[1] - 1.0));
    for (std::uint32_t row = first; row <= last; ++row) cross_row(p, face, row, section);
}

void Voxeliser::cross_row(const std::array<Vec3, 3>& p, const Face& face, std::uint32_t row, std::uint32_t section) {
    const Point2 q{sample_at(1, row), sample_at(2, section)}, nudge{inward(1, row), inward(2, section)};
    const auto side = [&](int n) {
        const Vec3 a = p[n], b = p[(n + 1) % 3];
        return orientation({a.y, a.z}, {b.y, b.z}, q, nudge);
    };
    const int turn = side(0);
    if (turn == 0 || side(1) != turn || side(2) != turn) return;
    const std::uint32_t beyond = first_beyond(p, turn > 0, {0, q.x, q.y}, {0, nudge.x, nudge.y});
    if (beyond == size_[0]) return;
    // The normal points from the first label to the second; along it the line leaves the first.
    const int left = (turn > 0) == is_mirrored_;
    const Label from = face.labels[left], to = face.labels[1 - left];
    crossings_.push_back({std::uint64_t{row} * size_[0] + beyond, from, to});
}

/// The first sample of the line beyond the face. `ahead`: the face's normal points along the line.
std::uint32_t Voxeliser::first_beyond(const std::array<Vec3, 3>& p, bool ahead, Vec3 line, Vec3 nudge) const {
    const auto is_beyond = [&](std::uint32_t n) {
        const int side = regionmesh::orientation(p[0], p[1], p[2], {sample_at(0, n), line.y, line.z});
        if (side != 0) return (side > 0) == ahead;
        const std::array<int, 3> normal = normal_signs(p);
        for (const int moved : {normal[1] * sign(nudge.y), normal[2] * sign(nudge.z), normal[0] * sign(inward(0, n))})
            if (moved != 0) return (moved > 0) == ahead;
        return false;
    };
    const Vec3 normal = regionmesh::cross(p[1] - p[0], p[2] - p[0]);
    const double x = p[0].x - (normal.y * (line.y - p[0].y) + normal.z * (line.z - p[0].z)) / normal.x;
    const double guess = std::ceil((x - sample_at(0, 0)) / options_.lattice.spacing[options_.sweep.axes[0]]);
    auto n = static_cast<std::uint32_t>(std::isnan(guess) ? 0 : std::clamp(guess, 0.0, static_cast<double>(size_[0])));
    while (n > 0 && is_beyond(n - 1)) --n;
    while (n < size_[0] && !is_beyond(n)) ++n;
    return n;
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

SampleAgreement compare_samples(const Mesh& mesh, LabelTable& labels, const std::vector<Label>& background,
                                SectionReader& reader) {
    const VolumeInfo& info = reader.info();
    Voxeliser voxeliser(mesh, {.lattice = info.lattice, .sweep = info.sweep, .background = background});
    const std::size_t samples = std::size_t{reader.section_width()} * reader.section_height();
    std::vector<InputLabel> given(samples);
    std::vector<Label> found(samples);
    SampleAgreement result;
    while (reader.next(given) && voxeliser.next(found)) {
        for (std::size_t n = 0; n < samples; ++n) {
            Label label = labels.dense(given[n]);
            if (std::ranges::find(background, label) != background.end()) label = background.front();
            if (result.regions.size() < labels.size()) result.regions.resize(labels.size());
            ++result.regions[label].in_sections;
            if (!is_exterior(found[n])) ++result.regions[found[n]].in_model;
            if (found[n] == label)
                ++result.regions[label].in_both;
            else
                ++result.wrong;
        }
        result.samples += samples;
    }
    result.contradictions = voxeliser.contradictions();
    return result;
}

}  // namespace regionmesh
