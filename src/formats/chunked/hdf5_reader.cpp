#include "formats/chunked/hdf5_reader.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "formats/input_file.h"
#include "formats/text/json_text.h"
#include "regionmesh/read_sections.h"

namespace regionmesh::formats {
namespace {

using Json = nlohmann::json;
constexpr Asked kHdf5{.program = kHdf5Program, .letters = {'H', '5'}, .library = "HDF5 library"};

// Processor time of one answer: a chunk of a GiB takes a while to unpack, and so do 100,000 objects to describe.
constexpr unsigned kFewSeconds = 3;
constexpr unsigned kManySeconds = 30;
constexpr std::string_view kSignature("\x89HDF\r\n\x1a\n", 8);

/// The superblock stands at the start, or after a user block of 512 bytes, 1024, 2048 and so on.
void require_hdf5(const std::filesystem::path& path) {
    const InputFile file(path);
    std::array<std::byte, 8> start{};
    for (std::uint64_t offset = 0; offset + start.size() <= file.size(); offset = offset == 0 ? 512 : 2 * offset) {
        file.read(offset, start);
        if (std::string_view(reinterpret_cast<const char*>(start.data()), start.size()) == kSignature) return;
    }
    fail(path, "not an HDF5 file (it does not begin as one; HDF4 is not read); write it again as HDF5");
}

/// Paths need not be UTF-8, as JSON must be.
std::string dump(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

/// JSON has no number for values that are not finite: they come as null.
std::vector<double> numbers_of(const Json& json) {
    std::vector<double> numbers;
    for (const Json& number : json) numbers.push_back(number.is_number() ? number.get<double>() : NAN);
    return numbers;
}

Hdf5Entry from_json(const Json& json) {
    Hdf5Entry entry{.path = json.at("path"), .is_dataset = json.at("is_dataset"), .type = json.at("type")};
    if (json.at("is_integer").get<bool>()) entry.sample_type = parse_sample_type(entry.type);
    json.at("shape").get_to(entry.shape);
    json.at("chunk").get_to(entry.chunk);
    json.at("stored_bytes").get_to(entry.stored_bytes);
    json.at("obstacle").get_to(entry.obstacle);
    json.at("words").get_to(entry.words);
    entry.values = numbers_of(json.at("values"));
    for (const auto& [name, numbers] : json.at("numbers").items()) entry.numbers[name] = numbers_of(numbers);
    return entry;
}

}  // namespace

Hdf5Reader::Hdf5Reader(const std::filesystem::path& path) : path_((require_hdf5(path), path)), program_(kHdf5, path) {}

std::vector<Hdf5Entry> Hdf5Reader::ask_entries(const std::string& request) {
    const Bytes bytes = program_.ask(request);
    const auto* text = reinterpret_cast<const char*>(bytes.data());
    return reading(path_, [&] {
        std::vector<Hdf5Entry> entries;
        for (const Json& entry : Json::parse(text, text + bytes.size())) entries.push_back(from_json(entry));
        return entries;
    });
}

std::optional<Hdf5Entry> Hdf5Reader::entry(const std::string& path) {
    std::vector<Hdf5Entry> entries = ask_entries(dump({{"seconds", kFewSeconds}, {"path", path}}));
    return entries.empty() ? std::nullopt : std::optional(std::move(entries.front()));
}

std::vector<Hdf5Entry> Hdf5Reader::entries() { return ask_entries(dump({{"seconds", kManySeconds}})); }

Bytes Hdf5Reader::read(const std::string& path, const Hdf5Box& box) {
    return program_.ask(dump({{"seconds", kManySeconds}, {"path", path}, {"start", box.start}, {"count", box.count}}));
}

}  // namespace regionmesh::formats
