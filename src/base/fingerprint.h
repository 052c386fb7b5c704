// A hash of bytes that is the same in every build, for what files keep.
#pragma once

#include <cstdint>
#include <string_view>

namespace regionmesh {

/// FNV-1a, 64 bits, of the bytes added so far (Fowler, Noll, Vo).
class Fingerprint {
public:
    Fingerprint& add(std::string_view text) {
        for (const char c : text) add_byte(static_cast<unsigned char>(c));
        return *this;
    }
    /// The lowest byte first.
    Fingerprint& add(std::uint64_t word) {
        for (int byte = 0; byte < 8; ++byte) add_byte(word >> 8 * byte & 0xFF);
        return *this;
    }
    std::uint64_t value() const { return value_; }

private:
    void add_byte(std::uint64_t byte) { value_ = (value_ ^ byte) * 0x100000001B3u; }

    std::uint64_t value_ = 0xCBF29CE484222325u;
};

}  // namespace regionmesh
