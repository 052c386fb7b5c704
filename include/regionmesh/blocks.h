// Models larger than memory: a volume cut into blocks, and a folder of pieces instead of a file.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "regionmesh/check.h"
#include "regionmesh/compare.h"
#include "regionmesh/label_table.h"
#include "regionmesh/mesh.h"
#include "regionmesh/mesh_file.h"
#include "regionmesh/output_file.h"
#include "regionmesh/reconstruct.h"
#include "regionmesh/section_reader.h"
#include "regionmesh/voxelise.h"
#include "regionmesh/write_report.h"

namespace regionmesh {

/// Names and values that have to be the same when a run goes on: the input's files and the options.
using RunIdentity = std::vector<std::pair<std::string, std::string>>;

struct BlockOptions {
    std::filesystem::path folder;   // of the model; its parent exists
    std::uint32_t block_cells = 0;  // along each axis; 0: from ReconstructOptions::memory
    RunIdentity identity = {};
    std::function<RunIdentity()> find_identity = {};  // looks it up again once samples are read, where it may change
    OutputOptions output = {};
};

/// How processes share the tasks of a run. All of them go through the same phases; between two phases they wait for
/// each other.
class BlockTasks {
public:
    virtual ~BlockTasks() = default;
    /// Whether this process does what is done once: it reads the input and writes the manifest.
    virtual bool is_first() const { return true; }
    /// The number of processes.
    virtual std::uint32_t processes() const { return 1; }
    /// A task of this phase that no process has begun, from 0 to count - 1; nothing after the last one.
    virtual std::optional<std::uint32_t> next(std::uint32_t count) {
        return next_ < count ? std::optional(next_++) : std::nullopt;
    }
    /// Ends a phase: returns when all processes have come here.
    virtual void end_phase() { next_ = 0; }

private:
    std::uint32_t next_ = 0;
};

struct BlockProgress {
    const char* stage = "";
    std::uint32_t done = 0, count = 0;  // blocks
};

struct BlockReport {
    std::uint32_t pieces = 0, block_cells = 0;  // of the last pass
    std::uint64_t initial_faces = 0, final_faces = 0, final_vertices = 0;
    std::uint32_t made = 0, found = 0;  // pieces of all passes: by this process, and complete from an earlier run
    StopReason stopped = StopReason::kNoneAsked;
    double error_bound = 0;
    DenoiseReport denoise = {};                   // without changes by region
    CheckReport check = {};                       // of the whole model, by the first process
    std::optional<SampleAgreement> samples = {};  // likewise; none where they are no longer there, or do not fit
    std::uint64_t peak_bytes = 0;                 // of this process
    double seconds = 0;
};

/// Throws Error(kUsage) for options that need the whole surface at once, which blocks do not have.
void require_block_options(const ReconstructOptions& options);

/// Reconstructs and simplifies the volume block by block, and writes the model into a folder of pieces with a manifest
/// (docs/explanation/blocks.md). A run that was ended at any moment goes on: complete pieces are not made again. The
/// bytes of the folder depend on the input and the options only, not on interruptions, threads or processes. Reads the
/// input three times, section by section: to count, to make faces, and to compare its samples with the model, which is
/// checked piece by piece, as one that is complete is when the run is given again. What is in the folder may come from
/// anywhere: it is validated, and samples that are read again are compared with hashes of those that the run was begun
/// with. Throws Error(kInput) where the folder belongs to a run of another input or other options, or is damaged, or
/// the input changed meanwhile, Error(kOutput) where another run works in it, and whatever require_block_options() and
/// the reader throw.
BlockReport reconstruct_blocks(const std::function<std::unique_ptr<SectionReader>()>& open,
                               const ReconstructOptions& options, const BlockOptions& blocks, BlockTasks& tasks,
                               const std::function<void(const BlockProgress&)>& on_progress = {});

/// Whether a folder holds a manifest of blocks.
bool is_block_folder(const std::filesystem::path& folder);

/// What a complete folder says besides its surface: `mesh` is empty. Throws like read_block_folder().
MeshFile describe_block_folder(const std::filesystem::path& folder);

/// Checks a complete folder piece by piece, with the faces of others round each: seams are checked as all else. Finds
/// what check() finds in the whole. Holds one piece and its surroundings, and the faces on seams that later pieces
/// need. Dense labels are those of describe_block_folder(), whose background belongs in the options. Throws like
/// read_block_folder().
CheckReport check_block_folder(const std::filesystem::path& folder, const CheckOptions& options = {});

/// A complete folder as a model for compare(), one part for each block. Holds no faces; a part is read with the faces
/// of others round it, so lines on seams are complete. Throws like read_block_folder().
std::unique_ptr<ComparedModel> open_block_folder(const std::filesystem::path& folder);

/// The size of the whole model of a complete folder. Holds one piece. Throws like read_block_folder().
ModelSize size_of_block_folder(const std::filesystem::path& folder);

/// Calls on_section with the labels of each section of samples, as Voxeliser::next() gives them, along the sweep of the
/// volume, and returns Voxeliser::contradictions(). Holds the faces of one layer of pieces, or of a part of the layer
/// where it has more than `most_faces`, and one piece. Requires a volume with the lattice of the folder
/// (has_lattice_of()).
std::uint64_t voxelise_block_folder(const std::filesystem::path& folder, const VolumeInfo& volume,
                                    const std::vector<Label>& background,
                                    const std::function<void(std::span<const Label>)>& on_section,
                                    std::uint64_t most_faces = 4'000'000);

/// compare_samples() in layers of pieces along the sweep of the reader, as voxelise_block_folder(). Requires a reader
/// with the lattice of the folder (has_lattice_of()).
SampleAgreement compare_block_samples(const std::filesystem::path& folder, LabelTable& labels,
                                      const std::vector<Label>& background, SectionReader& reader);

/// Whether the samples of a volume lie where those did that the model of the folder was made from.
bool has_lattice_of(const std::filesystem::path& folder, const VolumeInfo& volume);

struct VtpPiecesOptions {
    LabelNames names = {};      // of regions; empty: those in the folder
    LabelColours colours = {};  // of some regions; empty: those in the folder. The others get those of a palette
    OutputOptions output = {};
};

/// Writes each piece of a complete folder as NAME-NNNNNN.vtp beside `path`, NAME.pvtp, which ParaView opens as one
/// model. Holds one piece, and the vertices on seams that later pieces need. The point attribute GlobalIds numbers the
/// vertices of the whole from 0, in the order of the pieces: one on a seam has the same number in all pieces that have
/// it. NodeType of a vertex on a seam counts the labels in its piece. All files get their names at the end, together.
/// Returns the files written.
std::vector<std::filesystem::path> write_vtp_pieces(const std::filesystem::path& folder,
                                                    const std::filesystem::path& path,
                                                    const VtpPiecesOptions& options = {});

struct PrecomputedOptions {
    std::optional<double> metres = {};  // in a unit of the model; none: as a folder says, or else 1
    bool is_legacy = false;             // neuroglancer_legacy_mesh; otherwise neuroglancer_multilod_draco
    bool is_sharded = false;            // not legacy: neuroglancer_uint64_sharded_v1
    std::uint32_t levels = 0;           // of detail, not legacy; 0: from the number of faces
    LabelNames names = {};              // of regions; empty: those in the folder
    LabelColours colours = {};          // of some regions; empty: those in the folder. The viewer chooses the others
    OutputOptions output = {};
    // A folder says these itself:
    std::vector<Label> background = {};
    bool boundary_is_open = false;  // its box was not capped
    std::string source = {};        // what messages call it
};

struct PrecomputedResult {
    std::uint64_t regions = 0;
    /// Of legacy meshes: how far single precision moves points at most. Above a hundredth faces may degenerate.
    double rounded_share_of_edge = 0;
};

/// Makes the folder, and `names` in it, unless they are there. Throws Error(kOutput).
void make_precomputed_folder(const std::filesystem::path& output);

/// Writes the regions of a complete folder, but the background, as meshes for Neuroglancer: a folder that its data
/// source `precomputed` reads. Requires what make_precomputed_folder(output) makes. Coordinates are in nanometres.
///   multi-resolution  level 0 is the model cut along the walls of chunks, its positions rounded to 1/65535 of a chunk;
///                     each further level has about an eighth of the faces and does not keep samples in their regions.
///                     Fragments are compressed by Draco, without loss. All regions of a level fit together. Holds one
///                     piece with what simplify() needs for it, one fragment and 160 MB; 40 bytes in temporary files
///                     for each face and side.
///   legacy            single precision, one fragment for each region and piece. Holds one piece.
/// `info` is removed first and written last, so a folder that has it is whole. `state.json` is a state of the viewer
/// that shows up to 100 regions, those with the most faces, from a server at http://localhost:8080 that serves the
/// parent of `output`. Throws Error(kInput) for a negative label, which is no id there, and Error(kOutput) for
/// multi-resolution in a build without Draco.
PrecomputedResult write_precomputed(const std::filesystem::path& folder, const std::filesystem::path& output,
                                    const PrecomputedOptions& options = {});

/// The same of a model in memory. Faces of violations stay at all levels.
PrecomputedResult write_precomputed(Mesh mesh, const LabelTable& labels, const std::filesystem::path& output,
                                    const PrecomputedOptions& options = {});

/// The whole model of a complete folder, in memory: vertices and faces in the order of the pieces, shared vertices
/// once. Throws Error(kInput) for a folder that is not complete or is damaged.
MeshFile read_block_folder(const std::filesystem::path& folder);

}  // namespace regionmesh
