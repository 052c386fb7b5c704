#include "config_file.h"

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <sstream>
#include <utility>

#include "arguments.h"
#include "regionmesh/error.h"

namespace regionmesh::cli {
namespace {

constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";  // UTF-8, as some editors begin a file

bool has(const OptionValues& values, std::string_view name) {
    return std::ranges::any_of(values, [&](const auto& value) { return value.first == name; });
}

/// Calls visit(line, number) for each line, numbered from 1.
template <class Visit>
void for_lines(const std::string& text, Visit&& visit) {
    std::istringstream lines(text);
    int number = 0;
    for (std::string line; std::getline(lines, line);) visit(line, ++number);
}

/// CLI11 takes "#" for the start of a comment wherever it is.
void require_no_number_sign_in_quotes(const std::string& path, const std::string& text) {
    for_lines(text, [&](const std::string& line, int number) {
        char quote = 0;
        for (const char c : line) {
            if (quote && c == '#')
                throw Error(ErrorCode::kInput,
                            fmt::format("{}: line {}: a value with # cannot be read; give it on the command line", path,
                                        number));
            if (quote ? c == quote : c == '"' || c == '\'') quote = quote ? 0 : c;
            if (!quote && c == '#') break;
        }
    });
}

/// CLI11 takes time and memory that grow with the square of the parts of a name.
void require_short_names(const std::string& path, const std::string& text) {
    constexpr std::ptrdiff_t kMostParts = 100;
    for_lines(text, [&](const std::string& line, int number) {
        const std::size_t end = std::min(line.find_first_of("=]#\"'"), line.size());
        const bool is_name = line.find('[') < end || (end < line.size() && line[end] == '=');
        if (is_name && std::count(line.begin(), line.begin() + end, '.') > kMostParts)
            throw Error(ErrorCode::kInput,
                        fmt::format("{}: line {}: a name of more than {} parts; tables are named after commands, such "
                                    "as [reconstruct]",
                                    path, number, kMostParts));
    });
}

std::string trimmed(const std::string& text) {
    constexpr const char* kBlank = " \t\r";
    const std::size_t first = text.find_first_not_of(kBlank);
    return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(kBlank) - first + 1);
}

/// As options have it.
std::string option_name(std::string name) {
    std::ranges::replace(name, '_', '-');
    return name;
}

Error given_again(const std::string& path, const std::string& name) {
    return {ErrorCode::kUsage, path + ": " + name + " is given twice; leave one of them out"};
}

/// CLI11 joins the values of a name that lines behind each other have, and passes over what has no name. To it a line
/// that begins with ; is a comment.
void require_own_names(const std::string& path, const std::string& text) {
    std::string last;
    for_lines(text, [&](const std::string& line, int) {
        const std::string content = trimmed(line);
        if (content.starts_with('[')) last.clear();
        const std::size_t end = content.find_first_of("=]#[,");
        if (content.starts_with(';') || end == std::string::npos || content[end] != '=') return;
        std::string name = option_name(trimmed(content.substr(0, end)));
        std::erase_if(name, [](char c) { return c == '"' || c == '\''; });
        if (name.empty()) throw Error(ErrorCode::kUsage, path + ": \"" + content + "\" has no name; give NAME = VALUE");
        const OptionSpec* const option = find_option(name);
        if (name == last && !(option && option->repeats)) throw given_again(path, name);
        last = name;
    });
}

std::vector<CLI::ConfigItem> items_in(const std::string& path) {
    std::ifstream stream(path);
    if (std::error_code ignored; !stream || std::filesystem::is_directory(path, ignored))
        throw Error(ErrorCode::kInput, path + ": cannot be read; check the path and its permissions");
    std::string text(std::istreambuf_iterator<char>(stream), {});
    if (text.starts_with(kByteOrderMark)) text.erase(0, kByteOrderMark.size());
    require_no_number_sign_in_quotes(path, text);
    require_short_names(path, text);
    require_own_names(path, text);
    std::istringstream again(text);
    try {
        return CLI::ConfigTOML().from_config(again);
    } catch (const CLI::Error& error) {
        throw Error(ErrorCode::kInput, path + ": " + error.what());
    }
}

std::string joined(const std::vector<std::string>& texts) {
    std::string all;
    for (const std::string& text : texts) all += (all.empty() ? "" : ",") + text;
    return all;
}

OptionValues values_in(const std::string& path, const CommandSpec& command) {
    OptionValues values;
    std::set<std::pair<std::string, std::string>> names;  // key: table; that of the command is ""
    for (const CLI::ConfigItem& item : items_in(path)) {
        if (item.name == "++" || item.name == "--") continue;  // start and end of a table
        const std::string table = item.parents.empty() ? "" : item.parents.front();
        if (!table.empty() && std::ranges::find(command_table(), table, &CommandSpec::name) == command_table().end())
            throw Error(ErrorCode::kUsage,
                        fmt::format("{}: [{}]: no command has this name; tables are named after commands, such as [{}]",
                                    path, table, command.name));
        const std::string name = option_name(item.name);
        const OptionSpec* const option = find_option(name);
        const bool repeats = option && option->repeats, is_for_command = table.empty() || table == command.name;
        const bool is_new = names.emplace(is_for_command ? "" : table, name).second;
        if (!repeats && !is_new) throw given_again(path, name);
        if (!is_for_command) continue;
        if (repeats)
            for (const std::string& text : item.inputs) values.emplace_back(name, text);
        else
            values.emplace_back(name, joined(item.inputs));
    }
    return values;
}

/// Errors name the file, too.
void require_value(const std::string& path, const OptionSpec& option, const std::string& text) {
    Settings settings;
    try {
        option.set(settings, text);
    } catch (const Error& error) {
        throw Error(error.code(), path + ": " + error.what());
    }
}

}  // namespace

void add_config(OptionValues& values, const CommandSpec& command) {
    const auto config = std::ranges::find(values, "config", &OptionValues::value_type::first);
    if (config == values.end()) return;
    const std::string path = config->second;
    const bool is_report = std::filesystem::path(path).extension() == ".json";
    const OptionValues typed = values;
    for (auto& [name, text] : is_report ? options_of_report(path, command) : values_in(path, command)) {
        const OptionSpec* const option = find_option(name);
        if (!option || !(option->commands & command.command) || name == "config")
            throw Error(ErrorCode::kUsage, path + ": " + no_such_option(command, name));
        if (has(typed, name)) continue;
        require_value(path, *option, text);
        values.emplace_back(name, text);
    }
}

void require_complete(const OptionValues& values, const CommandSpec& command) {
    for (const OptionSpec& option : option_table())
        if ((option.commands & command.command) && (option.is_argument || option.is_required) &&
            !has(values, option.name))
            throw Error(ErrorCode::kUsage,
                        option.flag() + " is required; see regionmesh " + std::string(command.name) + " --help");
}

}  // namespace regionmesh::cli
