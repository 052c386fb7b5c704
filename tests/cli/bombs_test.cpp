// Small files that stand for large volumes: refused in a line, before memory is taken for their samples.
#include <zlib.h>

#include <cstring>
#include <string>

#include "cli/program.h"

namespace regionmesh {
namespace {

std::string deflated(const std::string& bytes) {
    uLongf size = compressBound(bytes.size());
    std::string packed(size, '\0');
    compress2(reinterpret_cast<Bytef*>(packed.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()),
              bytes.size(), 9);
    packed.resize(size);
    return packed;
}

std::string big_endian(std::uint32_t number) {
    std::string bytes;
    for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(number >> shift & 0xFF);
    return bytes;
}

/// A square picture of zeros with 8 bits a pixel.
std::string picture(std::uint32_t side, bool is_interlaced = false) {
    const auto chunk = [](std::string bytes) {  // after its four letters
        const std::string length = big_endian(static_cast<std::uint32_t>(bytes.size() - 4));
        const auto sum = ::crc32(0, reinterpret_cast<const Bytef*>(bytes.data()), static_cast<uInt>(bytes.size()));
        return length + bytes + big_endian(static_cast<std::uint32_t>(sum));
    };
    const std::string header =
        "IHDR" + big_endian(side) + big_endian(side) + std::string{8, 0, 0, 0, static_cast<char>(is_interlaced)};
    const std::string rows(std::size_t{side + 1} * side + (is_interlaced ? 2 * side : 0), '\0');
    return "\x89PNG\r\n\x1a\n" + chunk(header) + chunk("IDAT" + deflated(rows)) + chunk("IEND");
}

class Bombs : public Program {
protected:
    /// What a shell puts before a program to bound the memory that it may ask for.
    static std::string bounded(int megabytes) { return "ulimit -v " + std::to_string(megabytes * 1000) + ';'; }
};

TEST_F(Bombs, pictures_are_refused_before_their_pixels_are_read) {
    if (test::shim().empty()) GTEST_SKIP() << "sanitizers ask for more";
    std::filesystem::create_directory(path("pictures"));
    const std::string bomb = picture(9000);
    for (const char* name : {"pictures/1.png", "pictures/2.png"}) put_text(path(name), bomb);
    const std::string command = "reconstruct " + path("pictures").string() + " --memory 200MiB -o ";
    // 648 MB as labels of 64 bits, which the process does not get.
    expect_refusal(command + out("m.vtp"), 1, "needs at least", bounded(900));
    expect_refusal(command + out("m") + " --block-size 100", 1, "needs at least", bounded(900));
}

TEST_F(Bombs, a_refusal_after_a_warning_is_one_line) {
    std::string noise;
    for (std::uint32_t n = 0, bits = 7; n < 125000; ++n)
        noise += static_cast<char>((bits = bits * 1664525 + 1013904223) >> 24);
    put_text(path("noise.raw"), noise);
    const std::string command = "reconstruct " + path("noise.raw").string() + " --size 50,50,50 --type uint8 -o ";
    expect_refusal(command + out("m.vtp") + " --memory 24MiB", 1, "needs");
}

TEST_F(Bombs, a_refused_folder_is_not_left_behind) {
    put_text(path("short.npy"), "no array");
    expect_refusal("reconstruct " + path("short.npy").string() + " -o " + out("model/"), 1, "short.npy");
    put_text(path("short.vtp"), "no model");
    expect_refusal("convert " + path("short.vtp").string() + ' ' + out("m.precomputed"), 1, "short.vtp");
}

}  // namespace
}  // namespace regionmesh
