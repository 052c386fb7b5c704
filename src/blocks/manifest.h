// The manifest of a folder of pieces: what they are made of, and how far the run has come.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "blocks/block_grid.h"
#include "regionmesh/blocks.h"
#include "regionmesh/label_table.h"
#include "regionmesh/lattice.h"

namespace regionmesh {

/// A complete piece.
struct PieceEntry {
    std::uint32_t pass = 0;
    std::uint64_t vertices = 0, faces = 0;
    std::uint32_t checksum = 0;
    std::optional<std::uint64_t> collapses = {};  // of its log, to be made in the next pass
};

/// Costs up to which the passes after the first simplify, in units of scale^4.
struct Thresholds {
    double seams = 0, first_log = 0, second_log = 0;
};

/// docs/explanation/blocks.md lists the keys of the file.
struct Manifest {
    RunIdentity identity = {};
    bool is_surveyed = false;  // the labels are known, and what follows
    bool is_complete = false;  // the model is there
    bool is_in_place = false;  // labels are read out of the input, not out of a copy
    Lattice lattice = {};      // of the input
    Sweep sweep = {};
    std::string source = {};
    bool is_unsigned = false;                        // labels
    std::uint64_t label_count = 0;                   // in labels.bin
    std::optional<std::uint64_t> labels_hash = {};   // of labels.bin; earlier versions did not write it
    std::optional<std::uint64_t> hashes_hash = {};   // of samples.hashes; earlier versions did not write it
    std::optional<std::uint64_t> samples_hash = {};  // of an input that is read in one pass
    Space space = Space::kUnknown;
    std::optional<double> metres = {};  // in the unit of the lattice
    LabelNames names = {};
    LabelColours colours = {};
    std::optional<DenoiseReport> denoise = {};  // without changes by region; none: labels were not looked at
    std::vector<InputLabel> background = {};
    std::uint32_t block_cells = 0;
    std::uint32_t shift = 0;  // cells by which the first blocks of `pieces` are shorter
    double scale_z = 1;
    std::uint64_t initial_faces = 0;              // counted on the labels
    std::uint32_t passes = 0;                     // complete ones
    Thresholds thresholds = {};                   // where there is a target, from pass 0 on
    std::vector<PieceEntry> pieces = {};          // of the last pass that is complete, by block
    StopReason stopped = StopReason::kNoneAsked;  // once it is complete
    double error_bound = 0;
    std::uint64_t vertices = 0, faces = 0;  // of the whole model, once it is complete
};

/// The manifest of a folder that has one. Throws Error(kInput) for another.
Manifest require_manifest(const std::filesystem::path& folder);
/// The manifest of a complete folder. Throws Error(kInput) for another.
Manifest read_complete_manifest(const std::filesystem::path& folder);

/// The lattice in which pieces have their positions: along the axes, with z scaled.
Lattice piece_lattice(const Manifest& manifest);
/// The blocks that the pieces belong to.
BlockGrid piece_grid(const Manifest& manifest);

std::filesystem::path manifest_path(const std::filesystem::path& folder);

/// Nothing where there is no manifest. Throws Error(kInput) for one that is damaged or of another version.
std::optional<Manifest> read_manifest(const std::filesystem::path& folder);
void write_manifest(const Manifest& manifest, const std::filesystem::path& folder, const OutputOptions& options);

/// Throws Error(kInput) that names the first difference.
void require_same_run(const Manifest& there, const RunIdentity& identity, const std::filesystem::path& folder);

/// A file of 64-bit labels by dense label, in the folder.
inline constexpr const char* kLabels = "labels.bin";

void write_labels(const LabelTable& labels, const std::filesystem::path& folder, const OutputOptions& options);
LabelTable read_labels(const Manifest& manifest, const std::filesystem::path& folder);

std::uint64_t hash_of(const LabelTable& labels);

/// What the model says of its coordinates.
Coordinates coordinates_of(const Manifest& manifest);

/// A hash of the identity: pieces of another run are not taken for those of this one.
std::uint64_t job_of(const RunIdentity& identity);

}  // namespace regionmesh
