#include "model.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>
#include <numeric>
#include <utility>

#include "regionmesh/blocks.h"
#include "regionmesh/census.h"
#include "regionmesh/change_model.h"
#include "regionmesh/check.h"
#include "regionmesh/compare.h"
#include "regionmesh/error.h"
#include "regionmesh/limits.h"
#include "regionmesh/mesh_arrays.h"
#include "regionmesh/mesh_file.h"
#include "regionmesh/select_sections.h"
#include "regionmesh/voxelise.h"
#include "regionmesh/write_ascii_stl.h"
#include "regionmesh/write_report.h"
#include "settings.h"

namespace regionmesh::python {
namespace {

namespace fs = std::filesystem;

/// Sets the result of a run; frees what the run alone needed.
Model model_from(Reconstruction made, const LabelNames& names, bool is_open, const Coordinates& coordinates = {},
                 const LabelColours& colours = {}) {
    Model model{
        std::move(made.mesh), std::move(made.labels), std::move(made.background), names, is_open, coordinates, colours};
    model.report = report_json(made.report, model.labels, names, {}, coordinates.metres);
    model.stopped = made.report.stopped;
    return model;
}

/// The same vertices and faces under the same ids, with other dense labels. Requires ids without gaps.
Mesh relabelled(const Mesh& mesh, const std::vector<Label>& new_label) {
    Mesh copy;
    copy.reserve(mesh.vertex_end(), mesh.face_end());
    for (std::uint32_t v = 0; v < mesh.vertex_end(); ++v) {
        const Vertex& vertex = mesh[VertexId{v}];
        copy.add_vertex(vertex.position, vertex.sides, vertex.is_fixed);
    }
    const auto translate = [&](Label label) { return is_exterior(label) ? label : new_label[label]; };
    for (std::uint32_t f = 0; f < mesh.face_end(); ++f) {
        const auto& [vertices, next, labels] = mesh[FaceId{f}];
        copy.add_face(vertices[0], vertices[1], vertices[2], translate(labels[0]), translate(labels[1]));
    }
    return copy;
}

Mesh copy_of(const Mesh& mesh, const LabelTable& labels) {
    std::vector<Label> same(labels.size());
    std::iota(same.begin(), same.end(), Label{0});
    return relabelled(mesh, same);
}

/// Gives the labels of a mesh the numbers that they have in `order`.
void renumber(LabelledMesh& made, const std::vector<InputLabel>& order) {
    LabelTable table(made.labels.is_unsigned());
    for (const InputLabel label : order) table.dense(label);
    std::vector<Label> new_label(made.labels.size());
    for (Label label = 0; label < made.labels.size(); ++label) new_label[label] = table.dense(made.labels.input(label));
    made.mesh = relabelled(made.mesh, new_label);
    made.labels = std::move(table);
}

Model copy_of(const Model& model) {
    return {copy_of(model.mesh, model.labels),
            model.labels,
            model.background,
            model.names,
            model.is_open,
            model.coordinates,
            model.colours,
            model.lacking};
}

/// As it was before it went through a file without a background.
Model with_background(const Model& model, const Lattice& lattice, InputLabel background) {
    MeshFile file{.mesh = copy_of(model.mesh, model.labels), .labels = model.labels};
    restore_background(file, lattice, background);
    Model restored{std::move(file.mesh), std::move(file.labels), {}, model.names, model.is_open, model.coordinates};
    restored.background = {restored.labels.dense(background)};
    return restored;
}

CheckOptions check_options(const Model& model, std::uint32_t threads) {
    CheckOptions options;
    options.boundary_is_open = model.is_open;
    options.background = model.background;
    options.threads = threads;
    options.label_text = [&model](Label label) { return model.labels.text(model.labels.input(label)); };
    return options;
}

void describe(Model& made, const ModelChange& change) {
    made.report = report_json(change.report, made.labels, made.names, {}, made.coordinates.metres);
    made.stopped = change.report.stopped;
}

std::vector<InputLabel> background_of(const Model& model) {
    std::vector<InputLabel> background;
    for (const Label label : model.background) background.push_back(model.labels.input(label));
    return background;
}

/// A folder for Neuroglancer.
Saved save_precomputed(const Model& model, const fs::path& folder, const Settings& settings) {
    make_precomputed_folder(folder);
    const PrecomputedOptions options{.metres = with_units_and_space(settings, model.coordinates).metres,
                                     .is_legacy = settings.precomputed_is_legacy,
                                     .is_sharded = settings.precomputed_is_sharded,
                                     .levels = settings.precomputed_levels,
                                     .names = model.names,
                                     .colours = model.colours,
                                     .background = model.background,
                                     .boundary_is_open = model.is_open,
                                     .source = "save"};
    Mesh mesh = copy_of(model.mesh, model.labels);
    const PrecomputedResult made = write_precomputed(std::move(mesh), model.labels, folder, options);
    return {{folder.string()}, made.rounded_share_of_edge};
}

}  // namespace

Model reconstruct_source(Source& source, const RunOptions& run, Watch& watch) {
    const Settings settings = settings_from(run.options);
    const ReconstructOptions& options = settings.reconstruct;
    Model model;
    watch.run([&] {
        PrepareOptions prepare = settings.prepare;
        prepare.threads = options.threads;
        const PreparedSections all = prepared(source, prepare);
        WatchedSections sections(*all.reader, watch);
        StageProgress progress(watch, options);
        const VolumeInfo& info = sections.info();
        Reconstruction made = reconstruct(sections, with_free_target(settings, info.lattice.spacing),
                                          [&](const Progress& state) { progress(state); });
        if (!has_target(settings)) made.report.stopped = StopReason::kNoneAsked;
        made.report.sections_between = all.between;
        made.report.sections_moved = all.sections_moved;
        made.report.largest_section_shift = all.largest_shift;
        model = model_from(std::move(made), run.names.value_or(info.names), !options.cap,
                           with_units_and_space(settings, coordinates_of(info)), run.colours.value_or(info.colours));
    });
    return model;
}

Model reconstruct_tetrahedra(const std::string& path, const RunOptions& run, Watch& watch) {
    const Settings settings = settings_from(run.options, {path});
    std::unique_ptr<SectionReader> layers;
    std::unique_ptr<TetrahedronReader> tetrahedra;
    watch.run([&] {
        if (is_lattice(settings, {path}))
            layers = open_lattice(settings, {path});
        else
            tetrahedra = open_tetrahedra(path, settings.tetrahedra);
    });
    Model model;
    const auto make = [&](auto& reader) {
        const auto& info = reader.info();
        warn_of(path, info.warning);
        watch.run([&] {
            StageProgress progress(watch, settings.reconstruct);
            ReconstructOptions own = settings.reconstruct;
            if constexpr (requires { info.lattice; }) own = with_free_target(settings, info.lattice.spacing);
            Reconstruction made = reconstruct(reader, own, [&](const Progress& state) { progress(state); });
            if (!has_target(settings)) made.report.stopped = StopReason::kNoneAsked;
            model =
                model_from(std::move(made), run.names.value_or(info.names), !settings.reconstruct.cap,
                           with_units_and_space(settings, coordinates_of(info)), run.colours.value_or(LabelColours{}));
        });
    };
    if (layers)
        make(*layers);
    else
        make(*tetrahedra);
    return model;
}

Model load_model(const std::string& path, const OptionValues& options) {
    const Settings settings = settings_from(options);
    const py::gil_scoped_release release;
    MeshFile file = read_mesh(path, settings.surface);
    file.mesh.compact();
    std::optional<InputLabel> lacking;
    if (const auto& asked = settings.reconstruct.background; !asked.empty() && lacks_background(file, path, asked[0]))
        lacking = asked[0];
    std::vector<Label> background;
    for (const InputLabel label :
         !has_background(settings) && file.background ? *file.background : settings.reconstruct.background)
        background.push_back(file.labels.dense(label));
    return {std::move(file.mesh),      std::move(file.labels), std::move(background),   std::move(file.names),
            !settings.reconstruct.cap, file.coordinates,       std::move(file.colours), lacking};
}

Saved save_model(const Model& model, const std::string& path, bool per_region, const OptionValues& options) {
    const Settings settings = settings_from(options);
    const py::gil_scoped_release release;
    if (fs::path(path).extension() == ".precomputed") return save_precomputed(model, path, settings);
    const WriteOptions writing{.background = model.background,
                               .names = model.names,
                               .colours = model.colours,
                               .per_region = per_region,
                               .coordinates = with_units_and_space(settings, model.coordinates),
                               .boundary_is_open = model.is_open};
    if (settings.ascii) {
        OutputFiles files;
        write_ascii_stl(model.mesh, model.labels, path, writing, files);
        files.commit();
        return {{path}, 0};
    }
    Saved saved{{}, rounded_share_of_edge(model.mesh, path, writing)};
    for (const auto& file : write_mesh(model.mesh, model.labels, path, writing)) saved.paths.push_back(file.string());
    return saved;
}

Model model_of(const GivenArrays& given, const GivenLabels& labels) {
    MeshArrays arrays{.exterior_label = given.exterior_label, .is_unsigned = given.is_unsigned};
    const auto copy = [](const auto& from, auto& to, std::size_t rows) {
        to.resize(rows);
        if (rows > 0) std::memcpy(static_cast<void*>(to.data()), from.data(), rows * sizeof(to[0]));
    };
    copy(given.points, arrays.points, static_cast<std::size_t>(given.points.shape(0)));
    copy(given.faces, arrays.faces, static_cast<std::size_t>(given.faces.shape(0)));
    copy(given.labels, arrays.labels, static_cast<std::size_t>(given.labels.shape(0)));
    if (given.node_types)
        copy(*given.node_types, arrays.node_types, static_cast<std::size_t>(given.node_types->shape(0)));
    const py::gil_scoped_release release;
    LabelledMesh made = import_arrays(arrays);
    if (!labels.order.empty()) renumber(made, labels.order);
    std::vector<Label> background;
    for (const InputLabel label : labels.background) background.push_back(made.labels.dense(label));
    return {std::move(made.mesh), std::move(made.labels), std::move(background), labels.names,
            labels.is_open,       labels.coordinates,     labels.colours,        labels.lacking};
}

Model simplified(const Model& model, const OptionValues& options, const std::optional<Lattice>& samples, Watch& watch) {
    Settings settings = settings_from(options);
    settings.reconstruct.cap = !model.is_open;
    if (!has_target(settings) && !settings.reconstruct.improve && !settings.reconstruct.smooth_lines &&
        !settings.reconstruct.edge_length)
        throw Error(ErrorCode::kUsage,
                    "simplify: no target; give target_faces, reduce, max_error, edge_length, improve or smooth_lines");
    Model made;
    watch.run([&] {
        made = copy_of(model);
        const auto note = [&](const char* stage, std::uint64_t gone, const std::optional<std::uint64_t>& in_all) {
            watch.note(stage, gone, in_all);
        };
        const CheckOptions checks = check_options(made, settings.reconstruct.threads);
        describe(made, simplify_model(made.mesh, settings, checks, made.coordinates.spacing, samples, note));
    });
    return made;
}

Model smoothed(const Model& model, const OptionValues& options, Watch& watch) {
    const Settings settings = settings_from(options);
    Model made;
    watch.run([&] {
        made = copy_of(model);
        describe(made, smooth_model(made.mesh, settings, check_options(made, settings.reconstruct.threads)));
    });
    return made;
}

/// How the sections are prepared: as the spacing of the model says, unless `between` is given.
static PrepareOptions prepare_for(const Settings& settings, const Source& source, const Model& model,
                                  std::uint32_t threads) {
    PrepareOptions own = settings.prepare;
    own.threads = threads;
    if (given_text(settings, "between") || !model.coordinates.spacing) return own;
    const auto made = between_of_model(source.reader->info().lattice, *model.coordinates.spacing);
    own.between = made ? made->between : 0;
    return own;
}

std::string check_text(const Model& given, std::uint32_t threads, Source* source, const OptionValues& changes,
                       Watch& watch) {
    std::string text;
    watch.run([&] {
        std::optional<Model> restored;
        if (source && given.lacking) restored = with_background(given, source->reader->info().lattice, *given.lacking);
        const Model& model = restored ? *restored : given;
        LabelTable labels = model.labels;
        CheckOptions options = check_options(model, threads);
        options.label_text = [&labels](Label label) { return labels.text(labels.input(label)); };
        std::optional<SampleAgreement> samples;
        if (source != nullptr) {
            const Settings settings = settings_from(changes);
            const auto modelled = modelled_sections(
                prepared(*source, prepare_for(settings, *source, model, threads)).reader, settings.reconstruct);
            WatchedSections sections(*modelled, watch);
            const CensusOptions census{.cap = !model.is_open, .background = background_of(model), .threads = threads};
            const Census counted = count_labels(sections, census);
            options.oracle = relabelled(counted.oracle, counted.labels, labels);
            if (!model.is_open) samples = compare_samples(model.mesh, labels, model.background, sections, threads);
        }
        const CheckReport report = check(model.mesh, options);
        text = check_json(report, labels, model.names, samples ? &*samples : nullptr, model.coordinates.metres);
    });
    return text;
}

std::string table_text(const Model& model, const std::string& table, Watch& watch) {
    const auto write = table == "regions" ? regions_csv : table == "interfaces" ? interfaces_csv : lines_csv;
    std::string text;
    watch.run([&] { text = write(model.mesh, model.labels, model.background, {}); });
    return text;
}

std::string compare_text(const Model& a, const Model& b, const OptionValues& options, Watch& watch) {
    const Settings settings = settings_from(options);
    const CompareOptions asked{
        .samples = settings.samples, .background = background_of(a), .threads = settings.reconstruct.threads};
    std::string text;
    watch.run([&] { text = compare_json(compare({a.mesh, a.labels}, {b.mesh, b.labels}, asked)); });
    return text;
}

void voxelise(const Model& model, const Frame& frame, InputLabel outside, py::array& labels, Watch& watch) {
    VoxeliseOptions options;
    const auto& [s, o] = std::pair(frame.spacing, frame.origin);
    options.lattice = {{static_cast<std::uint32_t>(labels.shape(2)), static_cast<std::uint32_t>(labels.shape(1)),
                        static_cast<std::uint32_t>(labels.shape(0))},
                       {s[0], s[1], s[2]},
                       {o[0], o[1], o[2]},
                       frame.direction};
    require_lattice("voxelise()", options.lattice);
    options.background = model.background;
    auto* to = static_cast<std::byte*>(labels.mutable_data());
    const auto bytes = static_cast<std::size_t>(labels.itemsize());
    watch.run([&] {
        Voxeliser voxeliser(model.mesh, options);
        std::vector<Label> section(std::size_t{options.lattice.size[0]} * options.lattice.size[1]);
        while (voxeliser.next(section)) {
            watch.stop_if_cancelled();
            for (const Label label : section) {
                // The low bytes of a label, on a machine that is little endian.
                const InputLabel input = is_exterior(label) ? outside : model.labels.input(label);
                std::memcpy(to, &input, bytes);
                to += bytes;
            }
        }
        if (voxeliser.contradictions() != 0)
            throw Error(ErrorCode::kInput, "the surface contradicts itself at " +
                                               std::to_string(voxeliser.contradictions()) +
                                               " samples: it is not closed, or its faces cross or are turned over; "
                                               "check() lists the places");
    });
}

}  // namespace regionmesh::python
