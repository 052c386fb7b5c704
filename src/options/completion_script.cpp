// Scripts with which shells complete the command line.
#include <fmt/core.h>

#include "regionmesh/error.h"
#include "regionmesh/options.h"

namespace regionmesh {
namespace {

std::string joined(const std::vector<std::string_view>& words) {
    std::string text;
    for (const std::string_view word : words) text += (text.empty() ? "" : " ") + std::string(word);
    return text;
}

std::string command_names() {
    std::vector<std::string_view> names;
    for (const CommandSpec& command : command_table()) names.push_back(command.name);
    return joined(names);
}

/// Calls visit(option) for the options with a flag that the command takes.
template <class Visit>
void for_flags(const CommandSpec& command, Visit&& visit) {
    for (const OptionSpec& option : option_table())
        if ((option.commands & command.command) != 0 && !option.is_argument) visit(option);
}

std::string flags_of(const CommandSpec& command) {
    std::string flags = "--help";
    for_flags(command, [&](const OptionSpec& option) { flags += ' ' + option.flag(); });
    return flags;
}

std::string bash() {
    std::string text = R"(# bash completion of regionmesh
_regionmesh() {
    local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]} words=
    if [ "$COMP_CWORD" -eq 1 ]; then
)";
    text +=
        fmt::format("        COMPREPLY=($(compgen -W \"{} --help --version\" -- \"$word\"))\n        return\n    fi\n",
                    command_names());
    text += "    case $before in\n";
    for (const OptionSpec& option : option_table())
        if (!option.words.empty())
            text += fmt::format("        {}) words=\"{}\" ;;\n", option.flag(), joined(option.words));
    text += "    esac\n    if [ -z \"$words\" ] && [[ $word == -* ]]; then\n        case ${COMP_WORDS[1]} in\n";
    for (const CommandSpec& command : command_table())
        text += fmt::format("            {}) words=\"{}\" ;;\n", command.name, flags_of(command));
    return text + R"(        esac
    fi
    if [ -n "$words" ]; then COMPREPLY=($(compgen -W "$words" -- "$word")); else mapfile -t COMPREPLY < <(compgen -f -- "$word"); fi
}
complete -o filenames -F _regionmesh regionmesh
)";
}

/// Text for a string in single quotes, with the letters that _arguments gives a meaning made harmless.
std::string zsh_text(std::string_view text) {
    std::string all;
    for (const char c : text) {
        if (c == '\'')
            all += "'\\''";
        else if (c == '[' || c == ']' || c == ':' || c == '\\')
            all += std::string("\\") + c;
        else
            all += c;
    }
    return all;
}

std::string zsh() {
    std::string text =
        "#compdef regionmesh\n# zsh completion of regionmesh\n_regionmesh() {\n    if (( CURRENT == 2 )); then\n"
        "        local -a commands=(\n";
    for (const CommandSpec& command : command_table())
        text += fmt::format("            '{}:{}'\n", command.name, zsh_text(command.help));
    text +=
        "        )\n        _describe command commands\n        return\n    fi\n    local command=$words[2]\n    shift "
        "words\n    (( CURRENT-- ))\n    case $command in\n";
    for (const CommandSpec& command : command_table()) {
        text += fmt::format("        {}) _arguments", command.name);
        for_flags(command, [&](const OptionSpec& option) {
            const std::string value = option.kind == OptionKind::kFlag ? ""
                                      : option.words.empty()
                                          ? (option.kind == OptionKind::kFile ? ":file:_files" : ":value:")
                                          : ":value:(" + joined(option.words) + ")";
            text += fmt::format(" \\\n            '{}{}[{}]{}'", option.repeats ? "*" : "", option.flag(),
                                zsh_text(option.help), value);
        });
        text += " \\\n            '*:file:_files' ;;\n";
    }
    return text + "    esac\n}\n_regionmesh \"$@\"\n";
}

std::string fish() {
    std::string text = "# fish completion of regionmesh\n";
    const auto quoted = [](std::string_view help) {
        std::string all;
        for (const char c : help) all += c == '\'' || c == '\\' ? std::string("\\") + c : std::string(1, c);
        return '\'' + all + '\'';
    };
    for (const CommandSpec& command : command_table())
        text += fmt::format("complete -c regionmesh -n __fish_use_subcommand -f -a {} -d {}\n", command.name,
                            quoted(command.help));
    for (const CommandSpec& command : command_table())
        for_flags(command, [&](const OptionSpec& option) {
            text += fmt::format("complete -c regionmesh -n '__fish_seen_subcommand_from {}' -l {}", command.name,
                                option.name);
            if (option.letter) text += fmt::format(" -s {}", option.letter);
            if (option.kind != OptionKind::kFlag) text += option.kind == OptionKind::kFile ? " -r" : " -x";
            if (!option.words.empty()) text += " -a " + quoted(joined(option.words));
            text += " -d " + quoted(option.help) + '\n';
        });
    return text;
}

}  // namespace

std::string completion_script(const std::string& shell) {
    if (shell == "bash") return bash();
    if (shell == "zsh") return zsh();
    if (shell == "fish") return fish();
    throw Error(ErrorCode::kUsage, "--completion " + shell + ": not one of bash, zsh, fish");
}

}  // namespace regionmesh
