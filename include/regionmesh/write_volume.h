// Labels on a lattice, written section by section.
#pragma once

#include <filesystem>
#include <memory>
#include <span>

#include "regionmesh/output_file.h"
#include "regionmesh/section_reader.h"

namespace regionmesh {

/// Writes sections along z, x fastest, under a temporary name that becomes `path` in commit().
class SectionWriter {
public:
    virtual ~SectionWriter() = default;
    /// The next section, size[0] * size[1] labels. Throws Error(kOutput) for another number, for a label that the
    /// sample type cannot hold, and when the file cannot be written.
    virtual void write(std::span<const InputLabel> section) = 0;
    /// Throws Error(kOutput) for another number of sections than size[2].
    virtual void commit() = 0;
};

/// By extension: .npy (shape z, y, x), .nii and .nii.gz (the affine as sform; NIfTI-1, but NIfTI-2 if single precision
/// does not hold the affine, or an axis has more than 32767 samples), .nrrd (raw), .raw (bare samples); little endian.
/// `coordinates` are those of the lattice: NIfTI files are in RAS, NRRD files name the space; both say the unit of
/// length, NIfTI if it is the metre, the millimetre or the micrometre. `has_unsigned_labels`: those below 0 stand for
/// 2^63 and more, as in an unsigned LabelTable. Throws Error(kOutput) for another extension, and Error(kInput) for a
/// lattice that cannot be read back.
std::unique_ptr<SectionWriter> create_volume(const std::filesystem::path& path, const Lattice& lattice,
                                             const Coordinates& coordinates, SampleType type,
                                             const OutputOptions& options = {}, bool has_unsigned_labels = false);

}  // namespace regionmesh
