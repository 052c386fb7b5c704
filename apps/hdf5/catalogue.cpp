#include "catalogue.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <set>
#include <string_view>
#include <utility>

namespace regionmesh::hdf5 {
namespace {

using namespace formats;  // Hdf5Handle and its kin

constexpr hssize_t kMaxNumbers = 16;         // max numbers in an attribute, or in a dataset whose values are reported
constexpr std::size_t kMaxText = 64 << 10;   // bytes of an attribute
constexpr std::size_t kMaxEntries = 100000;  // max entries of a file
constexpr int kMaxDepth = 32;                // groups can contain themselves
constexpr int kMaxAxes = 32;                 // H5S_MAX_RANK

/// The first error, as the library describes it: the last call on its stack.
std::string library_words() {
    std::string words;
    const auto note = [](unsigned, const H5E_error2_t* error, void* place) -> herr_t {
        if (error->desc) *static_cast<std::string*>(place) = error->desc;
        return 1;
    };
    H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, note, &words);
    return words.empty() ? "HDF5 error" : words;
}

Hdf5File open_file(const std::string& name) {
    const Hdf5Properties access(H5Pcreate(H5P_FILE_ACCESS));
#if H5_VERSION_GE(1, 10, 7)
    H5Pset_file_locking(access.id(), false, true);  // nothing is written, and some file systems have no locks
#endif
    Hdf5File file(H5Fopen(name.c_str(), H5F_ACC_RDONLY, access.id()));
    if (!file) throw Refusal("the HDF5 library cannot open it (" + library_words() + "); fetch the file again");
    return file;
}

std::vector<std::uint64_t> shape_of(const Hdf5Space& space) {
    std::array<hsize_t, kMaxAxes> sizes{};
    const int count = H5Sget_simple_extent_ndims(space.id());
    if (count < 0 || count > kMaxAxes || H5Sget_simple_extent_dims(space.id(), sizes.data(), nullptr) < 0) return {};
    return {sizes.begin(), sizes.begin() + count};
}

/// The type in which integers are handed over. The library converts integers and enumerations to integers, but bit
/// fields only to bit fields.
struct Integer {
    const char* word;
    std::size_t bytes;
    bool is_signed;
    hid_t native, bits;
};

/// The smallest that holds the type; none where it is no integer of up to 64 bits.
std::optional<Integer> integer_of(const Hdf5Type& type) {
    const Integer known[] = {
        {"int8", 1, true, H5T_NATIVE_INT8, H5I_INVALID_HID},   {"uint8", 1, false, H5T_NATIVE_UINT8, H5T_NATIVE_B8},
        {"int16", 2, true, H5T_NATIVE_INT16, H5I_INVALID_HID}, {"uint16", 2, false, H5T_NATIVE_UINT16, H5T_NATIVE_B16},
        {"int32", 4, true, H5T_NATIVE_INT32, H5I_INVALID_HID}, {"uint32", 4, false, H5T_NATIVE_UINT32, H5T_NATIVE_B32},
        {"int64", 8, true, H5T_NATIVE_INT64, H5I_INVALID_HID}, {"uint64", 8, false, H5T_NATIVE_UINT64, H5T_NATIVE_B64}};
    const H5T_class_t kind = H5Tget_class(type.id());
    if (kind != H5T_INTEGER && kind != H5T_ENUM && kind != H5T_BITFIELD) return std::nullopt;
    const Hdf5Type base(kind == H5T_ENUM ? H5Tget_super(type.id()) : H5I_INVALID_HID);
    const bool is_signed = kind != H5T_BITFIELD && H5Tget_sign(base ? base.id() : type.id()) != H5T_SGN_NONE;
    const std::size_t bytes = H5Tget_size(type.id());
    for (const Integer& integer : known)
        if (bytes > 0 && integer.bytes >= bytes && integer.is_signed == is_signed) return integer;
    return std::nullopt;
}

std::string type_words(const Hdf5Type& type) {
    if (const auto known = integer_of(type)) return known->word;
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

void add_attributes(hid_t object, Words words, Entry& entry) {
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

constexpr const char* kElsewhere = "its samples are kept in another file";

/// The datasets that a virtual one is made of: all of them, and those on the way to the one that is looked at.
struct VirtualParts {
    std::set<std::string> seen;
    std::vector<std::string> way;
};

std::string obstacle_of(hid_t dataset, const Hdf5Properties& layout, VirtualParts& parts);

/// Of a part of a virtual dataset. The library takes the fill value where it cannot open a part.
std::string obstacle_of_part(const Hdf5Object& root, const std::string& name, VirtualParts& parts) {
    if (std::ranges::find(parts.way, name) != parts.way.end()) return "it is a part of itself";
    // Names with % count through parts that may be written later.
    if (!parts.seen.insert(name).second || name.find('%') != std::string::npos) return {};
    const Hdf5Dataset part(H5Dopen2(root.id(), name.c_str(), H5P_DEFAULT));
    if (!part) return "its samples are kept in another file, or are missing";
    parts.way.push_back(name);
    std::string obstacle = obstacle_of(part.id(), Hdf5Properties(H5Dget_create_plist(part.id())), parts);
    parts.way.pop_back();
    return obstacle;
}

std::string obstacle_of_parts(hid_t dataset, const Hdf5Properties& layout, VirtualParts& parts) {
    std::size_t count = 0;
    if (H5Pget_layout(layout.id()) != H5D_VIRTUAL || H5Pget_virtual_count(layout.id(), &count) < 0) return {};
    const Hdf5Object root(H5Oopen(dataset, "/", H5P_DEFAULT));
    for (std::size_t i = 0; i < count; ++i) {
        std::array<char, 256> file{};
        if (H5Pget_virtual_filename(layout.id(), i, file.data(), file.size()) < 0 ||
            std::string_view(file.data()) != ".")
            return kElsewhere;
        const ssize_t size = H5Pget_virtual_dsetname(layout.id(), i, nullptr, 0);
        std::string name(size > 0 ? static_cast<std::size_t>(size) + 1 : 1, '\0');
        H5Pget_virtual_dsetname(layout.id(), i, name.data(), name.size());
        name.pop_back();
        if (std::string obstacle = obstacle_of_part(root, name, parts); !obstacle.empty()) return obstacle;
    }
    return {};
}

/// Why the samples cannot be read: a filter that this build of the library lacks, or samples in another file, which is
/// not opened.
std::string obstacle_of(hid_t dataset, const Hdf5Properties& layout, VirtualParts& parts) {
    if (H5Pget_external_count(layout.id()) > 0) return kElsewhere;
    if (std::string obstacle = obstacle_of_parts(dataset, layout, parts); !obstacle.empty()) return obstacle;
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

void describe_dataset(hid_t object, Entry& entry) {
    entry.is_dataset = true;
    const Hdf5Type type(H5Dget_type(object));
    const Hdf5Space space(H5Dget_space(object));
    const Hdf5Properties layout(H5Dget_create_plist(object));
    entry.type = type_words(type);
    entry.is_integer = integer_of(type).has_value();
    entry.shape = shape_of(space);
    if (H5Pget_layout(layout.id()) == H5D_CHUNKED && !entry.shape.empty()) {
        std::array<hsize_t, kMaxAxes> chunk{};
        const int count = H5Pget_chunk(layout.id(), kMaxAxes, chunk.data());
        if (count == static_cast<int>(entry.shape.size())) entry.chunk.assign(chunk.begin(), chunk.begin() + count);
    }
    entry.stored_bytes = H5Dget_storage_size(object);
    VirtualParts parts;
    entry.obstacle = obstacle_of(object, layout, parts);
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

std::optional<Entry> describe(const Hdf5Object& object, std::string path, Words words) {
    Entry entry{.path = std::move(path)};
    const H5I_type_t kind = H5Iget_type(object.id());
    if (kind != H5I_GROUP && kind != H5I_DATASET) return std::nullopt;
    if (kind == H5I_DATASET) describe_dataset(object.id(), entry);
    add_attributes(object.id(), words, entry);
    return entry;
}

void walk(const std::string& file, const Hdf5Object& group, const std::string& path, int depth,
          std::vector<Entry>& entries) {
    std::vector<std::string> names;
    H5Literate(group.id(), H5_INDEX_NAME, H5_ITER_INC, nullptr, collect_hard_link, &names);
    for (const std::string& name : names) {
        const Hdf5Object object(H5Oopen(group.id(), name.c_str(), H5P_DEFAULT));
        if (!object) continue;
        auto entry = describe(object, path + "/" + name, Words::kShort);
        if (!entry) continue;
        if (entries.size() == kMaxEntries) {
            throw Refusal("holds more than " + std::to_string(kMaxEntries) + " objects; name the dataset, as in " +
                          file + ":/path");
        }
        entries.push_back(std::move(*entry));
        if (!entries.back().is_dataset && depth < kMaxDepth) walk(file, object, path + "/" + name, depth + 1, entries);
    }
}

}  // namespace

Catalogue::Catalogue(const std::string& file) : name_(file), file_(open_file(file)) {}

std::optional<Entry> Catalogue::entry(const std::string& path) {
    const Hdf5Object object(H5Oopen(file_.id(), path.c_str(), H5P_DEFAULT));
    return object ? describe(object, path, Words::kAll) : std::nullopt;
}

std::vector<Entry> Catalogue::entries() {
    std::vector<Entry> entries;
    walk(name_, Hdf5Object(H5Oopen(file_.id(), "/", H5P_DEFAULT)), "", 0, entries);
    return entries;
}

std::vector<std::byte> Catalogue::read(const std::string& path, const Box& box) {
    if (!dataset_ || open_path_ != path) {
        dataset_ = Hdf5Dataset(H5Dopen2(file_.id(), path.c_str(), H5P_DEFAULT));
        open_path_ = path;
    }
    const Hdf5Type stored(H5Dget_type(dataset_.id()));
    const auto integer = integer_of(stored);
    if (!integer && H5Tget_class(stored.id()) != H5T_FLOAT)
        throw Refusal(path + ": the samples cannot be read (" + library_words() + "); fetch the file again");
    const std::vector<hsize_t> start(box.start.begin(), box.start.end()), count(box.count.begin(), box.count.end());
    const Hdf5Space space(H5Dget_space(dataset_.id()));
    if (shape_of(space).size() != count.size() || start.size() != count.size())
        throw Refusal(path + ": changed while it was read; start again");
    const Hdf5Space memory(H5Screate_simple(static_cast<int>(count.size()), count.data(), nullptr));
    std::size_t bytes = integer ? integer->bytes : sizeof(double);
    for (const std::uint64_t size : box.count) bytes *= size;
    std::vector<std::byte> samples(bytes);
    const bool is_bit_field = H5Tget_class(stored.id()) == H5T_BITFIELD;
    const hid_t native = !integer ? H5T_NATIVE_DOUBLE : is_bit_field ? integer->bits : integer->native;
    if (H5Sselect_hyperslab(space.id(), H5S_SELECT_SET, start.data(), nullptr, count.data(), nullptr) < 0 ||
        H5Dread(dataset_.id(), native, memory.id(), space.id(), H5P_DEFAULT, samples.data()) < 0) {
        throw Refusal(path + ": samples cannot be read (" + library_words() + "); the file is damaged, fetch it again");
    }
    return samples;
}

}  // namespace regionmesh::hdf5
