// The header of NIfTI-1 and NIfTI-2 files: https://nifti.nimh.nih.gov (nifti1.h, nifti2.h).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>

#include "formats/codec/sample_format.h"
#include "regionmesh/lattice.h"

namespace regionmesh::formats {

inline constexpr std::size_t kNifti1HeaderBytes = 348;
inline constexpr std::size_t kNifti2HeaderBytes = 540;

/// What a label volume needs of the header.
struct NiftiHeader {
    std::uint64_t data_offset = 0;
    SampleFormat format;
    Lattice lattice;
};

/// `bytes` are the first of the file, kNifti2HeaderBytes where it has that many. Throws Error(kInput) naming `path` for
/// what is no label volume in one file: pairs, float, complex or colour samples, rescaled samples, more than one
/// volume, an empty one, a singular affine.
NiftiHeader parse_nifti_header(const std::filesystem::path& path, std::span<const std::byte> bytes);

}  // namespace regionmesh::formats
