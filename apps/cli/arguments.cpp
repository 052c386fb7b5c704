#include "arguments.h"

#include <fmt/core.h>

#include <algorithm>
#include <filesystem>
#include <numeric>
#include <string_view>
#include <system_error>
#include <utility>

namespace regionmesh::cli {
namespace {

/// "3", "-1", "0,5-9".
bool looks_like_labels(const std::string& text) {
    std::error_code ignored;
    return !text.empty() && text.find_first_not_of("0123456789,-") == std::string::npos &&
           text.find_first_of("0123456789") < 2 && !std::filesystem::exists(text, ignored);
}

bool takes_labels(const std::string& flag) {
    const OptionSpec* const option = flag.starts_with("--") ? find_option(flag.substr(2)) : nullptr;
    return option && option->kind == OptionKind::kLabel && option->repeats;
}

/// Letters to insert, to delete, to replace, or to swap with their neighbour.
std::size_t edits_between(std::string_view a, std::string_view b) {
    std::vector<std::size_t> before, last(b.size() + 1), row(b.size() + 1);
    std::iota(last.begin(), last.end(), std::size_t{0});
    for (std::size_t i = 0; i < a.size(); ++i) {
        row[0] = i + 1;
        for (std::size_t j = 0; j < b.size(); ++j) {
            row[j + 1] = std::min({last[j + 1] + 1, row[j] + 1, last[j] + (a[i] != b[j])});
            if (i > 0 && j > 0 && a[i] == b[j - 1] && a[i - 1] == b[j])
                row[j + 1] = std::min(row[j + 1], before[j - 1] + 1);
        }
        before = last;
        last = row;
    }
    return last.back();
}

/// "; did you mean reduce?", or nothing where no word is near.
std::string guess(std::string_view typed, const std::vector<std::string>& words) {
    const std::size_t most = std::max<std::size_t>(1, typed.size() / 3);
    const auto nearest =
        std::ranges::min_element(words, {}, [&](const auto& word) { return edits_between(typed, word); });
    if (nearest != words.end() && edits_between(typed, *nearest) <= most) return "; did you mean " + *nearest + '?';
    const auto longer = std::ranges::find_if(words, [&](const auto& word) { return word.starts_with(typed); });
    return longer == words.end() ? "" : "; did you mean " + *longer + '?';
}

std::vector<std::string> command_names() {
    std::vector<std::string> names;
    for (const CommandSpec& command : command_table()) names.emplace_back(command.name);
    return names;
}

std::vector<std::string> flags_of(const CommandSpec& command) {
    std::vector<std::string> flags{"--help", "--help-all"};
    for (const OptionSpec& option : option_table())
        if ((option.commands & command.command) != 0 && !option.is_argument) flags.push_back(option.flag());
    return flags;
}

std::string unknown_option(const CommandSpec& command, const std::vector<std::string>& arguments) {
    const std::vector<std::string> flags = flags_of(command);
    for (const std::string& argument : arguments) {
        if (argument == "--") break;
        const std::string flag = argument.substr(0, argument.find('='));
        if (!flag.starts_with("--") || std::ranges::find(flags, flag) != flags.end()) continue;
        return no_such_option(command, flag);
    }
    return {};
}

/// "help reconstruct" as "reconstruct --help"; a command that does not exist is left for its message.
std::vector<std::string> with_help_last(std::vector<std::string> arguments) {
    if (arguments.empty() || arguments.front() != "help") return arguments;
    arguments.erase(arguments.begin());
    const bool is_command = arguments.empty() || arguments.front().starts_with('-') ||
                            std::ranges::count(command_names(), arguments.front()) > 0;
    if (is_command) arguments.emplace_back("--help");
    return arguments;
}

}  // namespace

std::vector<std::string> arguments_of(int argc, char** argv) {
    const std::vector<std::string> typed(argv + std::min(argc, 1), argv + argc);
    std::vector<std::string> arguments;
    bool is_value = false, is_label = false;  // of an option of labels: the next argument, and the last one
    for (const std::string& text : typed) {
        if (is_label && looks_like_labels(text)) {
            arguments.back() += ',' + text;
            continue;
        }
        arguments.push_back(text);
        is_label = is_value && looks_like_labels(text);
        is_value = takes_labels(text);
    }
    return with_help_last(std::move(arguments));
}

std::string no_such_option(const CommandSpec& command, const std::string& name) {
    std::vector<std::string> names = flags_of(command);
    if (!name.starts_with("--"))
        for (std::string& flag : names) flag.erase(0, 2);
    return fmt::format("{}: {} has no such option{}", name, command.name, guess(name, names));
}

const CommandSpec* command_in(const std::vector<std::string>& arguments) {
    if (arguments.empty()) return nullptr;
    const auto found = std::ranges::find(command_table(), arguments.front(), &CommandSpec::name);
    return found == command_table().end() ? nullptr : &*found;
}

std::string unknown_word(const std::vector<std::string>& arguments) {
    if (const CommandSpec* const command = command_in(arguments)) return unknown_option(*command, arguments);
    std::string list;
    for (const std::string& name : command_names()) list += (list.empty() ? "" : ", ") + name;
    if (arguments.empty()) return "give a command: " + list;
    if (arguments.front().starts_with('-')) return {};
    const std::string meant = guess(arguments.front(), command_names());
    return fmt::format("{}: there is no such command{}", arguments.front(), meant.empty() ? "; give " + list : meant);
}

}  // namespace regionmesh::cli
