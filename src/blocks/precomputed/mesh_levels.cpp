// Levels of detail of a model in memory.
#include <utility>

#include "blocks/precomputed/levels.h"
#include "mesh/extent.h"
#include "regionmesh/box_axes.h"

namespace regionmesh {
namespace {

class MeshLevels final : public ModelLevels {
public:
    MeshLevels(Mesh mesh, const CheckOptions& options) : mesh_(std::move(mesh)), options_(options) {}

    std::uint64_t faces() const override { return mesh_.face_count(); }
    Box box() const override { return extent_of(mesh_, options_.threads); }
    void visit(std::uint32_t levels, const Visit& visit) override {
        mesh_.compact();
        visit(0, mesh_);
        for (std::uint32_t level = 1; level < levels; ++level) {
            reduce();
            visit(level, mesh_);
        }
    }

private:
    /// To the next level.
    void reduce() {
        const BoxAxes axes(mesh_);
        if (check(mesh_, options_).violation_count() > 0) lock_violations(mesh_, options_);
        simplify(mesh_, next_level_options(mesh_, options_.threads));
        axes.restore(mesh_);
        mesh_.compact();
    }

    Mesh mesh_;
    CheckOptions options_;
};

}  // namespace

std::unique_ptr<ModelLevels> levels_of_mesh(Mesh mesh, const CheckOptions& options) {
    return std::make_unique<MeshLevels>(std::move(mesh), options);
}

}  // namespace regionmesh
