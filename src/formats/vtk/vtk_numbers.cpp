#include "formats/vtk/vtk_numbers.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "formats/text/header_text.h"
#include "regionmesh/limits.h"

namespace regionmesh::formats {
namespace {

constexpr std::size_t kNumbersHeld = std::size_t{8} << 10;

}  // namespace

VtkNumbers::VtkNumbers(const VtkXml& xml, pugi::xml_node array, std::optional<std::uint64_t> count)
    : xml_(xml), array_(array) {
    const std::string_view type = array.attribute("type").value();
    const auto known = type == "String" ? NumberType::kUint8 : vtk_type(array);
    if (!known) fail(fmt::format("has type '{}': numbers are needed", shown(type)));
    type_ = *known;
    is_real_ = formats::is_real(type_);
    const VtkArrayPlace place = xml.place_of(array);
    if (place.form == VtkArrayPlace::Form::kAscii) {
        words_.emplace(InputFile(xml.path()), place.begin, place.end);
        return;
    }
    VtkBytes bytes = xml.open(array);
    stream_ = std::move(bytes.stream);
    if (!stream_->skip(bytes.offset)) fail(stream_->problem());
    count_ = bytes.count / bytes_of(type_);
    if (bytes.count % bytes_of(type_) != 0)
        fail(fmt::format("has {} bytes, {} of which are a number", bytes.count, bytes_of(type_)));
    if (count && *count_ != *count) fail(fmt::format("has {} numbers where {} are needed", *count_, *count));
}

/// False at the end.
bool VtkNumbers::refill() {
    next_ = held_ = 0;
    if (words_) {
        const auto word = words_->take_word();
        if (!word) return false;
        const auto real = is_real_ ? parse_real(*word) : std::nullopt;
        const auto integer = is_real_ ? std::nullopt : parse_label(*word);
        if (!real && !integer)
            fail(fmt::format("has '{}' where a{} number belongs", shown(*word), is_real_ ? " finite" : " whole"));
        reals_.assign(1, real.value_or(0));
        integers_.assign(1, integer.value_or(0));
        held_ = 1;
    } else {
        const std::size_t each = bytes_of(type_), wanted = std::min<std::uint64_t>(*count_ - taken_, kNumbersHeld);
        if (wanted == 0) return false;
        bytes_.resize(wanted * each);
        if (stream_->read(bytes_) < bytes_.size()) fail(stream_->problem());
        const bool is_big_endian = xml_.encoding().is_big_endian;
        if (is_real_) {
            reals_.resize(wanted);
            load_all(bytes_.data(), each, type_, is_big_endian, std::span(reals_));
        } else {
            integers_.resize(wanted);
            load_all(bytes_.data(), each, type_, is_big_endian, std::span(integers_));
        }
        held_ = wanted;
    }
    taken_ += held_;
    return true;
}

void VtkNumbers::require_number() {
    if (next_ == held_ && !refill()) fail(fmt::format("has {} numbers, and more are needed", taken_));
}

std::int64_t VtkNumbers::integer() {
    require_number();
    const std::size_t i = next_++;
    if (!is_real_) return integers_[i];
    const auto whole = whole_number(reals_[i]);
    if (!whole) fail(fmt::format("has {} where a whole number below 2^53 is needed", reals_[i]));
    return *whole;
}

double VtkNumbers::real() {
    require_number();
    const std::size_t i = next_++;
    return is_real_ ? reals_[i] : static_cast<double>(integers_[i]);
}

Vec3 VtkNumbers::point() {
    Vec3 p;
    for (int axis = 0; axis < 3; ++axis) p[axis] = real();
    return p;
}

void VtkNumbers::skip(std::uint64_t count) {
    while (count > 0) {
        require_number();
        const std::size_t part = std::min<std::uint64_t>(count, held_ - next_);
        next_ += part;
        count -= part;
    }
}

bool VtkNumbers::at_end() { return next_ == held_ && !refill(); }

void VtkNumbers::finish() {
    if (!at_end()) fail("has more numbers than the file announces");
    if (stream_ && !stream_->finish()) fail(stream_->problem());
}

VtkNumbers integers_of(const VtkXml& xml, pugi::xml_node array, std::optional<std::uint64_t> count) {
    if (const auto type = vtk_type(array); type && is_real(*type))
        xml.fail(array, fmt::format("has type '{}': integers are needed", array.attribute("type").value()));
    return {xml, array, count};
}

std::vector<double> tuple_of(const VtkXml& xml, const char* name, std::uint64_t count) {
    const pugi::xml_node array = array_named(xml.dataset().child("FieldData"), name);
    if (!array || std::string_view(array.attribute("type").value()) != "Float64" || components(array) != count ||
        xml.count(array, "NumberOfTuples", UINT64_MAX) != 1)
        return {};
    VtkNumbers numbers(xml, array, count);
    std::vector<double> tuple(count);
    for (double& number : tuple) number = numbers.real();
    numbers.finish();
    return tuple;
}

std::optional<double> metres_per_unit(const VtkXml& xml) {
    const std::vector<double> metres = tuple_of(xml, "MetresPerUnit", 1);
    return !metres.empty() && is_unit_of_length(metres[0]) ? std::optional(metres[0]) : std::nullopt;
}

VtkNumbers points_of(const VtkXml& xml, pugi::xml_node piece, std::uint64_t count) {
    const pugi::xml_node array = piece.child("Points").child("DataArray");
    if (!array || components(array) != 3) xml.fail("needs an array of points with three components");
    return {xml, array, 3 * count};
}

}  // namespace regionmesh::formats
