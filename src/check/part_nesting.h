// The test of nesting for a surface that memory does not hold at once.
#pragma once

#include <array>
#include <map>
#include <vector>

#include "check/nesting_ray.h"
#include "check/seam_sets.h"
#include "mesh/mesh_part.h"

namespace regionmesh {

/// Finds the separate parts of the surface, then sends a ray from each that does not touch the box. Holds the faces
/// that later parts have, too, and 80 bytes for each separate part that does not touch the box.
class PartNesting {
public:
    /// Volumes are measured from `origin`.
    explicit PartNesting(Vec3 origin) : origin_(origin) {}

    /// Requires parts in the order of their numbers.
    void add(const Mesh& mesh, const MeshPart& part);
    /// Call it after all parts. A ray is `reach` long.
    void begin_rays(double reach);
    /// Whether a ray may meet a face in the box.
    bool needs(const Box& box) const;
    /// Requires each face that rays may meet in one of the meshes.
    void meet(const Mesh& mesh, std::uint32_t threads);
    /// Vertices in findings have their number in the part that the sentence names.
    void report(const CheckOptions& options, Findings& findings) const;

private:
    /// The known facts about a separate part of the surface.
    struct Island {
        Vec3 farthest = {};  // along the ray
        double along = -HUGE_VAL;
        std::uint32_t vertex = 0, part = 0;  // the farthest
        bool touches_box = false;
        NestedVolumes volumes = {};  // empty if it touches the box
    };
    struct Ray {
        Vec3 from;
        std::uint32_t vertex, part;
        Label outer;
        NestingHit nearest = {};
        std::array<Label, 4> at_start{kNoLabel, kNoLabel, kNoLabel, kNoLabel};  // labels as found
    };
    static constexpr Label kNoLabel = ~Label{0};
    static void join(Island& into, Island&& other);
    void close(const Island& island);
    Box way_of(const Ray& ray) const;
    static void meet(const Mesh& mesh, FaceId f, Ray& ray);

    Vec3 origin_;
    SeamSets sets_;                         // sets of faces
    std::map<std::uint32_t, Island> open_;  // key: set; islands that reached a seam
    std::uint64_t count_ = 0;               // islands so far
    double reach_ = 0;
    std::vector<Ray> rays_;  // rays of islands that do not touch the box
};

}  // namespace regionmesh
