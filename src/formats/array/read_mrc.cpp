// MRC2014, the format of electron tomography: https://www.ccpem.ac.uk/mrc_format/mrc2014.php
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstring>
#include <span>

#include "base/add_warning.h"
#include "formats/array/array_axes.h"
#include "formats/array/array_file.h"
#include "formats/array/volume_formats.h"
#include "formats/array/volume_size.h"
#include "formats/codec/numbers.h"
#include "formats/input_file.h"

namespace regionmesh::formats {
namespace {

constexpr std::size_t kHeaderBytes = 1024;
// Where numbers of four bytes lie in the header.
constexpr std::size_t kSizes = 0, kMode = 12, kIntervals = 28, kCell = 40, kAxes = 64, kExtended = 92, kImodStamp = 152,
                      kImodFlags = 156, kOrigin = 196;
constexpr std::int32_t kImod = 1146047817;  // "IMOD" as a number
constexpr double kAngstrom = 1e-10;

/// A header in the byte order in which its axes are 1, 2 and 3 in some order, and its mode is known.
class MrcHeader {
public:
    MrcHeader(const std::filesystem::path& path, std::span<const std::byte> bytes) : path_(path), bytes_(bytes) {
        if (bytes.size() < kHeaderBytes) fail(path, "is shorter than the header of an MRC file; fetch it again");
        for (const bool is_big_endian : {false, true}) {
            is_big_endian_ = is_big_endian;
            const std::int32_t mode = integer(kMode), x = integer(kSizes);
            if (mode >= 0 && mode <= 101 && x > 0 && x < (1 << 24)) return;
        }
        fail(path, "is no MRC file (neither mode nor size of its header make sense); check the file");
    }

    std::int32_t integer(std::size_t place) const { return load<std::int32_t>(&bytes_[place], is_big_endian_); }
    double real(std::size_t place) const { return load<float>(&bytes_[place], is_big_endian_); }

    SampleFormat format() const {
        switch (const std::int32_t mode = integer(kMode)) {
            case 0: {
                // IMOD wrote bytes without a sign until 2012, and says so.
                const bool is_unsigned = integer(kImodStamp) == kImod && (integer(kImodFlags) & 1) == 0;
                return {is_unsigned ? SampleType::kU8 : SampleType::kI8, false};
            }
            case 1:
                return {SampleType::kI16, is_big_endian_};
            case 2:
                return real_format(NumberType::kFloat32, is_big_endian_);
            case 6:
                return {SampleType::kU16, is_big_endian_};
            default:
                fail(path_, fmt::format("has samples of mode {}; labels are of mode 0, 1, 2 or 6: convert them", mode));
        }
    }

    void place(const ReadOptions& options, ArrayFile& array) const {
        std::array<std::uint64_t, 3> size{};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const std::int32_t count = integer(kSizes + 4 * axis), order = integer(kAxes + 4 * axis);
            if (count < 0) fail(path_, fmt::format("has {} samples along an axis; the header is damaged", count));
            if (order != 0 && order != static_cast<std::int32_t>(axis) + 1)
                fail(path_, "stores its axes in another order than x, y, z (MAPC, MAPR, MAPS); write it in this one");
            size[axis] = static_cast<std::uint64_t>(count);
        }
        array.lattice.size = checked_size(path_, size);
        bool is_known = true;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const double intervals = integer(kIntervals + 4 * axis), cell = real(kCell + 4 * axis);
            const double spacing = intervals > 0 ? cell / intervals : 0, origin = real(kOrigin + 4 * axis);
            const bool is_length = std::isfinite(spacing) && spacing > 0;
            is_known &= is_length;
            array.lattice.spacing[static_cast<int>(axis)] = is_length ? spacing : 1;
            array.lattice.origin[static_cast<int>(axis)] = std::isfinite(origin) ? origin : 0;
        }
        if (is_known)
            array.metres = kAngstrom;
        else if (!options.spacing)
            add_warning(array.warning,
                        "the header does not give all lengths of a voxel, which are taken as 1; give "
                        "--spacing X,Y,Z");
    }

private:
    const std::filesystem::path& path_;
    std::span<const std::byte> bytes_;
    bool is_big_endian_ = false;
};

}  // namespace

std::unique_ptr<SectionReader> open_mrc(const std::filesystem::path& path, const ReadOptions& options) {
    ArrayFile array{.format = "mrc", .source = path, .remedy = "decompress the file first (gunzip)"};
    const std::vector<std::byte> bytes = read_header(path, array.encoding, kHeaderBytes, kHeaderBytes);
    const MrcHeader header(path, bytes);
    array.sample = header.format();
    header.place(options, array);
    const std::int64_t extended = header.integer(kExtended);
    if (extended < 0) fail(path, "has an extended header of a negative length; the header is damaged");
    array.skipped_bytes = static_cast<std::int64_t>(kHeaderBytes) + extended;
    take_table_beside(array);
    return open_array(array, options);
}

}  // namespace regionmesh::formats
