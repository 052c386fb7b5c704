#include "formats/vtk/vtk_xml_file.h"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <bit>
#include <charconv>
#include <cstddef>
#include <cstring>
#include <fstream>
#include <limits>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

#include "formats/codec/base64.h"
#include "regionmesh/error.h"

namespace regionmesh {
namespace {

static_assert(std::endian::native == std::endian::little, "little-endian numbers are taken as they lie in the file");

constexpr std::size_t kChunkBytes = 1 << 20;    // uncompressed arrays are taken by this much
constexpr std::uint64_t kMostInflation = 1032;  // zlib makes no more bytes of one

// Bytes of an array, out of base64 text or as they lie in the file.
class ByteSource {
public:
    ByteSource(std::string_view bytes, bool is_raw)
        : raw_(is_raw ? bytes : std::string_view()), decoder_(is_raw ? std::string_view() : bytes), is_raw_(is_raw) {}

    bool read(std::span<std::byte> bytes) {
        if (!is_raw_) return decoder_.read(bytes) == bytes.size();
        if (bytes.size() > raw_.size()) return false;
        if (!bytes.empty()) std::memcpy(bytes.data(), raw_.data(), bytes.size());
        raw_.remove_prefix(bytes.size());
        return true;
    }
    std::uint64_t most_left() const { return is_raw_ ? raw_.size() : decoder_.most_left(); }

private:
    std::string_view raw_;
    Base64Decoder decoder_;
    bool is_raw_;
};

template <class From, class To>
void append_as(std::span<const std::byte> bytes, bool is_swapped, std::vector<To>& values) {
    std::byte number[sizeof(From)];
    for (std::size_t i = 0; i < bytes.size(); i += sizeof(From)) {
        std::copy_n(&bytes[i], sizeof(From), number);
        if (is_swapped) std::reverse(number, number + sizeof(From));
        From value;
        std::memcpy(&value, number, sizeof(From));
        values.push_back(static_cast<To>(value));
    }
}

constexpr std::uint64_t kAnyCount = std::numeric_limits<std::uint64_t>::max();

// How numbers of a VTK type become T.
template <class T>
struct Conversion {
    std::string_view type;
    std::size_t bytes;
    void (*append)(std::span<const std::byte>, bool, std::vector<T>&);
    bool is_real;
};

template <class T>
std::optional<Conversion<T>> conversion(std::string_view type) {
    constexpr Conversion<T> kConversions[] = {
        {"Int8", 1, append_as<std::int8_t, T>, false},    {"UInt8", 1, append_as<std::uint8_t, T>, false},
        {"Int16", 2, append_as<std::int16_t, T>, false},  {"UInt16", 2, append_as<std::uint16_t, T>, false},
        {"Int32", 4, append_as<std::int32_t, T>, false},  {"UInt32", 4, append_as<std::uint32_t, T>, false},
        {"Int64", 8, append_as<std::int64_t, T>, false},  {"UInt64", 8, append_as<std::uint64_t, T>, false},
        {"Float32", 4, append_as<float, T>, true},        {"Float64", 8, append_as<double, T>, true},
        {"String", 1, append_as<std::uint8_t, T>, false},
    };
    for (const Conversion<T>& c : kConversions)
        if (c.type == type && !(c.is_real && std::is_integral_v<T>)) return c;
    return std::nullopt;
}

// One array on its way from bytes to numbers; each step says what is wrong, or nothing.
template <class T>
class ArrayDecoder {
public:
    using Problem = std::optional<std::string>;

    ArrayDecoder(const Conversion<T>& how, bool is_swapped, std::uint64_t count, const ArraySink<T>& sink)
        : how_(how), is_swapped_(is_swapped), left_(count), has_any_count_(count == kAnyCount), sink_(sink) {}

    Problem decode_ascii(std::string_view text);
    Problem decode_plain(ByteSource source, std::size_t word_bytes);
    Problem decode_compressed(ByteSource source, std::size_t word_bytes);

private:
    Problem hand_on();
    Problem take(std::span<const std::byte> bytes);
    Problem inflate_block(std::uint64_t size);
    Problem end() const {
        return left_ == 0 || has_any_count_ ? std::nullopt : Problem(fmt::format("is {} numbers short", left_));
    }
    bool read_words(ByteSource& source, std::size_t word_bytes, std::span<std::uint64_t> words) const;

    Conversion<T> how_;
    bool is_swapped_;
    std::uint64_t left_;
    bool has_any_count_;
    const ArraySink<T>& sink_;
    std::vector<T> values_;
    std::vector<std::byte> compressed_, bytes_;
};

template <class T>
typename ArrayDecoder<T>::Problem ArrayDecoder<T>::hand_on() {
    if (values_.size() > left_) return "has more numbers than the file announces";
    left_ -= values_.size();
    sink_(values_);
    values_.clear();
    return std::nullopt;
}

template <class T>
typename ArrayDecoder<T>::Problem ArrayDecoder<T>::take(std::span<const std::byte> bytes) {
    if (bytes.size() % how_.bytes != 0) return "does not end, or break into blocks, between two numbers";
    how_.append(bytes, is_swapped_, values_);
    return hand_on();
}

// The whole text as a number; integers beyond the signed ones as the bits of an unsigned one.
template <class T>
bool parse_number(std::string_view text, T& value) {
    const char* const end = text.data() + text.size();
    auto result = std::from_chars(text.data(), end, value);
    if constexpr (std::is_integral_v<T>) {
        std::make_unsigned_t<T> bits = 0;
        if (result.ec == std::errc::result_out_of_range) {
            result = std::from_chars(text.data(), end, bits);
            value = static_cast<T>(bits);
        }
    }
    return result.ec == std::errc{} && result.ptr == end;
}

template <class T>
typename ArrayDecoder<T>::Problem ArrayDecoder<T>::decode_ascii(std::string_view text) {
    constexpr std::string_view kSpaces = " \t\r\n\v\f";
    for (std::size_t begin = text.find_first_not_of(kSpaces); begin != std::string_view::npos;
         begin = text.find_first_not_of(kSpaces, begin)) {
        const std::size_t end = std::min(text.find_first_of(kSpaces, begin), text.size());
        const std::string_view word = text.substr(begin, end - begin);
        T value{};
        if (!parse_number(word, value)) return fmt::format("has '{}' where a number belongs", word.substr(0, 40));
        values_.push_back(value);
        begin = end;
        if (values_.size() * sizeof(T) < kChunkBytes) continue;
        if (Problem problem = hand_on()) return problem;
    }
    if (Problem problem = hand_on()) return problem;
    return end();
}

template <class T>
bool ArrayDecoder<T>::read_words(ByteSource& source, std::size_t word_bytes, std::span<std::uint64_t> words) const {
    for (std::uint64_t& word : words) {
        std::byte bytes[8] = {};
        if (!source.read(std::span(bytes).first(word_bytes))) return false;
        if (is_swapped_) std::reverse(bytes, bytes + word_bytes);
        std::memcpy(&word, bytes, sizeof(word));
    }
    return true;
}

// Layout: number of bytes, bytes.
template <class T>
typename ArrayDecoder<T>::Problem ArrayDecoder<T>::decode_plain(ByteSource source, std::size_t word_bytes) {
    std::uint64_t size = 0;
    if (!read_words(source, word_bytes, std::span(&size, 1)) || size > source.most_left()) return "is cut short";
    for (std::uint64_t done = 0; done < size; done += bytes_.size()) {
        bytes_.resize(std::min<std::uint64_t>(kChunkBytes, size - done));
        if (!source.read(bytes_)) return "is cut short, or no base64";
        if (Problem problem = take(bytes_)) return problem;
    }
    return end();
}

template <class T>
typename ArrayDecoder<T>::Problem ArrayDecoder<T>::inflate_block(std::uint64_t size) {
    if (size / kMostInflation > compressed_.size())
        return "has a block that is larger than its compressed bytes can bring forth";
    bytes_.resize(size);
    uLongf inflated = size;
    const int status = uncompress(reinterpret_cast<Bytef*>(bytes_.data()), &inflated,
                                  reinterpret_cast<const Bytef*>(compressed_.data()), compressed_.size());
    if (status != Z_OK || inflated != size) return "has a block that zlib cannot read";
    return take(bytes_);
}

// Layout: number of blocks, bytes of a block, bytes of the last block where it is smaller (else 0), compressed bytes of
// each block; then the blocks.
template <class T>
typename ArrayDecoder<T>::Problem ArrayDecoder<T>::decode_compressed(ByteSource source, std::size_t word_bytes) {
    std::uint64_t head[3] = {};
    if (!read_words(source, word_bytes, head) || head[0] > source.most_left() / word_bytes) return "is cut short";
    const auto [count, full_size, last_size] = head;
    std::vector<std::uint64_t> sizes(count);
    if (!read_words(source, word_bytes, sizes)) return "is cut short, or no base64";
    for (std::uint64_t i = 0; i < count; ++i) {
        if (sizes[i] > source.most_left()) return "is cut short";
        compressed_.resize(sizes[i]);
        if (!source.read(compressed_)) return "is cut short, or no base64";
        const bool is_partial = i + 1 == count && last_size != 0;
        if (Problem problem = inflate_block(is_partial ? last_size : full_size)) return problem;
    }
    return end();
}

std::string read_text(const std::filesystem::path& path) {
    std::error_code error;
    const std::uint64_t size = std::filesystem::file_size(path, error);
    std::ifstream file(path, std::ios::binary);
    std::string text(error || !file ? 0 : size, '\0');
    if (error || !file || !file.read(text.data(), static_cast<std::streamsize>(size)))
        throw Error(ErrorCode::kInput,
                    fmt::format("{}: cannot be read{}", path.string(), error ? ": " + error.message() : ""));
    return text;
}

}  // namespace

VtkXmlFile::VtkXmlFile(const std::filesystem::path& path, const char* type)
    : name_(path.string()), text_(read_text(path)) {
    find_appended();
    parse(type);
}

void VtkXmlFile::fail(const std::string& text) const {
    throw Error(ErrorCode::kInput, fmt::format("{}: {}", name_, text));
}

// Raw appended data is no XML: it is cut off before the parser sees it.
void VtkXmlFile::find_appended() {
    const std::size_t begin = text_.find("<AppendedData");
    if (begin == std::string::npos) return;
    const std::size_t end = text_.find('>', begin);
    const std::size_t underscore = end == std::string::npos ? end : text_.find_first_not_of(" \t\r\n", end + 1);
    if (underscore == std::string::npos || text_[underscore] != '_')
        fail("its AppendedData does not begin with an underscore");
    pugi::xml_document tag;
    if (!tag.load_string((text_.substr(begin, end - begin) + "/>").c_str())) fail("bad AppendedData element");
    const std::string_view encoding = tag.first_child().attribute("encoding").value();
    if (encoding != "raw" && encoding != "base64")
        fail(fmt::format("appended data in encoding '{}': raw or base64 is needed", encoding));
    appended_is_raw_ = encoding == "raw";
    appended_ = std::string_view(text_).substr(underscore + 1);
}

void VtkXmlFile::parse(const char* type) {
    pugi::xml_parse_result result;
    if (appended_.data()) {
        const std::string xml = text_.substr(0, text_.find("<AppendedData")) + "</VTKFile>";
        result = document_.load_buffer(xml.data(), xml.size());
    } else {
        result = document_.load_buffer_inplace(text_.data(), text_.size());
    }
    if (!result) fail(fmt::format("no XML: {} at byte {}", result.description(), result.offset));
    const pugi::xml_node root = document_.child("VTKFile");
    dataset_ = root.child(type);
    if (!dataset_) fail(fmt::format("is no VTK XML file with {}", type));
    const std::string_view compressor = root.attribute("compressor").value();
    if (!compressor.empty() && compressor != "vtkZLibDataCompressor")
        fail(fmt::format("compressor {}: write the file with zlib or without compression", compressor));
    is_compressed_ = !compressor.empty();
    is_big_endian_ = std::string_view(root.attribute("byte_order").value()) == "BigEndian";
    word_bytes_ = std::string_view(root.attribute("header_type").value()) == "UInt64" ? 8 : 4;
}

std::uint64_t VtkXmlFile::number(pugi::xml_node node, const char* attribute, std::uint64_t otherwise) const {
    const std::string_view text = node.attribute(attribute).value();
    if (text.empty()) return otherwise;
    std::uint64_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size())
        fail(fmt::format("{} is '{}': a count is needed", attribute, text));
    return value;
}

template <class T>
void VtkXmlFile::read(pugi::xml_node array, std::uint64_t count, const ArraySink<T>& sink) const {
    const std::string_view type = array.attribute("type").value(), format = array.attribute("format").value();
    const std::string name = fmt::format("array '{}'", array.attribute("Name").value());
    const auto how = conversion<T>(type);
    if (!how)
        fail(
            fmt::format("{} has type '{}': {} are needed", name, type, std::is_integral_v<T> ? "integers" : "numbers"));
    ArrayDecoder<T> decoder(*how, is_big_endian_, count, sink);
    const auto decode = [&](const ByteSource& source) {
        return is_compressed_ ? decoder.decode_compressed(source, word_bytes_)
                              : decoder.decode_plain(source, word_bytes_);
    };
    std::optional<std::string> problem;
    if (format == "appended") {
        const std::uint64_t offset = number(array, "offset", 0);
        if (offset > appended_.size()) fail(fmt::format("{} begins beyond the end of the appended data", name));
        problem = decode(ByteSource(appended_.substr(offset), appended_is_raw_));
    } else if (format == "binary") {
        problem = decode(ByteSource(array.child_value(), false));
    } else {
        problem = decoder.decode_ascii(array.child_value());
    }
    if (problem) fail(fmt::format("{} {}", name, *problem));
}

void VtkXmlFile::read_integers(pugi::xml_node array, std::uint64_t count, const ArraySink<std::int64_t>& sink) const {
    read(array, count, sink);
}

std::vector<std::string> VtkXmlFile::read_strings(pugi::xml_node array) const {
    std::vector<std::string> strings;
    std::string open;
    read<std::int64_t>(array, kAnyCount, [&](std::span<const std::int64_t> codes) {
        for (const std::int64_t code : codes) {
            if (code != 0)
                open += static_cast<char>(code);
            else
                strings.push_back(std::exchange(open, {}));
        }
    });
    return strings;
}

void VtkXmlFile::read_reals(pugi::xml_node array, std::uint64_t count, const ArraySink<double>& sink) const {
    read(array, count, sink);
}

}  // namespace regionmesh
