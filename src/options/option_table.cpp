// The table of options: one row an option, in *_rows.cpp.
#include <algorithm>
#include <iterator>

#include "options/deferred_options.h"
#include "options/option_rows.h"
#include "regionmesh/error.h"

namespace regionmesh {
namespace {

Rows all_rows() {
    Rows rows;
    for (const auto& group : {argument_rows, volume_rows, tetrahedra_rows, label_rows, surface_rows, decimation_rows,
                              smoothing_rows, validity_rows, comparison_rows, output_rows, run_rows})
        std::ranges::move(group(), std::back_inserter(rows));
    return rows;
}

}  // namespace

const std::vector<CommandSpec>& command_table() {
    static const std::vector<CommandSpec> commands{
        {kReconstruct, "reconstruct",
         "make a conforming, simplified, checked surface model of sections, points or tetrahedra",
         "regionmesh reconstruct scan.nii.gz -o model.vtp --reduce 90% --report report.json"},
        {kDecimate, "decimate", "reduce the faces of a labelled surface",
         "regionmesh decimate model.vtp -o small.vtp --target-faces 50000"},
        {kRemesh, "remesh", "bring the edges of a labelled surface near one length",
         "regionmesh remesh model.vtp -o even.vtp --edge-length 2"},
        {kSmooth, "smooth", "smooth a labelled surface", "regionmesh smooth model.vtp -o smooth.vtp --smooth 100"},
        {kCheck, "check", "look for cracks, folds, crossing faces and changes of topology",
         "regionmesh check model.vtp --sections scan.nii.gz"},
        {kConvert, "convert", "write a labelled surface in another format", "regionmesh convert model.vtp model.glb"},
        {kCompare, "compare", "measure the distances between two models, and by region, interface and line",
         "regionmesh compare full.vtp model.vtp"},
        {kInfo, "info", "print size, type, spacing and labels of an input, and the memory that a model needs",
         "regionmesh info scan.nii.gz"},
        {kVoxelise, "voxelise", "write the label of each sample of a lattice: the inverse of reconstruct",
         "regionmesh voxelise model.vtp --like scan.nii.gz -o labels.nii.gz"},
        {kView, "view", "write a page that shows a labelled surface in a browser",
         "regionmesh view model.vtp -o model.html"},
    };
    return commands;
}

const std::vector<OptionSpec>& option_table() {
    static const Rows rows = all_rows();
    return rows;
}

const OptionSpec* find_option(std::string_view name) {
    const auto& rows = option_table();
    const auto row = std::ranges::find(rows, name, &OptionSpec::name);
    return row == rows.end() ? nullptr : &*row;
}

void apply_options(Settings& settings, const OptionValues& values) {
    for (const auto& [name, text] : values)
        if (!find_option(name)) throw Error(ErrorCode::kUsage, name + ": there is no such option");
    for (const OptionSpec& row : option_table())
        for (const auto& [name, text] : values)
            if (name == row.name) {
                if (is_deferred(row, text))
                    settings.deferred.emplace_back(name, text);
                else
                    row.set(settings, text);
                const bool is_off = row.kind == OptionKind::kFlag && text == "false";
                if (!is_off) settings.given.emplace_back(name, text);
            }
    require_consistent(settings);
}

}  // namespace regionmesh
