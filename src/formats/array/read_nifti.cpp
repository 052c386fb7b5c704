// NIfTI-1 and NIfTI-2 files: https://nifti.nimh.nih.gov (nifti1.h, nifti2.h).
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "formats/array/affine.h"
#include "formats/array/array_file.h"
#include "formats/array/volume_formats.h"
#include "formats/array/volume_size.h"
#include "formats/codec/numbers.h"
#include "formats/input_file.h"
#include "regionmesh/label_names_file.h"

namespace regionmesh::formats {
namespace {

constexpr int kNifti1HeaderBytes = 348;
constexpr int kNifti2HeaderBytes = 540;

/// A field of the header, by its places in the two versions, which differ in the width of their numbers.
template <class First, class Second, class Value = Second>
struct Field {
    std::size_t first, second;
};
constexpr Field<std::int16_t, std::int64_t> kDim{40, 16};
constexpr Field<std::int16_t, std::int16_t> kDatatype{70, 12};
constexpr Field<float, double> kPixdim{76, 104}, kQuatern{256, 352}, kQoffset{268, 376}, kSrow{280, 400};
constexpr Field<float, std::int64_t, double> kVoxOffset{108, 168};
constexpr Field<float, double> kSclSlope{112, 176}, kSclInter{116, 184};
constexpr Field<std::int16_t, std::int32_t> kQformCode{252, 344}, kSformCode{254, 348};
constexpr Field<char, std::int32_t> kXyztUnits{123, 500};
constexpr Field<char, char> kMagic{344, 4};

/// A whole header. Its version and byte order show in sizeof_hdr, the first number of the file.
struct Header {
    std::span<const std::byte> bytes;
    std::size_t size;
    bool is_big_endian;

    bool is_first() const { return size == kNifti1HeaderBytes; }

    /// Number `i` of a field.
    template <class First, class Second, class Value>
    Value at(Field<First, Second, Value> field, std::size_t i = 0) const {
        return is_first() ? static_cast<Value>(load<First>(&bytes[field.first + i * sizeof(First)], is_big_endian))
                          : static_cast<Value>(load<Second>(&bytes[field.second + i * sizeof(Second)], is_big_endian));
    }
    Vec3 vector(Field<float, double> field, std::size_t i = 0, std::size_t step = 1) const {
        return {at(field, i), at(field, i + step), at(field, i + 2 * step)};
    }
};

/// Codes of nifti1.h, DT_*.
constexpr std::array<std::pair<int, SampleType>, 8> kIntegers{{{2, SampleType::kU8},
                                                               {4, SampleType::kI16},
                                                               {8, SampleType::kI32},
                                                               {256, SampleType::kI8},
                                                               {512, SampleType::kU16},
                                                               {768, SampleType::kU32},
                                                               {1024, SampleType::kI64},
                                                               {1280, SampleType::kU64}}};
constexpr std::array<std::pair<int, const char*>, 9> kNoLabels{{{1, "single bits"},
                                                                {16, "float32"},
                                                                {64, "float64"},
                                                                {1536, "float128"},
                                                                {32, "complex64"},
                                                                {1792, "complex128"},
                                                                {2048, "complex256"},
                                                                {128, "RGB colours"},
                                                                {2304, "RGBA colours"}}};

SampleType sample_type(const std::filesystem::path& path, std::int64_t datatype) {
    for (const auto& [code, type] : kIntegers) {
        if (code == datatype) return type;
    }
    std::string what = "of a type that is not read";
    for (const auto& [code, name] : kNoLabels) {
        if (code == datatype) what = name;
    }
    fail(path, "samples are " + what + " (datatype " + std::to_string(datatype) +
                   "); labels must be integers: convert them, to int32 say");
}

std::array<std::uint32_t, 3> volume_size(const std::filesystem::path& path, const Header& header) {
    const std::int64_t rank = header.at(kDim);
    if (rank < 2 || rank > 7)
        fail(path, "the header has " + std::to_string(rank) + " dimensions (dim[0]); a volume has three");
    std::array<std::uint64_t, 3> size{1, 1, 1};
    for (std::size_t axis = 1; axis <= static_cast<std::size_t>(rank); ++axis) {
        const std::int64_t count = header.at(kDim, axis);
        const std::string name = "dim[" + std::to_string(axis) + "]";
        if (count < 0) fail(path, name + " is " + std::to_string(count) + "; the header is damaged");
        if (axis <= 3)
            size[axis - 1] = static_cast<std::uint64_t>(count);
        else if (count > 1)
            fail(path, "holds " + std::to_string(count) + " volumes (" + name + "); save one of them alone");
    }
    return checked_size(path, size);
}

/// nifti1.h, method 2: the rotation of the unit quaternion (a, b, c, d), and qfac for a left-handed third axis.
Columns qform_columns(const Header& header, Vec3 spacing) {
    auto [b, c, d] = header.vector(kQuatern);
    double a = 1 - (b * b + c * c + d * d);
    if (a < 1e-7) {  // half a turn: rounding may have left less than nothing for a
        const double scale = 1 / std::sqrt(b * b + c * c + d * d);
        b *= scale, c *= scale, d *= scale;
        a = 0;
    } else {
        a = std::sqrt(a);
    }
    const double qfac = header.at(kPixdim) < 0 ? -1 : 1;
    return {spacing.x * Vec3{a * a + b * b - c * c - d * d, 2 * (b * c + a * d), 2 * (b * d - a * c)},
            spacing.y * Vec3{2 * (b * c - a * d), a * a + c * c - b * b - d * d, 2 * (c * d + a * b)},
            qfac * spacing.z * Vec3{2 * (b * d + a * c), 2 * (c * d - a * b), a * a + d * d - c * c - b * b}};
}

/// pixdim of an axis that the header counts must be a length. `given` is --spacing, which replaces it.
Vec3 zooms(const std::filesystem::path& path, const Header& header, const std::optional<Vec3>& given) {
    Vec3 spacing = header.vector(kPixdim, 1);
    for (int axis = 0; axis < 3; ++axis) {
        if (axis >= header.at(kDim) || given) {
            spacing[axis] = given ? (*given)[axis] : 1;
        } else if (!(std::isfinite(spacing[axis]) && spacing[axis] > 0)) {
            fail(path, "pixdim[" + std::to_string(axis + 1) + "] is " + std::to_string(spacing[axis]) +
                           ", no distance of samples; give the right one with --spacing X,Y,Z");
        }
    }
    return spacing;
}

void read_affine(const std::filesystem::path& path, const Header& header, const ReadOptions& options,
                 Lattice& lattice) {
    if (header.at(kSformCode) > 0) {
        const auto column = [&](std::size_t i) { return header.vector(kSrow, i, 4); };  // of three rows of four
        set_affine(path, "sform", "set sform_code to 0 or mend it", {column(0), column(1), column(2)}, column(3),
                   lattice);
        return;
    }
    lattice.spacing = zooms(path, header, options.spacing);
    if (header.at(kQformCode) > 0) {
        set_affine(path, "qform", "set qform_code to 0 or mend it", qform_columns(header, lattice.spacing),
                   header.vector(kQoffset), lattice);
    }
}

/// The metres of the unit of space, which has three bits beside that of time.
std::optional<double> metres_of(const Header& header) {
    switch (static_cast<unsigned>(header.at(kXyztUnits)) & 7u) {
        case 1:
            return 1;
        case 2:
            return 1e-3;
        case 3:
            return 1e-6;
        default:
            return {};
    }
}

/// Labels are the stored values; a file that wants them scaled holds something else. No slope, 0 or NaN, scales
/// nothing.
void check_unscaled(const std::filesystem::path& path, const Header& header) {
    const double slope = header.at(kSclSlope), inter = header.at(kSclInter);
    if (slope == 0 || std::isnan(slope) || (slope == 1 && (inter == 0 || std::isnan(inter)))) return;
    fail(path, "scl_slope " + std::to_string(slope) + " and scl_inter " + std::to_string(inter) +
                   " rescale the samples; save the labels unscaled");
}

std::int64_t data_offset(const std::filesystem::path& path, const Header& header) {
    const double offset = header.at(kVoxOffset);
    if (offset == 0) return static_cast<std::int64_t>(header.size) + 4;  // four bytes say whether extensions follow
    if (!(offset >= static_cast<double>(header.size)) || offset > 0x1p62 || offset != std::floor(offset))
        fail(path, "vox_offset is " + std::to_string(offset) +
                       ", not a whole number of bytes behind the header; the header is damaged");
    return static_cast<std::int64_t>(offset);
}

/// `bytes` are the first of the file, kNifti2HeaderBytes if it has as many.
Header parse_header(const std::filesystem::path& path, std::span<const std::byte> bytes) {
    for (const bool is_big_endian : {false, true}) {
        const auto size = bytes.size() < 4 ? 0 : load<std::int32_t>(bytes.data(), is_big_endian);
        if (size != kNifti1HeaderBytes && size != kNifti2HeaderBytes) continue;
        const Header header{bytes, static_cast<std::size_t>(size), is_big_endian};
        if (bytes.size() < header.size) {
            fail(path, "the header ends after " + std::to_string(bytes.size()) + " of " + std::to_string(size) +
                           " bytes; the file is truncated, fetch it again");
        }
        const std::string magic{header.at(kMagic, 0), header.at(kMagic, 1), header.at(kMagic, 2)};
        if (magic.starts_with("ni"))
            fail(path, "is half of a NIfTI pair (.hdr and .img); join them into one .nii file");
        if (magic != (header.is_first() ? "n+1" : "n+2"))
            fail(path, "not a NIfTI file (no magic word; Analyze 7.5?); convert it to .nii");
        return header;
    }
    fail(path, "not a NIfTI file (sizeof_hdr is neither 348 nor 540); check the file");
}

}  // namespace

std::unique_ptr<SectionReader> open_nifti(const std::filesystem::path& path, const ReadOptions& options) {
    ArrayFile array{.format = "nifti", .source = path, .remedy = "decompress the file first (gunzip)"};
    const std::vector<std::byte> bytes = read_header(path, array.encoding, kNifti1HeaderBytes, kNifti2HeaderBytes);
    const Header header = parse_header(path, bytes);
    array.sample = {sample_type(path, header.at(kDatatype)), header.is_big_endian};
    array.lattice.size = volume_size(path, header);
    check_unscaled(path, header);
    read_affine(path, header, options, array.lattice);
    array.space = Space::kRas;
    array.metres = metres_of(header);
    array.skipped_bytes = data_offset(path, header);
    take_table_beside(array);
    return open_array(array, options);
}

}  // namespace regionmesh::formats
