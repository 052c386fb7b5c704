#include "formats/text/ascii_stream.h"

#include <algorithm>
#include <bit>
#include <cstring>

#include "formats/codec/byte_reader.h"
#include "formats/text/header_text.h"

namespace regionmesh::formats {
namespace {

constexpr std::size_t kTextBytes = std::size_t{64} << 10;
constexpr std::size_t kLongestWord = 64;  // longer than any number

bool is_separator(char c) { return c == ' ' || (c >= '\t' && c <= '\r') || c == ','; }

}  // namespace

AsciiStream::AsciiStream(InputFile file, std::uint64_t begin, std::uint64_t end, AsciiNumbers numbers)
    : file_(std::move(file)), numbers_(numbers), begin_(begin), end_(end), place_(begin) {}

bool AsciiStream::refill() {
    text_.resize(std::min<std::uint64_t>(kTextBytes, end_ - place_));
    text_.resize(file_.read(place_, std::as_writable_bytes(std::span(text_))));
    place_ += text_.size();
    text_place_ = 0;
    return !text_.empty();
}

/// Words may lie across two pieces of text.
bool AsciiStream::next_word() {
    word_.clear();
    while (text_place_ < text_.size() || refill()) {
        const char c = text_[text_place_++];
        if (!is_separator(c)) {
            if (word_.size() < kLongestWord) word_ += c;
        } else if (!word_.empty()) {
            return true;
        }
    }
    return !word_.empty();
}

bool AsciiStream::parse_word() {
    std::uint64_t bits = 0;
    if (numbers_ == AsciiNumbers::kReals) {
        auto real = to_real(word_);
        if (!real) real = parse_real(word_);  // NaN
        if (!real || word_.size() == kLongestWord)
            problem_ = "'" + shown(word_) + "' is no number; numbers must be finite";
        bits = std::bit_cast<std::uint64_t>(real.value_or(0));
    } else {
        const auto is_signed = parse_integer(word_);
        const auto is_unsigned = is_signed ? std::nullopt : parse_size(word_);
        if (!is_signed && !is_unsigned) problem_ = "'" + shown(word_) + "' is no label; labels must be whole numbers";
        bits = is_signed ? static_cast<std::uint64_t>(*is_signed) : is_unsigned.value_or(0);
    }
    for (std::size_t i = 0; i < sizeof number_; ++i) number_[i] = static_cast<std::byte>(bits >> (8 * i));
    return problem_.empty();
}

std::size_t AsciiStream::read(std::span<std::byte> bytes) {
    std::size_t done = 0;
    while (done < bytes.size()) {
        if (number_place_ == sizeof number_) {
            if (!next_word()) {
                problem_ = "the numbers end early; the file is truncated, fetch it again";
                break;
            }
            if (!parse_word()) break;
            number_place_ = 0;
        }
        const std::size_t count = std::min(bytes.size() - done, sizeof number_ - number_place_);
        std::memcpy(bytes.data() + done, number_ + number_place_, count);
        number_place_ += count;
        done += count;
    }
    return done;
}

void AsciiStream::rewind() {
    place_ = begin_;
    text_.clear();
    text_place_ = 0;
    number_place_ = sizeof number_;
    problem_.clear();
}

}  // namespace regionmesh::formats
