// PLY in text or binary, with any properties; labels of faces under the names that programs use.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "formats/codec/byte_reader.h"
#include "formats/surface/mesh_formats.h"
#include "formats/surface/ply_header.h"
#include "formats/text/header_text.h"

namespace regionmesh {
namespace {

using formats::NumberType;

/// Properties with the labels behind a face and in front of it.
constexpr std::array<std::array<std::string_view, 2>, 7> kPairs{{{"label_first", "label_second"},
                                                                 {"label0", "label1"},
                                                                 {"label_0", "label_1"},
                                                                 {"label1", "label2"},
                                                                 {"label_1", "label_2"},
                                                                 {"label_inside", "label_outside"},
                                                                 {"region_inside", "region_outside"}}};
/// Properties with the label behind a face that has the exterior in front.
constexpr std::array<std::string_view, 3> kSingles{"label", "region", "region_id"};
constexpr std::array<std::string_view, 2> kCorners{"vertex_indices", "vertex_index"};

/// Most corners of one face.
constexpr std::uint64_t kMostCorners = 1 << 20;

/// The numbers of a file in order, from text or binary.
class PlyNumbers {
public:
    PlyNumbers(formats::ByteReader& file, PlyEncoding encoding) : file_(file), encoding_(encoding) {}

    double take(NumberType type) {
        if (encoding_ == PlyEncoding::kText) return take_text();
        const std::size_t size = bytes_of(type);
        double number = 0;
        load_all(reinterpret_cast<const std::byte*>(file_.take(size).data()), size, type,
                 encoding_ == PlyEncoding::kBigEndian, std::span(&number, 1));
        return number;
    }
    /// A whole number from 0 to `most`.
    std::uint64_t take_count(NumberType type, std::uint64_t most) {
        const double value = take(type);
        if (!(value >= 0 && value <= static_cast<double>(most)) || value != std::floor(value))
            file_.fail(fmt::format("has a list of {} numbers", value));
        return static_cast<std::uint64_t>(value);
    }

private:
    double take_text() {
        const auto word = file_.take_word();
        if (!word) file_.fail("ends too early: it was cut short");
        const auto value = formats::parse_finite(*word);
        if (!value) file_.fail_line(fmt::format("'{}' stands where a number belongs", formats::shown(*word)));
        return *value;
    }

    formats::ByteReader& file_;
    PlyEncoding encoding_;
};

class PlyReader {
public:
    explicit PlyReader(const std::filesystem::path& path) : file_(path) {}
    FileSurface read();

private:
    struct LabelPlaces {
        std::array<std::optional<std::size_t>, 2> low, high;  // of the first and second; high where it has two words
    };
    /// Takes the properties of an element into values_, and those of list `list` into list_.
    void take_element(const PlyElement& element, std::optional<std::size_t> list, PlyNumbers& numbers);
    void read_points(const PlyElement& element, PlyNumbers& numbers);
    void read_faces(const PlyElement& element, PlyNumbers& numbers);
    void require_end(PlyEncoding encoding);
    LabelPlaces find_labels(const PlyElement& element);
    InputLabel label_at(const LabelPlaces& places, int side, std::uint64_t face) const;

    formats::ByteReader file_;
    FileSurface surface_;
    RegionGroups groups_;
    std::vector<double> values_;  // of the current element, by property
    std::vector<double> list_;
    std::vector<std::uint32_t> corners_;
};

void PlyReader::take_element(const PlyElement& element, std::optional<std::size_t> list, PlyNumbers& numbers) {
    for (std::size_t n = 0; n < element.properties.size(); ++n) {
        const PlyProperty& property = element.properties[n];
        if (!property.count_type) {
            values_[n] = numbers.take(property.type);
            continue;
        }
        const bool is_wanted = list == n;
        std::uint64_t count = numbers.take_count(*property.count_type, is_wanted ? kMostCorners : 0xFFFFFFFFu);
        if (is_wanted) list_.clear();
        for (; count > 0; --count) {
            const double value = numbers.take(property.type);
            if (is_wanted) list_.push_back(value);
        }
    }
}

void PlyReader::read_points(const PlyElement& element, PlyNumbers& numbers) {
    std::array<std::size_t, 3> places{};
    for (int axis = 0; axis < 3; ++axis) {
        const auto place = element.find(std::string_view("xyz").substr(axis, 1));
        if (!place || element.properties[*place].count_type) file_.fail("has vertices without x, y and z");
        places[axis] = *place;
    }
    const std::size_t type = element.find("node_type").value_or(element.properties.size());
    const bool has_type = type < element.properties.size() && !element.properties[type].count_type;
    for (std::uint64_t n = 0; n < element.count; ++n) {
        take_element(element, std::nullopt, numbers);
        add_point(surface_, {values_[places[0]], values_[places[1]], values_[places[2]]}, file_.path());
        if (has_type) surface_.is_on_hull.push_back(values_[type] >= kFirstHullType);
    }
}

/// The properties with labels: the first pair that the faces have, or else the first single name.
PlyReader::LabelPlaces PlyReader::find_labels(const PlyElement& element) {
    const auto find = [&](std::string_view name) {
        const auto place = element.find(name);
        if (place && element.properties[*place].count_type)
            file_.fail(
                fmt::format("has lists in '{}', which names the labels of faces; write one number a face", name));
        return place;
    };
    for (const auto& pair : kPairs) {
        LabelPlaces places;
        for (int side = 0; side < 2; ++side) {
            places.low[side] = find(pair[side]);
            if (places.low[side]) continue;
            places.low[side] = find(std::string(pair[side]) + "_low");
            places.high[side] = find(std::string(pair[side]) + "_high");
            if (!places.high[side]) places.low[side].reset();
        }
        if (places.low[0] && places.low[1]) return places;
    }
    LabelPlaces places;
    for (const std::string_view name : kSingles)
        if (!places.low[0]) places.low[0] = find(name);
    surface_.is_by_region = true;
    return places;
}

InputLabel PlyReader::label_at(const LabelPlaces& places, int side, std::uint64_t face) const {
    if (!places.low[side]) return surface_.exterior_label;
    const double low = values_[*places.low[side]];
    // A double is exact for integers of 32 bits, but text may have more digits.
    if (low != std::floor(low) || std::abs(low) > 0x1p53)
        file_.fail(fmt::format("face {} has a label that is no integer", face));
    if (!places.high[side]) return static_cast<InputLabel>(low);
    const double high = values_[*places.high[side]];
    if (!(low >= 0 && low < 0x1p32 && high >= 0 && high < 0x1p32) || high != std::floor(high))
        file_.fail(fmt::format("face {} has a label whose two words are not of 32 bits", face));
    return static_cast<InputLabel>(static_cast<std::uint64_t>(high) << 32 | static_cast<std::uint64_t>(low));
}

void PlyReader::read_faces(const PlyElement& element, PlyNumbers& numbers) {
    std::optional<std::size_t> list;
    for (const std::string_view name : kCorners)
        if (!list) list = element.find(name);
    if (!list || !element.properties[*list].count_type) file_.fail("has faces without a list vertex_indices");
    const LabelPlaces places = find_labels(element);
    const std::uint32_t whole = groups_.add({}, true);  // where the faces have no labels
    for (std::uint64_t n = 0; n < element.count; ++n) {
        take_element(element, list, numbers);
        corners_.clear();
        for (const double v : list_) {
            if (!(v >= 0 && v < static_cast<double>(surface_.points.size())) || v != std::floor(v))
                file_.fail(fmt::format("face {} names vertex {} of {}", n, v, surface_.points.size()));
            corners_.push_back(static_cast<std::uint32_t>(v));
        }
        if (corners_.size() < 3) file_.fail(fmt::format("face {} has {} corners", n, corners_.size()));
        std::array<InputLabel, 2> labels{whole, 0};
        if (places.low[0]) labels = {label_at(places, 0, n), label_at(places, 1, n)};
        add_polygon(surface_, corners_, labels, file_.path());
    }
    if (!places.low[0]) groups_.put_labels(surface_);
}

/// Elements that the header does not know of would be left out.
void PlyReader::require_end(PlyEncoding encoding) {
    if (encoding == PlyEncoding::kText) {
        if (const auto word = file_.take_word())
            file_.fail_line(fmt::format("'{}' stands behind all that the header promises", formats::shown(*word)));
    } else if (file_.left() > 0) {
        file_.fail(fmt::format("has {} bytes more than its header promises", file_.left()));
    }
}

FileSurface PlyReader::read() {
    const PlyHeader header = read_ply_header(file_, surface_);
    PlyNumbers numbers(file_, header.encoding);
    bool has_points = false, has_faces = false;
    for (const PlyElement& element : header.elements) {
        values_.assign(element.properties.size(), 0);
        if (element.name == "vertex" && !has_points) {
            read_points(element, numbers);
            has_points = true;
        } else if (element.name == "face" && !has_faces && (has_points || element.count == 0)) {
            if (element.count > 0) read_faces(element, numbers);
            has_faces = true;
        } else if (!has_faces) {
            for (std::uint64_t n = 0; n < element.count && !element.properties.empty(); ++n)
                take_element(element, std::nullopt, numbers);
        }
    }
    if (!has_points) file_.fail("has no vertices");
    if (!has_faces) file_.fail("has no faces behind its vertices");
    if (header.elements.back().name == "face") require_end(header.encoding);
    return std::move(surface_);
}

}  // namespace

FileSurface read_ply(const std::filesystem::path& path) { return PlyReader(path).read(); }

}  // namespace regionmesh
