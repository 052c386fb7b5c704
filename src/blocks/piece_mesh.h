// A piece as a mesh.
#pragma once

#include "blocks/manifest.h"
#include "blocks/piece.h"
#include "regionmesh/mesh.h"

namespace regionmesh {

/// In the space of the model; vertices and faces keep their numbers.
Mesh mesh_of(const Piece& piece, const Manifest& manifest);

}  // namespace regionmesh
