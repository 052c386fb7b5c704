// The command line and its page against the table of options.
#include "regionmesh/options.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "cli/program.h"
#include "formats/registry.h"
#include "support/paths.h"

namespace regionmesh {
namespace {

using testing::HasSubstr;

/// A value of an option of text.
std::string text_value(const std::string& name) {
    if (name == "config") return "none.toml";
    if (name == "type") return "uint8";
    if (name == "roi") return "0:4,:,2:";
    if (name == "box") return "0:4.5,:,2:";
    if (name == "labels") return "1,5-9";
    if (name == "downsample") return "2,2,1";
    if (name == "threshold") return "1,2.5";
    return "X,Y,Z,LABEL";
}

/// A value that the option takes; empty for flags.
std::string good_value(const OptionSpec& option) {
    if (!option.default_text.empty()) return option.default_text;
    if (option.name == "log") return "/dev/null";  // written before the run ends
    switch (option.kind) {
        case OptionKind::kCount:
        case OptionKind::kLabel:
            return "1";
        case OptionKind::kNumber:
            return "0.2";
        case OptionKind::kShare:
            return "50%";
        case OptionKind::kBytes:
            return "1GiB";
        case OptionKind::kCounts:
        case OptionKind::kNumbers:
            return "1,2,3";
        case OptionKind::kFlag:
            return "";
        case OptionKind::kText:
            return text_value(option.name);
        case OptionKind::kWord:
            return std::string(option.words.front());
        case OptionKind::kFile:
            break;
    }
    return "none.json";
}

/// An input that the option applies to; none of them exists.
std::string input_for(const OptionSpec& option) {
    if (option.name == "array") return "none.vti";
    return option.inputs & kVolumeInput ? "none.npy" : option.inputs & kTableInput ? "none.csv" : "none.vtu";
}

class CliOptions : public Program {
protected:
    /// A command line of the command with the option that fails for its inputs only.
    std::string arguments(const CommandSpec& command, const OptionSpec& option, const std::string& value) const {
        std::string line(command.name);
        for (const OptionSpec& other : option_table()) {
            if ((other.commands & command.command) == 0 || &other == &option) continue;
            if (other.is_argument) line += ' ' + (other.name == "to" ? out("m.vtp") : path(input_for(option)).string());
            if (other.is_required) line += " --" + other.name + ' ' + out(other.is_output ? "m.vtp" : "none.npy");
        }
        if (command.command == kDecimate && option.name != "target-faces" && option.name != "reduce")
            line += " --target-faces 10";
        if (command.command == kRemesh && option.name != "edge-length") line += " --edge-length 2";
        if (option.inputs != kAnyInput && command.command == kCheck && option.name != "sections")
            line += " --sections " + path(input_for(option)).string();
        if (option.name == "terrain") line += " --layers auto";
        if (option.name == "surveys") line += " --collars " + path("none.csv").string();
        line += option.is_argument ? "" : " --" + option.name;
        return value.empty() ? line : line + (option.name == "output" ? ' ' + out(value) : ' ' + value);
    }

    template <class Visit>
    static void for_commands_and_options(Visit&& visit) {
        for (const CommandSpec& command : command_table())
            for (const OptionSpec& option : option_table())
                if ((option.commands & command.command) != 0) visit(command, option);
    }
};

TEST_F(CliOptions, the_page_is_that_of_the_table) {
    for (const formats::Format& format : formats::all_formats())
        if (!format.part.is_built) GTEST_SKIP() << "the help lists fewer formats";
    std::ifstream stream(test::source_folder() + "/docs/reference/command-line.md");
    const std::string page{std::istreambuf_iterator<char>(stream), {}};
    EXPECT_TRUE(page == command_line_page())
        << "write it again: regionmesh --help-markdown > docs/reference/command-line.md";
    const Ran ran = run("--help-markdown");
    EXPECT_EQ(ran.code, 0);
    EXPECT_TRUE(ran.out == page);
    for (const OptionSpec& option : option_table()) EXPECT_THAT(page, HasSubstr('`' + option.flag() + '`'));
}

TEST_F(CliOptions, the_short_help_has_what_most_runs_need_and_says_where_the_rest_is) {
    for (const CommandSpec& command : command_table()) {
        SCOPED_TRACE(command.name);
        const Ran ran = run("help " + std::string(command.name));
        EXPECT_EQ(ran.code, 0);
        EXPECT_EQ(ran.out, run(std::string(command.name) + " --help").out);
        EXPECT_THAT(ran.out, HasSubstr("--help-all lists all "));
        for (const OptionSpec& option : option_table()) {
            if ((option.commands & command.command) == 0 || option.is_argument) continue;
            EXPECT_EQ(ran.out.find(option.flag() + ' ') != std::string::npos, option.is_basic) << option.name;
        }
    }
    EXPECT_EQ(run("help").out, run("--help").out);
    EXPECT_EQ(run("help nothing").code, 2);
}

TEST_F(CliOptions, help_all_shows_every_option_with_its_group_range_and_default) {
    for (const CommandSpec& command : command_table()) {
        const Ran ran = run(std::string(command.name) + " --help-all");
        EXPECT_EQ(ran.code, 0);
        EXPECT_THAT(ran.out, HasSubstr("Example: regionmesh " + std::string(command.name) + ' '));
        EXPECT_THAT(ran.out, HasSubstr("Lengths are in the unit of"));
        EXPECT_THAT(ran.out, testing::Not(HasSubstr(" TEXT")));
        for (const OptionSpec& option : option_table()) {
            if ((option.commands & command.command) == 0) continue;
            SCOPED_TRACE(std::string(command.name) + ' ' + option.name);
            EXPECT_THAT(ran.out, HasSubstr(option.flag()));
            EXPECT_THAT(ran.out, HasSubstr(std::string(option.help)));
            const std::string heading = option.is_argument ? "Positionals" : std::string(option.group);
            EXPECT_THAT(ran.out, HasSubstr(heading + ":\n"));
            const std::string shown = option.default_text.empty() ? "" : "default " + option.default_text + ')';
            EXPECT_THAT(ran.out, HasSubstr(shown));
            EXPECT_THAT(ran.out, HasSubstr(option.range));
        }
    }
}

TEST_F(CliOptions, every_option_is_accepted_by_its_commands_and_no_other) {
    int count = 0;
    for_commands_and_options([&](const CommandSpec& command, const OptionSpec& option) {
        ++count;
        expect_refusal(arguments(command, option, good_value(option)), 1, "");
    });
    EXPECT_GT(count, 100);
    for (const CommandSpec& command : command_table())
        for (const OptionSpec& option : option_table())
            if ((option.commands & command.command) == 0 && !option.is_argument && option.kind == OptionKind::kFlag)
                expect_refusal(arguments(command, option, ""), 2, option.flag());
}

TEST_F(CliOptions, wrong_values_are_exit_2_in_one_line) {
    for_commands_and_options([&](const CommandSpec& command, const OptionSpec& option) {
        const bool is_name = option.kind == OptionKind::kLabel && option.repeats;  // of a label
        const bool takes_any_text = is_name || option.kind == OptionKind::kFile || option.kind == OptionKind::kText;
        if (takes_any_text || option.kind == OptionKind::kFlag) return;
        expect_refusal(arguments(command, option, "wrong"), 2, option.flag() + " wrong: not ");
    });
}

}  // namespace
}  // namespace regionmesh
