// Reports as JSON text.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "regionmesh/census.h"
#include "regionmesh/compare.h"
#include "regionmesh/denoise.h"
#include "regionmesh/label_names.h"
#include "regionmesh/label_table.h"
#include "regionmesh/mesh.h"
#include "regionmesh/mesh_file.h"
#include "regionmesh/output_file.h"
#include "regionmesh/report.h"
#include "regionmesh/voxelise.h"

namespace regionmesh {

/// The symbol of the unit of length that has `metres`: "mm" for 0.001. "0.0252 m" where there is no symbol.
std::string length_symbol(double metres);

/// The run of the program that made a model.
struct MadeBy {
    std::string command = {};  // "reconstruct"; empty: none
    std::vector<std::pair<std::string, std::string>> options =
        {};  // names and texts, as given; several of a name: in order
};

/// The report of a run: JSON text, indented by two spaces, with a newline at the end; a number that is not finite is
/// null. docs/reference/report.md lists the keys. `regions[]` are in order of `label`, a number with the signedness of
/// the input; regions with a name have `name`. `metres` are those of the model's unit of length, which is written as
/// `unit`.
std::string report_json(const Report& report, const LabelTable& labels, const LabelNames& names = {},
                        const MadeBy& made_by = {}, std::optional<double> metres = {});

/// The part of a check alone (`check --json`): quality, regions, region_pairs, quadruple_points_inside, violations and
/// violation_counts. With `samples` also samples, samples_wrong, samples_contradicting, dice and dice_of_regions[];
/// with `metres` also unit.
std::string check_json(const CheckReport& report, const LabelTable& labels, const LabelNames& names = {},
                       const SampleAgreement* samples = nullptr, std::optional<double> metres = {});

/// The report of a comparison, as JSON text like report_json; docs/how-to/compare.md lists the keys. Regions,
/// interfaces and lines are in order of label; the exterior is labels.exterior_label() and last in a list. Measures
/// that only one mesh has are null for the other, and so are the distances; `only_in_a` and `only_in_b` name them.
/// Regions with a name have `name`.
std::string compare_json(const CompareReport& report, const LabelNames& names = {});

/// How large a model is.
struct ModelSize {
    std::uint64_t faces = 0, vertices = 0;
    Box box{{}, {}};  // of all points; zeros without points
};
ModelSize size_of(const Mesh& mesh);

/// What `info --json` writes about a volume, about points or tetrahedra, and about a surface model: JSON text like
/// report_json(); docs/reference/report.md lists the keys. The mesh of `file` is not looked at. `report` is the check
/// of the model; its violations are not written.
std::string info_json(const VolumeInfo& info, const Census& census, const std::optional<Roughness>& roughness = {});
std::string info_json(const TetrahedraInfo& info, const TetrahedronCensus& census);
std::string info_json(const std::string& source, const MeshFile& file, const ModelSize& size,
                      const CheckReport& report);

/// A table of the regions as CSV, in order of label: label, name, faces, volume, area, centroid_x, _y, _z, box_low_x to
/// box_high_z, equivalent_diameter (of the sphere of the same volume), neighbours (labels, separated by blanks; the
/// background and the exterior are none), neighbour_areas, mean_curvature (1 / length, positive where the region is
/// convex: the mean of its interfaces', weighted by area; empty if none has any) and triple_line_length (of lines that
/// are not on the exterior). The volume and the centroid of an open region mean nothing. `background` is dense.
std::string regions_csv(const Mesh& mesh, const LabelTable& labels, const std::vector<Label>& background,
                        const LabelNames& names = {});

/// A table of the interfaces, of regions with each other, the background and the exterior: label, neighbour, name,
/// neighbour_name, faces, area, centroid_x, _y, _z, mean_curvature (positive where `label` is convex; of what is more
/// than one edge away from lines, empty if there is no such part, and on the exterior) and line_length, of the lines
/// that bound it.
std::string interfaces_csv(const Mesh& mesh, const LabelTable& labels, const std::vector<Label>& background,
                           const LabelNames& names = {});

/// A table of the lines, which are edges with three labels or more; the exterior counts as one: labels (separated by
/// blanks), names (by semicolons), label_count, edges, length and angles, the mean dihedral angle of each label in
/// degrees (docs/reference/files.md); "-" for the exterior, and where a label has not two faces at any of the edges.
std::string lines_csv(const Mesh& mesh, const LabelTable& labels, const std::vector<Label>& background,
                      const LabelNames& names = {});

/// Writes `text` as an OutputFile. Throws Error(kOutput).
void write_text(const std::filesystem::path& path, std::string_view text, const OutputOptions& options = {});

}  // namespace regionmesh
