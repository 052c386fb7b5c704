#include "formats/chunked/hdf5_reader.h"

#include <algorithm>
#include <array>
#include <memory>
#include <string_view>
#include <utility>

#include "formats/chunked/metadata_file.h"
#include "formats/input_file.h"
#include "regionmesh/read_sections.h"

namespace regionmesh::formats {
namespace {

using Json = nlohmann::json;

// Of computing: a chunk of a GiB takes some to unpack, and so do 100,000 objects to look at.
constexpr unsigned kFewSeconds = 3;
constexpr unsigned kManySeconds = 30;
constexpr std::string_view kSignature("\x89HDF\r\n\x1a\n", 8);

/// The superblock stands at the start, or behind a block of the user's own of 512 bytes, 1024, 2048 and so on.
void require_hdf5(const std::filesystem::path& path) {
    const InputFile file(path);
    std::array<std::byte, 8> start{};
    for (std::uint64_t offset = 0; offset + start.size() <= file.size(); offset = offset == 0 ? 512 : 2 * offset) {
        file.read(offset, start);
        if (std::string_view(reinterpret_cast<const char*>(start.data()), start.size()) == kSignature) return;
    }
    fail(path, "not an HDF5 file (it does not begin as one; HDF4 is not read); write it again as HDF5");
}

/// Words of the file need not be UTF-8, which JSON is.
std::string dump(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

Bytes to_bytes(std::string_view text) {
    const auto bytes = std::as_bytes(std::span(text));
    return {bytes.begin(), bytes.end()};
}

Json parse(std::span<const std::byte> bytes) {
    const auto* text = reinterpret_cast<const char*>(bytes.data());
    return Json::parse(text, text + bytes.size());
}

Json to_json(const Hdf5Entry& entry) {
    return {{"path", entry.path},
            {"is_dataset", entry.is_dataset},
            {"type", entry.type},
            {"shape", entry.shape},
            {"chunk", entry.chunk},
            {"is_integer", entry.sample_type.has_value()},
            {"stored_bytes", entry.stored_bytes},
            {"obstacle", entry.obstacle},
            {"values", entry.values},
            {"numbers", entry.numbers},
            {"words", entry.words}};
}

/// JSON has no number for what is not finite: it comes as null, and is no use as a length either.
std::vector<double> numbers_of(const Json& json) {
    std::vector<double> numbers;
    for (const Json& number : json) numbers.push_back(number.is_number() ? number.get<double>() : 0);
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

/// The file is opened by the first request, in the child.
ChildProcess::Answer answers(const std::filesystem::path& path) {
    return [path, file = std::shared_ptr<Hdf5Catalogue>()](std::span<const std::byte> bytes) mutable -> Bytes {
        if (!file) file = std::make_shared<Hdf5Catalogue>(path);
        const Json request = parse(bytes);
        if (request.contains("start")) {
            return file->read(request.at("path"), {.start = request.at("start"), .count = request.at("count")});
        }
        Json entries = Json::array();
        if (!request.contains("path")) {
            for (const Hdf5Entry& entry : file->entries()) entries.push_back(to_json(entry));
        } else if (const auto entry = file->entry(request.at("path"))) {
            entries.push_back(to_json(*entry));
        }
        return to_bytes(dump(entries));
    };
}

}  // namespace

Hdf5Reader::Hdf5Reader(const std::filesystem::path& path)
    : path_((require_hdf5(path), path)),
      child_(answers(path),
             path.string() + ": the HDF5 library fails on this file (it crashed, or took more time or memory than it " +
                 "should); the file is damaged, fetch it again") {}

std::vector<Hdf5Entry> Hdf5Reader::ask(const std::string& request, unsigned seconds) {
    return reading(path_, [&] {
        std::vector<Hdf5Entry> entries;
        for (const Json& entry : parse(child_.ask(to_bytes(request), seconds))) entries.push_back(from_json(entry));
        return entries;
    });
}

std::optional<Hdf5Entry> Hdf5Reader::entry(const std::string& path) {
    std::vector<Hdf5Entry> entries = ask(dump({{"path", path}}), kFewSeconds);
    return entries.empty() ? std::nullopt : std::optional(std::move(entries.front()));
}

std::vector<Hdf5Entry> Hdf5Reader::entries() { return ask("{}", kManySeconds); }

Bytes Hdf5Reader::read(const std::string& path, const Hdf5Box& box) {
    return child_.ask(to_bytes(dump({{"path", path}, {"start", box.start}, {"count", box.count}})), kManySeconds);
}

}  // namespace regionmesh::formats
