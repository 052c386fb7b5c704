#include "settings.h"

#include <algorithm>
#include <array>
#include <vector>

#include "regionmesh/error.h"

namespace regionmesh::python {
namespace {

namespace py = pybind11;

constexpr std::array<const char*, 11> kKinds{"flag",  "count",  "number",  "share", "bytes", "word",
                                             "label", "counts", "numbers", "text",  "file"};

py::dict row_of(const OptionSpec& option) {
    py::dict row;
    row["name"] = option.name;
    row["help"] = std::string(option.help);
    row["group"] = std::string(option.group);
    row["unit"] = std::string(option.unit);
    row["kind"] = kKinds.at(static_cast<std::size_t>(option.kind));
    row["range"] = option.range;
    row["words"] = std::vector<std::string>(option.words.begin(), option.words.end());
    row["default"] = option.default_text;
    row["repeats"] = option.repeats;
    row["is_argument"] = option.is_argument;
    row["for_volumes"] = (option.inputs & kVolumeInput) != 0;
    return row;
}

}  // namespace

py::list option_rows(const std::string& command) {
    const auto& commands = command_table();
    const auto found = std::ranges::find(commands, command, &CommandSpec::name);
    if (found == commands.end()) throw py::value_error(command + ": there is no such command");
    py::list rows;
    for (const OptionSpec& option : option_table())
        if ((option.commands & found->command) != 0) rows.append(row_of(option));
    return rows;
}

Settings settings_from(const OptionValues& values, const std::vector<std::string>& inputs) {
    Settings settings;
    apply_options(settings, values);
    require_fit(settings, inputs);
    if (settings.needs_sandbox)
        throw Error(ErrorCode::kUsage, "require_sandbox: the interpreter is not confined; use the program regionmesh");
    if (settings.memory_is_hard)
        throw Error(ErrorCode::kUsage, "memory_limit: hard would end the interpreter; use the program regionmesh");
    return settings;
}

}  // namespace regionmesh::python
