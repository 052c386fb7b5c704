#include <fmt/core.h>

#include <algorithm>
#include <numeric>

#include "advice.h"
#include "commands.h"
#include "input.h"
#include "printable.h"

namespace regionmesh::cli {
namespace {

/// `unit` is the thing counted for each label: "samples", "points" or "tetrahedra".
template <class AnyCensus>
void print_labels(const AnyCensus& census, const LabelNames& names, const char* unit) {
    std::vector<Label> order;
    for (Label label = 0; label < census.labels.size(); ++label)
        if (label < census.samples.size() && census.samples[label] > 0) order.push_back(label);
    std::sort(order.begin(), order.end(),
              [&](Label a, Label b) { return census.labels.less(census.labels.input(a), census.labels.input(b)); });
    fmt::print("labels     {}\n", order.size());
    constexpr std::size_t kShown = 20;
    for (std::size_t n = 0; n < std::min(order.size(), kShown); ++n) {
        const InputLabel label = census.labels.input(order[n]);
        const auto name = names.find(label);
        fmt::print("  {:>12}  {} {}{}{}\n", census.labels.text(label), census.samples[order[n]], unit,
                   name == names.end() ? "" : "  ", name == names.end() ? "" : printable(name->second));
    }
    if (order.size() > kShown) fmt::print("  and {} more\n", order.size() - kShown);
}

int print_info(TetrahedronReader& reader, const CensusOptions& options) {
    const TetrahedraInfo& info = reader.info();
    const TetrahedronCensus census = count_labels(reader, options);
    fmt::print("file       {} ({})\n", printable(info.source), info.format);
    fmt::print("size       {} points, {} tetrahedra\n", census.point_count, census.tetrahedron_count);
    fmt::print("spacing    {:.6g} (mean){}\n", census.spacing, info.scale_z == 1 ? "" : ", z scaled");
    fmt::print("sweep      along {}\n", "xyz"[census.sweep.axes[2]]);
    print_labels(census, info.names, info.has_cell_labels ? "tetrahedra" : "points");
    fmt::print("model      {} faces unsimplified; {} pairs of regions with an interface\n", census.face_count,
               census.oracle.region_pairs);
    return kGood;
}

int print_info(SectionReader& reader, const CensusOptions& options) {
    const VolumeInfo info = reader.info();
    const Lattice& lattice = info.lattice;
    const Census census = count_labels(reader, options);
    fmt::print("file       {} ({})\n", printable(info.source), info.format);
    fmt::print("size       {} x {} x {} samples of {}\n", lattice.size[0], lattice.size[1], lattice.size[2],
               to_string(info.type));
    fmt::print("spacing    {} x {} x {}\n", lattice.spacing.x, lattice.spacing.y, lattice.spacing.z);
    fmt::print("origin     {}, {}, {}\n", lattice.origin.x, lattice.origin.y, lattice.origin.z);
    if (!lattice.is_axis_aligned()) {
        auto d = lattice.direction;
        for (double& part : d) part += 0.0;  // not -0
        fmt::print("direction  [{:g} {:g} {:g}] [{:g} {:g} {:g}] [{:g} {:g} {:g}]\n", d[0], d[1], d[2], d[3], d[4],
                   d[5], d[6], d[7], d[8]);
    }
    const char axis = std::string("xyz")[info.sweep.axes[2]];
    fmt::print("sweep      along {}, {} sections of {} x {}\n", axis, reader.section_count(), reader.section_width(),
               reader.section_height());
    print_labels(census, info.names, "samples");
    const auto megabytes = [&](std::uint64_t faces) { return static_cast<double>(expected_bytes(info, faces)) / 1e6; };
    fmt::print("model      {} faces unsimplified; {} pairs of regions with an interface\n", census.face_count,
               census.oracle.region_pairs);
    fmt::print("memory     {:.0f} MB to hold the whole model; {:.0f} MB with a budget of a fifth of it\n",
               megabytes(census.face_count), megabytes(census.face_count / 5));
    return kGood;
}

}  // namespace

int run_info(const Settings& settings) {
    return with_reader(settings, settings.inputs, [&](auto& reader) {
        const int code = print_info(reader, census_options(settings));
        warn_of_grey_scale(settings, reader);
        return code;
    });
}

}  // namespace regionmesh::cli
