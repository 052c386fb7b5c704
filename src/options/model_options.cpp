// The options of stages that work on a whole model, for the program and the Python module.
#include <algorithm>
#include <cmath>

#include "regionmesh/options.h"
#include "regionmesh/write_report.h"
#include "smooth/lattice/usual_reach.h"

namespace regionmesh {

const std::string* given_text(const Settings& settings, std::string_view name) {
    const auto found = std::ranges::find(settings.given, name, &OptionValues::value_type::first);
    return found == settings.given.end() ? nullptr : &found->second;
}

bool has_background(const Settings& settings) {
    return given_text(settings, "background") || given_text(settings, "no-background");
}

bool has_target(const Settings& settings) {
    const ReconstructOptions& asked = settings.reconstruct;
    return asked.target_faces || asked.reduce || asked.promises.max_error < HUGE_VAL;
}

bool is_usual_smoothing(const Settings& settings, const Vec3& spacing) {
    const SmoothOptions& smooth = settings.reconstruct.smooth;
    const bool is_lattice = smooth.filter == SmoothFilter::kAuto || smooth.filter == SmoothFilter::kLattice;
    return is_lattice && smooth.passes > 0 && smooth.reach == usual_reach(spacing);
}

bool has_free_target(const Settings& settings) {
    const ReconstructOptions& asked = settings.reconstruct;
    return asked.decimate && !has_target(settings);
}

ReconstructOptions with_free_target(const Settings& settings, const Vec3& spacing) {
    ReconstructOptions options = settings.reconstruct;
    if (has_free_target(settings)) options.free_error = kFreeError * std::min({spacing.x, spacing.y, spacing.z});
    return options;
}

Coordinates with_units_and_space(const Settings& settings, Coordinates known) {
    if (settings.metres) known.metres = settings.metres;
    if (known.space == Space::kUnknown) known.space = settings.volume.space;
    return known;
}

std::uint32_t target_faces(const Settings& settings, const Mesh& mesh) {
    const ReconstructOptions& asked = settings.reconstruct;
    if (asked.reduce) return static_cast<std::uint32_t>(std::llround(mesh.face_count() * (1 - *asked.reduce)));
    if (asked.target_faces)
        return static_cast<std::uint32_t>(std::min<std::uint64_t>(*asked.target_faces, mesh.face_count()));
    return has_target(settings) ? 0 : mesh.face_count();
}

}  // namespace regionmesh
