#include "dream3d_file.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <initializer_list>
#include <new>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "formats/chunked/hdf5_handle.h"

namespace regionmesh::hdf5 {
namespace {

using namespace formats;

constexpr std::array<char, 8> kMesh{'R', 'M', 'H', '5', 'M', 'S', 'H', '1'};
constexpr hsize_t kRows = 1 << 16;        // per write
constexpr std::size_t kGrowth = 1 << 22;  // growth of the file in memory

template <class T>
struct ArrayType;
template <>
struct ArrayType<float> {
    static constexpr const char* kName = "DataArray<float32>";
    static hid_t stored() { return H5T_IEEE_F32LE; }
    static hid_t native() { return H5T_NATIVE_FLOAT; }
};
template <>
struct ArrayType<std::int32_t> {
    static constexpr const char* kName = "DataArray<int32>";
    static hid_t stored() { return H5T_STD_I32LE; }
    static hid_t native() { return H5T_NATIVE_INT32; }
};
template <>
struct ArrayType<std::uint64_t> {
    static constexpr const char* kName = "DataArray<uint64>";
    static hid_t stored() { return H5T_STD_U64LE; }
    static hid_t native() { return H5T_NATIVE_UINT64; }
};
template <>
struct ArrayType<std::int8_t> {
    static constexpr const char* kName = "DataArray<int8>";
    static hid_t stored() { return H5T_STD_I8LE; }
    static hid_t native() { return H5T_NATIVE_INT8; }
};

struct Counts {
    std::uint64_t vertices, faces;
};

/// The next numbers of the input; throws where it ends before them.
void receive(void* bytes, std::size_t count) {
    if (std::fread(bytes, 1, count, stdin) != count) throw std::runtime_error("standard input holds no whole model");
}

/// Makes the file in memory and then sends it: the HDF5 library does not recover from a full disk.
class Dream3dFile {
public:
    explicit Dream3dFile(Counts counts) : counts_(counts) {}

    /// The bytes of the file.
    std::string make() {
        const Hdf5Properties in_memory(need(H5Pcreate(H5P_FILE_ACCESS)));
        need_done(H5Pset_fapl_core(in_memory.id(), kGrowth, false));
        const Hdf5File file(need(H5Fcreate("model.dream3d", H5F_ACC_TRUNC, H5P_DEFAULT, in_memory.id())));
        put_text(file.id(), "FileVersion", "8.0");
        {
            const Hdf5Group structure = group(file.id(), "DataStructure");
            write_geometry(structure.id());
            put_numbers(structure.id(), "NextObjectId", {next_id_});
        }
        need_done(H5Fflush(file.id(), H5F_SCOPE_GLOBAL));
        std::string bytes(static_cast<std::size_t>(need(H5Fget_file_image(file.id(), nullptr, 0))), '\0');
        need(H5Fget_file_image(file.id(), bytes.data(), bytes.size()));
        return bytes;
    }

private:
    /// The file is in memory, so only lack of memory can fail.
    template <class Id>
    static Id need(Id id) {
        if (id < 0) throw std::bad_alloc();
        return id;
    }
    static void need_done(herr_t status) { need(status); }

    void write_geometry(hid_t structure) {
        const hsize_t vertices = counts_.vertices, faces = counts_.faces;
        const Hdf5Group geometry = group(structure, "TriangleDataContainer");
        put_object(geometry.id(), "TriangleGeom");
        put_numbers(geometry.id(), "Vertex List ID", {next_id_});
        put_array<float>(geometry.id(), "SharedVertexList", {vertices, 3});
        put_numbers(geometry.id(), "Face List ID", {next_id_});
        put_array<std::uint64_t, std::uint32_t>(geometry.id(), "SharedTriList", {faces, 3});
        put_numbers(geometry.id(), "Vertex Data ID", {next_id_});
        const Hdf5Group vertex_data = matrix(geometry.id(), "Vertex Data", vertices);
        put_array<std::int8_t>(vertex_data.id(), "NodeType", {vertices, 1});
        put_numbers(geometry.id(), "Face Data ID", {next_id_});
        const Hdf5Group face_data = matrix(geometry.id(), "Face Data", faces);
        put_array<std::int32_t>(face_data.id(), "FaceLabels", {faces, 2});
    }

    Hdf5Group group(hid_t parent, const char* name) const {
        return Hdf5Group(need(H5Gcreate2(parent, name, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT)));
    }

    /// A group of arrays with the same number of rows.
    Hdf5Group matrix(hid_t parent, const char* name, hsize_t rows) {
        Hdf5Group made = group(parent, name);
        put_object(made.id(), "AttributeMatrix");
        put_numbers(made.id(), "TupleDims", {rows});
        return made;
    }

    /// Writes the attributes that every object has.
    void put_object(hid_t object, const char* type) {
        put_text(object, "ObjectType", type);
        put_numbers(object, "ObjectId", {next_id_++});
        const int importable = 1;
        const Hdf5Space space(need(H5Screate(H5S_SCALAR)));
        const Hdf5Attribute attribute(
            need(H5Acreate2(object, "Importable", H5T_STD_I32LE, space.id(), H5P_DEFAULT, H5P_DEFAULT)));
        need_done(H5Awrite(attribute.id(), H5T_NATIVE_INT, &importable));
    }

    void put_text(hid_t object, const char* name, const std::string& text) const {
        const Hdf5Type type(need(H5Tcopy(H5T_C_S1)));
        need_done(H5Tset_size(type.id(), text.size() + 1));
        const Hdf5Space space(need(H5Screate(H5S_SCALAR)));
        const Hdf5Attribute attribute(need(H5Acreate2(object, name, type.id(), space.id(), H5P_DEFAULT, H5P_DEFAULT)));
        need_done(H5Awrite(attribute.id(), type.id(), text.c_str()));
    }

    void put_numbers(hid_t object, const char* name, std::initializer_list<std::uint64_t> numbers) const {
        const hsize_t count = numbers.size();
        const bool is_list = std::string_view(name).ends_with("Dims") || std::string_view(name).ends_with("Dimensions");
        const Hdf5Space space(need(is_list ? H5Screate_simple(1, &count, nullptr) : H5Screate(H5S_SCALAR)));
        const Hdf5Attribute attribute(
            need(H5Acreate2(object, name, H5T_STD_U64LE, space.id(), H5P_DEFAULT, H5P_DEFAULT)));
        need_done(H5Awrite(attribute.id(), H5T_NATIVE_UINT64, numbers.begin()));
    }

    /// Takes the array from the input, where its numbers are of type `Sent`.
    template <class T, class Sent = T>
    void put_array(hid_t parent, const char* name, std::array<hsize_t, 2> shape) {
        const Hdf5Space space(need(H5Screate_simple(2, shape.data(), nullptr)));
        const Hdf5Properties untimed(need(H5Pcreate(H5P_DATASET_CREATE)));
        need_done(H5Pset_obj_track_times(untimed.id(), false));  // the same model gives the same bytes
        const Hdf5Dataset array(
            need(H5Dcreate2(parent, name, ArrayType<T>::stored(), space.id(), H5P_DEFAULT, untimed.id(), H5P_DEFAULT)));
        put_object(array.id(), ArrayType<T>::kName);
        put_numbers(array.id(), "TupleDimensions", {shape[0]});
        put_numbers(array.id(), "ComponentDimensions", {shape[1]});
        std::vector<Sent> sent;
        for (hsize_t done = 0; done < shape[0]; done += kRows) {
            const std::array<hsize_t, 2> start{done, 0}, count{std::min(kRows, shape[0] - done), shape[1]};
            sent.resize(count[0] * count[1]);
            receive(sent.data(), sent.size() * sizeof(Sent));
            const std::vector<T> rows(sent.begin(), sent.end());
            need_done(H5Sselect_hyperslab(space.id(), H5S_SELECT_SET, start.data(), nullptr, count.data(), nullptr));
            const Hdf5Space here(need(H5Screate_simple(2, count.data(), nullptr)));
            need_done(H5Dwrite(array.id(), ArrayType<T>::native(), here.id(), space.id(), H5P_DEFAULT, rows.data()));
        }
    }

    Counts counts_;
    std::uint64_t next_id_ = 1;
};

}  // namespace

std::string make_dream3d() {
    const formats::Hdf5Silence silence;
    std::array<char, 8> magic;
    Counts counts{};
    receive(magic.data(), magic.size());
    if (magic != kMesh) throw std::runtime_error("standard input holds no model");
    receive(&counts, sizeof counts);
    return Dream3dFile(counts).make();
}

}  // namespace regionmesh::hdf5
