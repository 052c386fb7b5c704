// Text from files and names of files, as a terminal may show it.
#pragma once

#include <cstddef>
#include <cstdio>
#include <string>
#include <string_view>

namespace regionmesh::cli {

/// Calls put(bytes, count) with pieces of `text`. Control characters, which could command a terminal, become "\x1b":
/// those of ASCII, and U+0080 to U+009F in UTF-8. Allocates nothing.
template <class Put>
void for_printable(std::string_view text, Put&& put) {
    const auto escape = [&](unsigned char byte) {
        char escaped[8];
        put(escaped, static_cast<std::size_t>(std::snprintf(escaped, sizeof escaped, "\\x%02x", byte)));
    };
    for (std::size_t n = 0; n < text.size(); ++n) {
        const auto byte = static_cast<unsigned char>(text[n]);
        const auto next = static_cast<unsigned char>(n + 1 < text.size() ? text[n + 1] : 0);
        if (byte == 0xC2 && next >= 0x80 && next < 0xA0) {
            escape(byte);
            escape(next);
            ++n;
        } else if (byte < ' ' || byte == 0x7F) {
            escape(byte);
        } else {
            put(&text[n], 1);
        }
    }
}

inline std::string printable(std::string_view text) {
    std::string shown;
    for_printable(text, [&](const char* bytes, std::size_t count) { shown.append(bytes, count); });
    return shown;
}

}  // namespace regionmesh::cli
