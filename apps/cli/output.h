// What the commands write: models, reports, and the lines that several commands print.
#pragma once

#include "regionmesh/formats.h"
#include "regionmesh/options.h"
#include "regionmesh/regionmesh.h"

namespace regionmesh::cli {

/// Throws Error where the model, the table of names or the report could not be written or read: before the work.
void require_outputs(const Settings& settings);

/// The names from --names, or else those found with the input.
LabelNames names_or(const Settings& settings, const LabelNames& found);

/// What a file says about a model besides its faces.
struct ModelNotes {
    LabelNames names;
    Space space = Space::kUnknown;
};

/// Writes the model to `settings.output`, and the table of --regions. `background` is dense. With --per-region prints
/// the files that were written.
void write_model(const Settings& settings, const Mesh& mesh, const LabelTable& labels,
                 const std::vector<Label>& background, const ModelNotes& notes);

/// Writes the report if --report asks for it, with the memory used until now.
void write_report_file(const Settings& settings, Report& report, const LabelTable& labels, const LabelNames& names);

/// kViolations where the report has some, else kGood.
int exit_code(const CheckReport& report);

/// Prints "violation KIND: COUNT" for each kind found, and at most `listed` findings of each.
void print_violations(const CheckReport& report, int listed);
/// One line on what was proved: violations, and samples that lie in another region.
void print_certificate(const CheckReport& report, const SampleAgreement* samples);

/// Prints how to repair faces with opposite orientations, where there are such faces.
void print_orient_hint(const CheckReport& report);

/// Prints which part of an invalid model was not changed, and which violations became more.
void print_fixed_part(const LockedPart& fixed, const CheckReport& before, const CheckReport& after);

}  // namespace regionmesh::cli
