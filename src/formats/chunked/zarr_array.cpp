// https://zarr-specs.readthedocs.io: Zarr storage specification version 2, core specification version 3.
#include "formats/chunked/zarr_array.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <numeric>
#include <string_view>

#include "formats/text/json_text.h"

namespace regionmesh::formats {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

/// A real as stored; "NaN" and the like may be those of samples that are never read.
std::vector<std::byte> stored_real(const fs::path& metadata, const Json& value, const SampleFormat& format) {
    double real = 0;
    if (value.is_number())
        real = value.get<double>();
    else if (value == "NaN")
        real = NAN;
    else if (value == "Infinity" || value == "-Infinity")
        real = value == "Infinity" ? INFINITY : -INFINITY;
    else if (!value.is_null())
        fail(metadata, "the fill value " + value.dump() + " is no number; correct it");
    const bool is_single = format.real == NumberType::kFloat32;
    const std::uint64_t bits =
        is_single ? std::bit_cast<std::uint32_t>(static_cast<float>(real)) : std::bit_cast<std::uint64_t>(real);
    std::vector<std::byte> sample(sample_bytes(format));
    for (std::size_t i = 0; i < sample.size(); ++i)
        sample[format.is_big_endian ? sample.size() - 1 - i : i] = static_cast<std::byte>(bits >> (8 * i));
    return sample;
}

/// A sample as stored. Without a fill value any sample will do.
std::vector<std::byte> stored_sample(const fs::path& metadata, const Json& value, const SampleFormat& format) {
    if (format.real) return stored_real(metadata, value, format);
    std::uint64_t bits = 0;
    if (value.is_boolean()) {
        bits = value.get<bool>() ? 1 : 0;
    } else if (value.is_number_integer()) {
        bits = value.is_number_unsigned() ? value.get<std::uint64_t>()
                                          : static_cast<std::uint64_t>(value.get<std::int64_t>());
    } else if (!value.is_null() && value != 0.0) {
        fail(metadata, "the fill value " + value.dump() + " is no integer; labels must be integers");
    }
    const bool is_negative = value.is_number_integer() && !value.is_number_unsigned() && value.get<std::int64_t>() < 0;
    if (!range_of(format.type).holds(static_cast<InputLabel>(bits), is_negative))
        fail(metadata, "the fill value " + value.dump() + " is no number of type " + to_string(format.type) +
                           "; correct it, or the type");
    std::vector<std::byte> sample(sample_bytes(format));
    for (std::size_t i = 0; i < sample.size(); ++i)
        sample[format.is_big_endian ? sample.size() - 1 - i : i] = static_cast<std::byte>(bits >> (8 * i));
    return sample;
}

std::vector<int> c_order(std::size_t axes) {
    std::vector<int> order(axes);
    std::iota(order.begin(), order.end(), 0);
    return order;
}

/// "<u2": byte order, kind, bytes.
SampleFormat parse_dtype(const fs::path& metadata, const Json& dtype) {
    if (!dtype.is_string()) fail(metadata, "samples are structures; labels must be integers");
    const auto word = dtype.get<std::string>();
    if (word == "|b1") return {.type = SampleType::kU1};
    if (word.size() == 3 && word[1] == 'f' && (word[2] == '4' || word[2] == '8'))
        return format_of(metadata, word[2] == '4' ? "float32" : "float64", word[0] == '>');
    const bool is_integer = word.size() == 3 && (word[1] == 'i' || word[1] == 'u') && word[2] >= '1' && word[2] <= '8';
    const std::string name = std::string(is_integer && word[1] == 'u' ? "uint" : "int") +
                             (is_integer ? std::to_string(8 * (word[2] - '0')) : "");
    return format_of(metadata, is_integer ? name : word, word[0] == '>');
}

/// Version 3 has codecs of numcodecs under longer names.
Codec codec_of(const fs::path& metadata, std::string name) {
    constexpr std::string_view kPrefix = "numcodecs.";
    if (name.starts_with(kPrefix)) name.erase(0, kPrefix.size());
    const auto codec = parse_codec(name);
    if (!codec) refuse_codec(metadata, name);
    return *codec;
}

void require_one_compressor(const fs::path& metadata, const std::vector<Codec>& codecs) {
    const auto sums = std::ranges::count(codecs, Codec::kCrc32c);
    if (static_cast<std::size_t>(sums) + 1 < codecs.size())
        fail(metadata, "chunks are compressed twice, which is not read; write it again with one codec");
}

StoreArray parse_version_2(const fs::path& folder, const Json& json) {
    const fs::path metadata = folder / ".zarray";
    if (json.at("zarr_format") != 2)
        fail(metadata, "Zarr version " + json.at("zarr_format").dump() + "; 2 and 3 are read");
    StoreArray array{.folder = folder};
    array.shape = whole_numbers(metadata, json.at("shape"));
    array.chunk = whole_numbers(metadata, json.at("chunks"));
    array.file = array.chunk;
    array.format = parse_dtype(metadata, json.at("dtype"));
    array.fill = stored_sample(metadata, json.value("fill_value", Json()), array.format);
    array.stored = c_order(array.chunk.size());
    const std::string order = json.value("order", "C");
    if (order != "C" && order != "F") fail(metadata, "the order '" + order + "' is neither C nor F");
    if (order == "F") std::ranges::reverse(array.stored);
    const std::string separator = json.value("dimension_separator", ".");
    if (separator != "/" && separator != ".")
        fail(metadata, "the dimension_separator '" + separator + "' is neither / nor .");
    array.names.separator = separator[0];
    if (const Json filters = json.value("filters", Json()); !filters.is_null() && !filters.empty())
        refuse_codec(metadata, filters.at(0).at("id"));
    if (const Json compressor = json.value("compressor", Json()); !compressor.is_null())
        array.codecs = {codec_of(metadata, compressor.at("id"))};
    return array;
}

/// The one array-to-array codec that is read: axis i of its output is axis order[i] of its input.
void apply_transpose(const fs::path& metadata, const Json& order, std::vector<int>& stored) {
    if (order == "C") return;
    std::vector<int> permuted = stored;
    if (order == "F") {
        std::ranges::reverse(permuted);
    } else {
        if (order.size() != stored.size()) fail(metadata, "transpose has another number of axes; write it again");
        for (std::size_t i = 0; i < stored.size(); ++i) {
            const auto from = whole_number(metadata, order.at(i));
            if (from >= stored.size()) fail(metadata, "transpose names axis " + std::to_string(from));
            permuted[i] = stored[from];
        }
    }
    stored = permuted;
}

/// The name of a codec, which is a word or an object with a configuration.
std::string codec_name(const Json& codec) { return codec.is_string() ? codec : codec.at("name"); }
Json configuration(const Json& codec) {
    return codec.is_object() ? codec.value("configuration", Json::object()) : Json::object();
}

bool is_big_endian(const Json& codec) { return configuration(codec).value("endian", "little") == "big"; }

void parse_codecs(const fs::path& metadata, const Json& codecs, StoreArray& array);

void parse_sharding(const fs::path& metadata, const Json& sharding, StoreArray& array) {
    if (array.is_sharded) fail(metadata, "shards lie in shards, which is not read; write it again with one level");
    if (array.stored != c_order(array.stored.size())) refuse_codec(metadata, "transpose before sharding_indexed");
    array.is_sharded = true;
    array.chunk = whole_numbers(metadata, sharding.at("chunk_shape"));
    array.index_is_first = sharding.value("index_location", "end") == "start";
    for (const Json& codec : sharding.at("index_codecs")) {
        const std::string name = codec_name(codec);
        if (name == "crc32c") array.index_codecs.push_back(Codec::kCrc32c);
        if ((name != "bytes" || is_big_endian(codec)) && name != "crc32c")
            refuse_codec(metadata, name + " of an index");
    }
    parse_codecs(metadata, sharding.at("codecs"), array);
}

/// Order of codecs: transposition of axes, then samples (or chunks of a shard) to bytes, then packing of bytes.
void parse_codecs(const fs::path& metadata, const Json& codecs, StoreArray& array) {
    bool has_bytes = false;
    for (const Json& codec : codecs) {
        const std::string name = codec_name(codec);
        if (name == "transpose" && !has_bytes) {
            apply_transpose(metadata, configuration(codec).at("order"), array.stored);
        } else if ((name == "bytes" || name == "endian") && !has_bytes) {
            array.format.is_big_endian = is_big_endian(codec);
            has_bytes = true;
        } else if (name == "sharding_indexed" && codecs.size() == 1) {
            return parse_sharding(metadata, configuration(codec), array);
        } else if (has_bytes && name != "sharding_indexed") {
            array.codecs.push_back(codec_of(metadata, name));
        } else {
            refuse_codec(metadata, name + " in this place");
        }
    }
    if (!has_bytes) fail(metadata, "no codec makes bytes of the samples; write the file again");
    require_one_compressor(metadata, array.codecs);
}

ChunkNames parse_names(const fs::path& metadata, const Json& encoding) {
    const std::string name = codec_name(encoding);
    if (name != "default" && name != "v2")
        fail(metadata, "chunks are named by the rule '" + name + "', which is not known");
    const bool is_default = name == "default";
    const std::string separator = configuration(encoding).value("separator", is_default ? "/" : ".");
    if (separator != "/" && separator != ".") fail(metadata, "the separator '" + separator + "' is neither / nor .");
    return {.prefix = is_default ? "c" + separator : "", .separator = separator[0]};
}

StoreArray parse_version_3(const fs::path& folder, const Json& json) {
    const fs::path metadata = folder / "zarr.json";
    StoreArray array{.folder = folder};
    array.shape = whole_numbers(metadata, json.at("shape"));
    const Json& type = json.at("data_type");
    array.format = format_of(metadata, type.is_string() ? type.get<std::string>() : type.dump());
    const Json& grid = json.at("chunk_grid");
    if (grid.at("name") != "regular")
        fail(metadata, "the chunk grid is " + grid.at("name").dump() + "; regular ones are read");
    array.chunk = whole_numbers(metadata, grid.at("configuration").at("chunk_shape"));
    array.file = array.chunk;
    array.stored = c_order(array.chunk.size());
    array.names = parse_names(metadata, json.at("chunk_key_encoding"));
    if (!json.value("storage_transformers", Json::array()).empty()) refuse_codec(metadata, "storage_transformers");
    parse_codecs(metadata, json.at("codecs"), array);
    array.fill = stored_sample(metadata, json.value("fill_value", Json()), array.format);
    for (const Json& name : json.value("dimension_names", Json::array()))
        array.axis_names.push_back(name.is_string() ? name.get<std::string>() : "");
    return array;
}

bool is_there(const fs::path& path) {
    std::error_code ignored;
    return fs::exists(path, ignored);
}

/// Of version 3; a draft of it had another `zarr.json`. Other programs have files of this name, too.
std::optional<Json> read_version_3(const fs::path& folder) {
    const fs::path metadata = folder / "zarr.json";
    auto json = read_json(metadata);
    if (!json || !json->is_object() || !json->contains("zarr_format")) return std::nullopt;
    return reading(metadata, [&] {
        if (json->at("zarr_format") != 3)
            fail(metadata, "Zarr version " + json->at("zarr_format").dump() + "; 2 and 3 are read");
        return json;
    });
}

}  // namespace

std::optional<StoreArray> read_zarr_array(const fs::path& folder) {
    std::optional<StoreArray> array;
    fs::path metadata = folder / ".zarray";
    if (const auto json = read_json(metadata)) {
        array = reading(metadata, [&] { return parse_version_2(folder, *json); });
    } else if (const auto json_3 = read_version_3(folder)) {
        metadata = folder / "zarr.json";
        array = reading(metadata, [&]() -> std::optional<StoreArray> {
            if (json_3->at("node_type") != "array") return std::nullopt;
            return parse_version_3(folder, *json_3);
        });
    }
    if (!array) return std::nullopt;
    check_array(*array, metadata);
    array->attributes = read_zarr_attributes(folder);
    return array;
}

Json read_zarr_attributes(const fs::path& folder) {
    if (is_there(folder / ".zarray") || is_there(folder / ".zgroup") || is_there(folder / ".zattrs"))
        return read_json(folder / ".zattrs").value_or(Json::object());
    const auto json = read_version_3(folder);
    return json ? json->value("attributes", Json::object()) : Json();
}

bool is_zarr(const fs::path& folder) {
    for (const char* name : {".zarray", ".zgroup", ".zattrs", "zarr.json"}) {
        if (is_there(folder / name)) return true;
    }
    return false;
}

}  // namespace regionmesh::formats
