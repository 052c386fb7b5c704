#include "regionmesh/voxelise.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "base/parallel_for.h"
#include "base/parallel_invoke.h"
#include "mesh/sample_lines.h"
#include "regionmesh/limits.h"

namespace regionmesh {
namespace {

/// Share of the spacing within which a vertex of an oblique model lies on a side of the box.
constexpr double kOnSide = 1e-9;

/// Share of a coordinate that is lost when it is rounded a few times.
constexpr double kRounding = 64 * std::numeric_limits<double>::epsilon();

/// The same where a coordinate is stored in single precision.
constexpr double kSingleRounding = std::numeric_limits<float>::epsilon() / 2;

/// The same for several roundings: of the lattice, and of what a program computed from it.
constexpr double kRoundings = 4;

/// Share of the spacing by which a vertex is moved at most by these, and by one rounding in a turned lattice. In a
/// lattice along the axes a coordinate that was rounded once is known, however far it is.
constexpr double kMostMoved = 1e-3, kMostMovedInTurned = 0.25;

/// Room for rounding, in samples: positions of crossings and of samples are rounded a few times.
double doubt(double coordinate, double spacing) {
    constexpr double kLeast = 1e-6;
    return kLeast + kRounding * std::abs(coordinate) / spacing;
}

/// An oblique lattice has its vertices turned into its axes, with the origin at 0.
SampleLines lines_of(const VoxeliseOptions& options) {
    Lattice lattice = options.lattice;
    if (!lattice.is_axis_aligned()) lattice.origin = {};
    return {lattice, options.sweep.axes};
}

/// Are all coordinates numbers of single precision, as in a file that has no others?
bool is_single(const Mesh& mesh) {
    for (std::uint32_t v = 0; v < mesh.vertex_end(); ++v) {
        if (!mesh.is_alive(VertexId{v})) continue;
        const Vec3 p = mesh.position(VertexId{v});
        for (int axis = 0; axis < 3; ++axis)
            if (static_cast<float>(p[axis]) != p[axis]) return false;
    }
    return true;
}

}  // namespace

Voxeliser::Voxeliser(const Mesh& mesh, const VoxeliseOptions& options, std::uint32_t threads)
    : mesh_(mesh), options_(options), into_axes_(options.lattice) {
    require_lattice("lattice", options.lattice);
    require_sweep("lattice", options.sweep);
    const auto lines = std::make_shared<SampleLines>(lines_of(options));
    lines_ = lines;
    for (int n = 0; n < 3; ++n) size_[n] = lines_->size(n);
    is_turned_ = !options.lattice.is_axis_aligned();
    rounding_ = is_single(mesh) ? kSingleRounding : is_turned_ ? kRounding : 0;
    is_mirrored_ = options.lattice.axes_volume() < 0;
    find_sides(*lines);
    find_sections(threads);
    sort_faces();
}

void Voxeliser::find_sides(SampleLines& lines) {
    const auto box_of = [&](auto&& position) {
        Box box;
        for (std::uint32_t v = 0; v < mesh_.vertex_end(); ++v)
            if (mesh_.is_alive(VertexId{v})) box.add(position(VertexId{v}));
        return box;
    };
    Box box = box_of([&](VertexId v) { return in_lines(v); });
    if (box.low.x > box.high.x) return;
    const Vec3 origin = in_sweep(options_.lattice.origin);
    for (int axis = 0; axis < 3; ++axis)
        for (int end = 0; end < 2; ++end) {
            const double coordinate = end == 0 ? box.low[axis] : box.high[axis];
            const double n = std::clamp(std::round(lines.index_of(axis, coordinate)), 0.0, size_[axis] - 1.0);
            const double side = sides_[axis][end] = lines.at(axis, static_cast<std::uint32_t>(n));
            // A lattice that is not the model's has samples there whose coordinates were rounded in another way.
            const double near =
                kOnSide * lines.spacing(axis) + kRounding * (std::abs(coordinate) + std::abs(origin[axis]));
            if (side != coordinate && std::abs(side - coordinate) < near) rounding_ = std::max(rounding_, kRounding);
        }
    if (rounding_ != 0) box = box_of([&](VertexId v) { return place(v); });
    for (int axis = 0; axis < 3; ++axis) lines.turn_back_at(axis, box.high[axis]);
}

/// Axes of the sweep: the line of samples along x, sections along z.
Vec3 Voxeliser::in_sweep(Vec3 p) const {
    const auto& axes = options_.sweep.axes;
    return {p[axes[0]], p[axes[1]], p[axes[2]]};
}

Vec3 Voxeliser::in_lines(VertexId v) const {
    return in_sweep(is_turned_ ? into_axes_(mesh_.position(v)) : mesh_.position(v));
}

/// The same, with coordinates at the ends of the model that were rounded put back.
Vec3 Voxeliser::place(VertexId v) const {
    Vec3 p = in_lines(v);
    if (rounding_ == 0) return p;
    const Vec3 lost = rounding_ * in_sweep(into_axes_.magnitude(mesh_.position(v)));
    for (int axis = 0; axis < 3; ++axis) {
        const double spacing = lines_->spacing(axis);
        const double once = is_turned_ ? std::min(lost[axis], kMostMovedInTurned * spacing) : 0;
        const double near = kOnSide * spacing + std::max(once, std::min(kRoundings * lost[axis], kMostMoved * spacing));
        for (const double side : sides_[axis])
            if (std::abs(p[axis] - side) < near || (!is_turned_ && p[axis] == static_cast<float>(side))) p[axis] = side;
    }
    return p;
}

bool Voxeliser::is_outside(Label label) const {
    return is_exterior(label) || std::ranges::find(options_.background, label) != options_.background.end();
}

/// size(axis) where all samples lie below.
std::uint32_t Voxeliser::first_at_or_above(int axis, double low) const {
    const double at = std::ceil(lines_->index_of(axis, low) - doubt(low, lines_->spacing(axis)));
    return static_cast<std::uint32_t>(std::clamp(at, 0.0, static_cast<double>(size_[axis])));
}

/// One more than the number of the last sample.
std::uint32_t Voxeliser::end_at_or_below(int axis, double high) const {
    const double at = std::floor(lines_->index_of(axis, high) + doubt(high, lines_->spacing(axis))) + 1;
    return static_cast<std::uint32_t>(std::clamp(at, 0.0, static_cast<double>(size_[axis])));
}

void Voxeliser::find_sections(std::uint32_t threads) {
    constexpr std::uint32_t kVertices = 4096;  // vertices of a task
    sections_of_.resize(mesh_.vertex_end());
    for_each_index(mesh_.vertex_end(), kVertices, threads, [&](std::uint32_t v) {
        if (!mesh_.is_alive(VertexId{v})) return;
        const double z = place(VertexId{v}).z;
        sections_of_[v] = {first_at_or_above(2, z), end_at_or_below(2, z)};
    });
}

/// Sections that the face may reach.
Voxeliser::Sections Voxeliser::sections_of(FaceId f) const {
    const auto& [a, b, c] = mesh_[f].vertices;
    const Sections &at_a = sections_of_[index(a)], &at_b = sections_of_[index(b)], &at_c = sections_of_[index(c)];
    return {std::min({at_a.first, at_b.first, at_c.first}), std::max({at_a.end, at_b.end, at_c.end})};
}

/// Counts faces by the first section that they may reach, then puts them in that order. Many lie between two sections.
void Voxeliser::sort_faces() {
    const auto for_faces = [&](auto&& visit) {
        for (std::uint32_t f = 0; f < mesh_.face_end(); ++f) {
            if (!mesh_.is_alive(FaceId{f})) continue;
            const Sections sections = sections_of(FaceId{f});
            if (sections.first < sections.end) visit(FaceId{f}, sections.first);
        }
    };
    start_.assign(size_[2] + 1, 0);
    for_faces([&](FaceId, std::uint32_t first) { ++start_[first + 1]; });
    for (std::size_t n = 1; n < start_.size(); ++n) start_[n] += start_[n - 1];
    order_.resize(start_.back());
    std::vector<std::uint32_t> place_of(start_.begin(), start_.end());
    for_faces([&](FaceId f, std::uint32_t first) { order_[place_of[first]++] = f; });
}

/// Adds the faces that begin at sections from `begin` to before `end`, and keeps those that may reach `first` or
/// beyond.
void Voxeliser::activate(std::uint32_t first, std::uint32_t begin, std::uint32_t end) {
    std::erase_if(active_, [&](const ActiveFace& active) { return active.sections.end <= first; });
    for (std::uint32_t n = start_[begin]; n < start_[end]; ++n) {
        const Sections sections = sections_of(order_[n]);
        if (sections.end > first) active_.push_back({order_[n], sections});
    }
}

void Voxeliser::skip_to(std::uint32_t section) {
    section = std::clamp(section, section_, size_[2]);
    activate(section, section_, section);
    section_ = section;
}

bool Voxeliser::next(std::span<Label> section) { return next(std::span(&section, 1), 1) == 1; }

std::uint32_t Voxeliser::next(std::span<const std::span<Label>> sections, std::uint32_t threads) {
    const auto count = static_cast<std::uint32_t>(std::min<std::size_t>(sections.size(), size_[2] - section_));
    if (count == 0) return 0;
    for (const std::span<Label> section : sections.first(count))
        require_section_size("Voxeliser", section.size(), size_[0], size_[1]);
    activate(section_, section_, section_ + count);
    scratch_.resize(std::max<std::size_t>(scratch_.size(), count));
    parallel_for(count, threads, [&](std::uint32_t n) { label_section(section_ + n, sections[n], scratch_[n]); });
    section_ += count;
    for (std::uint32_t n = 0; n < count; ++n) contradictions_ += scratch_[n].contradictions;
    return count;
}

void Voxeliser::label_section(std::uint32_t section, std::span<Label> labels, Scratch& scratch) const {
    auto& crossings = scratch.crossings;
    crossings.clear();
    scratch.contradictions = 0;
    for (const auto& [face, sections] : active_)
        if (sections.first <= section && section < sections.end) cross(face, section, crossings);
    // No order among equal samples is needed: all of them are passed before the sample is labelled.
    std::ranges::sort(crossings, {}, &Crossing::sample);
    std::size_t begin = 0;
    for (std::uint32_t row = 0; row < size_[1]; ++row) {
        const std::uint64_t first = first_of(row);
        std::size_t end = begin;
        while (end < crossings.size() && crossings[end].sample < first_of(row + 1)) ++end;
        label_row(std::span(crossings).subspan(begin, end - begin), first,
                  labels.subspan(std::size_t{row} * size_[0], size_[0]), scratch);
        begin = end;
    }
}

/// Tries the rows that the face's cut with the plane of the section may reach; the exact test decides.
void Voxeliser::cross(FaceId f, std::uint32_t section, std::vector<Crossing>& crossings) const {
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
    const std::uint32_t end = end_at_or_below(1, high);
    for (std::uint32_t row = first_at_or_above(1, low); row < end; ++row) {
        const auto crossing = lines_->crossing(p, row, section);
        if (!crossing) continue;
        // The normal points from the first label to the second; along it the line leaves the first.
        const int left = crossing->is_ahead == is_mirrored_;
        crossings.push_back({first_of(row) + crossing->first_beyond, face.labels[left], face.labels[1 - left]});
    }
}

void Voxeliser::label_row(std::span<const Crossing> crossings, std::uint64_t first, std::span<Label> labels,
                          Scratch& scratch) const {
    const Label outside = options_.background.empty() ? kNoRegion : options_.background.front();
    auto& entered = scratch.entered;
    entered.clear();
    const auto add = [&](Label label, int times) {
        if (is_outside(label)) return;
        const auto known = std::ranges::find(entered, label, &std::pair<Label, int>::first);
        if (known == entered.end()) return void(entered.emplace_back(label, times));
        if ((known->second += times) == 0) entered.erase(known);
    };
    Label now = outside;
    bool contradicts = false;
    std::size_t begin = 0, end = 0;  // range of the samples since the last crossing
    const auto label_up_to = [&](std::size_t sample) {
        begin = std::exchange(end, sample);
        std::fill(labels.begin() + begin, labels.begin() + end, now);
        scratch.contradictions += contradicts ? end - begin : 0;
    };
    for (std::size_t next = 0; next < crossings.size();) {
        const std::uint64_t sample = crossings[next].sample;
        label_up_to(sample - first);
        for (; next < crossings.size() && crossings[next].sample == sample; ++next) {
            add(crossings[next].left, -1);
            add(crossings[next].entered, 1);
        }
        if (end == labels.size()) break;
        contradicts = entered.size() > 1 || (entered.size() == 1 && entered[0].second != 1);
        now = entered.empty() || contradicts ? outside : entered[0].first;
    }
    if (end < labels.size()) label_up_to(labels.size());
    // Beyond the last sample the line has to leave what it has entered.
    if (contradicts || entered.empty()) return;
    std::fill(labels.begin() + begin, labels.end(), outside);
    scratch.contradictions += end - begin;
}

double SampleAgreement::dice() const {
    Counts all;
    for (Label label = 0; label < regions.size(); ++label)
        if (label != background) all += regions[label];
    return all.dice();
}

namespace {

/// Counts runs of samples with one label in both.
void count_runs(SampleAgreement& counts, const std::vector<Label>& background, std::span<const Label> given,
                std::span<const Label> found) {
    for (std::size_t n = 0; n < given.size();) {
        const std::size_t first = n;
        while (n < given.size() && given[n] == given[first] && found[n] == found[first]) ++n;
        const std::size_t run = n - first;
        const bool is_background = std::ranges::find(background, given[first]) != background.end();
        const Label in_section = is_background ? background.front() : given[first], in_model = found[first];
        counts.regions[in_section].in_sections += run;
        if (!is_exterior(in_model)) counts.regions[in_model].in_model += run;
        (in_model == in_section ? counts.regions[in_section].in_both : counts.wrong) += run;
    }
    counts.samples += given.size();
    if (!background.empty()) counts.background = background.front();
}

void add(SampleAgreement& sum, const SampleAgreement& part) {
    sum.samples += part.samples;
    sum.wrong += part.wrong;
    if (part.background) sum.background = part.background;
    sum.regions.resize(std::max(sum.regions.size(), part.regions.size()));
    for (std::size_t n = 0; n < part.regions.size(); ++n) sum.regions[n] += part.regions[n];
}

}  // namespace

void add_samples(SampleAgreement& counts, LabelTable& labels, const std::vector<Label>& background,
                 std::span<const InputLabel> given, std::span<const Label> found) {
    std::vector<Label> dense(given.size());
    labels.dense(given, dense);
    counts.regions.resize(std::max<std::size_t>(counts.regions.size(), labels.size()));
    count_runs(counts, background, dense, found);
}

SampleAgreement compare_samples(const Mesh& mesh, LabelTable& labels, const std::vector<Label>& background,
                                SectionReader& reader, std::uint32_t threads) {
    constexpr std::uint32_t kMostSections = 4;  // sections of a wave; it is read while the one before is compared
    const VolumeInfo& info = reader.info();
    if (info.can_rewind) reader.rewind();
    Voxeliser voxeliser(mesh, {.lattice = info.lattice, .sweep = info.sweep, .background = background}, threads);
    const std::uint32_t most = threads == 0 ? kMostSections : 2 * std::min(threads, kMostSections / 2);
    const std::size_t samples = std::size_t{reader.section_width()} * reader.section_height();
    const auto room = [&] { return std::vector<std::vector<Label>>(most, std::vector<Label>(samples)); };
    std::vector<std::vector<Label>> given = room(), ahead = room(), in_model = room();
    std::vector<InputLabel> input(samples);
    std::uint32_t read = 0, all = 0;  // sections ahead, and up to them
    const auto read_ahead = [&] {
        for (read = 0; read < most && all < reader.section_count(); ++read, ++all) {
            require_section(reader.next(input), info, all);
            labels.dense(input, ahead[read]);
        }
    };
    std::vector<SampleAgreement> agreements(most);  // sums of all sections with the same index in their wave
    read_ahead();
    while (read > 0) {
        std::swap(given, ahead);
        const auto compare = [&, count = read, regions = labels.size()] {  // reading may add labels
            const std::vector<std::span<Label>> found(in_model.begin(), in_model.begin() + count);
            parallel_for(voxeliser.next(found, threads), threads, [&](std::uint32_t n) {
                agreements[n].regions.resize(regions);
                count_runs(agreements[n], background, given[n], found[n]);
            });
        };
        parallel_invoke(threads, compare, read_ahead);
    }
    SampleAgreement result;
    for (const SampleAgreement& agreement : agreements) add(result, agreement);
    result.contradictions = voxeliser.contradictions();
    return result;
}

}  // namespace regionmesh
