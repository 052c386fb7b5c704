// Units of drill holes in the order of their ages, and where each hole passes from one to the next.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "boreholes/drill_holes.h"
#include "boreholes/table_labels.h"

namespace regionmesh::formats {

/// Most units of one table.
inline constexpr std::size_t kMostUnits = 250;

/// The statement of a hole about the base of a unit at its position.
enum class ContactKind {
    kAt,       // the base is here
    kGround,   // the unit is missing at the top of the hole: its base is the ground
    kAtMost,   // nothing was logged below this unit or a younger one: the base is here or below
    kAtLeast,  // the hole was not logged above here, and an older unit follows: the base is here or above
};

struct Contact {
    double x = 0, y = 0, z = 0;
    ContactKind kind = ContactKind::kAt;
};

struct LayerOrder {
    std::vector<std::uint32_t> units;            // numbers of TableLabels, from young to old
    std::vector<std::vector<Contact>> contacts;  // one list per unit but the oldest; one or two of each hole
    double ordered_share =
        1;  // share of the logged length that lies in its unit when every hole has each unit once, in order
};

/// `wanted` lists units from young to old, "auto" for all others in the order found in the holes, and "-UNIT" for units
/// that are not to be modelled. "auto" minimises the number of pairs of intervals of a hole in which the older unit
/// lies above, by moves of one unit at a time. Intervals of units that are not in the order, or without a unit, count
/// as not logged. Where units repeat in a hole, the base of a unit lies where the most of the hole's length is in
/// order. Throws Error(kUsage) for a unit that is listed twice, and Error(kInput) for an unknown unit, fewer than two
/// units, more than kMostUnits, holes that are not in order, and a hole that leads upwards.
LayerOrder order_layers(const DrillHoles& holes, const TableLabels& labels, const std::string& wanted);

}  // namespace regionmesh::formats
