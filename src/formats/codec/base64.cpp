#include "formats/codec/base64.h"

#include <algorithm>
#include <array>

namespace regionmesh {
namespace {

constexpr std::string_view kAlphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
constexpr std::size_t kTextBytes = std::size_t{64} << 10;  // held of the text
constexpr char kPadding = '=';

// Two letters at a time: the text of every number of twelve bits.
constexpr auto kPairs = [] {
    std::array<std::array<char, 2>, 4096> pairs{};
    for (std::size_t i = 0; i < pairs.size(); ++i) pairs[i] = {kAlphabet[i >> 6], kAlphabet[i & 63]};
    return pairs;
}();

constexpr std::uint8_t kNoLetter = 0x80;
constexpr auto kValues = [] {
    std::array<std::uint8_t, 256> values{};
    values.fill(kNoLetter);
    for (std::size_t i = 0; i < kAlphabet.size(); ++i)
        values[static_cast<unsigned char>(kAlphabet[i])] = static_cast<std::uint8_t>(i);
    return values;
}();

std::uint8_t value_of(char letter) { return kValues[static_cast<unsigned char>(letter)]; }

bool is_space(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

char* put_group(std::byte a, std::byte b, std::byte c, char* text) {
    const std::uint32_t bits = std::to_integer<std::uint32_t>(a) << 16 | std::to_integer<std::uint32_t>(b) << 8 |
                               std::to_integer<std::uint32_t>(c);
    text = std::copy_n(kPairs[bits >> 12].data(), 2, text);
    return std::copy_n(kPairs[bits & 4095].data(), 2, text);
}

void take_group(std::uint32_t bits, std::byte* bytes) {
    bytes[0] = static_cast<std::byte>(bits >> 16);
    bytes[1] = static_cast<std::byte>(bits >> 8);
    bytes[2] = static_cast<std::byte>(bits);
}

}  // namespace

void Base64Encoder::encode(std::span<const std::byte> bytes, std::string& text) {
    const std::size_t begin = text.size();
    text.resize(begin + (bytes.size() + static_cast<std::size_t>(waiting_count_)) / 3 * 4);
    char* out = text.data() + begin;
    std::size_t i = 0;
    if (waiting_count_ > 0) {
        while (waiting_count_ < 3 && i < bytes.size()) waiting_[waiting_count_++] = bytes[i++];
        if (waiting_count_ < 3) return;
        out = put_group(waiting_[0], waiting_[1], waiting_[2], out);
        waiting_count_ = 0;
    }
    for (; i + 3 <= bytes.size(); i += 3) out = put_group(bytes[i], bytes[i + 1], bytes[i + 2], out);
    for (; i < bytes.size(); ++i) waiting_[waiting_count_++] = bytes[i];
}

void Base64Encoder::finish(std::string& text) {
    if (waiting_count_ == 0) return;
    char group[4];
    put_group(waiting_[0], waiting_count_ > 1 ? waiting_[1] : std::byte{0}, std::byte{0}, group);
    std::fill(group + 1 + waiting_count_, group + 4, kPadding);
    text.append(group, 4);
    waiting_count_ = 0;
}

std::string base64(std::span<const std::byte> bytes) {
    Base64Encoder encoder;
    std::string text;
    encoder.encode(bytes, text);
    encoder.finish(text);
    return text;
}

namespace formats {

/// The next byte that is no white space; '<' at the end of the text.
char Base64Stream::next_letter() {
    while (true) {
        if (next_ == text_.size()) {
            text_.resize(std::min<std::uint64_t>(kTextBytes, end_ - place_));
            text_.resize(file_.read(place_, std::as_writable_bytes(std::span(text_))));
            place_ += text_.size();
            next_ = 0;
            if (text_.empty()) return '<';
        }
        if (text_[next_] == '<') return '<';
        const char letter = text_[next_++];
        if (!is_space(letter)) return letter;
    }
}

/// Decodes the next four letters into the waiting bytes.
bool Base64Stream::read_group() {
    std::uint32_t bits = 0;
    int letters = 0, padding = 0;
    while (letters + padding < 4) {
        const char letter = next_letter();
        const std::uint8_t value = value_of(letter);
        if (letter == kPadding && letters >= 2) {
            ++padding;
            bits <<= 6;
        } else if (value != kNoLetter && padding == 0) {
            ++letters;
            bits = bits << 6 | value;
        } else {
            problem_ = "the base64 text ends early or is damaged; fetch the file again";
            return false;
        }
    }
    take_group(bits, waiting_);
    waiting_begin_ = 0;
    waiting_count_ = letters - 1;
    return true;
}

std::size_t Base64Stream::read(std::span<std::byte> bytes) {
    std::size_t done = 0;
    while (done < bytes.size() && problem_.empty()) {
        if (waiting_begin_ < waiting_count_) {
            bytes[done++] = waiting_[waiting_begin_++];
            continue;
        }
        for (; done + 3 <= bytes.size() && next_ + 4 <= text_.size(); done += 3, next_ += 4) {
            const std::uint32_t a = value_of(text_[next_]), b = value_of(text_[next_ + 1]),
                                c = value_of(text_[next_ + 2]), d = value_of(text_[next_ + 3]);
            if ((a | b | c | d) & kNoLetter) break;
            take_group(a << 18 | b << 12 | c << 6 | d, &bytes[done]);
        }
        if (done < bytes.size() && !read_group()) break;
    }
    return done;
}

void Base64Stream::rewind() {
    place_ = begin_;
    text_.clear();
    next_ = 0;
    waiting_begin_ = waiting_count_ = 0;
    problem_.clear();
}

}  // namespace formats
}  // namespace regionmesh
