// One HTML file that shows a model and its report in a browser, without a network.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "regionmesh/label_names.h"
#include "regionmesh/label_table.h"
#include "regionmesh/lattice.h"
#include "regionmesh/mesh.h"
#include "regionmesh/output_file.h"

namespace regionmesh {

/// One model of a page. Holds references.
struct PageModel {
    const Mesh& mesh;
    const LabelTable& labels;
    std::string title;                   // the name of its file
    std::vector<Label> background = {};  // not shown as regions
    LabelNames names = {};
    LabelColours colours = {};               // of some regions; the others get those of a palette
    std::optional<double> metres = {};       // in its unit of length, where it is known
    Space space = Space::kUnknown;           // where x, y and z point
    std::span<const double> distances = {};  // by vertex id, to the other model; may be empty
};

struct PageOptions {
    std::string command = {};       // what made the page: "reconstruct", "decimate", "check", "compare", "view"
    std::string command_line = {};  // as typed
    std::string report = {};        // JSON text of report_json(), check_json() or compare_json(); may be empty
    bool has_labels = false;        // the report compares the topology with the labels of the input
    bool boundary_is_open = false;  // regions are open at the box
    std::optional<double> min_quality = {};  // bound that decimation kept for changed faces
    std::optional<double> max_error = {};    // bound on the error of decimation, a length
    std::uint32_t preview_faces = 500'000;   // a model with more faces is simplified for the page
    std::uint32_t threads = 0;               // of that simplification; 0: one per core
};

/// Writes one model, or two side by side. Positions are rounded to 1/65535 of the extent along each axis: the page is
/// for looking, not for measuring. The bytes depend on the arguments only, except `threads`. Names, titles and the
/// report are data: no text in them can become markup or script. Memory: about 40 bytes per face; for a model that is
/// simplified, 250 bytes per face more. The page is one of `files`, which the caller commits. Throws Error(kOutput),
/// also for a report that is no JSON text, for too few distances, and for another number of models.
void write_page(const std::filesystem::path& path, const std::vector<PageModel>& models, const PageOptions& options,
                OutputFiles& files);
/// The same, committed.
void write_page(const std::filesystem::path& path, const std::vector<PageModel>& models, const PageOptions& options);

}  // namespace regionmesh
