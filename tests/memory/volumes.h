// Generated volumes for the test of --memory.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace regionmesh::memory {

enum class Pattern { kNoise, kBlocks, kCells, kLayers, kBand };  // band: noise in a quarter, along x
inline constexpr int kPatterns = 5;

struct Volume {
    Pattern pattern;
    std::uint32_t size[3];  // samples along x, y and z
    std::uint64_t seed;
    std::string text() const;
};

/// Writes the labels as .npy of bytes.
void write_npy(const Volume& volume, const std::filesystem::path& path);

}  // namespace regionmesh::memory
