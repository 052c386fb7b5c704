#include "output_options.h"

namespace regionmesh::cli {

const std::string kMeshWritten = "model to write: " + writable_extensions();

void OutputOptions::add_options(CLI::App& command) {
    command.add_option("-o,--output", path, kMeshWritten)->required();
    add_content_options(command);
}

void OutputOptions::add_content_options(CLI::App& command) {
    command.add_option("--names", names,
                       "table of labels and names (.csv, .tsv, .txt, .xml) instead of the input's own");
    command.add_flag("--per-region", per_region, "a file for each region, MODEL-LABEL: .stl, .obj and .ply");
}

void OutputOptions::require_writable(bool boundary_is_open) const {
    require_writable_mesh(path, {.per_region = per_region, .boundary_is_open = boundary_is_open});
    if (!names.empty()) read_label_names(names);
}

LabelNames OutputOptions::names_or(const LabelNames& found) const {
    return names.empty() ? found : read_label_names(names);
}

void OutputOptions::write(const Mesh& mesh, const LabelTable& labels, const std::vector<Label>& background,
                          const LabelNames& region_names) const {
    write_mesh(mesh, labels, path, {.background = background, .names = region_names, .per_region = per_region});
}

}  // namespace regionmesh::cli
