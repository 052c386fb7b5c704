#include <gmock/gmock.h>

#include <random>

#include "formats/array/read_volume.h"
#include "formats/temporary_folder.h"

namespace regionmesh {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::AnyOf;
using testing::HasSubstr;
using testing::StartsWith;

class ReadZarrTest : public TemporaryFolder {
protected:
    /// A copy of a store of tests/data/chunked, with `from` replaced by `to` in one of its files.
    fs::path changed(const std::string& store, const std::string& file, const std::string& from,
                     const std::string& to) {
        const fs::path copy = path("changed.zarr");
        fs::remove_all(copy);
        fs::copy(data("chunked/" + store), copy, fs::copy_options::recursive);
        std::string text = text_of(copy / file);
        const std::size_t place = text.find(from);
        EXPECT_NE(place, std::string::npos) << from;
        put_text(copy / file, text.replace(place, from.size(), to));
        return copy;
    }
};

Paths stores_in(const std::string& folder) {
    Paths stores;
    for (const auto& entry : fs::directory_iterator(data("chunked/" + folder)))
        if (entry.path().filename() != "bad") stores.push_back(entry.path());
    EXPECT_GT(stores.size(), 10u);
    return stores;
}

TEST_F(ReadZarrTest, every_type_codec_order_and_sweep_of_versions_2_and_3_comes_back_label_for_label) {
    for (const char* version : {"zarr2", "zarr3"}) {
        for (const fs::path& store : stores_in(version)) {
            for (const SweepChoice sweep : kSweeps) {
                const Volume volume = read_volume({store}, swept(sweep));
                EXPECT_EQ(volume.info.format, "zarr");
                EXPECT_EQ(volume.info.type, type_in_name(store)) << store;
                EXPECT_EQ(volume.info.lattice.size, (std::array<std::uint32_t, 3>{5, 4, 3}));
                EXPECT_EQ(volume.labels, expected(type_in_name(store))) << store;
                EXPECT_GT(volume.info.held_bytes, 0u);
            }
        }
    }
}

TEST_F(ReadZarrTest, separator_of_version_2_that_is_neither_slash_nor_dot_is_refused) {
    const fs::path store = changed("zarr2/bad/missing_int16.zarr", ".zarray", "{", R"({"dimension_separator": "!",)");
    EXPECT_THAT(refusal({store}), HasSubstr("the dimension_separator '!' is neither / nor ."));
}

TEST_F(ReadZarrTest, chunks_that_are_not_there_are_the_fill_value_in_the_byte_order_of_the_array) {
    EXPECT_EQ(read_volume({data("chunked/zarr2/bad/missing_int16.zarr")}).labels,
              expected([](InputLabel v) { return v == 0 ? 5 : -7; }));
}

TEST_F(ReadZarrTest, shards_are_read_chunk_by_chunk_and_may_lack_some) {
    for (const char* where : {"start", "end"}) {
        for (const SweepChoice sweep : kSweeps) {
            const Volume volume =
                read_volume({data("chunked/zarr3/bad/shard_" + std::string(where) + "_uint16.zarr")}, swept(sweep));
            const auto labels =
                expected([](InputLabel v) {  // a chunk is 3 x 2 x 2, and the second of each shard is missing
                    return v % 5 >= 3 && v % 20 / 5 < 2 ? 500 : v;
                });
            EXPECT_EQ(volume.labels, labels) << where;
        }
    }
}

TEST_F(ReadZarrTest, only_array_of_a_group_is_found_and_several_are_listed) {
    EXPECT_THAT(
        refusal({data("chunked/zarr2/bad/several.zarr")}),
        AllOf(HasSubstr("several arrays; name one: "), HasSubstr("several.zarr/a, "), HasSubstr("several.zarr/b/c")));
    EXPECT_EQ(read_volume({data("chunked/zarr2/bad/several.zarr/b")}).labels, expected(SampleType::kU16));
    EXPECT_EQ(read_volume({data("chunked/zarr2/bad/several.zarr/a/")}).labels, expected(SampleType::kU16));
}

TEST_F(ReadZarrTest, what_is_not_read_is_refused_by_name) {
    for (const char* name : {"chunked/zarr2/bad/float32.zarr", "chunked/zarr3/bad/float32.zarr"})
        EXPECT_EQ(read_volume({data(name)}).labels, expected(SampleType::kU8)) << name;
    EXPECT_THAT(refusal({data("chunked/zarr2/bad/delta.zarr")}), HasSubstr("made by 'delta', which is not read"));
    EXPECT_THAT(refusal({data("chunked/zarr2/bad/bz2.zarr")}), HasSubstr("made by 'bz2'"));
    put_text(path("a.zarr.zip"), "PK\x03\x04");
    EXPECT_THAT(refusal({path("a.zarr.zip")}), HasSubstr("unpack it into a directory"));
    fs::create_directory(path("empty.zarr"));
    EXPECT_THAT(refusal({path("empty.zarr")}), HasSubstr("holds no array of integers"));
    EXPECT_THAT(refusal({data("chunked/ome/image_04.zarr")}, raw({{5, 4, 3}}, SampleType::kU8)), HasSubstr("raw file"));
}

TEST_F(ReadZarrTest, image_of_ome_zarr_opens_at_its_finest_resolution_with_scale_and_place) {
    for (const char* version : {"04", "05"}) {
        const std::string image = "chunked/ome/image_" + std::string(version) + ".zarr";
        const Volume fine = read_volume({data(image)});
        EXPECT_EQ(fine.labels, expected(SampleType::kU16));
        EXPECT_EQ(fine.info.lattice.spacing, (Vec3{0.5, 2, 5}));
        EXPECT_EQ(fine.info.lattice.origin, (Vec3{10, 20, 30}));
        const auto coarse = open_sections({data(image + "/1")});
        EXPECT_EQ(coarse->info().lattice.size, (std::array<std::uint32_t, 3>{3, 2, 2}));
        EXPECT_EQ(coarse->info().lattice.spacing, (Vec3{1, 4, 10}));
    }
}

TEST_F(ReadZarrTest, a_level_is_of_its_image_however_its_path_is_written) {
    const fs::path image = changed("ome/image_04.zarr", ".zgroup", "2", "2");
    fs::create_directory_symlink(image / "1", path("link"));
    for (const fs::path& written : {image / "1", image / "0" / ".." / "1", image / "1" / ".", path("link")})
        EXPECT_EQ(open_sections({written})->info().lattice.spacing, (Vec3{1, 4, 10})) << written;
}

TEST_F(ReadZarrTest, axes_in_other_units_get_that_of_x) {
    const fs::path image =
        changed("ome/image_04.zarr", ".zattrs", R"("name": "z")", R"("name": "z", "unit": "micrometer")");
    const std::string text = text_of(image / ".zattrs"), x = R"("name": "x")";
    const auto with_unit_of_x = [&](const std::string& unit) {
        std::string other = text;
        put_text(image / ".zattrs", other.replace(other.find(x), x.size(), x + R"(, "unit": ")" + unit + '"'));
        return Paths{image};
    };
    const Lattice lattice = open_sections(with_unit_of_x("nanometer"))->info().lattice;
    EXPECT_NEAR(length(lattice.spacing - Vec3{0.5, 2, 5000}), 0, 1e-9);
    EXPECT_NEAR(length(lattice.origin - Vec3{10, 20, 30000}), 0, 1e-9);
    EXPECT_EQ(open_sections(with_unit_of_x("micrometer"))->info().lattice.spacing, (Vec3{0.5, 2, 5}));
    EXPECT_EQ(open_sections(with_unit_of_x("micrometer"))->info().metres, 1e-6);
    EXPECT_EQ(open_sections({data("chunked/ome/image_04.zarr")})->info().metres, std::nullopt);
    EXPECT_THAT(refusal(with_unit_of_x("cubit")), HasSubstr("axis z is in micrometer and axis x in cubit"));
}

TEST_F(ReadZarrTest, names_of_axes_may_be_capital_and_one_may_be_missing) {
    const std::string store = "zarr3/names_dot_uint16.zarr", file = "zarr.json";
    const Volume volume = read_volume({data("chunked/" + store)});
    for (const char* axis : {"x", "y", "z"}) {
        const std::string name = '"' + std::string(axis) + '"';
        const std::string capital = {'"', static_cast<char>(axis[0] - 'a' + 'A'), '"'};
        for (const std::string& other : {capital, std::string("null")})
            EXPECT_EQ(read_volume({changed(store, file, name, other)}).labels, volume.labels) << axis << other;
    }
    for (const char* axis : {"x", "y"}) {
        const std::string name = '"' + std::string(axis) + '"';
        EXPECT_EQ(read_volume({changed(store, file, name, "\"lat\"")}).labels, volume.labels) << axis;
    }
    EXPECT_THAT(refusal({changed(store, file, "\"z\"", "\"lat\"")}), HasSubstr("axis 'lat' has"));
}

TEST_F(ReadZarrTest, files_of_other_programs_above_an_array_are_left_alone) {
    const std::string store = "zarr3/names_dot_uint16.zarr";
    fs::copy(data("chunked/" + store), path("v.zarr"), fs::copy_options::recursive);
    put_text(path("zarr.json"), "{\"a\": 1}");
    EXPECT_EQ(read_volume({path("v.zarr")}).labels, read_volume({data("chunked/" + store)}).labels);
}

TEST_F(ReadZarrTest, labels_of_an_image_bring_names) {
    for (const char* version : {"04", "05"}) {
        for (const char* level : {"", "/0"}) {
            const auto reader =
                open_sections({data("chunked/ome/image_" + std::string(version) + ".zarr/labels/cells" + level)});
            EXPECT_EQ(reader->info().names, (LabelNames{{1, "nucleus"}, {2, "membrane"}})) << version << level;
            EXPECT_EQ(reader->info().colours, (LabelColours{{1, 0xFF0000}})) << version << level;
        }
    }
}

TEST_F(ReadZarrTest, sizes_are_whole_numbers) {
    for (const char* number : {"5.5", "-5", "1e30", "\"5\"", "true"}) {
        const fs::path store = changed("zarr2/bad/missing_int16.zarr", ".zarray", "\"shape\"",
                                       "\"shape\": [" + std::string(number) + ", 4, 5], \"was\"");
        EXPECT_THAT(refusal({store}), HasSubstr("for a whole number; write the file again")) << number;
    }
}

TEST_F(ReadZarrTest, unknown_order_is_refused) {
    const fs::path store = changed("zarr2/bad/missing_int16.zarr", ".zarray", "\"order\": \"C\"", "\"order\": \"Q\"");
    EXPECT_THAT(refusal({store}), HasSubstr("the order 'Q' is neither C nor F"));
}

TEST_F(ReadZarrTest, axes_without_samples_are_refused) {
    const fs::path store = changed("ome/channels.zarr", "0/.zarray", "\"shape\"", "\"shape\": [0, 3, 4, 5], \"was\"");
    EXPECT_THAT(refusal({store}), HasSubstr("has 0 samples; give a volume that has some"));
}

TEST_F(ReadZarrTest, negative_scale_mirrors_the_axis) {
    const Lattice lattice = open_sections({data("chunked/ome/flipped.zarr")})->info().lattice;
    EXPECT_EQ(lattice.spacing, (Vec3{0.5, 2, 5}));
    EXPECT_EQ(lattice.direction, (std::array<double, 9>{1, 0, 0, 0, -1, 0, 0, 0, 1}));
}

TEST_F(ReadZarrTest, one_channel_is_chosen_and_times_beside_channels_are_refused) {
    ReadOptions second;
    second.layer = 1;
    EXPECT_THAT(refusal({data("chunked/ome/channels.zarr")}),
                HasSubstr("axis 'c' has 2 samples; choose one with --layer"));
    EXPECT_EQ(read_volume({data("chunked/ome/channels.zarr")}, second).labels,
              expected([](InputLabel v) { return v + 100; }));
    EXPECT_THAT(refusal({data("chunked/ome/times.zarr")}, second), HasSubstr("axis 'c'"));
}

TEST_F(ReadZarrTest, spacing_comes_from_attributes_in_common_use) {
    const Lattice lattice = open_sections({data("chunked/zarr2/spaced_uint8.zarr")})->info().lattice;
    EXPECT_EQ(lattice.spacing, (Vec3{0.5, 2, 5}));
    EXPECT_EQ(lattice.origin, (Vec3{10, 20, 30}));
    const std::string list = "\"resolution\": [\n        5,\n        2,\n        0.5\n    ]";
    for (const auto& [value, count] :
         {std::pair("5", 1), {"{\"x\": 0.5, \"y\": 2, \"z\": 5}", 0}, {"[5, 2]", 2}, {"[\"a\", 5, 2, 0.5]", 0}}) {
        const auto reader = open_sections(
            {changed("zarr2/spaced_uint8.zarr", ".zattrs", list, std::string("\"resolution\": ") + value)});
        EXPECT_EQ(reader->info().lattice.spacing, (Vec3{1, 1, 1})) << value;
        EXPECT_EQ(reader->info().lattice.origin, (Vec3{10, 20, 30})) << value;
        EXPECT_EQ(reader->info().warning,
                  "the attribute 'resolution' is not used: 3 numbers are needed, not " + std::to_string(count));
    }
}

TEST_F(ReadZarrTest, store_is_recognised_before_a_directory_of_images_whatever_its_name) {
    fs::copy(data("chunked/zarr2/type_uint16.zarr"), path("store"), fs::copy_options::recursive);
    fs::copy_file(data("png/gray8/s1.png"), path("store") / "preview.png");
    EXPECT_EQ(open_sections({path("store")})->info().format, "zarr");
}

TEST_F(ReadZarrTest, chunks_cut_short_or_too_long_are_named_with_their_section) {
    const std::string chunk = text_of(data("chunked/zarr2/bad/plain_uint16.zarr") / "1.0.0");
    const fs::path bad = changed("zarr2/bad/plain_uint16.zarr", "1.0.0", chunk, chunk.substr(1));
    EXPECT_THAT(refusal({bad}, swept(SweepChoice::kZ)),
                AllOf(HasSubstr("changed.zarr/1.0.0: section "), HasSubstr("fetch it again")));
    put_text(bad / "1.0.0", chunk + "x");
    EXPECT_THAT(refusal({bad}), HasSubstr("61 bytes where a chunk has 60"));
    put_text(bad / "1.0.0", std::string(2000000, 'x'));
    EXPECT_THAT(refusal({bad}), HasSubstr("too many for a chunk"));
    fs::remove(bad / "1.0.0");
    fs::create_directory(bad / "1.0.0");
    EXPECT_THAT(refusal({bad}), HasSubstr("is a directory"));
}

TEST_F(ReadZarrTest, check_sums_are_looked_at) {
    const std::string chunk = text_of(data("chunked/zarr3/sums_uint16.zarr/c/0/0/0"));
    std::string wrong = chunk;
    wrong.back() ^= 1;
    EXPECT_THAT(refusal({changed("zarr3/sums_uint16.zarr", "c/0/0/0", chunk, wrong)}), HasSubstr("check sum"));
    const std::string shard = text_of(data("chunked/zarr3/bad/shard_end_uint16.zarr/c/0/0/0"));
    wrong = shard;
    wrong.back() ^= 1;
    EXPECT_THAT(refusal({changed("zarr3/bad/shard_end_uint16.zarr", "c/0/0/0", shard, wrong)}),
                HasSubstr("index of the shard"));
}

TEST_F(ReadZarrTest, store_without_chunks_is_refused) {
    fs::create_directory(path("a.zarr"));
    fs::copy_file(data("chunked/zarr2/type_uint16.zarr/.zarray"), path("a.zarr") / ".zarray");
    EXPECT_THAT(refusal({path("a.zarr")}), HasSubstr("holds no chunk of samples"));
    fs::create_directories(path("a.zarr") / "0" / "0");
    put_text(path("a.zarr") / "0" / "0" / "0", "chunk");  // where the separator is a slash
    EXPECT_THAT(refusal({path("a.zarr")}), HasSubstr("holds no chunk of samples"));
}

TEST_F(ReadZarrTest, fill_value_must_be_of_the_type) {
    for (const char* value : {"65536", "-1"}) {
        const fs::path store =
            changed("zarr2/type_uint16.zarr", ".zarray", "\"fill_value\": 0", std::string("\"fill_value\": ") + value);
        EXPECT_THAT(refusal({store}),
                    HasSubstr(std::string("the fill value ") + value + " is no number of type uint16"));
    }
}

TEST_F(ReadZarrTest, sizes_that_no_chunk_backs_are_refused_before_anything_is_allocated) {
    const auto refuse = [&](const std::string& from, const std::string& to) {
        return refusal({changed("zarr2/bad/plain_uint16.zarr", ".zarray", from, to)});
    };
    const std::string chunks = "\"chunks\": [\n        2,", shape = "\"shape\": [\n        3,";
    EXPECT_THAT(refuse(chunks, "\"chunks\": [ 4000000000,"), HasSubstr("more than a GiB"));
    EXPECT_THAT(refuse(chunks, "\"chunks\": [ 18446744073709551615,"), HasSubstr("more than a GiB"));
    EXPECT_THAT(refuse(chunks, "\"chunks\": [ 0,"), HasSubstr("empty"));
    EXPECT_THAT(refuse(chunks, "\"chunks\": [ 20000000,"), HasSubstr("60 bytes cannot hold the 600000000 of a chunk"));
    EXPECT_THAT(refuse(shape, "\"shape\": [ 3000000000,"), HasSubstr("2^31"));
    EXPECT_THAT(refuse(shape, "\"shape\": [ 3, 3,"), HasSubstr("number of dimensions"));
    EXPECT_THAT(refuse("\"zarr_format\": 2", "\"zarr_format\": 1"), HasSubstr("Zarr version 1"));
    EXPECT_THAT(refuse("{", ""), HasSubstr(".zarray: the metadata are not as they should be"));
    EXPECT_THAT(refuse("{", std::string(1000, '[')), HasSubstr("nested deeper"));
}

TEST_F(ReadZarrTest, image_cannot_name_arrays_outside_its_folder) {
    const fs::path bad = changed("ome/image_04.zarr", ".zattrs", "\"path\": \"0\"", "\"path\": \"../image_04.zarr/0\"");
    EXPECT_THAT(refusal({bad}), HasSubstr("outside"));
}

TEST_F(ReadZarrTest, damaged_chunks_and_metadata_end_in_an_error_or_in_labels) {
    std::mt19937 random(1);
    for (const char* name : {"zarr2/packed_blosc_zstd_1_uint16.zarr", "zarr2/packed_zlib_uint16.zarr",
                             "zarr2/packed_lz4_uint16.zarr", "zarr3/bad/shard_end_uint16.zarr"}) {
        for (int round = 0; round < 100; ++round) {
            const fs::path store = path("bad.zarr");
            fs::remove_all(store);
            fs::copy(data("chunked/" + std::string(name)), store, fs::copy_options::recursive);
            Paths files;
            for (const auto& entry : fs::recursive_directory_iterator(store))
                if (entry.is_regular_file()) files.push_back(entry.path());
            std::string text = text_of(files[random() % files.size()]);
            for (int i = 0; i < 3; ++i) text[random() % text.size()] = static_cast<char>(random());
            put_text(files[random() % files.size()], text);
            EXPECT_THAT(refusal({store}), AnyOf(StartsWith(store.string()), "nothing thrown")) << name << " " << round;
        }
    }
}

}  // namespace
}  // namespace regionmesh
