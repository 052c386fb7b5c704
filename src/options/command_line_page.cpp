// The reference of the command line in Markdown.
#include <fmt/core.h>

#include <algorithm>

#include "regionmesh/options.h"

namespace regionmesh {
namespace {

constexpr std::string_view kHead = R"(# The command line

This page is written by the program: `regionmesh --help-markdown > docs/reference/command-line.md`.
`regionmesh COMMAND --help` prints the same for one command.

```
)";

constexpr std::string_view kConventions = R"(```

- Exit codes: 0 good; 1 the input cannot be used, or the output cannot be written; 2 usage: an unknown option, a value
  that the option does not take, or options that contradict each other; 3 the model has violations;
  4 `--preserve-volume` left a region off its volume.
- An error is one line on stderr: what is wrong, where, and what to do. A run that fails before its results are complete
  leaves no file behind.
- Progress is shown on a terminal only. The summary goes to stdout; `--quiet` suppresses both. A file to write may be a
  device or a pipe: `check model.vtp --quiet --json /dev/stdout | jq .violation_counts`.
- *Length* is the unit of the spacing of a volume, or of the points of a surface.
- A share is `90%` or `0.9`. A size in bytes has the unit B, kB, MB, GB, KiB, MiB, GiB, or none.
- An option is given once; one marked with "..." takes several values, and may be repeated.
- `--config run.toml` reads options from a file, such as `reduce = "90%"`, `background = [0, 7]`, `quiet = true` and
  `input = ["scan.nii.gz"]`; a table `[reconstruct]` holds those of that command. `--config report.json` takes the options of
  the run that wrote the report; give `--report` another file. An option on the command line replaces the same one of the
  file; one that contradicts another one of the file is refused. Paths are relative to the current folder.
- The result depends on the input and the options only, not on the number of threads.
)";

std::string usage(const CommandSpec& command) {
    std::string line = fmt::format("regionmesh {}", command.name);
    for (const OptionSpec& option : option_table()) {
        if (!(option.commands & command.command)) continue;
        if (option.is_argument) {
            std::string name = option.name;
            std::ranges::transform(name, name.begin(), [](unsigned char c) { return std::toupper(c); });
            line += ' ' + name + (option.repeats ? "..." : "");
        } else if (option.is_required) {
            line += fmt::format(" {}{} {}", option.letter ? "-" : "--",
                                option.letter ? std::string(1, option.letter) : option.name, value_name(option));
        }
    }
    return line + " [OPTIONS]";
}

/// Text for a cell of a table.
std::string escaped(std::string text) {
    for (std::size_t at = 0; (at = text.find('|', at)) != std::string::npos; at += 2) text.insert(at, 1, '\\');
    return text;
}

std::string row_text(const OptionSpec& option) {
    const std::string letter = option.letter ? fmt::format("`-{}`, ", option.letter) : "";
    const std::string value = value_name(option);
    std::string text = fmt::format("| {}`{}`{}{}{} | {}", letter, option.flag(), value.empty() ? "" : " ",
                                   escaped(value), option.repeats ? " ..." : "", escaped(std::string(option.help)));
    if (!option.unit.empty()) text += fmt::format(" ({})", option.unit);
    const std::string none = option.is_required ? "required" : "";
    return text + fmt::format(" | {} | {} | {} |\n", option.range,
                              option.default_text.empty() ? none : '`' + option.default_text + '`',
                              names_of_commands(option.commands));
}

}  // namespace

std::string command_line_page() {
    std::string page(kHead);
    for (const CommandSpec& command : command_table()) page += usage(command) + '\n';
    page += kConventions;
    page += "\n## Commands\n\n| command | purpose | example |\n|---|---|---|\n";
    for (const CommandSpec& command : command_table())
        page += fmt::format("| `{}` | {} | `{}` |\n", command.name, command.help, command.example);
    std::string_view group;
    for (const OptionSpec& option : option_table()) {
        if (option.group != group)
            page += fmt::format("\n## {}\n\n| option | meaning | range | default | commands |\n|---|---|---|---|---|\n",
                                option.group);
        group = option.group;
        page += row_text(option);
    }
    return page;
}

}  // namespace regionmesh
