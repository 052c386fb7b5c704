// Models at several levels of detail.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>

#include "blocks/manifest.h"
#include "regionmesh/check.h"
#include "regionmesh/mesh.h"
#include "regionmesh/simplify.h"
#include "regionmesh/vec3.h"

namespace regionmesh {

/// Each level has about an eighth of the faces of the one before, as many as its chunks are fewer.
inline constexpr std::uint32_t kFacesPerLevel = 8;

/// As many levels as leave the last one 20,000 faces or more, and eight at most.
std::uint32_t level_count(std::uint64_t faces);

/// To an eighth of the faces of a level.
SimplifyOptions next_level_options(const Mesh& mesh, std::uint32_t threads = 0);

/// Level 0 is the model. Samples do not stay in their regions at the others.
class ModelLevels {
public:
    using Visit = std::function<void(std::uint32_t level, const Mesh& part)>;

    virtual ~ModelLevels() = default;
    virtual std::uint64_t faces() const = 0;
    /// Holds all vertices; empty if there are none.
    virtual Box box() const = 0;
    /// Calls visit(level, part) for all parts of the first levels: meshes in the space of the model, with dense ids.
    virtual void visit(std::uint32_t levels, const Visit& visit) = 0;
};

/// Of a complete folder: level 0 piece by piece. Level 1 is made of the pieces, level n + 1 of eight neighbouring parts
/// of level n joined: the vertices that other parts use stay, and faces with two of them; everything else is simplified
/// to an eighth, so parts fit together and so do regions. Holds as many faces as a piece has; the parts of the last
/// level lie in a temporary file.
std::unique_ptr<ModelLevels> levels_of_folder(const std::filesystem::path& folder, const Manifest& manifest);

/// Of a model in memory, which can be visited once: a level is its only part. Violations stay as they are.
std::unique_ptr<ModelLevels> levels_of_mesh(Mesh mesh, const CheckOptions& options);

}  // namespace regionmesh
