// The header of a PLY file: what stands in it, and how.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "formats/codec/byte_reader.h"
#include "regionmesh/label_names.h"

namespace regionmesh {

enum class PlyEncoding { kText, kLittleEndian, kBigEndian };
enum class PlyType { kInt8, kUint8, kInt16, kUint16, kInt32, kUint32, kFloat32, kFloat64 };

std::size_t bytes_of(PlyType type);

struct PlyProperty {
    std::string name;
    PlyType type;
    std::optional<PlyType> count_type;  // of a list: how its length is written
};

struct PlyElement {
    std::string name;
    std::uint64_t count = 0;
    std::vector<PlyProperty> properties = {};

    /// The place of a property; none where there is none of this name.
    std::optional<std::size_t> find(std::string_view property) const;
    /// What an element takes in a file at the least.
    std::uint64_t least_bytes(PlyEncoding encoding) const;
};

struct PlyHeader {
    PlyEncoding encoding = PlyEncoding::kText;
    std::vector<PlyElement> elements;
    std::int64_t exterior_label = -1;  // of a comment of ours
    LabelNames names;                  // likewise
};

/// Takes the header. Throws Error(kInput) where it is none, has no end, or promises more elements than the rest of the
/// file can hold.
PlyHeader read_ply_header(formats::ByteReader& file);

}  // namespace regionmesh
