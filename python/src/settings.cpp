#include "settings.h"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
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

std::string with_arguments(const std::string& text) {
    constexpr std::string_view kWord = "abcdefghijklmnopqrstuvwxyz-";
    std::string made;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t flag = text.find("--", at);
        if (flag == std::string::npos) return made + text.substr(at);
        const std::size_t end = std::min(text.find_first_not_of(kWord, flag + 2), text.size());
        const OptionSpec* const option = find_option(text.substr(flag + 2, end - flag - 2));
        made += text.substr(at, flag - at);
        at = end;
        if (!option) {
            made += text.substr(flag, end - flag);
            continue;
        }
        const bool is_inverted = option->name.starts_with("no-") && option->name != "no-background";
        std::string name = is_inverted ? option->name.substr(3) : option->name;
        std::ranges::replace(name, '-', '_');
        made += is_inverted ? name + "=False" : name;
        // "--reduce 2: not a share" names the value, and so do lists of two such.
        if (!is_inverted && flag == 0 && option->kind != OptionKind::kFlag && end < text.size() && text[end] == ' ' &&
            text.compare(end, 5, " and ") != 0) {
            made += '=';
            ++at;
        }
    }
    return made;
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
