#include "tetrahedra_options.h"

#include <algorithm>

namespace regionmesh::cli {
namespace {

/// A number above 0.
double parse_factor(const std::string& flag, const std::string& text) {
    const double value = parse_number(flag, text);
    if (value == 0) throw Error(ErrorCode::kInput, flag + " 0: not a number above 0");
    return value;
}

/// Stands for a flag that has no value.
constexpr const char* kGiven = "given";

void refuse_given(const std::string& flag, const std::string& value, const std::string& input, const char* kind) {
    if (!value.empty())
        throw Error(ErrorCode::kInput, flag + (value == kGiven ? "" : ' ' + value) + ": " + input + " is " + kind);
}

}  // namespace

void TetrahedraArguments::add_options(CLI::App& command) {
    command.add_option("--columns", columns,
                       "tables: which columns are what, as X,Y,Z,LABEL or hole=nr,label=lith ...");
    command.add_option("--step", step, "drill holes: points no farther apart than this stand for an interval");
    command.add_option("--scale-z", scale_z,
                       "points and meshes: work with z times about this (a power of two); the model is not scaled");
    command.add_option("--array", array, "meshes: name of the array of labels");
    command.add_flag("--hull", hull, "points and meshes: close regions on the hull, as --boundary cap does");
}

bool TetrahedraArguments::is_meant(const std::vector<std::string>& inputs, const InputOptions& volume) const {
    if (inputs.empty()) return false;
    const bool any =
        std::any_of(inputs.begin(), inputs.end(), [](const auto& input) { return holds_tetrahedra(input); });
    if (!any) {
        for (const auto& [flag, value] : {std::pair("--columns", columns),
                                          {"--step", step},
                                          {"--scale-z", scale_z},
                                          {"--array", array},
                                          {"--hull", hull ? kGiven : ""}})
            refuse_given(flag, value, inputs[0], "neither a table of points nor a mesh");
        return false;
    }
    if (inputs.size() > 1) throw Error(ErrorCode::kInput, inputs[1] + ": one table or mesh at a time; give one");
    for (const auto& [flag, value] : {std::pair("--spacing", volume.spacing),
                                      {"--layer", volume.layer},
                                      {"--size", volume.size},
                                      {"--type", volume.type}})
        refuse_given(flag, value, inputs[0], "no volume of samples");
    if (is_mesh(inputs[0])) {
        refuse_given("--columns", columns, inputs[0], "a mesh, no table");
        refuse_given("--step", step, inputs[0], "a mesh, no table");
    } else {
        refuse_given("--array", array, inputs[0], "a table, no mesh");
    }
    if (hull && !volume.cap())
        throw Error(ErrorCode::kInput, "--hull closes what --boundary open leaves open; give one");
    return true;
}

std::unique_ptr<TetrahedronReader> TetrahedraArguments::open(const std::vector<std::string>& inputs) const {
    TetrahedraOptions options{.columns = columns, .array = array};
    if (!step.empty()) options.step = parse_factor("--step", step);
    if (!scale_z.empty()) options.scale_z = parse_factor("--scale-z", scale_z);
    return open_tetrahedra(inputs.front(), options);
}

}  // namespace regionmesh::cli
