// A model as Python holds it, and what can be done with it. Functions without a Watch release the GIL.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <optional>
#include <string>
#include <vector>

#include "regionmesh/label_names.h"
#include "regionmesh/options.h"
#include "regionmesh/reconstruct.h"
#include "regionmesh/simplify.h"
#include "sources.h"
#include "watch.h"

namespace regionmesh::python {

/// Never changed after it is made, so that views of it stay valid and threads may share it. Ids have no gaps.
struct Model {
    Mesh mesh;
    LabelTable labels;
    std::vector<Label> background;
    LabelNames names;
    bool is_open = false;
    Coordinates coordinates = {};
    LabelColours colours = {};               // of some regions, given by the input
    std::optional<InputLabel> lacking = {};  // a background that the exterior may stand for
    std::string report = {};                 // JSON; empty where it was not checked yet
    StopReason stopped = StopReason::kNoneAsked;
};

/// What a reconstruction takes besides its labels.
struct RunOptions {
    OptionValues options;
    std::optional<LabelNames> names = {};
    std::optional<LabelColours> colours = {};
};

Model reconstruct_source(Source& source, const RunOptions& run, Watch& watch);
Model reconstruct_tetrahedra(const std::string& path, const RunOptions& run, Watch& watch);

/// With the background of the file where the options name none.
Model load_model(const std::string& path, const OptionValues& options);
/// What was written, and how far the format moves points: a share of the mean edge.
struct Saved {
    std::vector<std::string> paths;
    double rounded_share_of_edge = 0;
};
/// `options` are those of the files: units.
Saved save_model(const Model& model, const std::string& path, bool per_region, const OptionValues& options);

/// points, faces, labels and node types, read-only; the arrays own the memory.
py::tuple arrays_of(const Model& model);

struct GivenArrays {
    py::array_t<double, py::array::c_style> points;
    py::array_t<std::uint32_t, py::array::c_style> faces;
    py::array_t<std::int64_t, py::array::c_style> labels;
    std::optional<py::array_t<std::uint8_t, py::array::c_style>> node_types;
    InputLabel exterior_label;
    bool is_unsigned;
};
struct GivenLabels {
    std::vector<InputLabel> background;
    std::vector<InputLabel> order;  // by dense number, so that a copy of a model is treated alike; may be empty
    LabelNames names;
    bool is_open;
    Coordinates coordinates;
    LabelColours colours;
    std::optional<InputLabel> lacking;
};
Model model_of(const GivenArrays& given, const GivenLabels& labels);

/// As `regionmesh decimate`. No sample of the lattice changes its region, where one is given.
Model simplified(const Model& model, const OptionValues& options, const std::optional<Lattice>& samples, Watch& watch);
Model smoothed(const Model& model, const OptionValues& options, Watch& watch);

/// The check as JSON. With a source also against its labels, cleaned as `room` says.
std::string check_text(const Model& model, std::uint32_t threads, Source* source, const OptionValues& changes,
                       Watch& watch);
/// "regions", "interfaces" or "lines": the table of `regionmesh check` as CSV.
std::string table_text(const Model& model, const std::string& table, Watch& watch);
std::string compare_text(const Model& a, const Model& b, const OptionValues& options, Watch& watch);

/// Fills `labels` [z, y, x], of integers in memory order. Throws Error(kInput) for a surface that is not closed.
void voxelise(const Model& model, const Frame& frame, InputLabel outside, py::array& labels, Watch& watch);

}  // namespace regionmesh::python
