#include "command_line.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "blocks.h"
#include "config_file.h"
#include "input.h"
#include "messages.h"
#include "regionmesh/error.h"
#include "regionmesh/output_file.h"

namespace regionmesh::cli {
namespace {

constexpr const char* kUnits =
    "Lengths are in the unit of the input's spacing or points. Exit codes: 0 good, 1 bad input, 2 usage, 3 violations, "
    "4 sound but volumes not met.";

/// Where CLI11 puts the texts of one option.
struct Texts {
    const OptionSpec* spec = nullptr;
    CLI::Option* option = nullptr;
    std::vector<std::string> many;
    std::string one;
    bool flag = false;

    void append_to(OptionValues& values) const {
        if (option->count() == 0) return;
        if (spec->repeats)
            for (const std::string& text : many) values.emplace_back(spec->name, text);
        else
            values.emplace_back(spec->name, spec->kind == OptionKind::kFlag ? (flag ? "true" : "false") : one);
    }
};

void add_option(CLI::App& command, const OptionSpec& spec, const Typed& typed, Texts& texts) {
    texts.spec = &spec;
    const std::string flags = spec.letter ? std::string{'-', spec.letter} + ',' + spec.flag() : spec.flag();
    const std::string description = description_of(spec);
    if (spec.kind == OptionKind::kFlag)
        texts.option = command.add_flag(flags, texts.flag, description);
    else if (spec.repeats)
        texts.option = command.add_option(flags, texts.many, description);
    else
        texts.option = command.add_option(flags, texts.one, description);
    // So that "--background 0 scan.nii.gz" leaves the input alone.
    if (spec.kind == OptionKind::kLabel) texts.option->allow_extra_args(false);
    if (spec.kind != OptionKind::kFlag) texts.option->type_name(spec.is_argument ? "" : value_name(spec));
    const bool is_shown = typed.wants_all || spec.is_basic;
    if (!spec.is_argument) texts.option->group(is_shown ? std::string(spec.group) : "");
    texts.option->required((spec.is_argument || spec.is_required) && !typed.has_config);
}

/// Before the first thread of the work starts, so that all are confined. Returns what the kernel enforces.
std::optional<SandboxState> confine(const Settings& settings, std::uint32_t command) {
    make_block_folder(settings, command);
    if (!settings.sandbox) return std::nullopt;
    SandboxRules rules = sandbox_rules(settings);
    for (const std::filesystem::path& folder : made_folders())
        rules.emptied.push_back(folder.has_parent_path() ? folder.parent_path() : ".");
    const SandboxState state = enter_sandbox(rules);
    if (settings.needs_sandbox && !(state.files && state.calls))
        throw Error(ErrorCode::kInput, std::string("--require-sandbox: this kernel has no ") +
                                           (state.files ? "seccomp" : "Landlock") +
                                           "; use another kernel, or leave the option out");
    return state;
}

void say_confined(const std::optional<SandboxState>& state) {
    if (!state) return;
    say_more("sandbox: {}, {}", state->files ? "files are restricted" : "this kernel has no Landlock",
             state->calls ? "system calls are filtered" : "this kernel has no seccomp");
}

}  // namespace

/// The options that the short help leaves out, by name, in lines; empty where there are none.
std::string other_options(const CommandSpec& command) {
    constexpr std::size_t kWidth = 110;
    std::string text, line;
    for (const OptionSpec& option : option_table()) {
        if ((option.commands & command.command) == 0 || option.is_argument || option.is_basic) continue;
        if (line.size() + option.flag().size() > kWidth) text += std::exchange(line, "") + ",\n";
        line += (line.empty() ? "" : ", ") + option.flag();
    }
    return line.empty() ? text : "Others: " + text + line + ".\n";
}

void add_command(CLI::App& app, const CommandSpec& command, int (*run)(const Settings&), const Typed& typed,
                 Action& action) {
    const auto all = std::make_shared<std::vector<std::unique_ptr<Texts>>>();
    CLI::App& subcommand = *app.add_subcommand(std::string(command.name), std::string(command.help));
    const auto has = [&](const OptionSpec& spec) { return (spec.commands & command.command) != 0; };
    std::string more;
    if (!typed.wants_all)
        more = other_options(command) + "regionmesh " + std::string(command.name) + " --help-all lists all " +
               std::to_string(std::ranges::count_if(option_table(), has)) + " options.\n";
    subcommand.footer(more + "Example: " + std::string(command.example) + '\n' + kUnits);
    for (const OptionSpec& spec : option_table()) {
        if (!has(spec)) continue;
        add_option(subcommand, spec, typed, *all->emplace_back(std::make_unique<Texts>()));
    }
    subcommand.callback([all, run, &command, &action] {
        action = [all, run, &command] {
            OptionValues values;
            for (const auto& texts : *all) texts->append_to(values);
            add_config(values, command);
            require_complete(values, command);
            Settings settings;
            apply_options(settings, values);
            require_distinct_files(settings);
            silence_others(settings);
            begin_messages(command.command, settings);
            try {
                const std::optional<SandboxState> confined = confine(settings, command.command);
                remove_outputs_on_signals();  // its thread is confined, too
                resolve_by_input(settings);
                const int code = run(settings);
                say_confined(confined);
                return code;
            } catch (...) {
                remove_empty_folders();
                throw;
            }
        };
    });
}

}  // namespace regionmesh::cli
