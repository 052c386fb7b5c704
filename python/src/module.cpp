// The module regionmesh._core: what the package in python/regionmesh is made of. Not for users.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <mutex>

#include "model.h"
#include "regionmesh/error.h"
#include "regionmesh/label_names_file.h"
#include "regionmesh/process.h"
#include "regionmesh/read_sections.h"
#include "regionmesh/stop.h"
#include "regionmesh/write_report.h"
#include "settings.h"
#include "sources.h"

namespace regionmesh::python {
namespace {

/// Messages name files, whose names need not be UTF-8.
void raise_in_python(std::exception_ptr failure) {
    try {
        if (failure) std::rethrow_exception(failure);
    } catch (const Error& error) {
        const std::string text = with_arguments(error.what());
        const auto message = py::reinterpret_steal<py::object>(
            PyUnicode_DecodeUTF8(text.data(), static_cast<py::ssize_t>(text.size()), "surrogateescape"));
        PyErr_SetObject(error.code() == ErrorCode::kOutput ? PyExc_OSError : PyExc_ValueError, message.ptr());
    } catch (const Stopped&) {  // by end_all()
        PyErr_SetNone(PyExc_SystemExit);
    }
}

ArrayOptions array_options(const OptionValues& options, const LabelNames& names, const std::string& name) {
    return {.sweep = settings_from(options).volume.sweep, .names = names, .name = name};
}

py::dict info_of(const Source& source) {
    const VolumeInfo& info = source.reader->info();
    const Lattice& lattice = info.lattice;
    const auto tuple = [](Vec3 v) { return py::make_tuple(v.x, v.y, v.z); };
    py::dict result;
    result["size"] = lattice.size;
    result["type"] = to_string(info.type);
    result["spacing"] = tuple(lattice.spacing);
    result["origin"] = tuple(lattice.origin);
    result["direction"] = lattice.direction;
    result["names"] = info.names;
    result["can_rewind"] = info.can_rewind;
    result["metres"] = info.metres;
    return result;
}

void free_large_arrays_at_once() {
    static std::once_flag once;
    std::call_once(once, keep_large_arrays_apart);
}

void bind_sources(py::module_& module) {
    py::class_<Frame>(module, "Frame")
        .def(py::init<std::array<double, 3>, std::array<double, 3>, std::array<double, 9>, std::optional<double>,
                      std::string>());
    py::class_<Source>(module, "Source").def_property_readonly("info", info_of);
    module.def("array_source", [](const py::array& array, const Frame& frame, const OptionValues& options,
                                  const KeptLabels& kept, const LabelNames& names, const std::string& name) {
        return select(array_source(array, frame, array_options(options, names, name)), options, kept);
    });
    module.def("call_source", [](const std::tuple<py::object, py::object, std::array<std::uint32_t, 3>, std::string>&
                                     calls,
                                 const Frame& frame, const OptionValues& options, const KeptLabels& kept,
                                 const LabelNames& names, const std::string& name) {
        const auto& [next, rewind, size, type] = calls;
        return select(call_source({next, rewind, size, type}, frame, {.names = names, .name = name}), options, kept);
    });
    module.def("file_source", file_source);
}

void bind_runs(py::module_& module) {
    using Names = std::optional<LabelNames>;
    using Colours = std::optional<LabelColours>;
    module.def("reconstruct_source", [](Source& source, const OptionValues& options, const Names& names,
                                        const Colours& colours, const py::object& progress) {
        free_large_arrays_at_once();
        Watch watch(progress);
        return reconstruct_source(source, {options, names, colours}, watch);
    });
    module.def("reconstruct_tetrahedra", [](const std::string& path, const OptionValues& options, const Names& names,
                                            const Colours& colours, const py::object& progress) {
        free_large_arrays_at_once();
        Watch watch(progress);
        return reconstruct_tetrahedra(path, {options, names, colours}, watch);
    });
    using Samples = std::optional<std::pair<Frame, ArraySize>>;
    module.def("simplify", [](const Model& model, const OptionValues& options, const Samples& samples,
                              const py::object& progress) {
        Watch watch(progress);
        const auto lattice = samples ? std::optional(lattice_of(samples->first, samples->second)) : std::nullopt;
        return simplified(model, options, lattice, watch);
    });
    module.def("smooth", [](const Model& model, const OptionValues& options) {
        Watch watch(py::none{});
        return smoothed(model, options, watch);
    });
    module.def(
        "check",
        [](const Model& model, std::uint32_t threads, Source* source, const OptionValues& changes) {
            Watch watch(py::none{});
            return check_text(model, threads, source, changes, watch);
        },
        py::arg("model"), py::arg("threads"), py::arg("source").none(true), py::arg("changes"));
    module.def("table", [](const Model& model, const std::string& table) {
        Watch watch(py::none{});
        return table_text(model, table, watch);
    });
    module.def("compare", [](const Model& a, const Model& b, const OptionValues& options) {
        Watch watch(py::none{});
        return compare_text(a, b, options, watch);
    });
    module.def("voxelise", [](const Model& model, const Frame& frame, InputLabel outside, py::array& labels) {
        Watch watch(py::none{});
        voxelise(model, frame, outside, labels, watch);
    });
}

void bind_model(py::module_& module) {
    py::class_<Model>(module, "Model")
        .def_property_readonly("arrays", arrays_of)
        .def_readonly("report", &Model::report)
        .def_property_readonly("stopped", [](const Model& model) { return to_string(model.stopped); })
        .def_readonly("names", &Model::names)
        .def_readonly("colours", &Model::colours)
        .def_readonly("is_open", &Model::is_open)
        .def_readonly("lacking", &Model::lacking)
        .def_property_readonly("space",
                               [](const Model& model) { return std::string(space_name(model.coordinates.space)); })
        .def_property_readonly("metres", [](const Model& model) { return model.coordinates.metres; })
        .def_property_readonly("spacing",
                               [](const Model& model) -> std::optional<std::array<double, 3>> {
                                   const auto& spacing = model.coordinates.spacing;
                                   if (!spacing) return {};
                                   return {{spacing->x, spacing->y, spacing->z}};
                               })
        .def_property_readonly("is_unsigned", [](const Model& model) { return model.labels.is_unsigned(); })
        .def_property_readonly("exterior_label", [](const Model& model) { return model.labels.exterior_label(); })
        .def_property_readonly("vertex_count", [](const Model& model) { return model.mesh.vertex_count(); })
        .def_property_readonly("face_count", [](const Model& model) { return model.mesh.face_count(); })
        .def_property_readonly("label_order",
                               [](const Model& model) {
                                   std::vector<InputLabel> labels(model.labels.size());
                                   for (Label label = 0; label < labels.size(); ++label)
                                       labels[label] = model.labels.input(label);
                                   return labels;
                               })
        .def_property_readonly("background", [](const Model& model) {
            std::vector<InputLabel> labels;
            for (const Label label : model.background) labels.push_back(model.labels.input(label));
            return labels;
        });
    module.def("load", load_model);
    module.def("save", [](const Model& model, const std::string& path, bool per_region, const OptionValues& options) {
        const Saved saved = save_model(model, path, per_region, options);
        std::vector<py::bytes> paths(saved.paths.begin(), saved.paths.end());  // which need not be UTF-8
        return std::pair(paths, saved.rounded_share_of_edge);
    });
    using Arrays = std::tuple<decltype(GivenArrays::points), decltype(GivenArrays::faces),
                              decltype(GivenArrays::labels), decltype(GivenArrays::node_types)>;
    using Labels = std::tuple<std::vector<InputLabel>, std::vector<InputLabel>, LabelNames, LabelColours,
                              std::optional<InputLabel>>;
    using Known = std::tuple<std::string, std::optional<double>, std::optional<std::array<double, 3>>>;
    module.def("from_arrays", [](const Arrays& arrays, const Labels& about, const Known& known, InputLabel exterior,
                                 bool is_unsigned, bool is_open) {
        const auto& [points, faces, labels, types] = arrays;
        const auto& [background, order, names, colours, lacking] = about;
        const auto& [space, metres, spacing] = known;
        Coordinates coordinates{space_named(space), metres, {}};
        if (spacing) coordinates.spacing = Vec3{(*spacing)[0], (*spacing)[1], (*spacing)[2]};
        return model_of({points, faces, labels, types, exterior, is_unsigned},
                        {background, order, names, is_open, coordinates, colours, lacking});
    });
}

}  // namespace

PYBIND11_MODULE(_core, module) {
    module.attr("version") = REGIONMESH_VERSION;
    py::register_exception_translator(raise_in_python);
    module.def("option_rows", option_rows);
    module.def("metres_of", [](const OptionValues& options) { return settings_from(options).metres; });
    module.def("length_symbol", length_symbol);
    module.def("check_options", [](const OptionValues& options) { settings_from(options); });
    module.def("kind_of_input", [](const std::vector<std::string>& paths) {
        return kind_of_input(paths) == kVolumeInput ? "volume" : "tetrahedra";
    });
    module.def("volume_extensions", volume_extensions);
    module.def("read_names", [](const std::string& path) { return read_label_names(path); });
    module.def("read_colours", [](const std::string& path) { return read_label_colours(path); });
    py::module_::import("atexit").attr("register")(py::cpp_function(Watch::end_all));
    py::module_::import("os").attr("register_at_fork")(py::arg("after_in_child") = py::cpp_function(Watch::forget_all));
    bind_sources(module);
    bind_runs(module);
    bind_model(module);
}

}  // namespace regionmesh::python
