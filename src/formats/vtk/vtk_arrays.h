// What the DataArrays of VTK's XML files are called, and what they hold.
#pragma once

#include <array>
#include <optional>
#include <pugixml.hpp>
#include <string_view>
#include <utility>

#include "regionmesh/section_reader.h"

namespace regionmesh::formats {

inline pugi::xml_node array_named(pugi::xml_node parent, const char* name) {
    return parent.find_child_by_attribute("DataArray", "Name", name);
}

/// By the attribute `type`; none for reals and the like.
inline std::optional<SampleType> vtk_integer_type(std::string_view type) {
    constexpr std::array<std::pair<std::string_view, SampleType>, 8> kTypes{{{"Int8", SampleType::kI8},
                                                                             {"UInt8", SampleType::kU8},
                                                                             {"Int16", SampleType::kI16},
                                                                             {"UInt16", SampleType::kU16},
                                                                             {"Int32", SampleType::kI32},
                                                                             {"UInt32", SampleType::kU32},
                                                                             {"Int64", SampleType::kI64},
                                                                             {"UInt64", SampleType::kU64}}};
    for (const auto& [word, known] : kTypes)
        if (word == type) return known;
    return std::nullopt;
}

}  // namespace regionmesh::formats
