// The page of --html and of the command view.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "output.h"
#include "regionmesh/formats.h"
#include "regionmesh/options.h"

namespace regionmesh::cli {

/// The command as typed, with its options in the order of the table.
std::string command_line_of(Command command, const Settings& settings);

/// For reports: the command, and the options that were given, without --config, whose options they hold.
MadeBy made_by(Command command, const Settings& settings);

/// Options of a page with the report `report` (JSON text). `has_labels`: it compares the topology with the input.
/// `quality_bound`: that of the report (Report).
PageOptions page_options(Command command, const Settings& settings, std::string report, bool has_labels,
                         std::optional<double> quality_bound = {});

/// Throws Error where the page could not be written: before the work.
void require_page(const std::string& path, const OutputOptions& options);

/// The name of a file without its folder.
std::string title_of(const std::string& path);

/// A model for a page.
PageModel page_model(const std::string& path, const Model& model);

/// Writes the report and the page of the model that a command made, those that are asked for, as some of `files`.
void write_report_and_page(Command command, const Settings& settings, Report& report, const Model& model,
                           OutputFiles& files);

/// Writes a changed model and all that is asked for beside it, and prints the files of --per-region.
void write_changed(Command command, const Settings& settings, const MeshFile& file, const CheckOptions& options,
                   Report& report);

}  // namespace regionmesh::cli
