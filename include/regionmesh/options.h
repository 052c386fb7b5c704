// Every option of the programs, declared once. The command line, its page in docs/ and bindings are built from this.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "regionmesh/compare.h"
#include "regionmesh/mesh_file.h"
#include "regionmesh/page.h"
#include "regionmesh/prepare_sections.h"
#include "regionmesh/read_layers.h"
#include "regionmesh/read_sections.h"
#include "regionmesh/read_tetrahedra.h"
#include "regionmesh/reconstruct.h"
#include "regionmesh/sandbox.h"

namespace regionmesh {

/// The name and the text of each option that is set: {"reduce", "90%"}. A flag has the text "true" or "false".
using OptionValues = std::vector<std::pair<std::string, std::string>>;

/// The settings of a command. A default-constructed struct holds the defaults of all options.
struct Settings {
    std::vector<std::string> inputs;    // volume, sections, table or mesh to reconstruct
    std::vector<std::string> models;    // surfaces to read: one, or two to compare
    std::vector<std::string> sections;  // the input to check a model against, or to voxelise it like
    ReadOptions volume;
    PrepareOptions prepare{.between =
                               std::nullopt};  // of sections that are modelled; its threads are those of reconstruct
    TetrahedraOptions tetrahedra;
    std::string layers;   // LayerOptions::units; empty: drill holes become tetrahedra, not layers
    std::string terrain;  // LayerOptions::terrain
    ReadMeshOptions surface;
    bool hull = false;

    ReconstructOptions reconstruct{.denoise = {}};  // the other commands copy from it what they need
    std::optional<double> scale;                    // unit of nifpms in smooth; none: the mean edge length
    std::uint64_t samples = CompareOptions{}.samples;

    InputLabel outside = 0;  // of samples in no region, when a model is voxelised

    std::optional<double> metres;  // in a unit of length of the input

    std::string write_labels;                                                                          // file
    std::string output, names, report, json, distance, html, regions, interfaces, lines, log, config;  // files
    std::uint32_t preview_faces = PageOptions{}.preview_faces;
    OutputOptions writing;
    bool precomputed_is_legacy = false, precomputed_is_sharded = false;  // as PrecomputedOptions has them
    std::uint32_t precomputed_levels = 0;
    bool per_region = false, ascii = false, list_all = false, quiet = false, verbose = false;
    bool sandbox = true, needs_sandbox = false;     // confine the program; end where the kernel cannot
    std::optional<std::uint32_t> block_cells = {};  // BlockOptions::block_cells; the output is then a folder
    bool memory_is_hard = false;                    // the program ends rather than exceed reconstruct.memory

    OptionValues given;     // set by apply_options(), without flags that are "false"
    OptionValues deferred;  // those of `given` with names of labels or units of length: resolve_options() sets them
};

/// Kind of the value of an option: how it is written as text, and its type in a binding.
enum class OptionKind {
    kFlag,     // no value on the command line; bool
    kCount,    // whole number
    kNumber,   // floating point
    kShare,    // 0.9 or 90%
    kBytes,    // 2GiB, 500MB, 1000000
    kWord,     // one of OptionSpec::words
    kLabel,    // integer of 64 bits, signed or unsigned
    kCounts,   // three whole numbers X,Y,Z
    kNumbers,  // three numbers X,Y,Z
    kText,
    kFile,
};

/// Commands as bits.
enum Command : std::uint32_t {
    kReconstruct = 1,
    kDecimate = 2,
    kSmooth = 4,
    kCheck = 8,
    kConvert = 16,
    kCompare = 32,
    kInfo = 64,
    kVoxelise = 128,
    kView = 256,
    kRemesh = 512,
};

/// Kinds of input as bits.
enum InputKind : std::uint32_t { kVolumeInput = 1, kTableInput = 2, kMeshInput = 4, kAnyInput = 7 };

/// One option, or one argument without a flag.
struct OptionSpec {
    std::string name;                  // "min-quality"; the flag is --min-quality
    bool is_basic = false;             // in the short help
    std::string_view help;             // one line, without default, unit and range
    std::string_view group;            // heading in help texts
    std::uint32_t commands = 0;        // that take it
    std::string_view unit = {};        // of the value; empty: none
    std::string_view value = {};       // placeholder in help texts; empty: that of the kind
    std::uint32_t inputs = kAnyInput;  // refused with inputs of other kinds
    bool is_argument = false;          // has no flag; required, in the order of the table
    bool is_required = false;
    bool repeats = false;    // set() adds a value
    bool is_output = false;  // a file that the command writes
    char letter = 0;         // short flag; 0: none

    // These follow from the member of Settings that the option is bound to.
    OptionKind kind = OptionKind::kFlag;
    std::string range = {};                    // "0 to 1"; empty: any value of the kind
    std::vector<std::string_view> words = {};  // of kWord
    std::string default_text = {};             // as typed; empty: none
    /// Throws Error(kUsage) with one line for a text that is not a value of the kind or is outside the range.
    std::function<void(Settings&, const std::string&)> set = {};

    std::string flag() const { return is_argument ? name : "--" + name; }
};

/// One command of the program.
struct CommandSpec {
    Command command;
    std::string_view name, help, example;
};

/// All commands, in the order of help texts.
const std::vector<CommandSpec>& command_table();

/// All options, by group.
const std::vector<OptionSpec>& option_table();

/// The option of that name, without dashes; null where there is none.
const OptionSpec* find_option(std::string_view name);

/// Sets options in the order of the table, whatever the order of `values`. Throws Error(kUsage) for an unknown name and
/// for options that contradict each other, and what OptionSpec::set throws.
void apply_options(Settings& settings, const OptionValues& values);

/// Sets the options that are deferred: a name becomes its labels (all that have it, in any case of letters), and a
/// length with a unit one in the unit of the input, of `metres`. `source` is the input, in messages. Throws
/// Error(kUsage) for a name that no label has, and for a unit where that of the input is not known.
void resolve_options(Settings& settings, const LabelNames& names, std::optional<double> metres,
                     const std::string& source);

/// Where no target is given, faces that cost nothing are removed: the largest error, as a share of the finest spacing.
inline constexpr double kFreeError = 0.05;

/// `settings.reconstruct` for a volume with this spacing: with kFreeError as free error where no target is given and
/// decimation is not turned off.
ReconstructOptions with_free_target(const Settings& settings, const Vec3& spacing);

/// Whether --smooth asks for what the default does anyway where samples have these distances: strong for far sections.
bool is_usual_smoothing(const Settings& settings, const Vec3& spacing);

/// Whether with_free_target() sets a largest error.
bool has_free_target(const Settings& settings);

/// Throws Error(kUsage) where two options contradict each other, whatever the input.
void require_consistent(const Settings& settings);

/// Throws Error(kUsage) where a file that the run writes is one that it reads, or is written twice: whatever their
/// names and links, and with the files that belong to a model. A model may be smoothed or decimated in place. Looks at
/// the files; changes nothing.
void require_distinct_files(const Settings& settings);

/// The file that an input is in: file.h5 for the dataset file.h5:/path, else the input itself.
std::filesystem::path file_of_input(const std::string& input);

/// What the process of a command needs to do: read anything, write below the folders of its outputs and in that of
/// temporary files, start the helper programs. Looks at the files.
SandboxRules sandbox_rules(const Settings& settings);

/// The text of an option that was given; null where it was not.
const std::string* given_text(const Settings& settings, std::string_view name);

/// Whether --background or --no-background is given: a model file may say what its background is.
bool has_background(const Settings& settings);

/// Whether a target is given: faces, a share of them, or an error.
bool has_target(const Settings& settings);

/// `known`, with the unit of --units where it is given, and the space of --space where none is known.
Coordinates with_units_and_space(const Settings& settings, Coordinates known);

/// The target of a whole model in faces; all of them where none is given.
std::uint32_t target_faces(const Settings& settings, const Mesh& mesh);

/// How to read drill holes as layers.
LayerOptions layer_options(const Settings& settings);

/// Whether the input is a lattice of samples: a volume, or drill holes as layers.
bool is_lattice(const Settings& settings, const std::vector<std::string>& inputs);

/// Opens such an input.
std::unique_ptr<SectionReader> open_lattice(const Settings& settings, const std::vector<std::string>& inputs);

/// The same, prepared as Settings::prepare says, to be modelled.
PreparedSections open_prepared(const Settings& settings, const std::vector<std::string>& inputs);

/// The kind of the input, by the name of its first file.
InputKind kind_of_input(const std::vector<std::string>& inputs);

/// Throws Error(kUsage) where an option that was given does not apply to the input, or for two tables or meshes.
void require_fit(const Settings& settings, const std::vector<std::string>& inputs);

/// Throws Error(kUsage) for options that some kinds of input alone take: for a check without sections.
void require_no_input_options(const Settings& settings);

/// The options in a report, which the same command takes again: `options` of report_json(). Throws Error(kInput) for a
/// file that is no report, and Error(kUsage) for the report of another command.
OptionValues options_of_report(const std::string& path, const CommandSpec& command);

/// Placeholder of the value in help texts: "COUNT", "auto|x|y|z"; empty for flags.
std::string value_name(const OptionSpec& option);

/// "lowest quality of a face (faces; at least 0; default 0.1)": help, unit, range and default.
std::string description_of(const OptionSpec& option);

/// "reconstruct, info": the commands of a set of bits.
std::string names_of_commands(std::uint32_t commands);

/// A page for man(1), in the language of groff.
std::string manual_page();

/// A script with which the shell "bash", "zsh" or "fish" completes commands, options and words. Throws Error(kUsage)
/// for another shell.
std::string completion_script(const std::string& shell);

/// The text of docs/reference/command-line.md.
std::string command_line_page();

}  // namespace regionmesh
