#include "fuzz/mutate.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <iterator>
#include <string_view>

namespace regionmesh::fuzz {
namespace {

constexpr std::size_t kMostBytes = std::size_t{1} << 20;
constexpr std::size_t kHeaderBytes = 4096;  // where most changes go
constexpr std::string_view kGzipMagic = "\x1f\x8b";
constexpr std::string_view kPngMagic = "\x89PNG\r\n\x1a\n";

constexpr std::array<std::string_view, 24> kNumbers{"0",
                                                    "-1",
                                                    "1",
                                                    "2",
                                                    "-0",
                                                    "00",
                                                    "255",
                                                    "65536",
                                                    "1000000",
                                                    "2147483647",
                                                    "2147483648",
                                                    "4294967295",
                                                    "4294967296",
                                                    "9223372036854775807",
                                                    "9223372036854775808",
                                                    "18446744073709551615",
                                                    "99999999999999999999",
                                                    "-9223372036854775808",
                                                    "1e308",
                                                    "1e-320",
                                                    "nan",
                                                    "inf",
                                                    "0.5",
                                                    ""};
constexpr std::array<std::uint64_t, 14> kIntegers{
    0, 1, 2, 3, 0x7f, 0x80, 0xff, 0x7fff, 0xffff, 0x10000, 0x7fffffff, 0x80000000, 0xffffffff, 0xffffffffffffffff};

bool is_word_letter(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-' ||
           c == '.';
}

struct Span {
    std::size_t begin, count;
};

/// A place, in front most of the time.
std::size_t some_place(const std::string& text, Random& random) {
    const std::size_t end = random.one_in(4) ? text.size() : std::min(text.size(), kHeaderBytes);
    return random.below(end + 1);
}

Span some_span(const std::string& text, Random& random) {
    const std::size_t begin = some_place(text, random);
    const std::size_t most = random.one_in(8) ? text.size() : 32;
    return {begin, std::min(text.size() - begin, random.below(most + 1))};
}

/// The word, or the number in text, at or behind some place.
Span some_word(const std::string& text, Random& random, bool is_number) {
    const auto belongs = [&](char c) { return is_number ? c >= '0' && c <= '9' : is_word_letter(c); };
    std::size_t begin = some_place(text, random);
    while (begin < text.size() && !belongs(text[begin])) ++begin;
    while (begin > 0 && begin <= text.size() && belongs(text[begin - 1])) --begin;
    std::size_t end = begin;
    while (end < text.size() && belongs(text[end]) && end - begin < 64) ++end;
    return {begin, end - begin};
}

void write_integer(std::string& text, Random& random) {
    const std::size_t bytes = std::size_t{1} << random.below(4);
    if (text.size() < bytes) return;
    const std::size_t place = std::min(some_place(text, random), text.size() - bytes);
    std::uint64_t value = kIntegers[random.below(kIntegers.size())];
    const bool is_big_endian = random.one_in(2);
    for (std::size_t i = 0; i < bytes; ++i, value >>= 8)
        text[place + (is_big_endian ? bytes - 1 - i : i)] = static_cast<char>(value);
}

void change_once(std::string& text, const std::vector<std::string>& seeds, Random& random) {
    const std::string& other = seeds[random.below(seeds.size())];
    const std::size_t place = some_place(text, random);
    const Span span = some_span(text, random);
    switch (random.below(12)) {
        case 0:
            if (place < text.size()) text[place] = static_cast<char>(text[place] ^ (1 << random.below(8)));
            break;
        case 1:
            if (place < text.size()) text[place] = static_cast<char>(random.next());
            break;
        case 2:
            for (std::size_t i = 0; i < span.count; ++i) text[span.begin + i] = static_cast<char>(random.next());
            break;
        case 3:
            text.erase(span.begin, span.count);
            break;
        case 4:
            text.insert(place, text.substr(span.begin, span.count));
            break;
        case 5:
            if (random.one_in(4)) text.resize(random.below(text.size() + 1));
            break;
        case 6: {
            const Span from = some_span(other, random);
            text.replace(span.begin, span.count, other, from.begin, from.count);
            break;
        }
        case 7:
        case 8:
        case 9: {
            const Span number = some_word(text, random, true);
            text.replace(number.begin, number.count, kNumbers[random.below(kNumbers.size())]);
            break;
        }
        case 10: {
            const Span word = some_word(text, random, false), from = some_word(other, random, false);
            text.replace(word.begin, word.count, other, from.begin, from.count);
            break;
        }
        default:
            write_integer(text, random);
    }
    if (text.size() > kMostBytes) text.resize(kMostBytes);
}

std::string gunzip(const std::string& packed) {
    z_stream stream{};
    inflateInit2(&stream, 15 + 16);
    std::string text(kMostBytes, '\0');
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data()));
    stream.avail_in = static_cast<uInt>(packed.size());
    stream.next_out = reinterpret_cast<Bytef*>(text.data());
    stream.avail_out = static_cast<uInt>(text.size());
    inflate(&stream, Z_FINISH);
    text.resize(text.size() - stream.avail_out);
    inflateEnd(&stream);
    return text;
}

std::string gzip(const std::string& text) {
    z_stream stream{};
    deflateInit2(&stream, 1, Z_DEFLATED, 15 + 16, 8, Z_DEFAULT_STRATEGY);
    std::string packed(deflateBound(&stream, text.size()), '\0');
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(text.data()));
    stream.avail_in = static_cast<uInt>(text.size());
    stream.next_out = reinterpret_cast<Bytef*>(packed.data());
    stream.avail_out = static_cast<uInt>(packed.size());
    deflate(&stream, Z_FINISH);
    packed.resize(packed.size() - stream.avail_out);
    deflateEnd(&stream);
    return packed;
}

/// New check sums for the chunks of a PNG, so that libpng looks into them.
void mend_png(std::string& text) {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
    for (std::size_t place = kPngMagic.size(); place + 12 <= text.size();) {
        const std::size_t length = std::size_t{byte(place)} << 24 | std::size_t{byte(place + 1)} << 16 |
                                   std::size_t{byte(place + 2)} << 8 | byte(place + 3);
        if (length > text.size() - place - 12) return;
        const uLong sum = crc32(0, reinterpret_cast<const Bytef*>(&text[place + 4]), static_cast<uInt>(length + 4));
        for (std::size_t i = 0; i < 4; ++i) text[place + 8 + length + i] = static_cast<char>(sum >> (24 - 8 * i));
        place += 12 + length;
    }
}

}  // namespace

std::uint64_t Random::next() {  // splitmix64
    std::uint64_t z = state_ += 0x9e3779b97f4a7c15;
    z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9;
    z = (z ^ z >> 27) * 0x94d049bb133111eb;
    return z ^ z >> 31;
}

std::string text_of(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

std::string mutate(const std::vector<std::string>& seeds, std::size_t index, Random& random) {
    std::string text = seeds[index];
    const bool is_inside = text.starts_with(kGzipMagic) && random.one_in(2);
    if (is_inside) text = gunzip(text);
    for (std::size_t changes = 1 + random.below(1 + random.below(6)); changes > 0; --changes)
        change_once(text, seeds, random);
    if (text.starts_with(kPngMagic) && !random.one_in(8)) mend_png(text);
    return is_inside ? gzip(text) : text;
}

}  // namespace regionmesh::fuzz
