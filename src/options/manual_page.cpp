// The page for man(1).
#include <fmt/core.h>

#include <algorithm>
#include <cctype>

#include "regionmesh/options.h"

namespace regionmesh {
namespace {

/// Text for groff: its own letters escaped.
std::string escaped(std::string_view text) {
    std::string all;
    for (const char c : text) {
        if (c == '\\')
            all += "\\e";
        else if (c == '-')
            all += "\\-";
        else
            all += c;
    }
    if (!all.empty() && (all[0] == '.' || all[0] == '\'')) all.insert(0, "\\&");
    return all;
}

std::string upper(std::string text) {
    std::ranges::transform(text, text.begin(), [](unsigned char c) { return std::toupper(c); });
    return text;
}

std::string usage(const CommandSpec& command) {
    std::string line = fmt::format(".B regionmesh {}\n", command.name);
    for (const OptionSpec& option : option_table()) {
        if (!(option.commands & command.command)) continue;
        if (option.is_argument)
            line += fmt::format(".I {}{}\n", upper(option.name), option.repeats ? "..." : "");
        else if (option.is_required)
            line += fmt::format(".BI \\-\\-{} \" {}\"\n", escaped(option.name), value_name(option));
    }
    return line + ".RI [ OPTIONS ]\n.br\n";
}

std::string entry(const OptionSpec& option) {
    const std::string letter = option.letter ? fmt::format("\\-{}, ", option.letter) : "";
    const std::string flag = option.is_argument ? upper(option.name) : letter + escaped(option.flag());
    std::string text = fmt::format(".TP\n\\fB{}\\fR \\fI{}\\fR\n", flag, escaped(value_name(option)));
    text += escaped(description_of(option)) + ".\nFor " + names_of_commands(option.commands) + ".\n";
    return text;
}

}  // namespace

std::string manual_page() {
    std::string page =
        ".TH REGIONMESH 1\n.SH NAME\nregionmesh \\- certified multi\\-region surface models from labelled "
        "sections\n.SH SYNOPSIS\n";
    for (const CommandSpec& command : command_table()) page += usage(command);
    page +=
        ".SH DESCRIPTION\nReads labelled planar sections, points or tetrahedra, and writes one surface model of all "
        "regions.\n.SH COMMANDS\n";
    for (const CommandSpec& command : command_table())
        page += fmt::format(".TP\n.B {}\n{}\n", command.name, escaped(command.help));
    std::string_view group;
    page += ".SH OPTIONS\n";
    for (const OptionSpec& option : option_table()) {
        if (option.group != group) page += fmt::format(".SS {}\n", escaped(option.group));
        group = option.group;
        page += entry(option);
    }
    return page +
           ".SH EXIT STATUS\n0: good. 1: the input cannot be used, or the output cannot be written. 2: usage. 3: "
           "the model has violations. 4: \\-\\-preserve\\-volume left a region off its volume.\n";
}

}  // namespace regionmesh
