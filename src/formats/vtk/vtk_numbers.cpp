#include "formats/vtk/vtk_numbers.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <string_view>
#include <utility>

#include "formats/text/ascii_stream.h"
#include "formats/text/header_text.h"
#include "formats/vtk/label_array.h"
#include "formats/vtk/vtk_arrays.h"
#include "formats/vtk/vtk_blocks.h"

namespace regionmesh::formats {
namespace {

constexpr std::size_t kNumbersHeld = std::size_t{8} << 10;

template <class Bits, class Real>
void decode_reals(std::span<const std::byte> bytes, bool is_big_endian, std::span<double> reals) {
    for (std::size_t i = 0; i < reals.size(); ++i)
        reals[i] = std::bit_cast<Real>(
            static_cast<Bits>(decode_word(bytes.subspan(i * sizeof(Real), sizeof(Real)), is_big_endian)));
}

}  // namespace

bool is_vtk_integer(std::string_view type) { return vtk_integer_type(type).has_value(); }
bool is_vtk_real(std::string_view type) { return type == "Float32" || type == "Float64"; }

VtkNumbers::VtkNumbers(const std::filesystem::path& path, const VtkXmlTags& tags, pugi::xml_node array,
                       std::optional<std::uint64_t> count)
    : path_(path), name_(array.attribute("Name").value()), count_(count) {
    const std::string_view type = array.attribute("type").value();
    is_real_ = is_vtk_real(type);
    if (!is_real_ && !is_vtk_integer(type)) fail(fmt::format("has type '{}': numbers are needed", shown(type)));
    const VtkArrayPlace place = tags.place_of(array);
    format_ = {vtk_integer_type(type).value_or(SampleType::kI64), tags.encoding().is_big_endian};
    bytes_each_ = !is_real_ ? sample_bytes(format_.type) : type == "Float32" ? sizeof(float) : sizeof(double);
    if (place.form == VtkArrayPlace::Form::kAscii) {
        format_ = kAsciiFormat;
        bytes_each_ = sizeof(double);
        stream_ = std::make_unique<AsciiStream>(InputFile(path), place.begin, place.end,
                                                is_real_ ? AsciiNumbers::kReals : AsciiNumbers::kIntegers);
    } else if (tags.encoding().is_compressed) {
        begin_compressed(place, tags.encoding());
    } else {
        begin_plain(place, tags.encoding().word_bytes);
    }
}

void VtkNumbers::begin_plain(const VtkArrayPlace& place, std::size_t word_bytes) {
    stream_ = open_stored(path_, place);
    std::array<std::byte, 8> word{};
    const auto bytes = std::span(word).first(word_bytes);
    if (stream_->read(bytes) < bytes.size()) fail(stream_->problem());
    check_bytes(decode_word(bytes, format_.is_big_endian));
}

void VtkNumbers::begin_compressed(const VtkArrayPlace& place, const VtkEncoding& encoding) {
    auto blocks = std::make_unique<VtkBlocks>(open_stored(path_, place), open_stored(path_, place), encoding);
    const auto bytes = blocks->inflated_bytes();
    if (!bytes) fail(blocks->problem());
    stream_ = std::move(blocks);
    check_bytes(*bytes);
}

void VtkNumbers::check_bytes(std::uint64_t bytes) {
    const std::uint64_t numbers = bytes / bytes_each_;
    if (bytes % bytes_each_ != 0) fail(fmt::format("has {} bytes, {} of which are a number", bytes, bytes_each_));
    if (count_ && *count_ != numbers) fail(fmt::format("has {} numbers where {} are needed", numbers, *count_));
    count_ = numbers;
}

void VtkNumbers::fail(const std::string& text) const {
    formats::fail(path_, fmt::format("array '{}': {}", name_, text));
}

void VtkNumbers::refill() {
    const std::uint64_t left = count_ ? *count_ - taken_ : kNumbersHeld;
    if (left == 0) fail(fmt::format("has {} numbers, and more are needed", taken_));
    const std::size_t wanted = std::min<std::uint64_t>(left, kNumbersHeld);
    bytes_.resize(wanted * bytes_each_);
    held_ = stream_->read(bytes_) / bytes_each_;
    if (held_ == 0) fail(stream_->problem());
    if (is_real_) {
        reals_.resize(held_);
        const auto decode =
            bytes_each_ == sizeof(float) ? decode_reals<std::uint32_t, float> : decode_reals<std::uint64_t, double>;
        decode(bytes_, format_.is_big_endian, reals_);
    } else {
        integers_.resize(held_);
        decode_samples(bytes_.data(), bytes_each_, format_, integers_);
    }
    taken_ += held_;
    next_ = 0;
}

std::int64_t VtkNumbers::integer() {
    if (next_ == held_) refill();
    const std::size_t i = next_++;
    if (!is_real_) return integers_[i];
    const auto whole = whole_number(reals_[i]);
    if (!whole) fail(fmt::format("has {} where a whole number below 2^53 is needed", reals_[i]));
    return *whole;
}

double VtkNumbers::real() {
    if (next_ == held_) refill();
    const std::size_t i = next_++;
    return is_real_ ? reals_[i] : static_cast<double>(integers_[i]);
}

void VtkNumbers::skip(std::uint64_t count) {
    while (count > 0) {
        if (next_ == held_) refill();
        const std::size_t part = std::min<std::uint64_t>(count, held_ - next_);
        next_ += part;
        count -= part;
    }
}

}  // namespace regionmesh::formats
