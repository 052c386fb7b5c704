// NIfTI-1 and NIfTI-2 files: https://nifti.nimh.nih.gov (nifti1.h, nifti2.h).
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/add_warning.h"
#include "formats/array/affine.h"
#include "formats/array/array_file.h"
#include "formats/array/volume_formats.h"
#include "formats/array/volume_size.h"
#include "formats/codec/deflate_stream.h"
#include "formats/codec/numbers.h"
#include "formats/input_file.h"
#include "formats/registry.h"
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
    bool is_analyze = false;  // Analyze 7.5: sizes, type and spacings lie where NIfTI has them, and no place in space

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
constexpr std::array<std::pair<int, const char*>, 7> kNoLabels{{{1, "single bits"},
                                                                {1536, "float128"},
                                                                {32, "complex64"},
                                                                {1792, "complex128"},
                                                                {2048, "complex256"},
                                                                {128, "RGB colours"},
                                                                {2304, "RGBA colours"}}};

SampleFormat stored_format(const std::filesystem::path& path, std::int64_t datatype, bool is_big_endian) {
    constexpr int kSingle = 16, kDouble = 64;
    if (datatype == kSingle) return real_format(NumberType::kFloat32, is_big_endian);
    if (datatype == kDouble) return real_format(NumberType::kFloat64, is_big_endian);
    for (const auto& [code, type] : kIntegers) {
        if (code == datatype) return {type, is_big_endian};
    }
    std::string what = "of a type that is not read";
    for (const auto& [code, name] : kNoLabels) {
        if (code == datatype) what = name;
    }
    fail(path, "samples are " + what + " (datatype " + std::to_string(datatype) +
                   "); labels must be integers: convert them, to int32 say");
}

/// The samples along each of the seven axes.
std::array<std::uint64_t, 7> axis_sizes(const std::filesystem::path& path, const Header& header) {
    const std::int64_t rank = header.at(kDim);
    if (rank < 2 || rank > 7)
        fail(path, "the header has " + std::to_string(rank) + " dimensions (dim[0]); a volume has three");
    std::array<std::uint64_t, 7> size{1, 1, 1, 1, 1, 1, 1};
    for (std::size_t axis = 1; axis <= static_cast<std::size_t>(rank); ++axis) {
        const std::int64_t count = header.at(kDim, axis);
        if (count < 0) fail(path, fmt::format("dim[{}] is {}; the header is damaged", axis, count));
        size[axis - 1] = axis <= 3 ? static_cast<std::uint64_t>(count) : std::max<std::uint64_t>(count, 1);
    }
    return size;
}

void choose_volume(const std::array<std::uint64_t, 7>& size, const ReadOptions& options, ArrayFile& array) {
    std::vector<BlockAxis> axes;
    for (std::size_t axis = 3; axis < size.size(); ++axis)
        axes.push_back({fmt::format("dim[{}]", axis + 1), size[axis]});
    choose_block(axes, options, array);
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

/// A file may say twice where its samples lie, and the two may differ: by a mirror, say.
std::string warning_of_two_maps(const std::filesystem::path& path, const Header& header) {
    if (header.at(kSformCode) <= 0 || header.at(kQformCode) <= 0) return {};
    const Vec3 pixdim = header.vector(kPixdim, 1);
    if (!(pixdim.x > 0 && pixdim.y > 0 && pixdim.z > 0 && std::isfinite(pixdim.x + pixdim.y + pixdim.z))) return {};
    const Columns qform = qform_columns(header, zooms(path, header, {}));
    const Columns sform{header.vector(kSrow, 0, 4), header.vector(kSrow, 1, 4), header.vector(kSrow, 2, 4)};
    const auto volume = [](const Columns& columns) { return dot(columns[0], cross(columns[1], columns[2])); };
    constexpr double kRounding = 0.01;  // of a spacing
    double off = length(header.vector(kQoffset) - header.vector(kSrow, 3, 4)) /
                 std::min({length(qform[0]), length(qform[1]), length(qform[2])});
    for (int axis = 0; axis < 3; ++axis) {
        const double samples = std::max(static_cast<double>(header.at(kDim, static_cast<std::size_t>(axis) + 1)), 1.0);
        off = std::max(off, samples * length(qform[axis] - sform[axis]) / length(qform[axis]));
    }
    if (!(off > kRounding)) return {};
    const bool is_mirrored = (volume(qform) < 0) != (volume(sform) < 0);
    return fmt::format("its sform and its qform disagree{}; the sform is used{}",
                       is_mirrored ? ": one is the mirror image of the other" : " about where the samples lie",
                       is_mirrored ? ": look whether left and right are on the right side" : "");
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

/// No slope, 0 or NaN, scales nothing.
void set_scale(const std::filesystem::path& path, const Header& header, SampleFormat& format) {
    const double slope = header.at(kSclSlope), intercept = header.is_analyze ? 0 : header.at(kSclInter);
    if (header.is_analyze && !std::isfinite(slope)) return;  // SPM has a scale there, others anything
    if (slope == 0 || std::isnan(slope)) return;
    if (std::isinf(slope) || std::isinf(intercept))
        fail(path, "scl_slope and scl_inter are not finite; set them to 1 and 0, or mend them");
    format.slope = slope;
    format.intercept = std::isnan(intercept) ? 0 : intercept;
}

std::int64_t data_offset(const std::filesystem::path& path, const Header& header, bool is_pair) {
    const double offset = header.at(kVoxOffset);
    if (is_pair) {
        if (!(offset >= 0) || offset > 0x1p62 || offset != std::floor(offset))
            fail(path, "vox_offset is " + std::to_string(offset) + ", no whole number of bytes; the header is damaged");
        return static_cast<std::int64_t>(offset);
    }
    if (offset == 0) return static_cast<std::int64_t>(header.size) + 4;  // four bytes say whether extensions follow
    if (!(offset >= static_cast<double>(header.size)) || offset > 0x1p62 || offset != std::floor(offset))
        fail(path, "vox_offset is " + std::to_string(offset) +
                       ", not a whole number of bytes behind the header; the header is damaged");
    return static_cast<std::int64_t>(offset);
}

/// `bytes` are the first of the file, kNifti2HeaderBytes if it has as many.
Header parse_header(const std::filesystem::path& path, std::span<const std::byte> bytes, bool is_pair) {
    for (const bool is_big_endian : {false, true}) {
        const auto size = bytes.size() < 4 ? 0 : load<std::int32_t>(bytes.data(), is_big_endian);
        if (size != kNifti1HeaderBytes && size != kNifti2HeaderBytes) continue;
        Header header{bytes, static_cast<std::size_t>(size), is_big_endian};
        if (bytes.size() < header.size) {
            fail(path, "the header ends after " + std::to_string(bytes.size()) + " of " + std::to_string(size) +
                           " bytes; the file is truncated, fetch it again");
        }
        const std::string magic{header.at(kMagic, 0), header.at(kMagic, 1), header.at(kMagic, 2)};
        const char version = header.is_first() ? '1' : '2';
        if (is_pair) {
            header.is_analyze = header.is_first() && !magic.starts_with("n");
            if (!header.is_analyze && magic != std::string("ni") + version)
                fail(path,
                     "is no header of a NIfTI pair, nor of Analyze 7.5 (its magic word is another); check the file");
            return header;
        }
        if (magic.starts_with("ni")) fail(path, "is half of a NIfTI pair: name it .hdr, and the file of samples .img");
        if (magic != std::string("n+") + version)
            fail(path, "not a NIfTI file (no magic word); an Analyze header is named .hdr");
        return header;
    }
    fail(path, "not a NIfTI file (sizeof_hdr is neither 348 nor 540); check the file");
}

/// The two files of a pair.
struct PairOfFiles {
    std::filesystem::path header, samples;
};

/// Of a path to either, compressed or not; none where the path names a file of another kind.
std::optional<PairOfFiles> pair_of(const std::filesystem::path& path) {
    const std::string own = extension(path);
    if (!own.starts_with(".hdr") && !own.starts_with(".img")) return {};
    const std::string text = path.string(), stem = text.substr(0, text.size() - own.size());
    const auto find = [&](std::initializer_list<const char*> endings) {
        std::error_code ignored;
        for (const char* ending : endings)
            if (std::filesystem::is_regular_file(stem + ending, ignored)) return std::filesystem::path(stem + ending);
        fail(path, fmt::format("is half of a pair, and {}{} is not there; put it beside", stem, *endings.begin()));
    };
    PairOfFiles pair;
    pair.header = own.starts_with(".hdr") ? path : find({".hdr", ".hdr.gz", ".HDR"});
    pair.samples = own.starts_with(".img") ? path : find({".img", ".img.gz", ".IMG"});
    return pair;
}

}  // namespace

std::unique_ptr<SectionReader> open_nifti(const std::filesystem::path& path, const ReadOptions& options) {
    const auto pair = pair_of(path);
    const std::filesystem::path header_file = pair ? pair->header : path;
    ArrayFile array{.format = "nifti", .source = path, .remedy = "decompress the file first (gunzip)"};
    const std::vector<std::byte> bytes =
        read_header(header_file, array.encoding, kNifti1HeaderBytes, kNifti2HeaderBytes);
    const Header header = parse_header(header_file, bytes, pair.has_value());
    if (pair) {
        array.files = {pair->samples};
        array.encoding = is_gzipped(InputFile(pair->samples)) ? Encoding::kDeflated : Encoding::kRaw;
    }
    array.sample = stored_format(path, header.at(kDatatype), header.is_big_endian);
    set_scale(path, header, array.sample);
    const auto size = axis_sizes(path, header);
    array.lattice.size = checked_size(path, {size[0], size[1], size[2]});
    choose_volume(size, options, array);
    array.skipped_bytes = data_offset(path, header, pair.has_value());
    if (header.is_analyze) {
        array.format = "analyze";
        array.lattice.spacing = zooms(path, header, options.spacing);
        array.warning =
            "Analyze files do not say where their samples lie, nor which side is left; positions begin at 0";
    } else {
        read_affine(path, header, options, array.lattice);
        array.space = Space::kRas;
        array.metres = metres_of(header);
        add_warning(array.warning, warning_of_two_maps(path, header));
    }
    take_table_beside(array);
    return open_array(array, options);
}

}  // namespace regionmesh::formats
