#include <gmock/gmock.h>

#include <random>

#include "formats/array/read_volume.h"
#include "formats/temporary_folder.h"

namespace regionmesh {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;
using ReadHdf5Test = TemporaryFolder;

SampleType stored_type(const std::string& name) {
    return name == "bool" ? SampleType::kI8 : *parse_sample_type(name);  // h5py makes an enumeration of bytes
}

TEST_F(ReadHdf5Test, every_type_byte_order_and_sweep_comes_back_label_for_label) {
    for (const char* name : {"bool", "int8", "uint8", "int16", "uint16", "int32", "uint32", "int64", "uint64"}) {
        for (const char* place : {"/contiguous/", "/big/gzip_"}) {
            for (const SweepChoice sweep : {SweepChoice::kAuto, SweepChoice::kX, SweepChoice::kY, SweepChoice::kZ}) {
                const Volume volume = read_volume({inside("types.h5", place + std::string(name))}, swept(sweep));
                EXPECT_EQ(volume.info.format, "hdf5");
                EXPECT_EQ(volume.info.type, stored_type(name)) << name;
                EXPECT_EQ(volume.info.lattice.size, (std::array<std::uint32_t, 3>{5, 4, 3}));
                EXPECT_EQ(volume.labels, expected(*parse_sample_type(name))) << place << name;
                EXPECT_GT(volume.info.held_bytes, 0u);
            }
        }
    }
}

TEST_F(ReadHdf5Test, virtual_datasets_are_read_where_all_parts_are_in_the_file) {
    EXPECT_EQ(read_volume({inside("virtual.h5", "/inside")}).labels, expected(SampleType::kU16));
    for (const char* name : {"/elsewhere", "/chained", "/linked"})
        EXPECT_THAT(refusal({inside("virtual.h5", name)}), HasSubstr("its samples are kept in another file")) << name;
    EXPECT_THAT(refusal({inside("virtual.h5", "/itself")}), HasSubstr("it is a part of itself"));
}

TEST_F(ReadHdf5Test, filters_of_the_library_are_undone) {
    for (const char* name : {"plain", "shuffle", "sums", "offset", "deep"}) {
        for (const SweepChoice sweep : {SweepChoice::kAuto, SweepChoice::kX, SweepChoice::kY, SweepChoice::kZ}) {
            const std::string dataset = "/packed/" + std::string(name) + "_uint16";
            EXPECT_EQ(read_volume({inside("types.h5", dataset)}, swept(sweep)).labels, expected(SampleType::kU16));
        }
    }
}

TEST_F(ReadHdf5Test, integers_of_odd_sizes_enumerations_and_bit_fields_are_labels) {
    const Volume narrow = read_volume({inside("types.h5", "/int24")});
    EXPECT_EQ(narrow.info.type, SampleType::kI32);
    EXPECT_EQ(narrow.labels, expected(SampleType::kI32));
    EXPECT_EQ(read_volume({inside("types.h5", "/bits")}).labels, expected(SampleType::kU16));
    EXPECT_EQ(read_volume({inside("types.h5", "/enum")}).labels, expected([](InputLabel v) { return v % 3; }));
}

TEST_F(ReadHdf5Test, chunks_that_were_never_written_are_the_fill_value) {
    EXPECT_EQ(read_volume({inside("types.h5", "/missing")}).labels,
              expected([](InputLabel v) { return v < 5 ? 9 : 7; }));
}

TEST_F(ReadHdf5Test, only_volume_of_integers_is_found_and_its_axes_go_by_their_names) {
    const Volume volume = read_volume({data("chunked/one.h5")});
    EXPECT_EQ(volume.info.source, inside("one.h5", "/exported_data").string());
    EXPECT_EQ(volume.info.lattice.size, (std::array<std::uint32_t, 3>{5, 4, 3}));
    EXPECT_EQ(volume.labels, expected(SampleType::kU16));
}

TEST_F(ReadHdf5Test, slash_at_the_start_of_a_path_may_be_left_out_and_links_are_followed) {
    EXPECT_EQ(read_volume({inside("one.h5", "exported_data")}).labels, expected(SampleType::kU16));
    EXPECT_EQ(read_volume({inside("types.h5", "/soft")}).labels, expected(SampleType::kU16));
}

TEST_F(ReadHdf5Test, file_with_a_colon_in_its_name_goes_first) {
    std::filesystem::copy_file(data("chunked/one.h5"), path("a.h5:b.h5"));
    EXPECT_EQ(read_volume({path("a.h5:b.h5")}).labels, expected(SampleType::kU16));
    EXPECT_EQ(read_volume({path("a.h5:b.h5").string() + ":/exported_data"}).labels, expected(SampleType::kU16));
    std::filesystem::copy_file(data("npy/uint8.npy"), path("a.h5:b.npy"));
    EXPECT_EQ(read_volume({path("a.h5:b.npy")}).info.format, "npy");
    EXPECT_THAT(refusal({path("no.h5:/b")}), HasSubstr("no such file"));
}

TEST_F(ReadHdf5Test, several_volumes_are_listed_to_choose_from) {
    EXPECT_THAT(refusal({data("chunked/types.h5")}),
                AllOf(HasSubstr("types.h5: holds several datasets; name one: "), HasSubstr("types.h5:/big/gzip_bool"),
                      HasSubstr("(int16, 3 x 4 x 5)"), HasSubstr("more")));
    EXPECT_THAT(refusal({inside("types.h5", "/contiguous")}), Not(HasSubstr("big")));
    EXPECT_THAT(refusal({inside("one.h5", "/nothing")}), HasSubstr("holds no /nothing; name one of "));
}

TEST_F(ReadHdf5Test, what_is_no_volume_of_integers_is_refused_by_name) {
    const auto refuse = [](const std::string& dataset) { return refusal({inside("types.h5", dataset)}); };
    EXPECT_EQ(read_volume({inside("types.h5", "/floats")}).labels, expected(SampleType::kU8));
    EXPECT_THAT(refuse("/words"), HasSubstr("samples are text"));
    EXPECT_THAT(refuse("/records"), HasSubstr("samples are compound"));
    EXPECT_THAT(refuse("/four"), HasSubstr("axis 0 has 2 samples; choose one with --layer 0 to 1"));
    EXPECT_THAT(refuse("/line"), HasSubstr("1 dimensions"));
    EXPECT_THAT(refuse("/empty"), HasSubstr("empty volume"));
    EXPECT_THAT(refuse("/lzf"), AllOf(HasSubstr("filter 32000 (lzf)"), HasSubstr("write it again")));
}

TEST_F(ReadHdf5Test, spacing_and_origin_come_from_common_attributes_along_z_y_x) {
    const auto lattice = [](const std::string& dataset) {
        return open_sections({inside("spaced.h5", dataset)})->info().lattice;
    };
    EXPECT_EQ(lattice("/element_size_um").spacing, (Vec3{0.5, 2, 5}));
    EXPECT_EQ(open_sections({inside("spaced.h5", "/element_size_um")})->info().metres, 1e-6);
    EXPECT_EQ(open_sections({inside("spaced.h5", "/resolution")})->info().metres, std::nullopt);
    EXPECT_EQ(lattice("/resolution").spacing, (Vec3{0.5, 2, 5}));
    EXPECT_EQ(lattice("/resolution").origin, (Vec3{10, 20, 30}));
    EXPECT_EQ(lattice("/LabDCT/Data/GrainId").spacing, (Vec3{0.25, 0.5, 0.75}));
    EXPECT_EQ(lattice("/two").size, (std::array<std::uint32_t, 3>{5, 4, 1}));
}

TEST_F(ReadHdf5Test, attributes_that_do_not_fit_are_named) {
    const auto reader = open_sections({inside("spaced.h5", "/beside")});
    EXPECT_EQ(reader->info().lattice.spacing, (Vec3{1, 1, 1}));
    EXPECT_EQ(reader->info().warning, "the attribute 'spacing' is not used: 3 numbers are needed, not 2");
    EXPECT_EQ(open_sections({inside("spaced.h5", "/beside")}, spaced({1, 2, 3}))->info().warning, "");
}

TEST_F(ReadHdf5Test, negative_spacing_mirrors_and_a_spacing_of_nothing_is_refused) {
    const Lattice lattice = open_sections({inside("spaced.h5", "/voxel_size")})->info().lattice;
    EXPECT_EQ(lattice.spacing, (Vec3{0.5, 2, 5}));
    EXPECT_EQ(lattice.direction, (std::array<double, 9>{1, 0, 0, 0, -1, 0, 0, 0, 1}));
    EXPECT_THAT(refusal({inside("spaced.h5", "/spacing")}), HasSubstr("spacing along z is 0"));
    EXPECT_EQ(open_sections({inside("spaced.h5", "/spacing")}, spaced({1, 2, 3}))->info().lattice.spacing,
              (Vec3{1, 2, 3}));
}

TEST_F(ReadHdf5Test, one_channel_or_time_is_chosen_and_two_such_axes_are_refused) {
    ReadOptions second;
    second.layer = 1;
    EXPECT_THAT(refusal({inside("channels.h5", "/one")}), HasSubstr("axis 'c' has 2 samples; choose one with --layer"));
    EXPECT_EQ(read_volume({inside("channels.h5", "/one")}, second).labels,
              expected([](InputLabel v) { return v + 100; }));
    EXPECT_THAT(refusal({inside("channels.h5", "/two")}, second), HasSubstr("axis 'c'"));
    EXPECT_THAT(refusal({data("chunked/one.h5")}, second), HasSubstr("has one layer"));
    second.layer = 2;
    EXPECT_THAT(refusal({inside("channels.h5", "/one")}, second), HasSubstr("there is no 2"));
}

TEST_F(ReadHdf5Test, files_that_are_not_hdf5_or_cut_short_are_refused) {
    put_text(path("a.h5"), "\x0e\x03\x13\x01 HDF4 begins like this");
    EXPECT_THAT(refusal({path("a.h5")}), HasSubstr("not an HDF5 file"));
    const std::string whole = text_of(data("chunked/types.h5"));
    for (std::size_t length = 0; length < whole.size(); length += whole.size() / 20) {
        put_text(path("cut.h5"), whole.substr(0, length));
        EXPECT_THAT(refusal({path("cut.h5").string() + ":/contiguous/uint16"}), StartsWith(path("cut.h5").string()));
    }
}

/// Either what was there, or an error of one line: never a crash of this process.
TEST_F(ReadHdf5Test, damaged_files_end_in_an_error_or_in_labels) {
    const std::string whole = text_of(data("chunked/spaced.h5"));
    std::mt19937 random(1);
    for (int round = 0; round < 60; ++round) {
        std::string bad = whole;
        for (int i = 0; i < 8; ++i) bad[random() % 2000] = static_cast<char>(random());
        put_text(path("bad.h5"), bad);
        const std::string problem = refusal({path("bad.h5").string() + ":/resolution"});
        EXPECT_THAT(problem, testing::AnyOf(StartsWith(path("bad.h5").string()), "nothing thrown")) << round;
    }
}

class MatFiles : public TemporaryFolder {};

TEST_F(MatFiles, of_matlab_7_3_are_hdf5_behind_a_block_of_512_bytes) {
    const std::string block = "MATLAB 7.3 MAT-file" + std::string(512 - 19, ' ');
    put_text(path("a.mat"), block + text_of(data("chunked/one.h5")));
    EXPECT_EQ(read_volume({path("a.mat")}).labels, read_volume({data("chunked/one.h5")}).labels);
    EXPECT_THAT(refusal({path("a.mat").string() + ":/nothing"}), testing::HasSubstr("nothing"));
}

}  // namespace
}  // namespace regionmesh
