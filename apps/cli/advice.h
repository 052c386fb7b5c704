// What a run says about an input that is probably not meant.
#pragma once

#include <optional>
#include <string>

#include "regionmesh/formats.h"
#include "regionmesh/options.h"
#include "regionmesh/regionmesh.h"

namespace regionmesh::cli {

/// Throws Error(kInput) where the model has no region, or no face: it says why.
void require_regions(const Settings& settings, const CheckReport& report);

/// Warns of labels in --background and --labels that the input does not have. `mesh` is the model made of it, with at
/// least one face.
void warn_of_absent_labels(const Settings& settings, const Mesh& mesh, const LabelTable& labels);

/// Warns of options for filters with passes where the lattice filter smooths. `settings` are of sections.
void warn_of_passes(const Settings& settings);

/// Warns where what is compared is in two units of length, as far as both say one.
void warn_of_units(const std::string& a, const std::optional<double>& metres_a, const std::string& b,
                   const std::optional<double>& metres_b);

/// Warns where the sections look like a grey-scale image: many values, and samples that differ from all four
/// neighbours in their section, which labels have few of. Reads sections until it has seen enough, at most
/// kGreySections, and rewinds before and after; does nothing where the reader cannot.
void warn_of_grey_scale(const Settings& settings, SectionReader& reader);
inline void warn_of_grey_scale(const Settings&, TetrahedronReader&) {}

/// "; 66.7 % of the samples are background, label 0 (...)": which share, and why. Empty where there is none, or the
/// samples were not counted.
std::string background_text(const Settings& settings, const Reconstruction& made);

/// Which verdict refused most edges, in per cent of those refused, and what to try.
std::string missed_text(const Settings& settings, const VerdictCounts& verdicts);

/// Warns of --smooth strong where normal gives the same bytes: where sections are far apart.
void warn_of_same_smoothing(const Settings& settings, const Vec3& spacing);

/// Warns of samples that several masks claim.
void warn_of_overlaps(const Overlaps& overlaps, const LabelTable& labels, const LabelNames& names);

}  // namespace regionmesh::cli
