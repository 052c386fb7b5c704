// How rough labels are, and labels with the roughness taken out: the topology of all regions stays
// (docs/how-to/smooth.md).
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "regionmesh/section_reader.h"

namespace regionmesh {

/// DenoiseOptions::distance and specks: from the roughness of the labels.
inline constexpr double kAutoDenoise = -1;
inline constexpr std::int64_t kAutoSpecks = -1;

/// Largest distance, and largest speck, that can be asked for.
inline constexpr double kMostDenoise = 8;
inline constexpr std::int64_t kMostSpeck = 1'000'000;

struct DenoiseOptions {
    double distance = kAutoDenoise;     // of a sample that changes from the boundary of its region, at most, in finest
                                        // spacings; 0: no sample changes, nor specks; kAutoDenoise: as rough labels ask
    std::int64_t specks = kAutoSpecks;  // samples of a speck, at most; 0: no specks
    std::uint32_t threads = 0;          // 0: one per core. The result does not depend on it
    std::uint64_t memory = 0;           // bytes of the process; 0: no bound
};

/// What labels look like, counted in one pass.
struct Roughness {
    std::array<double, 3> enlarged{1, 1, 1};  // along x, y, z: samples of this lattice to one of a coarser lattice that
                                              // the labels were copied from; 1: not copied
    std::array<double, 3> first_edge{0, 0, 0};  // a boundary between two samples of the coarser lattice, in samples
    double ragged = 0;  // share of samples on interfaces that are bumps or dents of one sample, the rarer kind twice
    double stray = 0;   // share of samples on interfaces whose neighbours all have one other label

    bool is_enlarged() const;
    bool is_ragged() const;
    bool is_speckled() const;
    /// "clean", "enlarged 1.5 x 1.5 x 1", "speckled: 2 % stray", "ragged: 5 % bumps" or several of these.
    std::string text() const;
};

struct RegionChange {
    std::uint64_t gained = 0, lost = 0;  // samples
};

/// What denoise_sections() did.
struct DenoiseReport {
    std::optional<Roughness> roughness = {};       // nothing where it was not measured
    std::string refused = {};                      // why nothing was done where it was asked for; or empty
    std::uint64_t samples = 0;                     // of the volume
    std::uint64_t specks = 0, speck_samples = 0;   // given to neighbours
    std::uint64_t largest_speck = 0;               // samples; 0: specks were kept
    std::uint64_t cut_samples = 0;                 // of `changed`: threads and pinholes of one sample, cut or filled
    std::uint64_t changed = 0;                     // samples, without those of specks
    double largest_distance = 0;                   // of these from the boundary of their region, a length
    std::uint64_t labels = 0, labels_left = 0;     // with samples, before and after; 0 where nothing was to change
    std::map<InputLabel, RegionChange> regions{};  // that gained or lost samples, without specks

    bool has_changes() const { return changed + speck_samples > 0; }
    /// One line: what the labels are, and what was done.
    std::string text() const;
};

/// Bytes of the process while labels of such roughness are denoised; 0 where nothing would change.
std::uint64_t bytes_to_denoise(const VolumeInfo& volume, const Roughness& roughness, const DenoiseOptions& options);

/// Reads all sections. Threads: 0 for one per core; the result is the same.
Roughness measure_roughness(SectionReader& reader, std::uint32_t threads = 0);

/// The sections of another reader with less roughness. First specks get the label of the neighbour with the largest
/// interface: parts of a label, connected as in the mesh, of few samples, where the label has a part 20 times as large.
/// Then samples change their label, one by one, if
/// - they lie within the distance of the boundary of their region,
/// - the label is that of a smooth surface fitted to all labels nearby, and
/// - the sample is simple for its old and its new label, alone and together with any others: all regions, interfaces,
///   lines and quadruple points keep their topology.
/// The smooth surface is that of the coarser lattice where labels were enlarged, else the label with most weight round
/// the sample. Where noise is strong (Roughness::ragged) threads and pinholes of one sample go, too: no region
/// vanishes, splits, or is born.
///
/// Changes are found before the first section is handed out, in up to five readings, and kept in a temporary file. An
/// input that can be read once only is handed on as it is; DenoiseReport::refused says so.
class DenoisedSections final : public SectionReader {
public:
    /// The first holds a reference to the reader. Throws Error(kInput) where DenoiseOptions::memory is too little.
    DenoisedSections(SectionReader& reader, const DenoiseOptions& options);
    DenoisedSections(std::unique_ptr<SectionReader> reader, const DenoiseOptions& options);
    ~DenoisedSections() override;

    const VolumeInfo& info() const override;
    bool next(std::span<InputLabel> section) override;
    void rewind() override;

    const DenoiseReport& report() const;

private:
    struct State;
    std::unique_ptr<SectionReader> own_;
    std::unique_ptr<State> state_;
};

/// The same; `reader` itself for a distance of 0.
std::unique_ptr<SectionReader> denoise_sections(std::unique_ptr<SectionReader> reader, const DenoiseOptions& options);

/// Throws Error(kUsage) for numbers out of range.
void require_in_range(const DenoiseOptions& options);

}  // namespace regionmesh
