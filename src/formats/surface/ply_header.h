// The header of a PLY file.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "formats/codec/byte_reader.h"
#include "formats/surface/file_surface.h"

namespace regionmesh {

enum class PlyEncoding { kText, kLittleEndian, kBigEndian };

struct PlyProperty {
    std::string name;
    formats::NumberType type;
    std::optional<formats::NumberType> count_type;  // of a list: the type of its length
};

struct PlyElement {
    std::string name;
    std::uint64_t count = 0;
    std::vector<PlyProperty> properties = {};

    /// The place of a property; none where no property has this name.
    std::optional<std::size_t> find(std::string_view property) const;
};

struct PlyHeader {
    PlyEncoding encoding = PlyEncoding::kText;
    std::vector<PlyElement> elements;
};

/// Takes the header; exterior label and names, in comments of ours, go to `surface`. Throws Error(kInput) where the
/// header is missing, has no end, or promises more elements than the rest of the file can hold.
PlyHeader read_ply_header(formats::ByteReader& file, FileSurface& surface);

}  // namespace regionmesh
