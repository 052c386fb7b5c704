// Small files and helper programs that would keep the program busy, or waiting, for ever.
#include <sys/stat.h>

#include <chrono>
#include <cmath>
#include <fstream>

#include "cli/program.h"
#include "regionmesh/formats.h"

namespace regionmesh {
namespace {

using testing::HasSubstr;

class Endless : public Program {};

/// The corners of a regular polygon, one line each: "v X Y 0".
std::string corners_text(int count) {
    std::string text;
    for (int n = 0; n < count; ++n) {
        const double turn = 2 * 3.14159265358979 * n / count;
        text += "v " + std::to_string(std::cos(turn)) + " " + std::to_string(std::sin(turn)) + " 0\n";
    }
    return text;
}

TEST_F(Endless, pipes_as_inputs_are_refused) {
    for (const std::string name : {"f.vtp", "f.vtu", "f.npy", "f.obj", "f.csv", "f.nii.gz", "f.h5", "f.tif"}) {
        ASSERT_EQ(::mkfifo(path(name).c_str(), 0600), 0);
        const std::string limit = "timeout 20";
        EXPECT_EQ(run("info " + path(name).string(), limit).code, 1) << name;
        EXPECT_EQ(run("check " + path(name).string(), limit).code, 1) << name;
    }
}

TEST_F(Endless, polygon_of_many_corners_is_read_and_checked_in_time_like_its_corners) {
    constexpr int kCorners = 100'000;
    std::ofstream file(path("polygon.obj"));
    file << corners_text(kCorners) << 'f';
    for (int n = 1; n <= kCorners; ++n) file << ' ' << n;
    file << '\n';
    file.close();
    const auto start = std::chrono::steady_clock::now();
    const Ran ran = run("check " + path("polygon.obj").string() + " --boundary open", "timeout 60");
    EXPECT_EQ(ran.code, 3);  // an open surface round a region
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(20));
    EXPECT_EQ(read_mesh(path("polygon.obj")).mesh.face_count(), kCorners - 2u);
}

TEST_F(Endless, volume_of_endless_sections_in_a_small_store_is_refused_with_its_work) {
    std::filesystem::create_directory(path("v.zarr"));
    put_text(path("v.zarr/.zarray"),
             R"({"zarr_format":2,"shape":[2000000000,4,4],"chunks":[1000,4,4],"dtype":"|u1","compressor":null,)"
             R"("fill_value":0,"order":"C","filters":null})");
    put_text(path("v.zarr/0.0.0"), std::string(16000, '\1'));
    expect_refusal("info " + path("v.zarr").string(), 1, "more than --max-work 1000000000000");
    put_text(path("v.raw"), std::string(60, '\1'));
    const std::string small = "info " + path("v.raw").string() + " --size 5,4,3 --type uint8 --max-work ";
    expect_refusal(small + "20539", 1, "5 sections of 4 x 3 samples are work of 20540");
    EXPECT_EQ(run(small + "20540").code, 0);
}

/// 1,024 sections of 2,048 x 2,048 bytes that take a few blocks on the disk.
TEST_F(Endless, sparse_npy_of_4_GB_is_refused_by_max_work_and_read_as_far_as_it_is_wanted) {
    constexpr std::uint64_t kBytes = std::uint64_t{1} << 32;
    std::string header = "{'descr': '|u1', 'fortran_order': False, 'shape': (1024, 2048, 2048), }";
    header.resize(117, ' ');
    std::string head("\x93NUMPY\1\0\x76\0", 10);
    head += header + '\n';
    put_text(path("v.npy"), head);
    std::filesystem::resize_file(path("v.npy"), 128 + kBytes);
    const std::string volume = path("v.npy").string();
    const auto start = std::chrono::steady_clock::now();
    expect_refusal("info " + volume + " --max-work 4000000000", 1, "more than --max-work 4000000000");
    const Ran ran = run("info " + volume + " --roi :,:,:10 --sweep z", "timeout 60");
    EXPECT_EQ(ran.code, 0) << ran.error;
    EXPECT_THAT(ran.out, HasSubstr("41943040 samples"));
    std::filesystem::resize_file(path("v.npy"), 128 + kBytes - 1);
    expect_refusal("info " + volume, 1, "v.npy");
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(60));
}

}  // namespace
}  // namespace regionmesh
