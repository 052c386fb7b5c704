// What the commands read: volumes, points, tetrahedra and surfaces.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "regionmesh/formats.h"
#include "regionmesh/options.h"
#include "regionmesh/regionmesh.h"

namespace regionmesh::cli {

/// open_lattice(), with a warning of what the reader decided: once in a run, which may open its input several times.
std::unique_ptr<SectionReader> open_volume(const Settings& settings, const std::vector<std::string>& inputs);

/// open_prepared(), with the same warning.
PreparedSections open_prepared_volume(const Settings& settings, const std::vector<std::string>& inputs);

/// The same with open_tetrahedra(), of the first input.
std::unique_ptr<TetrahedronReader> open_unstructured(const Settings& settings, const std::vector<std::string>& inputs);

/// Reads what the options need that name labels or have a unit of length, and sets them.
void resolve_by_input(Settings& settings);

/// Calls visit(reader) with the reader of the input, of either kind, and returns the result. Throws Error(kUsage) for
/// options that do not apply to the input.
template <class Visit>
auto with_reader(const Settings& settings, const std::vector<std::string>& inputs, Visit&& visit) {
    require_fit(settings, inputs);
    if (!is_lattice(settings, inputs)) return visit(*open_unstructured(settings, inputs));
    return visit(*open_volume(settings, inputs));
}

/// What a reader found out while it read, where `before` is what it warned of when it was opened.
void warn_of_rest(const SectionReader& reader, const std::string& before);
inline void warn_of_rest(const TetrahedronReader&, const std::string&) {}

/// Whether a path ends in one of ".vtp .vtu .ply", in capitals or not.
bool has_extension(const std::string& path, const std::string& extensions);

/// Throws Error(kUsage), "--name: why", where one of these options was given.
void refuse_options(const Settings& settings, std::span<const std::string_view> names, const std::string& why);

/// Throws Error(kUsage) where sections are to be put between others, or moved: blocks are made of them as they are.
void refuse_prepared_blocks(const Settings& settings);

/// Throws Error(kUsage) for options about how a file becomes a model, which a folder of pieces is already.
void require_fit_of_folder(const std::string& path, const ReadMeshOptions& options);

/// A surface from a file, or from a folder of pieces.
MeshFile read_model(const std::string& path, const ReadMeshOptions& options = {});

/// What count_labels() takes from the settings.
CensusOptions census_options(const Settings& settings);

/// The settings with what a model's file says where the command line says nothing: its background and its space.
Settings settings_for(const Settings& settings, const MeshFile& file);

/// What check() takes for a model from a file. Adds the background to `labels`, and refers to them.
CheckOptions check_options(const Settings& settings, LabelTable& labels);

}  // namespace regionmesh::cli
