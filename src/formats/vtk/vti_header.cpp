#include "formats/vtk/vti_header.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <pugixml.hpp>
#include <string_view>
#include <utility>
#include <vector>

#include "formats/array/affine.h"
#include "formats/array/volume_size.h"
#include "formats/text/header_text.h"
#include "formats/vtk/vtk_arrays.h"

namespace regionmesh::formats {
namespace {

/// What one DataArray is, before one is chosen.
struct Candidate {
    pugi::xml_node node;
    bool is_cell = false;
    bool is_active = false;
    std::optional<SampleType> type;  // none for reals and the like

    std::string text() const {
        return fmt::format("{} ({} {}, {})", node.attribute("Name").value(), is_cell ? "cells" : "points",
                           node.attribute("type").value(), node.attribute("NumberOfComponents").as_int(1));
    }
};

std::vector<Candidate> find_candidates(pugi::xml_node piece) {
    std::vector<Candidate> found;
    for (const bool is_cell : {false, true}) {
        const pugi::xml_node data = piece.child(is_cell ? "CellData" : "PointData");
        const std::string_view active = data.attribute("Scalars").value();
        for (const pugi::xml_node node : data.children("DataArray")) {
            Candidate candidate{node, is_cell, !active.empty() && active == node.attribute("Name").value(), {}};
            const std::string_view type = node.attribute("type").value();
            if (node.attribute("NumberOfComponents").as_int(1) == 1) candidate.type = vtk_integer_type(type);
            found.push_back(candidate);
        }
    }
    return found;
}

Candidate choose_array(const InputFile& file, const std::vector<Candidate>& all) {
    const Candidate* chosen = nullptr;
    for (const bool is_active_only : {true, false}) {
        int count = 0;
        for (const Candidate& candidate : all) {
            if (!candidate.type || (is_active_only && !candidate.is_active)) continue;
            chosen = &candidate;
            ++count;
        }
        if (count == 1) return *chosen;
    }
    constexpr std::size_t kShown = 20;
    std::string names;
    for (std::size_t i = 0; i < std::min(all.size(), kShown); ++i) names += (i == 0 ? "" : "; ") + all[i].text();
    if (all.size() > kShown) names += fmt::format("; and {} more", all.size() - kShown);
    if (!chosen) {
        fail(file.path(), "has no array of integers with one component, as labels need; it has " +
                              (names.empty() ? "none at all" : names));
    }
    fail(file.path(), "has several arrays of integers; make the one with labels its active scalars: " + names);
}

/// Samples of cells lie at their centres, one fewer on each axis; an axis of one point has one cell, there.
void place_in_space(const InputFile& file, pugi::xml_node image, pugi::xml_node piece, bool is_cell, Lattice& lattice) {
    const auto numbers = [&](pugi::xml_node node, const char* name, std::size_t count, std::vector<double> otherwise) {
        const std::string_view text = node.attribute(name).value();
        if (text.empty() && !otherwise.empty()) return otherwise;
        auto found = parse_reals(text);
        if (!found || found->size() != count)
            fail(file.path(), fmt::format("{} is '{}': {} numbers are needed", name, shown(text), count));
        return *found;
    };
    const auto origin = numbers(image, "Origin", 3, {0, 0, 0}), spacing = numbers(image, "Spacing", 3, {1, 1, 1});
    const auto direction = numbers(image, "Direction", 9, {1, 0, 0, 0, 1, 0, 0, 0, 1});
    const std::string_view text = piece.attribute("Extent").value();
    std::vector<std::int64_t> extent;
    for (const std::string_view word : split_words(text))
        if (const auto number = parse_integer(word)) extent.push_back(*number);
    Columns columns;
    Vec3 first{origin[0], origin[1], origin[2]};
    std::array<std::uint64_t, 3> size{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        constexpr std::int64_t kMost = std::int64_t{1} << 40;
        if (extent.size() != 6 || extent[2 * axis] < -kMost || extent[2 * axis + 1] > kMost ||
            extent[2 * axis + 1] < extent[2 * axis])
            fail(file.path(), fmt::format("Extent is '{}': first and last index on each axis are needed", shown(text)));
        const std::int64_t low = extent[2 * axis], parts = extent[2 * axis + 1] - low;
        const bool is_between = is_cell && parts > 0;
        size[axis] = static_cast<std::uint64_t>(is_between ? parts : parts + 1);
        columns[axis] = spacing[axis] * Vec3{direction[axis], direction[3 + axis], direction[6 + axis]};
        first += (static_cast<double>(low) + (is_between ? 0.5 : 0)) * columns[axis];
    }
    lattice.size = checked_size(file.path(), size);
    set_affine(file.path(), "map to space", "mend Origin, Spacing or Direction", columns, first, lattice);
}

}  // namespace

VtiHeader read_vti_header(const InputFile& file) {
    const VtkXmlTags tags(file);
    const pugi::xml_node image = tags.root().child("ImageData"), piece = image.child("Piece");
    if (!image) fail(file.path(), "is no VTK XML file with ImageData; other VTK data hold no sections");
    if (!piece || piece.next_sibling("Piece")) fail(file.path(), "has no Piece, or several; write it as one piece");
    VtiHeader header;
    header.encoding = tags.encoding();
    const Candidate chosen = choose_array(file, find_candidates(piece));
    header.array = {tags.place_of(chosen.node), *chosen.type, chosen.node.attribute("Name").value()};
    place_in_space(file, image, piece, chosen.is_cell, header.lattice);
    return header;
}

}  // namespace regionmesh::formats
