#include "formats/chunked/hdf5_catalogue.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <utility>

#include "formats/input_file.h"
#include "regionmesh/read_sections.h"

namespace regionmesh::formats {
namespace {

constexpr hssize_t kMaxNumbers = 16;         // of an attribute, or of a dataset that is looked into
constexpr std::size_t kMaxText = 64 << 10;   // bytes of an attribute
constexpr std::size_t kMaxEntries = 100000;  // of a file without a path
constexpr int kMaxDepth = 32;                // groups can hold themselves
constexpr int kMaxAxes = 32;                 // H5S_MAX_RANK

/// What went wrong first, in the library's words: the last call on its stack.
std::string library_words() {
    std::string words;
    const auto note = [](unsigned, const H5E_error2_t* error, void* place) -> herr_t {
        if (error->desc) *static_cast<std::string*>(place) = error->desc;
        return 1;
    };
    H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, note, &words);
    return words.empty() ? "HDF5 error" : words;
}

Hdf5File open_file(const std::filesystem::path& path) {
    const Hdf5Properties access(H5Pcreate(H5P_FILE_ACCESS));
#if H5_VERSION_GE(1, 10, 7)
    H5Pset_file_locking(access.id(), false, true);  // nothing is written, and not every file system has locks
#endif
    Hdf5File file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, access.id()));
    if (!file) fail(path, "the HDF5 library cannot open it (" + library_words() + "); fetch the file again");
    return file;
}

std::vector<std::uint64_t> shape_of(const Hdf5Space& space) {
    std::array<hsize_t, kMaxAxes> sizes{};
    const int count = H5Sget_simple_extent_ndims(space.id());
    if (count < 0 || count > kMaxAxes || H5Sget_simple_extent_dims(space.id(), sizes.data(), nullptr) < 0) return {};
    return {sizes.begin(), sizes.begin() + count};
}

/// Integers of odd sizes are read into the next larger type.
std::optional<SampleType> integer_type(std::size_t bytes, bool is_signed) {
    if (bytes == 0 || bytes > 8) return std::nullopt;
    if (bytes == 1) return is_signed ? SampleType::kI8 : SampleType::kU8;
    if (bytes == 2) return is_signed ? SampleType::kI16 : SampleType::kU16;
    if (bytes <= 4) return is_signed ? SampleType::kI32 : SampleType::kU32;
    return is_signed ? SampleType::kI64 : SampleType::kU64;
}

std::optional<SampleType> sample_type(const Hdf5Type& type) {
    const std::size_t bytes = H5Tget_size(type.id());
    switch (H5Tget_class(type.id())) {
        case H5T_INTEGER:
            return integer_type(bytes, H5Tget_sign(type.id()) != H5T_SGN_NONE);
        case H5T_ENUM: {
            const Hdf5Type base(H5Tget_super(type.id()));
            return integer_type(bytes, H5Tget_sign(base.id()) != H5T_SGN_NONE);
        }
        case H5T_BITFIELD:
            return integer_type(bytes, false);
        default:
            return std::nullopt;
    }
}

std::string type_words(const Hdf5Type& type) {
    if (const auto known = sample_type(type)) return to_string(*known);
    switch (H5Tget_class(type.id())) {
        case H5T_FLOAT:
            return "float" + std::to_string(8 * H5Tget_size(type.id()));
        case H5T_STRING:
            return "text";
        case H5T_COMPOUND:
            return "compound";
        case H5T_ARRAY:
            return "array";
        case H5T_REFERENCE:
            return "reference";
        default:
            return "other";
    }
}

/// The library converts integers and enumerations to integers, bit fields only to bit fields.
hid_t memory_type(SampleType type, bool is_bit_field) {
    switch (type) {
        case SampleType::kU1:
        case SampleType::kU8:
            return is_bit_field ? H5T_NATIVE_B8 : H5T_NATIVE_UINT8;
        case SampleType::kI8:
            return H5T_NATIVE_INT8;
        case SampleType::kU16:
            return is_bit_field ? H5T_NATIVE_B16 : H5T_NATIVE_UINT16;
        case SampleType::kI16:
            return H5T_NATIVE_INT16;
        case SampleType::kU32:
            return is_bit_field ? H5T_NATIVE_B32 : H5T_NATIVE_UINT32;
        case SampleType::kI32:
            return H5T_NATIVE_INT32;
        case SampleType::kU64:
            return is_bit_field ? H5T_NATIVE_B64 : H5T_NATIVE_UINT64;
        case SampleType::kI64:
            return H5T_NATIVE_INT64;
    }
    return H5I_INVALID_HID;
}

bool is_number(const Hdf5Type& type) {
    const H5T_class_t kind = H5Tget_class(type.id());
    return kind == H5T_INTEGER || kind == H5T_FLOAT;
}

std::string read_text(const Hdf5Attribute& attribute, const Hdf5Type& type) {
    if (H5Tis_variable_str(type.id()) > 0) {
        char* text = nullptr;
        const Hdf5Type memory(H5Tcopy(H5T_C_S1));
        H5Tset_size(memory.id(), H5T_VARIABLE);
        H5Tset_cset(memory.id(), H5Tget_cset(type.id()));
        if (H5Aread(attribute.id(), memory.id(), &text) < 0 || !text) return {};
        const std::string copy(text, ::strnlen(text, kMaxText));
        H5free_memory(text);
        return copy;
    }
    std::string text(H5Tget_size(type.id()), '\0');
    if (text.empty() || text.size() > kMaxText || H5Aread(attribute.id(), type.id(), text.data()) < 0) return {};
    return text.substr(0, text.find('\0'));
}

herr_t collect_name(hid_t, const char* name, const H5A_info_t*, void* place) {
    static_cast<std::vector<std::string>*>(place)->emplace_back(name);
    return 0;
}

enum class Words { kAll, kShort };

void add_attributes(hid_t object, Words words, Hdf5Entry& entry) {
    std::vector<std::string> names;
    H5Aiterate2(object, H5_INDEX_NAME, H5_ITER_INC, nullptr, collect_name, &names);
    for (const std::string& name : names) {
        const Hdf5Attribute attribute(H5Aopen(object, name.c_str(), H5P_DEFAULT));
        if (!attribute) continue;
        const Hdf5Type type(H5Aget_type(attribute.id()));
        const Hdf5Space space(H5Aget_space(attribute.id()));
        const hssize_t count = H5Sget_simple_extent_npoints(space.id());
        if (is_number(type) && count > 0 && count <= kMaxNumbers) {
            std::vector<double> numbers(static_cast<std::size_t>(count));
            if (H5Aread(attribute.id(), H5T_NATIVE_DOUBLE, numbers.data()) >= 0) entry.numbers[name] = numbers;
        } else if (H5Tget_class(type.id()) == H5T_STRING && count == 1 &&
                   (words == Words::kAll || H5Tis_variable_str(type.id()) == 0)) {
            entry.words[name] = read_text(attribute, type);
        }
    }
}

/// Filters that this build of the library lacks, or samples kept in another file, which is not ours to open.
std::string obstacle_of(const Hdf5Properties& layout) {
    if (H5Pget_external_count(layout.id()) > 0) return "its samples are kept in another file";
    const int count = H5Pget_nfilters(layout.id());
    for (int i = 0; i < count; ++i) {
        unsigned flags = 0, filter_config = 0;
        std::size_t values = 0;
        std::array<char, 64> name{};
        const H5Z_filter_t filter = H5Pget_filter2(layout.id(), static_cast<unsigned>(i), &flags, &values, nullptr,
                                                   name.size() - 1, name.data(), &filter_config);
        if (filter >= 0 && H5Zfilter_avail(filter) <= 0) {
            return "it is packed by filter " + std::to_string(filter) + " (" + name.data() +
                   "), which the HDF5 library here does not have";
        }
    }
    return {};
}

void describe_dataset(hid_t object, Hdf5Entry& entry) {
    entry.is_dataset = true;
    const Hdf5Type type(H5Dget_type(object));
    const Hdf5Space space(H5Dget_space(object));
    const Hdf5Properties layout(H5Dget_create_plist(object));
    entry.type = type_words(type);
    entry.sample_type = sample_type(type);
    entry.shape = shape_of(space);
    if (H5Pget_layout(layout.id()) == H5D_CHUNKED && !entry.shape.empty()) {
        std::array<hsize_t, kMaxAxes> chunk{};
        const int count = H5Pget_chunk(layout.id(), kMaxAxes, chunk.data());
        if (count == static_cast<int>(entry.shape.size())) entry.chunk.assign(chunk.begin(), chunk.begin() + count);
    }
    entry.stored_bytes = H5Dget_storage_size(object);
    entry.obstacle = obstacle_of(layout);
    const hssize_t count = H5Sget_simple_extent_npoints(space.id());
    if (is_number(type) && count > 0 && count <= kMaxNumbers && entry.obstacle.empty()) {
        std::vector<double> values(static_cast<std::size_t>(count));
        if (H5Dread(object, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) >= 0)
            entry.values = std::move(values);
    }
}

herr_t collect_hard_link(hid_t, const char* name, const H5L_info_t* link, void* place) {
    if (link->type == H5L_TYPE_HARD) static_cast<std::vector<std::string>*>(place)->emplace_back(name);
    return 0;
}

std::optional<Hdf5Entry> describe(const Hdf5Object& object, std::string path, Words words) {
    Hdf5Entry entry{.path = std::move(path)};
    const H5I_type_t kind = H5Iget_type(object.id());
    if (kind != H5I_GROUP && kind != H5I_DATASET) return std::nullopt;
    if (kind == H5I_DATASET) describe_dataset(object.id(), entry);
    add_attributes(object.id(), words, entry);
    return entry;
}

void walk(const std::filesystem::path& file, const Hdf5Object& group, const std::string& path, int depth,
          std::vector<Hdf5Entry>& entries) {
    std::vector<std::string> names;
    H5Literate(group.id(), H5_INDEX_NAME, H5_ITER_INC, nullptr, collect_hard_link, &names);
    for (const std::string& name : names) {
        const Hdf5Object object(H5Oopen(group.id(), name.c_str(), H5P_DEFAULT));
        if (!object) continue;
        auto entry = describe(object, path + "/" + name, Words::kShort);
        if (!entry) continue;
        if (entries.size() == kMaxEntries) {
            fail(file, "holds more than " + std::to_string(kMaxEntries) + " objects; name the dataset, as in " +
                           file.string() + ":/path");
        }
        entries.push_back(std::move(*entry));
        if (!entries.back().is_dataset && depth < kMaxDepth) walk(file, object, path + "/" + name, depth + 1, entries);
    }
}

}  // namespace

Hdf5Catalogue::Hdf5Catalogue(const std::filesystem::path& path) : path_(path), file_(open_file(path)) {}

std::optional<Hdf5Entry> Hdf5Catalogue::entry(const std::string& path) {
    const Hdf5Object object(H5Oopen(file_.id(), path.c_str(), H5P_DEFAULT));
    return object ? describe(object, path, Words::kAll) : std::nullopt;
}

std::vector<Hdf5Entry> Hdf5Catalogue::entries() {
    std::vector<Hdf5Entry> entries;
    walk(path_, Hdf5Object(H5Oopen(file_.id(), "/", H5P_DEFAULT)), "", 0, entries);
    return entries;
}

Bytes Hdf5Catalogue::read(const std::string& path, const Hdf5Box& box) {
    if (!dataset_ || open_path_ != path) {
        dataset_ = Hdf5Dataset(H5Dopen2(file_.id(), path.c_str(), H5P_DEFAULT));
        open_path_ = path;
    }
    const Hdf5Type stored(H5Dget_type(dataset_.id()));
    const auto type = sample_type(stored);
    const bool is_real = H5Tget_class(stored.id()) == H5T_FLOAT;
    if (!type && !is_real)
        fail(path_, path + ": the samples cannot be read (" + library_words() + "); fetch the file again");
    const std::vector<hsize_t> start(box.start.begin(), box.start.end()), count(box.count.begin(), box.count.end());
    const Hdf5Space space(H5Dget_space(dataset_.id()));
    if (shape_of(space).size() != count.size()) fail(path_, path + ": changed while it was read; start again");
    const Hdf5Space memory(H5Screate_simple(static_cast<int>(count.size()), count.data(), nullptr));
    std::size_t bytes = is_real ? sizeof(double) : sample_bytes(*type);
    for (const std::uint64_t size : box.count) bytes *= size;
    Bytes samples(bytes);
    const bool is_bit_field = H5Tget_class(stored.id()) == H5T_BITFIELD;
    const hid_t native = is_real ? H5T_NATIVE_DOUBLE : memory_type(*type, is_bit_field);
    if (H5Sselect_hyperslab(space.id(), H5S_SELECT_SET, start.data(), nullptr, count.data(), nullptr) < 0 ||
        H5Dread(dataset_.id(), native, memory.id(), space.id(), H5P_DEFAULT, samples.data()) < 0) {
        fail(path_, path + ": samples cannot be read (" + library_words() + "); the file is damaged, fetch it again");
    }
    return samples;
}

}  // namespace regionmesh::formats
