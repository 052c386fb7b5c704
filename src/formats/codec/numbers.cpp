#include "formats/codec/numbers.h"

namespace regionmesh::formats {
namespace {

template <class From, bool kIsBig, class To>
void load_run(const std::byte* bytes, std::size_t pitch, std::span<To> numbers) {
    for (To& number : numbers) {
        number = static_cast<To>(load<From>(bytes, kIsBig));
        bytes += pitch;
    }
}

template <class From, class To>
void load_as(const std::byte* bytes, std::size_t pitch, bool is_big_endian, std::span<To> numbers) {
    is_big_endian ? load_run<From, true>(bytes, pitch, numbers) : load_run<From, false>(bytes, pitch, numbers);
}

}  // namespace

std::size_t bytes_of(NumberType type) {
    constexpr std::size_t kBytes[] = {1, 1, 2, 2, 4, 4, 8, 8, 4, 8};
    return kBytes[static_cast<std::size_t>(type)];
}

template <class To>
void load_all(const std::byte* bytes, std::size_t pitch, NumberType type, bool is_big_endian, std::span<To> numbers) {
    using Load = void (*)(const std::byte*, std::size_t, bool, std::span<To>);
    constexpr Load kLoads[] = {load_as<std::int8_t, To>,   load_as<std::uint8_t, To>,  load_as<std::int16_t, To>,
                               load_as<std::uint16_t, To>, load_as<std::int32_t, To>,  load_as<std::uint32_t, To>,
                               load_as<std::int64_t, To>,  load_as<std::uint64_t, To>, load_as<float, To>,
                               load_as<double, To>};
    kLoads[static_cast<std::size_t>(type)](bytes, pitch, is_big_endian, numbers);
}

template void load_all(const std::byte*, std::size_t, NumberType, bool, std::span<std::int64_t>);
template void load_all(const std::byte*, std::size_t, NumberType, bool, std::span<double>);

}  // namespace regionmesh::formats
