#include "formats/array/nifti_header.h"

#include <bit>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "formats/array/affine.h"
#include "formats/array/volume_size.h"
#include "formats/input_file.h"

namespace regionmesh::formats {
namespace {

/// Fields of the header as both versions have them, by name; reals as doubles.
struct Fields {
    std::string_view magic;
    std::array<std::int64_t, 8> dim{};
    std::int64_t datatype = 0;
    std::array<double, 8> pixdim{};
    double vox_offset = 0, scl_slope = 0, scl_inter = 0;
    std::int64_t qform_code = 0, sform_code = 0;
    std::array<double, 3> quatern{}, qoffset{};
    std::array<double, 12> srow{};
};

/// Places of those fields in the file.
struct Places {
    std::size_t magic, dim, datatype, pixdim, vox_offset, scl_slope, scl_inter, qform_code, sform_code, quatern,
        qoffset, srow;
};
constexpr Places kPlaces1{344, 40, 70, 76, 108, 112, 116, 252, 254, 256, 268, 280};
constexpr Places kPlaces2{4, 16, 12, 104, 168, 176, 184, 344, 348, 352, 376, 400};

template <class Value>
Value value_at(std::span<const std::byte> bytes, std::size_t place, bool is_big_endian) {
    std::array<std::byte, sizeof(Value)> raw;
    for (std::size_t i = 0; i < raw.size(); ++i) {
        const bool is_same = is_big_endian == (std::endian::native == std::endian::big);
        raw[i] = bytes[place + (is_same ? i : raw.size() - 1 - i)];
    }
    return std::bit_cast<Value>(raw);
}

template <class Value, class Array>
void read_array(std::span<const std::byte> bytes, std::size_t place, bool is_big_endian, Array& out) {
    for (std::size_t i = 0; i < out.size(); ++i) {
        out[i] = value_at<Value>(bytes, place + i * sizeof(Value), is_big_endian);
    }
}

/// The two versions differ in the width of their numbers: Dim, Code, Real and Offset (of the first sample).
template <class Dim, class Code, class Real, class Offset>
Fields read_fields(std::span<const std::byte> bytes, const Places& at, bool is_big_endian) {
    Fields fields;
    fields.magic = {reinterpret_cast<const char*>(bytes.data()) + at.magic, 4};
    fields.datatype = value_at<std::int16_t>(bytes, at.datatype, is_big_endian);
    fields.vox_offset = static_cast<double>(value_at<Offset>(bytes, at.vox_offset, is_big_endian));
    fields.scl_slope = value_at<Real>(bytes, at.scl_slope, is_big_endian);
    fields.scl_inter = value_at<Real>(bytes, at.scl_inter, is_big_endian);
    fields.qform_code = value_at<Code>(bytes, at.qform_code, is_big_endian);
    fields.sform_code = value_at<Code>(bytes, at.sform_code, is_big_endian);
    read_array<Dim>(bytes, at.dim, is_big_endian, fields.dim);
    read_array<Real>(bytes, at.pixdim, is_big_endian, fields.pixdim);
    read_array<Real>(bytes, at.quatern, is_big_endian, fields.quatern);
    read_array<Real>(bytes, at.qoffset, is_big_endian, fields.qoffset);
    read_array<Real>(bytes, at.srow, is_big_endian, fields.srow);
    return fields;
}

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

std::array<std::uint32_t, 3> volume_size(const std::filesystem::path& path, const std::array<std::int64_t, 8>& dim) {
    const std::int64_t rank = dim[0];
    if (rank < 2 || rank > 7)
        fail(path, "the header has " + std::to_string(rank) + " dimensions (dim[0]); a volume has three");
    std::array<std::uint64_t, 3> size{1, 1, 1};
    for (std::int64_t axis = 1; axis <= rank; ++axis) {
        if (dim[axis] < 0)
            fail(path, "dim[" + std::to_string(axis) + "] is " + std::to_string(dim[axis]) + "; the header is damaged");
        if (axis <= 3) {
            size[axis - 1] = static_cast<std::uint64_t>(dim[axis]);
        } else if (dim[axis] > 1) {
            fail(path, "holds " + std::to_string(dim[axis]) + " volumes (dim[" + std::to_string(axis) +
                           "]); save one of them alone");
        }
    }
    return checked_size(path, size);
}

/// nifti1.h, method 2: the rotation of the unit quaternion (a, b, c, d), and qfac for a left-handed third axis.
Columns qform_columns(const Fields& fields, Vec3 spacing) {
    auto [b, c, d] = fields.quatern;
    double a = 1 - (b * b + c * c + d * d);
    if (a < 1e-7) {  // half a turn: rounding may have left less than nothing for a
        const double scale = 1 / std::sqrt(b * b + c * c + d * d);
        b *= scale, c *= scale, d *= scale;
        a = 0;
    } else {
        a = std::sqrt(a);
    }
    const double qfac = fields.pixdim[0] < 0 ? -1 : 1;
    return {spacing.x * Vec3{a * a + b * b - c * c - d * d, 2 * (b * c + a * d), 2 * (b * d - a * c)},
            spacing.y * Vec3{2 * (b * c - a * d), a * a + c * c - b * b - d * d, 2 * (c * d + a * b)},
            qfac * spacing.z * Vec3{2 * (b * d + a * c), 2 * (c * d - a * b), a * a + d * d - c * c - b * b}};
}

void read_affine(const std::filesystem::path& path, const Fields& fields, Lattice& lattice) {
    if (fields.sform_code > 0) {
        const auto& s = fields.srow;
        set_affine(path, "sform", "set sform_code to 0 or mend it",
                   {Vec3{s[0], s[4], s[8]}, Vec3{s[1], s[5], s[9]}, Vec3{s[2], s[6], s[10]}}, {s[3], s[7], s[11]},
                   lattice);
        return;
    }
    for (int axis = 0; axis < 3; ++axis) {
        const double spacing = std::abs(fields.pixdim[axis + 1]);  // 0 where nobody wrote one: 1, as nifticlib has it
        lattice.spacing[axis] = std::isfinite(spacing) && spacing > 0 ? spacing : 1;
    }
    if (fields.qform_code > 0) {
        const auto& q = fields.qoffset;
        set_affine(path, "qform", "set qform_code to 0 or mend it", qform_columns(fields, lattice.spacing),
                   {q[0], q[1], q[2]}, lattice);
    }
}

/// Labels are what is stored; a file that wants them scaled holds something else. No slope, 0 or NaN, scales nothing.
void check_unscaled(const std::filesystem::path& path, const Fields& fields) {
    if (fields.scl_slope == 0 || std::isnan(fields.scl_slope)) return;
    if (fields.scl_slope == 1 && (fields.scl_inter == 0 || std::isnan(fields.scl_inter))) return;
    fail(path, "scl_slope " + std::to_string(fields.scl_slope) + " and scl_inter " + std::to_string(fields.scl_inter) +
                   " rescale the samples; save the labels unscaled");
}

std::uint64_t data_offset(const std::filesystem::path& path, double vox_offset, std::size_t header_bytes) {
    if (vox_offset == 0) return header_bytes + 4;  // four bytes say whether extensions follow
    if (!(vox_offset >= static_cast<double>(header_bytes)) || vox_offset > 0x1p62) {
        fail(path, "vox_offset is " + std::to_string(vox_offset) + ", not behind the header; the header is damaged");
    }
    return static_cast<std::uint64_t>(vox_offset);
}

/// The version and the byte order show in sizeof_hdr, the first number of the file.
struct Version {
    std::size_t header_bytes;
    bool is_big_endian;
};

std::optional<Version> detect_version(std::span<const std::byte> bytes) {
    if (bytes.size() < 4) return std::nullopt;
    for (const bool is_big_endian : {false, true}) {
        const auto header_bytes = value_at<std::int32_t>(bytes, 0, is_big_endian);
        if (header_bytes == kNifti1HeaderBytes || header_bytes == kNifti2HeaderBytes) {
            return Version{static_cast<std::size_t>(header_bytes), is_big_endian};
        }
    }
    return std::nullopt;
}

}  // namespace

NiftiHeader parse_nifti_header(const std::filesystem::path& path, std::span<const std::byte> bytes) {
    const auto version = detect_version(bytes);
    if (!version) fail(path, "not a NIfTI file (sizeof_hdr is neither 348 nor 540); check the file");
    if (bytes.size() < version->header_bytes) {
        fail(path, "the header ends after " + std::to_string(bytes.size()) + " of " +
                       std::to_string(version->header_bytes) + " bytes; the file is truncated, fetch it again");
    }
    const bool is_first = version->header_bytes == kNifti1HeaderBytes;
    const Fields fields =
        is_first
            ? read_fields<std::int16_t, std::int16_t, float, float>(bytes, kPlaces1, version->is_big_endian)
            : read_fields<std::int64_t, std::int32_t, double, std::int64_t>(bytes, kPlaces2, version->is_big_endian);
    if (fields.magic.starts_with("ni"))
        fail(path, "is half of a NIfTI pair (.hdr and .img); join them into one .nii file");
    if (!fields.magic.starts_with(is_first ? "n+1" : "n+2"))
        fail(path, "not a NIfTI file (no magic word; Analyze 7.5?); convert it to .nii");
    NiftiHeader header;
    header.format = {sample_type(path, fields.datatype), version->is_big_endian};
    header.lattice.size = volume_size(path, fields.dim);
    check_unscaled(path, fields);
    read_affine(path, fields, header.lattice);
    header.data_offset = data_offset(path, fields.vox_offset, version->header_bytes);
    return header;
}

}  // namespace regionmesh::formats
