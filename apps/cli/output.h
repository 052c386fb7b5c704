// What the commands write: models, reports, and the lines that several commands print.
#pragma once

#include <filesystem>
#include <vector>

#include "regionmesh/change_model.h"
#include "regionmesh/formats.h"
#include "regionmesh/options.h"
#include "regionmesh/regionmesh.h"

namespace regionmesh::cli {

/// Throws Error where the model, the table of names or the report could not be written or read: before the work.
void require_outputs(const Settings& settings);
/// The same without the model.
void require_tables(const Settings& settings);

/// What the input says about its labels.
struct Described {
    LabelNames names;
    LabelColours colours;
};

/// Names and colours from --names, or else, each for itself, those found with the input.
Described describe(const Settings& settings, const LabelNames& names, const LabelColours& colours);

/// What is written of a model. `background` is dense.
struct Model {
    const Mesh& mesh;
    const LabelTable& labels;
    const std::vector<Label>& background;
    const LabelNames& names;
    const LabelColours& colours;
    Coordinates coordinates = {};
};

/// Writes the tables of --regions, --interfaces and --lines as some of `files`.
void write_tables(const Settings& settings, const Model& model, OutputFiles& files);

/// How a model is written: on as many threads as it was made.
OutputOptions model_writing(const Settings& settings);

/// Warns where single precision moves points by more than a hundredth of an edge.
void warn_of_rounding(const std::string& output, double share_of_edge, const std::string& advice);

/// Writes the model to `settings.output`, and the tables, as some of `files`. Returns the files of the model.
std::vector<std::filesystem::path> write_model(const Settings& settings, const Model& model, OutputFiles& files);

/// "m.stl (one file a region)".
std::string output_text(const Settings& settings);
/// Prints the files of --per-region, after their commit.
void print_region_files(const Settings& settings, const std::vector<std::filesystem::path>& written);

/// The report of the model as JSON.
std::string report_text(const Report& report, const Model& model, const MadeBy& made_by);

/// Writes the report of the model if --report asks for it, with the memory used until now.
void write_report_file(const Settings& settings, Report& report, const Model& model, const MadeBy& made_by,
                       OutputFiles& files);

/// 7109137 as 7,109,137.
std::string grouped(std::uint64_t count);
/// "regions", "vertices", "tetrahedra".
std::string plural_of(const std::string& noun);
/// "1 region", "7,109 regions".
std::string counted(std::uint64_t count, const std::string& noun);

/// kViolations where the report has some, else kGood.
int exit_code(const CheckReport& report);
/// The same, or kNotMet where the model is sound but regions are off the volumes asked for.
int exit_code(const Report& report);

/// Prints how much lines turned before and after they were smoothed, if they were.
void print_smoothed_lines(const Report& report);
/// Prints what was done about faces below the bound on quality, if there were any.
void print_floor(const Report& report);

/// Prints the lengths of edges before and after they were brought near a wanted one, if they were.
void print_remeshed(const Report& report);

/// Prints the shape of the faces before and after they were improved, if they were.
void print_improved(const Report& report);

/// Prints "violation KIND: COUNT" for each kind found, and at most `listed` findings of each.
void print_violations(const CheckReport& report, int listed);
/// How rough the labels are and what was done about it, where they were looked at.
void print_denoised(const DenoiseReport& done);
/// How many samples lie in the region of their label, or of the one that --room gave them.
std::string samples_text(const SampleAgreement& samples, bool has_room);
/// One line on what was proved: violations, and samples that lie in another region.
void print_certificate(const Report& report, const std::optional<double>& metres);

/// Prints why decimation ended before its target, if it did: on standard output, or with --quiet on standard error.
void print_stop(const Settings& settings, const Report& report);

/// Prints how to repair faces with opposite orientations, where there are such faces.
void print_orient_hint(const CheckReport& report);

/// Prints which part of an invalid model was not changed, and which violations became more.
void print_locked_part(const ModelChange& change);

}  // namespace regionmesh::cli
