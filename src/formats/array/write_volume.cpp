#include "regionmesh/write_volume.h"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "formats/codec/sample_format.h"
#include "formats/text/length_unit.h"
#include "regionmesh/error.h"
#include "regionmesh/label_table.h"
#include "regionmesh/limits.h"
#include "regionmesh/output_file.h"
#include "regionmesh/write_report.h"

namespace regionmesh {
namespace {

static_assert(std::endian::native == std::endian::little, "samples are written as they lie in memory");

/// What each format calls a sample type.
struct TypeNames {
    SampleType type;
    const char *npy, *nrrd;
    std::int16_t nifti;
    InputLabel least, most;  // of labels below 2^63
};

template <class T>
constexpr TypeNames names(SampleType type, const char* npy, const char* nrrd, std::int16_t nifti) {
    using Limits = std::numeric_limits<T>;
    constexpr bool is_wide = sizeof(T) == 8;
    return {type,
            npy,
            nrrd,
            nifti,
            static_cast<InputLabel>(Limits::min()),
            is_wide ? std::numeric_limits<InputLabel>::max() : static_cast<InputLabel>(Limits::max())};
}

constexpr std::array kTypes{names<std::int8_t>(SampleType::kI8, "|i1", "int8", 256),
                            names<std::uint8_t>(SampleType::kU8, "|u1", "uint8", 2),
                            names<std::int16_t>(SampleType::kI16, "<i2", "int16", 4),
                            names<std::uint16_t>(SampleType::kU16, "<u2", "uint16", 512),
                            names<std::int32_t>(SampleType::kI32, "<i4", "int32", 8),
                            names<std::uint32_t>(SampleType::kU32, "<u4", "uint32", 768),
                            names<std::int64_t>(SampleType::kI64, "<i8", "int64", 1024),
                            names<std::uint64_t>(SampleType::kU64, "<u8", "uint64", 1280)};

const TypeNames& names_of(SampleType type) {
    if (type == SampleType::kU1) type = SampleType::kU8;
    for (const TypeNames& names : kTypes)
        if (names.type == type) return names;
    throw Error(ErrorCode::kOutput, "no such type of samples");
}

std::string npy_header(const Lattice& lattice, const Coordinates&, const TypeNames& type) {
    std::string text = fmt::format("{{'descr': '{}', 'fortran_order': False, 'shape': ({}, {}, {}), }}", type.npy,
                                   lattice.size[2], lattice.size[1], lattice.size[0]);
    text.append((64 - (10 + text.size() + 1) % 64) % 64, ' ');
    text += '\n';
    const auto length = static_cast<std::uint16_t>(text.size());
    std::string header("\x93NUMPY\x01\x00", 8);
    header += static_cast<char>(length & 0xFF);
    header += static_cast<char>(length >> 8);
    return header + text;
}

/// Column `axis` of the affine: the step from one sample to the next.
Vec3 step(const Lattice& lattice, int axis) {
    const auto& d = lattice.direction;
    return lattice.spacing[axis] * Vec3{d[axis], d[3 + axis], d[6 + axis]};
}

/// The line of the unit of all axes; none where it has no name, but would be a number of others.
std::string nrrd_unit(const std::optional<double>& metres) {
    const std::string symbol = metres ? length_symbol(*metres) : "";
    return formats::metres_in(symbol) ? fmt::format("space units: \"{0}\" \"{0}\" \"{0}\"\n", symbol) : "";
}

std::string nrrd_header(const Lattice& lattice, const Coordinates& coordinates, const TypeNames& type) {
    const char* where = coordinates.space == Space::kRas   ? "space: right-anterior-superior"
                        : coordinates.space == Space::kLps ? "space: left-posterior-superior"
                                                           : "space dimension: 3";
    std::string text =
        fmt::format("NRRD0004\ntype: {}\ndimension: 3\n{}\n{}sizes: {} {} {}\nspace directions:", type.nrrd, where,
                    nrrd_unit(coordinates.metres), lattice.size[0], lattice.size[1], lattice.size[2]);
    for (int axis = 0; axis < 3; ++axis) {
        const Vec3 s = step(lattice, axis);
        text += fmt::format(" ({},{},{})", s.x, s.y, s.z);
    }
    const Vec3 o = lattice.origin;
    return text + fmt::format("\nspace origin: ({},{},{})\nendian: little\nencoding: raw\n\n", o.x, o.y, o.z);
}

/// Writes values into a header of fixed places.
class Places {
public:
    explicit Places(std::size_t size) : bytes_(size, '\0') {}
    template <class T>
    void put(std::size_t at, T value) {
        std::memcpy(bytes_.data() + at, &value, sizeof value);
    }
    void put_text(std::size_t at, std::string_view text) { std::memcpy(bytes_.data() + at, text.data(), text.size()); }
    std::string take() { return std::move(bytes_); }

private:
    std::string bytes_;
};

/// Rows of three steps and the origin, in RAS, as NIfTI has them.
using Affine = std::array<double, 12>;

Affine affine_in_ras(const Lattice& lattice, Space space) {
    Affine affine;
    for (int row = 0; row < 3; ++row) {
        const double sign = space == Space::kLps && row < 2 ? -1 : 1;
        for (int column = 0; column < 4; ++column)
            affine[4 * row + column] = sign * (column < 3 ? step(lattice, column)[row] : lattice.origin[row]);
    }
    return affine;
}

/// Does single precision hold the affine, but for the rounding of its steps? Else samples on a side of a model would
/// lie beyond it.
bool is_single(const Affine& affine, const Lattice& lattice) {
    constexpr double kRounding = 1e-14;
    const double most = kRounding * std::max({lattice.spacing.x, lattice.spacing.y, lattice.spacing.z});
    return std::ranges::all_of(affine,
                               [&](double value) { return std::abs(static_cast<float>(value) - value) <= most; });
}

template <class Real>
void put_affine(Places& header, std::size_t at, const Affine& affine) {
    for (std::size_t n = 0; n < affine.size(); ++n)
        header.put<Real>(at + sizeof(Real) * n, static_cast<Real>(affine[n]));
}

/// NIFTI_UNITS_METER, _MM, _MICRON or _UNKNOWN.
std::int8_t nifti_unit(const std::optional<double>& metres) {
    return metres == 1 ? 1 : metres == 1e-3 ? 2 : metres == 1e-6 ? 3 : 0;
}

std::string nifti1_header(const Lattice& lattice, const Affine& affine, std::int8_t unit, const TypeNames& type) {
    Places header(352);
    header.put<std::int32_t>(0, 348);
    header.put<std::int16_t>(40, 3);
    header.put<float>(76, 1);
    for (int axis = 0; axis < 3; ++axis) {
        header.put<std::int16_t>(42 + 2 * axis, static_cast<std::int16_t>(lattice.size[axis]));
        header.put<float>(80 + 4 * axis, static_cast<float>(lattice.spacing[axis]));
    }
    for (int n = 3; n < 7; ++n) header.put<std::int16_t>(42 + 2 * n, 1);
    header.put<std::int16_t>(70, type.nifti);
    header.put<std::int16_t>(72, static_cast<std::int16_t>(8 * formats::sample_bytes(type.type)));
    header.put<float>(108, 352);
    header.put<float>(112, 1);
    header.put<std::int8_t>(123, unit);
    header.put<std::int16_t>(254, 1);  // sform: scanner coordinates
    put_affine<float>(header, 280, affine);
    header.put_text(344, "n+1");
    return header.take();
}

std::string nifti2_header(const Lattice& lattice, const Affine& affine, std::int8_t unit, const TypeNames& type) {
    Places header(544);
    header.put<std::int32_t>(0, 540);
    header.put_text(4, std::string_view("n+2\0\r\n\x1a\n", 8));
    header.put<std::int16_t>(12, type.nifti);
    header.put<std::int16_t>(14, static_cast<std::int16_t>(8 * formats::sample_bytes(type.type)));
    header.put<std::int64_t>(16, 3);
    header.put<double>(104, 1);
    for (int axis = 0; axis < 3; ++axis) {
        header.put<std::int64_t>(24 + 8 * axis, lattice.size[axis]);
        header.put<double>(112 + 8 * axis, lattice.spacing[axis]);
    }
    for (int n = 3; n < 7; ++n) header.put<std::int64_t>(24 + 8 * n, 1);
    header.put<std::int64_t>(168, 544);
    header.put<double>(176, 1);
    header.put<std::int32_t>(348, 1);  // sform: scanner coordinates
    put_affine<double>(header, 400, affine);
    header.put<std::int32_t>(500, unit);
    return header.take();
}

std::string nifti_header(const Lattice& lattice, const Coordinates& coordinates, const TypeNames& type) {
    const Affine affine = affine_in_ras(lattice, coordinates.space);
    const std::int8_t unit = nifti_unit(coordinates.metres);
    const bool fits = std::ranges::all_of(lattice.size, [](std::uint32_t n) { return n <= 32767; });
    return fits && is_single(affine, lattice) ? nifti1_header(lattice, affine, unit, type)
                                              : nifti2_header(lattice, affine, unit, type);
}

std::string no_header(const Lattice&, const Coordinates&, const TypeNames&) { return {}; }

struct Format {
    const char* extension;
    std::string (*header)(const Lattice&, const Coordinates&, const TypeNames&);
    bool is_gzipped;
};
constexpr std::array<Format, 5> kFormats{{{".npy", npy_header, false},
                                          {".nii", nifti_header, false},
                                          {".nii.gz", nifti_header, true},
                                          {".nrrd", nrrd_header, false},
                                          {".raw", no_header, false}}};

/// Bytes into a file, through gzip where wanted.
class Output {
public:
    Output(const std::filesystem::path& path, bool is_gzipped, const OutputOptions& options)
        : file_(path, options), is_gzipped_(is_gzipped) {
        constexpr int kGzipWrapper = 15 + 16, kMemory = 8;
        if (is_gzipped && deflateInit2(&stream_, 6, Z_DEFLATED, kGzipWrapper, kMemory, Z_DEFAULT_STRATEGY) != Z_OK)
            throw std::bad_alloc();
    }
    ~Output() {
        if (is_gzipped_) deflateEnd(&stream_);
    }
    Output(const Output&) = delete;
    Output& operator=(const Output&) = delete;

    void write(std::string_view bytes) {
        if (!is_gzipped_) return file_.write(bytes);
        constexpr std::size_t kMost = std::numeric_limits<uInt>::max();
        for (; !bytes.empty(); bytes.remove_prefix(std::min(bytes.size(), kMost)))
            deflate_all(bytes.substr(0, kMost), Z_NO_FLUSH);
    }
    void commit() {
        if (is_gzipped_) deflate_all({}, Z_FINISH);
        file_.commit();
    }

private:
    void deflate_all(std::string_view bytes, int flush) {
        stream_.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
        stream_.avail_in = static_cast<uInt>(bytes.size());
        do {
            stream_.next_out = reinterpret_cast<Bytef*>(buffer_.data());
            stream_.avail_out = static_cast<uInt>(buffer_.size());
            deflate(&stream_, flush);
            file_.write(std::string_view(buffer_.data(), buffer_.size() - stream_.avail_out));
        } while (stream_.avail_out == 0);
    }

    OutputFile file_;
    bool is_gzipped_;
    z_stream stream_{};
    std::array<char, 1 << 16> buffer_;
};

struct VolumeKind {
    const Lattice& lattice;
    const Coordinates& coordinates;
    SampleType type;
    bool has_unsigned_labels;
};

class VolumeWriter final : public SectionWriter {
public:
    VolumeWriter(const std::filesystem::path& path, const Format& format, const VolumeKind& kind,
                 const OutputOptions& options)
        : path_(path),
          size_(kind.lattice.size),
          type_(names_of(kind.type)),
          has_unsigned_labels_(kind.has_unsigned_labels),
          output_(path, format.is_gzipped, options) {
        output_.write(format.header(kind.lattice, kind.coordinates, type_));
    }

    void write(std::span<const InputLabel> section) override {
        if (section.size() != std::uint64_t{size_[0]} * size_[1] || ++written_ > size_[2]) refuse_count();
        const std::size_t size = formats::sample_bytes(type_.type);
        bytes_.resize(section.size() * size);
        char* place = bytes_.data();
        for (const InputLabel label : section) {
            if (!holds(label))
                throw Error(ErrorCode::kOutput,
                            fmt::format("{}: samples of {} do not hold the label {}; give --like a volume of a type "
                                        "that holds it",
                                        path_.string(), type_.nrrd, LabelTable(has_unsigned_labels_).text(label)));
            std::memcpy(place, &label, size);  // little endian: the low bytes come first
            place += size;
        }
        output_.write(bytes_);
    }
    void commit() override {
        if (written_ != size_[2]) refuse_count();
        output_.commit();
    }

private:
    bool holds(InputLabel label) const {
        if (has_unsigned_labels_ && label < 0) return type_.type == SampleType::kU64;
        return type_.least <= label && label <= type_.most;
    }
    [[noreturn]] void refuse_count() const {
        throw Error(ErrorCode::kOutput, fmt::format("{}: not the {} sections of {} x {} samples that were announced",
                                                    path_.string(), size_[2], size_[0], size_[1]));
    }

    std::filesystem::path path_;
    std::array<std::uint32_t, 3> size_;
    std::uint32_t written_ = 0;
    const TypeNames& type_;
    bool has_unsigned_labels_;
    Output output_;
    std::string bytes_;
};

}  // namespace

std::unique_ptr<SectionWriter> create_volume(const std::filesystem::path& path, const Lattice& lattice,
                                             const Coordinates& coordinates, SampleType type,
                                             const OutputOptions& options, bool has_unsigned_labels) {
    require_lattice(path.string(), lattice);
    const std::string name = path.filename().string();
    std::string known;
    for (const Format& format : kFormats) {
        if (name.ends_with(format.extension))
            return std::make_unique<VolumeWriter>(path, format,
                                                  VolumeKind{lattice, coordinates, type, has_unsigned_labels}, options);
        known += std::string(" ") + format.extension;
    }
    throw Error(ErrorCode::kOutput, path.string() + ": labels are written as" + known);
}

}  // namespace regionmesh
