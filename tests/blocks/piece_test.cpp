#include "blocks/piece.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "regionmesh/error.h"

namespace regionmesh {
namespace {

namespace fs = std::filesystem;

class PieceFile : public testing::Test {
protected:
    ~PieceFile() override { fs::remove(path_); }

    /// Whether the file is refused once any one of its bytes is another.
    void expect_every_byte_counts() {
        for (std::streamoff at = 0; at < static_cast<std::streamoff>(fs::file_size(path_)); ++at) {
            change(at);
            EXPECT_THROW(read_piece(path_), Error) << "byte " << at;
            change(at);
        }
        EXPECT_NO_THROW(read_piece(path_));
    }

    const fs::path path_ = fs::temp_directory_path() / ("piece-" + std::to_string(::getpid()));

private:
    void change(std::streamoff at) const {
        std::fstream file(path_, std::ios::in | std::ios::out | std::ios::binary);
        char byte = 0;
        file.seekg(at).get(byte);
        file.seekp(at).put(static_cast<char>(byte ^ 1));
    }
};

TEST_F(PieceFile, with_faces_is_refused_once_a_byte_is_another) {
    Piece piece;
    piece.vertices = {{.position = {0, 0, 0}}, {.position = {1, 0, 0}}, {.position = {0, 1, 0}}};
    piece.faces = {{{0, 1, 2}, {1, 2}}};
    write_piece(piece, path_, {.sync = false});
    expect_every_byte_counts();
}

TEST_F(PieceFile, without_faces_is_refused_once_a_byte_is_another) {
    Piece piece;
    write_piece(piece, path_, {.sync = false});
    expect_every_byte_counts();
}

}  // namespace
}  // namespace regionmesh
