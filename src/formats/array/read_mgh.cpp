// Volumes of FreeSurfer: https://surfer.nmr.mgh.harvard.edu/fswiki/FsTutorial/MghFormat
#include <array>
#include <cmath>
#include <cstdint>
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

namespace regionmesh::formats {
namespace {

constexpr std::size_t kHeaderBytes = 284;
constexpr std::size_t kSizes = 4, kFrames = 16, kType = 20, kHasPlace = 28, kSpacing = 30, kDirections = 42,
                      kCentre = 78;

/// Big endian, whatever the machine.
class Header {
public:
    Header(const std::filesystem::path& path, std::span<const std::byte> bytes) : path_(path), bytes_(bytes) {
        if (bytes.size() < kHeaderBytes || load<std::int32_t>(bytes.data(), true) != 1)
            fail(path, "not an MGH file (it does not begin with version 1); check the file");
    }

    std::array<std::uint32_t, 3> size() const {
        std::array<std::uint64_t, 3> size;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const std::int64_t count = integer(kSizes + 4 * axis);
            if (count < 0) fail(path_, "a size is " + std::to_string(count) + "; the header is damaged");
            size[axis] = static_cast<std::uint64_t>(count);
        }
        return checked_size(path_, size);
    }

    std::uint64_t frames() const {
        const std::int64_t frames = integer(kFrames);
        if (frames < 1) fail(path_, "holds " + std::to_string(frames) + " frames; the header is damaged");
        return static_cast<std::uint64_t>(frames);
    }

    SampleFormat format() const {
        const std::int64_t type = integer(kType);
        constexpr int kReal = 3;
        if (type == kReal) return real_format(NumberType::kFloat32, true);
        constexpr std::array<std::pair<int, SampleType>, 4> kIntegers{
            {{0, SampleType::kU8}, {1, SampleType::kI32}, {4, SampleType::kI16}, {10, SampleType::kU16}}};
        for (const auto& [code, found] : kIntegers)
            if (code == type) return {found, true};
        fail(path_, "samples are of a type that is not read (type " + std::to_string(type) +
                        "); labels must be integers: mri_convert -odt int makes them");
    }

    /// Columns lead from the middle of the volume; without a place in the header FreeSurfer takes coronal sections.
    void place(const ReadOptions& options, Lattice& lattice) const {
        std::array<Vec3, 3> directions{Vec3{-1, 0, 0}, Vec3{0, 0, -1}, Vec3{0, 1, 0}};
        Vec3 spacing{1, 1, 1}, centre{};
        if (load<std::int16_t>(bytes_.data() + kHasPlace, true) > 0) {
            spacing = vector(kSpacing);
            for (std::size_t axis = 0; axis < 3; ++axis) directions[axis] = vector(kDirections + 12 * axis);
            centre = vector(kCentre);
        }
        Columns columns;
        Vec3 steps;
        for (int axis = 0; axis < 3; ++axis) {
            columns[axis] = spacing[axis] * directions[axis];
            steps[axis] = -0.5 * lattice.size[axis];
        }
        const Vec3 first = first_sample(columns, centre, steps, options);
        set_affine(path_, "map to space", "mend the header", columns, first, lattice);
    }

private:
    std::int64_t integer(std::size_t place) const { return load<std::int32_t>(bytes_.data() + place, true); }
    Vec3 vector(std::size_t place) const {
        const auto number = [&](std::size_t n) { return double{load<float>(bytes_.data() + place + 4 * n, true)}; };
        return {number(0), number(1), number(2)};
    }

    const std::filesystem::path& path_;
    std::span<const std::byte> bytes_;
};

}  // namespace

std::unique_ptr<SectionReader> open_mgh(const std::filesystem::path& path, const ReadOptions& options) {
    ArrayFile array{.format = "mgh", .source = path, .remedy = "decompress the file first (mri_convert a.mgz a.mgh)"};
    const std::vector<std::byte> bytes = read_header(path, array.encoding, kHeaderBytes, kHeaderBytes);
    const Header header(path, bytes);
    array.sample = header.format();
    array.lattice.size = header.size();
    choose_block({{"frames", header.frames()}}, options, array);
    header.place(options, array.lattice);
    array.space = Space::kRas;
    array.metres = 1e-3;  // as the format has it
    array.skipped_bytes = kHeaderBytes;
    take_table_beside(array);
    return open_array(array, options);
}

}  // namespace regionmesh::formats
