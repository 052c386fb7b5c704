#include "page_output.h"

#include <algorithm>

#include "regionmesh/error.h"

namespace regionmesh::cli {
namespace {

/// In single quotes where a shell would not take the text as one word.
std::string quoted(const std::string& text) {
    constexpr std::string_view kPlain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=./,:%@";
    if (!text.empty() && text.find_first_not_of(kPlain) == std::string::npos) return text;
    std::string made = "'";
    for (const char letter : text) made += letter == '\'' ? std::string("'\\''") : std::string(1, letter);
    return made + "'";
}

const CommandSpec& spec_of(Command command) {
    return *std::ranges::find(command_table(), command, &CommandSpec::command);
}

}  // namespace

MadeBy made_by(Command command, const Settings& settings) {
    MadeBy made_by{.command = std::string(spec_of(command).name), .options = settings.given};
    std::erase_if(made_by.options, [](const auto& option) { return option.first == "config"; });
    return made_by;
}

std::string command_line_of(Command command, const Settings& settings) {
    std::string line = "regionmesh " + std::string(spec_of(command).name);
    for (const auto& [name, text] : made_by(command, settings).options) {
        const OptionSpec& option = *find_option(name);
        if (!option.is_argument) line += ' ' + option.flag();
        if (option.kind != OptionKind::kFlag) line += ' ' + quoted(text);
    }
    return line;
}

PageOptions page_options(Command command, const Settings& settings, std::string report, bool has_labels,
                         std::optional<double> quality_bound) {
    PageOptions options;
    options.command = spec_of(command).name;
    options.command_line = command_line_of(command, settings);
    options.report = std::move(report);
    options.has_labels = has_labels;
    options.boundary_is_open = !settings.reconstruct.cap;
    options.min_quality = quality_bound;
    const double most = settings.reconstruct.promises.max_error;
    if ((command == kReconstruct || command == kDecimate || command == kRemesh) && most < HUGE_VAL)
        options.max_error = most;
    options.preview_faces = settings.preview_faces;
    options.threads = settings.reconstruct.threads;
    return options;
}

void require_page(const std::string& path, const OutputOptions& options) {
    if (path.empty()) return;
    const std::string extension = std::filesystem::path(path).extension().string();
    if (extension != ".html" && extension != ".htm") throw Error(ErrorCode::kOutput, path + ": a page ends in .html");
    require_writable(path, options);
}

std::string title_of(const std::string& path) {
    const std::filesystem::path whole(path);
    return (whole.has_filename() ? whole : whole.parent_path()).filename().string();
}

PageModel page_model(const std::string& path, const Model& model) {
    return {.mesh = model.mesh,
            .labels = model.labels,
            .title = title_of(path),
            .background = model.background,
            .names = model.names,
            .colours = model.colours,
            .metres = model.coordinates.metres,
            .space = model.coordinates.space};
}

void write_report_and_page(Command command, const Settings& settings, Report& report, const Model& model,
                           OutputFiles& files) {
    const MadeBy made = made_by(command, settings);
    write_report_file(settings, report, model, made, files);
    if (settings.html.empty()) return;
    const bool has_labels = command == kReconstruct;
    write_page(settings.html, {page_model(settings.output, model)},
               page_options(command, settings, report_text(report, model, made), has_labels, report.quality_bound),
               files);
}

void write_changed(Command command, const Settings& settings, const MeshFile& file, const CheckOptions& options,
                   Report& report) {
    const auto [names, colours] = describe(settings, file.names, file.colours);
    const Model model{file.mesh, file.labels, options.background,
                      names,     colours,     with_units_and_space(settings, file.coordinates)};
    OutputFiles files(model_writing(settings));
    const auto written = write_model(settings, model, files);
    write_report_and_page(command, settings, report, model, files);
    files.commit();
    print_region_files(settings, written);
}

}  // namespace regionmesh::cli
