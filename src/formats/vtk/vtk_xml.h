// VTK XML files: their tags, and the bytes of their arrays.
// https://docs.vtk.org/en/latest/design_documents/VTKFileFormats.html
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <pugixml.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "formats/codec/byte_stream.h"
#include "formats/codec/numbers.h"
#include "formats/vtk/label_array.h"

namespace regionmesh::formats {

/// Where the bytes of an array lie in the file; other text may follow them.
struct VtkArrayPlace {
    enum class Form { kAscii, kBase64, kRaw };
    Form form = Form::kRaw;
    std::uint64_t begin = 0, end = 0;
};

/// How the bytes of all arrays are encoded.
struct VtkEncoding {
    bool is_compressed = false;  // by zlib
    bool is_big_endian = false;
    std::size_t word_bytes = 4;  // of the counts in front of arrays
};

/// The bytes of an array that is not ascii.
struct VtkBytes {
    std::unique_ptr<ByteStream> stream;
    std::uint64_t offset = 0;  // of the first number in the stream
    std::uint64_t count = 0;   // of bytes from there, as the array says
};

/// Reads the file once up to its appended data, but holds only the tags, 4 MiB at most. Arrays may be ascii, inline
/// base64, or appended raw or base64; with or without zlib; header words of 32 or 64 bits; either byte order. Throws
/// Error(kInput) naming the file: no XML, no element `type`, or another compression than zlib.
class VtkXml {
public:
    /// `type` is what the file must hold: "PolyData", "UnstructuredGrid", "ImageData".
    VtkXml(const std::filesystem::path& path, const char* type);
    VtkXml(const VtkXml&) = delete;
    VtkXml& operator=(const VtkXml&) = delete;

    const std::filesystem::path& path() const { return path_; }
    /// The element that is named as the type.
    pugi::xml_node dataset() const { return dataset_; }
    const VtkEncoding& encoding() const { return encoding_; }

    /// The place of a DataArray. Throws where it begins beyond the end of the file, or has an unknown format.
    VtkArrayPlace place_of(pugi::xml_node array) const;
    /// Opens an array that is not ascii, at the beginning of its stream.
    VtkBytes open(pugi::xml_node array) const;

    /// The array with a name in Cells or Polys. Throws where there is none.
    pugi::xml_node required_array(pugi::xml_node cells, const char* name) const;

    /// A count in an attribute; 0 where there is none. Throws for `most` + 1 and more, and for anything else.
    std::uint64_t count(pugi::xml_node node, const char* attribute, std::uint64_t most) const;

    /// Throws Error(kInput) "path: text" and "path: array 'name': text".
    [[noreturn]] void fail(const std::string& text) const;
    [[noreturn]] void fail(pugi::xml_node array, const std::string& text) const;

private:
    std::unique_ptr<ByteStream> open_stored(const VtkArrayPlace& place) const;

    std::filesystem::path path_;
    std::uint64_t file_bytes_ = 0;
    std::uint64_t appended_ = 0;  // the byte behind the underscore; 0 if there is none
    pugi::xml_document document_;
    pugi::xml_node dataset_;
    VtkEncoding encoding_;
};

/// The DataArray of that name in an element; an empty node where there is none.
inline pugi::xml_node array_named(pugi::xml_node parent, const char* name) {
    return parent.find_child_by_attribute("DataArray", "Name", name);
}

/// From the attribute `type`; none for text.
std::optional<NumberType> vtk_type_named(std::string_view name);
std::optional<NumberType> vtk_type(pugi::xml_node array);

/// The number of components, 1 by default.
std::uint64_t components(pugi::xml_node array);

/// All arrays of numbers of a piece, those of points first or those of cells.
std::vector<pugi::xml_node> arrays_of(pugi::xml_node piece, bool cells_first);
MeshArray describe(pugi::xml_node array);

/// A count in front of an array.
std::uint64_t decode_word(std::span<const std::byte> bytes, bool is_big_endian);

}  // namespace regionmesh::formats
