// A piece of a model: the faces of one block, as a file with a checksum.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "judge/collapse_log.h"
#include "regionmesh/label.h"
#include "regionmesh/output_file.h"
#include "regionmesh/simplify.h"
#include "regionmesh/vec3.h"

namespace regionmesh {

/// 32 bytes, as in the file.
struct PieceVertex {
    Vec3 position;  // as the mesher places it: z scaled, in the axes of the lattice
    float error_bound = 0;
    SideSet sides = 0;
    std::uint8_t is_shared = 0;  // faces of other pieces may use a vertex at exactly this position
    std::uint16_t unused = 0;
};
static_assert(sizeof(PieceVertex) == 32);

/// 20 bytes, as in the file: corners in the piece; the normal points from the first label to the second. Labels are
/// dense, those of the whole volume.
struct PieceFace {
    std::array<std::uint32_t, 3> vertices;
    std::array<Label, 2> labels;
};
static_assert(sizeof(PieceFace) == 20);

/// Thresholds at which a sample of a block was simplified (histogram of a block).
inline constexpr int kMostThresholdTrials = 12;

/// The first bytes of the file. All numbers are little endian.
struct PieceHeader {
    std::array<char, 8> magic{'r', 'm', 'p', 'i', 'e', 'c', 'e', '1'};
    std::uint64_t job = 0;  // hash of the options and the input
    std::uint32_t pass = 0, block = 0;
    std::uint64_t vertices = 0, faces = 0;
    std::uint64_t unused = 0;
    StopReason stopped = StopReason::kTarget;  // kTarget, too, where a threshold ended it
    float error_bound = 0;                     // largest of a vertex
    Box box = {};                              // of the vertices
    /// Share of the faces left after collapses up to the thresholds tried; 0 after the last one.
    std::array<double, kMostThresholdTrials> left{};
};
static_assert(sizeof(PieceHeader) == 56 + 48 + 8 * kMostThresholdTrials);

struct Piece {
    PieceHeader header;
    std::vector<PieceVertex> vertices;
    std::vector<PieceFace> faces;
    std::vector<LoggedCollapse> log = {};  // collapses that may still be made, of vertices that are not shared. The
                                           // error bounds of vertices are those after all of them
};

/// Sets the counts, the box and the largest error bound, and writes header, vertices, faces, log and the CRC-32 of
/// all of them. The file has its name only when it is complete. Returns the checksum.
std::uint32_t write_piece(Piece& piece, const std::filesystem::path& path, const OutputOptions& options);

/// What the pieces of a run have in common.
struct PieceLimits {
    std::uint64_t labels = kFirstExterior;  // dense ones, and the exteriors of the six sides
    Box box = {};                           // of all vertices; empty: unknown
};

/// Throws Error(kInput) for a file that is not such a piece, whose checksum does not fit, or that has what no piece
/// has: the file may come from anywhere. What the stages after it rely on across pieces, BlockGatherer requires.
Piece read_piece(const std::filesystem::path& path, const PieceLimits& limits = {});
/// The header alone; the rest of the file is not looked at.
PieceHeader read_piece_header(const std::filesystem::path& path, const PieceLimits& limits = {});
/// The log alone; the checksum is not looked at.
std::vector<LoggedCollapse> read_piece_log(const std::filesystem::path& path);

/// The checksum that the file says.
std::uint32_t read_checksum(const std::filesystem::path& path);

/// The checksum of a complete piece of this job, pass and block; nothing where there is none.
std::optional<std::uint32_t> find_piece(const std::filesystem::path& path, const PieceHeader& like,
                                        const PieceLimits& limits);

}  // namespace regionmesh
