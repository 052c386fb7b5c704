// Text in files of XML.
#pragma once

#include <string>
#include <string_view>

namespace regionmesh::formats {

/// Text for an attribute in XML 1.0, which has no control characters.
inline std::string xml_attribute(std::string_view text) {
    std::string all;
    for (const char letter : text) switch (letter) {
            case '&':
                all += "&amp;";
                break;
            case '<':
                all += "&lt;";
                break;
            case '>':
                all += "&gt;";
                break;
            case '"':
                all += "&quot;";
                break;
            default:
                all += static_cast<unsigned char>(letter) < ' ' ? ' ' : letter;
        }
    return all;
}

}  // namespace regionmesh::formats
