// The options of stages that work on a whole model, for the program and the Python module.
#include <algorithm>
#include <cmath>

#include "regionmesh/options.h"
#include "regionmesh/write_report.h"

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
    return asked.target_faces || asked.reduce || asked.max_error;
}

Coordinates with_units_and_space(const Settings& settings, Coordinates known) {
    if (settings.metres) known.metres = settings.metres;
    if (known.space == Space::kUnknown) known.space = settings.volume.space;
    return known;
}

SimplifyOptions simplify_options(const Settings& settings, const Mesh& mesh) {
    const ReconstructOptions& asked = settings.reconstruct;
    SimplifyOptions options{.target_faces = has_target(settings) ? 0 : mesh.face_count()};
    if (asked.target_faces)
        options.target_faces =
            static_cast<std::uint32_t>(std::min<std::uint64_t>(*asked.target_faces, mesh.face_count()));
    if (asked.reduce)
        options.target_faces = static_cast<std::uint32_t>(std::llround(mesh.face_count() * (1 - *asked.reduce)));
    if (asked.max_error) options.max_error = *asked.max_error;
    options.min_quality = asked.min_quality.value_or(SimplifyOptions{}.min_quality);
    options.perturbation = asked.perturbation;
    options.intersect_check = asked.intersect_check;
    options.placement = asked.placement;
    options.threads = asked.threads;
    options.scale = typical_edge(mesh);
    if (!asked.cap) options.box = size_of(mesh).box;
    return options;
}

SmoothOptions smooth_options(const Settings& settings, const Mesh& mesh) {
    SmoothOptions options = settings.reconstruct.smooth;
    options.min_quality = settings.reconstruct.min_quality.value_or(SmoothOptions{}.min_quality);
    options.intersect_check = settings.reconstruct.intersect_check;
    options.threads = settings.reconstruct.threads;
    options.scale = settings.scale.value_or(typical_edge(mesh));
    return options;
}

}  // namespace regionmesh
