// Compressed arrays of VTK XML files.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "formats/codec/deflate_stream.h"
#include "formats/vtk/vtk_xml.h"

namespace regionmesh::formats {

/// Layout: number of blocks, bytes of a block, bytes of the last one where it is smaller (else 0), compressed bytes of
/// each block; then the blocks, each a zlib stream. Holds neither a block nor the table.
class VtkBlocks final : public ByteStream {
public:
    /// Both streams begin at the array: one reads the table while the other reads blocks.
    VtkBlocks(std::unique_ptr<ByteStream> table, std::unique_ptr<ByteStream> blocks, const VtkEncoding& encoding);

    /// The inflated size in bytes, as the header says; none where that is missing or needs more than 63 bits.
    std::optional<std::uint64_t> inflated_bytes();

    std::size_t read(std::span<std::byte> bytes) override;
    void rewind() override;
    bool finish() override { return end_block(); }
    const std::string& problem() const override { return problem_; }

private:
    /// The compressed bytes of one block.
    class Block;

    bool read_words(std::span<std::uint64_t> words);
    bool begin();
    bool begin_block();
    bool end_block();

    std::unique_ptr<ByteStream> table_, blocks_;
    VtkEncoding encoding_;
    std::uint64_t count_ = 0, full_bytes_ = 0, last_bytes_ = 0;
    bool has_begun_ = false;
    std::uint64_t next_ = 0;         // block
    std::uint64_t left_ = 0;         // bytes of the open block, inflated
    std::uint64_t packed_left_ = 0;  // and compressed, not yet taken from the stream
    bool is_open_ = false;           // a block, whose check sum was not yet verified
    DeflateStream inflated_;         // of the open block
    std::string problem_;
};

}  // namespace regionmesh::formats
