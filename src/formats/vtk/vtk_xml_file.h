// A VTK XML file and its arrays, in all the ways VTK's writers encode them.
// https://docs.vtk.org/en/latest/design_documents/VTKFileFormats.html
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <pugixml.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace regionmesh {

/// Takes the values of an array in order, some at a time.
template <class T>
using ArraySink = std::function<void(std::span<const T>)>;

/// Holds the whole text of the file; arrays are decoded as they are asked for. Arrays may be ascii, inline base64, or
/// appended raw or base64; with or without zlib; header words of 32 or 64 bits; either byte order. No allocation
/// exceeds what the bytes of the file can bring forth. Throws Error(kInput) that names the file.
class VtkXmlFile {
public:
    /// `type` is what the file must hold: "PolyData", "UnstructuredGrid".
    VtkXmlFile(const std::filesystem::path& path, const char* type);
    VtkXmlFile(const VtkXmlFile&) = delete;
    VtkXmlFile& operator=(const VtkXmlFile&) = delete;

    /// The element that is named as the type.
    pugi::xml_node dataset() const { return dataset_; }

    /// Gives the `count` numbers of a DataArray to `sink`; an array of another length is an error. Unsigned integers of
    /// 64 bits keep their bits; reals where integers are needed are an error.
    void read_integers(pugi::xml_node array, std::uint64_t count, const ArraySink<std::int64_t>& sink) const;
    void read_reals(pugi::xml_node array, std::uint64_t count, const ArraySink<double>& sink) const;

    /// The strings of a DataArray of that type.
    std::vector<std::string> read_strings(pugi::xml_node array) const;

    /// A count or number in an attribute; `otherwise` where there is none.
    std::uint64_t number(pugi::xml_node node, const char* attribute, std::uint64_t otherwise) const;

    [[noreturn]] void fail(const std::string& text) const;

private:
    void parse(const char* type);
    void find_appended();
    template <class T>
    void read(pugi::xml_node array, std::uint64_t count, const ArraySink<T>& sink) const;

    std::string name_;
    std::string text_;
    std::string_view appended_;  // from the byte after the underscore, as long as the file goes on
    bool appended_is_raw_ = false;
    bool is_compressed_ = false;
    bool is_big_endian_ = false;
    std::size_t word_bytes_ = 4;
    pugi::xml_document document_;
    pugi::xml_node dataset_;
};

}  // namespace regionmesh
