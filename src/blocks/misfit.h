// Whether gathered pieces are parts of one surface.
#pragma once

#include <span>
#include <string>

#include "regionmesh/label.h"
#include "surface/chunk.h"

namespace regionmesh {

/// What a surface does not have, in a few words; empty where the faces of a chunk without carried vertices are as those
/// of a run: no two with the same corners, and round each edge with a corner that is not active every region begins as
/// often as it ends. The exteriors and `background` are one region; `is_capped`: the surface is closed at the sides of
/// the box, too. Simplification relies on it.
std::string misfit_of(const Chunk& chunk, std::span<const Label> background, bool is_capped);

}  // namespace regionmesh
