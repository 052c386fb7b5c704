// The tags of a VTK XML file, and where its arrays lie: for files that are read piece by piece.
// https://docs.vtk.org/en/latest/design_documents/VTKFileFormats.html
#pragma once

#include <cstdint>
#include <memory>
#include <pugixml.hpp>

#include "formats/codec/byte_stream.h"

namespace regionmesh::formats {

/// Where the bytes of an array lie in the file; text may go on behind them.
struct VtkArrayPlace {
    enum class Form { kAscii, kBase64, kRaw };
    Form form = Form::kRaw;
    std::uint64_t begin = 0, end = 0;
};

/// How the bytes of all arrays are to be taken.
struct VtkEncoding {
    bool is_compressed = false;  // by zlib
    bool is_big_endian = false;
    std::size_t word_bytes = 4;  // of the counts in front of arrays
};

/// Reads the file once up to its appended data, but holds the tags only, 4 MiB at most. Throws Error(kInput) naming the
/// file: no XML, or another compression than zlib.
class VtkXmlTags {
public:
    explicit VtkXmlTags(const InputFile& file);
    VtkXmlTags(const VtkXmlTags&) = delete;
    VtkXmlTags& operator=(const VtkXmlTags&) = delete;

    pugi::xml_node root() const { return document_.child("VTKFile"); }
    const VtkEncoding& encoding() const { return encoding_; }

    /// Of a DataArray. Throws where it is said to begin behind the end of the file, or in an unknown way.
    VtkArrayPlace place_of(pugi::xml_node array) const;

private:
    std::filesystem::path path_;
    std::uint64_t file_bytes_;
    std::uint64_t appended_ = 0;  // the byte behind the underscore; 0 if there is none
    pugi::xml_document document_;
    VtkEncoding encoding_;
};

/// The bytes of an array that is no ascii, with the counts in front of it.
std::unique_ptr<ByteStream> open_stored(const std::filesystem::path& path, const VtkArrayPlace& place);

/// A count in front of an array.
std::uint64_t decode_word(std::span<const std::byte> bytes, bool is_big_endian);

}  // namespace regionmesh::formats
