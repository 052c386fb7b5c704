// How models from files are read, and what the commands that change them say of those that are not sound.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "regionmesh/formats.h"
#include "regionmesh/regionmesh.h"

namespace regionmesh::cli {

/// For help texts.
inline constexpr const char* kMeshRead = "labelled surface: .vtp, .vtu, .ply, .stl, .obj, .dream3d, or a folder";

struct MeshOptions {
    std::string weld;
    bool orient = false;

    /// Adds --weld and --orient.
    void add_options(CLI::App& command);
    /// Throws Error(kInput) for a distance that is no number.
    MeshFile read(const std::string& path) const;
};

/// "pinched_vertex 12, open_edge 40": all kinds found, in their order; empty where there are none.
std::string counts_text(const CheckReport& report);

/// Says how to mend faces that look opposite ways, where there are such.
void print_orient_hint(const CheckReport& report);

/// Says what was left as it came, and what is there now that was not before.
void print_unsound(const FixedPart& fixed, const CheckReport& before, const CheckReport& after);

}  // namespace regionmesh::cli
