// Sections from an array in memory: any integer type, any strides, no copy.
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>

#include "regionmesh/label_names.h"
#include "regionmesh/section_reader.h"

namespace regionmesh {

using ArraySize = std::array<std::uint32_t, 3>;      // samples along x, y, z
using ArrayStrides = std::array<std::ptrdiff_t, 3>;  // bytes from a sample to the next along x, y, z

/// A view of a labelled volume in the caller's memory. Samples have the byte order of the machine and need not be
/// aligned. Strides may be negative or 0, as in numpy.
struct LabelArray {
    const void* data = nullptr;         // sample (0, 0, 0)
    SampleType type = SampleType::kU8;  // all but kU1
    ArraySize size{};
    ArrayStrides strides{};
};

/// Strides of an array without gaps, x fastest, then y.
constexpr ArrayStrides dense_strides(const ArraySize& size, std::size_t sample_bytes) {
    const auto x = static_cast<std::ptrdiff_t>(sample_bytes);
    return {x, x * std::ptrdiff_t{size[0]}, x * std::ptrdiff_t{size[0]} * std::ptrdiff_t{size[1]}};
}

/// The sample type of an integer type of C++.
template <std::integral T>
constexpr SampleType sample_type_of() {
    constexpr bool is_signed = std::is_signed_v<T>;
    static_assert(sizeof(T) == 1 || sizeof(T) == 2 || sizeof(T) == 4 || sizeof(T) == 8);
    if constexpr (sizeof(T) == 1) return is_signed ? SampleType::kI8 : SampleType::kU8;
    if constexpr (sizeof(T) == 2) return is_signed ? SampleType::kI16 : SampleType::kU16;
    if constexpr (sizeof(T) == 4) return is_signed ? SampleType::kI32 : SampleType::kU32;
    return is_signed ? SampleType::kI64 : SampleType::kU64;
}

template <std::integral T>
LabelArray label_array(const T* data, const ArraySize& size, const ArrayStrides& strides) {
    return {data, sample_type_of<T>(), size, strides};
}
/// An array without gaps, x fastest, then y.
template <std::integral T>
LabelArray label_array(const T* data, const ArraySize& size) {
    return label_array(data, size, dense_strides(size, sizeof(T)));
}

struct ArrayOptions {
    Vec3 spacing{1, 1, 1};
    Vec3 origin{0, 0, 0};
    std::array<double, 9> direction{1, 0, 0, 0, 1, 0, 0, 0, 1};  // direction as in Lattice
    std::optional<double> metres = {};                           // metres in a unit of length: 1e-15 to 1e6
    Space space = Space::kUnknown;
    SweepChoice sweep = SweepChoice::kAuto;
    LabelNames names = {};
    std::string name = "array";  // name of the array in messages
};

/// A reader of the array's sections. The array must outlive it and stay unchanged; the reader holds no copy, so
/// ReconstructOptions::memory does not include the array. Labels of unsigned 64-bit arrays keep their bits. Throws
/// Error(kInput) for an array without data or samples, a type that is no integer of whole bytes, spacing that is not
/// positive, a direction, origin or unit that is out of range, or directions that are not of length 1, to a thousandth.
std::unique_ptr<SectionReader> open_array(const LabelArray& array, const ArrayOptions& options = {});

}  // namespace regionmesh
