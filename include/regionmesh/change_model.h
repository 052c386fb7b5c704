// Changes of a whole model, checked before and after: those of the commands decimate and smooth, and of Python.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "regionmesh/check.h"
#include "regionmesh/lattice.h"
#include "regionmesh/mesh.h"
#include "regionmesh/options.h"
#include "regionmesh/report.h"

namespace regionmesh {

/// What a change did.
struct ModelChange {
    CheckReport before;  // check of the mesh as it came, turned into the axes of its box (BoxAxes)
    LockedPart locked;   // because of violations that it came with
    Report report;       // report as reconstruct() gives it
};

/// Called with the faces that are gone in a stage ("decimate", "smooth lines", "improve", "check"), and with how many
/// will be in all, where that is known.
using OnModelChange =
    std::function<void(const char* stage, std::uint64_t gone, const std::optional<std::uint64_t>& in_all)>;

/// Simplifies a mesh to the target of the settings, and smooths its lines and improves it where they say so, in the
/// axes of its box (BoxAxes) or of `samples`, none of which then changes its region. `checks` says what its boundary
/// and its background are; the ids of the mesh are dense afterwards. Where the settings give no bound on quality, it is
/// usual_quality_bound(spacing), and the usual one where the mesh is improved or `spacing`, that of the samples it was
/// made of, is not known. Throws what simplify(), smooth_lines() and improve() throw.
ModelChange simplify_model(Mesh& mesh, const Settings& settings, const CheckOptions& checks,
                           const std::optional<Vec3>& spacing = {}, const std::optional<Lattice>& samples = {},
                           const OnModelChange& on_change = {});

/// Smooths a mesh in the same way, and restores the volumes of its regions where the settings say so. Throws what
/// smooth() and preserve_volumes() throw.
ModelChange smooth_model(Mesh& mesh, const Settings& settings, const CheckOptions& checks);

}  // namespace regionmesh
