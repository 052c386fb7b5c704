#include "formats/surface/region_seeds.h"

#include <fmt/format.h>

#include <algorithm>

#include "regionmesh/error.h"

namespace regionmesh {
namespace {

std::string name_of(const FileView& view, Label label) {
    return is_exterior(label) ? "the exterior" : "region " + view.label_text(label);
}

}  // namespace

void require_closed_regions(const FileView& view, const Bodies& bodies) {
    for (const Body& body : bodies.all())
        if (!body.is_bounded && !view.is_background(body.label))
            throw Error(ErrorCode::kOutput,
                        fmt::format("{} is not closed, so that nothing can mesh its volume: leave out --boundary open, "
                                    "or see regionmesh check",
                                    name_of(view, body.label)));
}

Seeds find_seeds(const FileView& view, const Bodies& bodies) {
    Seeds seeds;
    for (const Body& body : bodies.all()) {
        if (!body.is_bounded) continue;
        const auto point = bodies.point_inside(body);
        if (!point)
            throw Error(ErrorCode::kOutput,
                        fmt::format("{} has a part with face {} that is too thin for a point inside",
                                    name_of(view, body.label), index(face_of(bodies.sides(body.shells[0])[0]))));
        (view.is_background(body.label) ? seeds.holes : seeds.regions).push_back({body.label, *point});
    }
    const auto rank = [&](const Seed& seed) { return view.rank(seed.label); };
    std::ranges::stable_sort(seeds.regions, {}, rank);
    std::ranges::stable_sort(seeds.holes, {}, rank);
    return seeds;
}

}  // namespace regionmesh
