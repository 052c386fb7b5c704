#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

#include "formats/array/read_volume.h"
#include "formats/temporary_folder.h"

namespace regionmesh {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

class ReadN5Test : public TemporaryFolder {
protected:
    /// A copy of a store whose first block is `block`.
    fs::path with_block(const std::string& store, const std::string& block) {
        const fs::path copy = path("changed.n5");
        fs::remove_all(copy);
        fs::copy(data("chunked/n5/" + store), copy, fs::copy_options::recursive);
        put_text(copy / "0/0/0", block);
        return copy;
    }
};

TEST_F(ReadN5Test, every_type_and_codec_comes_back_label_for_label) {
    int count = 0;
    for (const auto& entry : fs::directory_iterator(data("chunked/n5"))) {
        if (entry.path().filename() == "bad") continue;
        for (const SweepChoice sweep : {SweepChoice::kX, SweepChoice::kY, SweepChoice::kZ}) {
            const Volume volume = read_volume({entry.path()}, swept(sweep));
            EXPECT_EQ(volume.info.format, "n5");
            EXPECT_EQ(volume.info.type, type_in_name(entry.path()));
            EXPECT_EQ(volume.info.lattice.size, (std::array<std::uint32_t, 3>{5, 4, 3}));
            EXPECT_EQ(volume.labels, expected(type_in_name(entry.path()))) << entry.path();
        }
        ++count;
    }
    EXPECT_GE(count, 15);
}

TEST_F(ReadN5Test, group_opens_at_its_finest_resolution_and_another_may_be_named) {
    for (const char* place : {"", "/volume", "/volume/s0"}) {
        const Volume fine = read_volume({data("chunked/n5/bad/levels.n5" + std::string(place))});
        EXPECT_EQ(fine.labels, expected(SampleType::kU16));
        EXPECT_EQ(fine.info.lattice.spacing, (Vec3{0.5, 2, 5}));
        EXPECT_EQ(fine.info.lattice.origin, (Vec3{10, 20, 30}));
    }
    const Lattice coarse = open_sections({data("chunked/n5/bad/levels.n5/volume/s1")})->info().lattice;
    EXPECT_EQ(coarse.spacing, (Vec3{1, 4, 10}));
    EXPECT_EQ(coarse.origin, (Vec3{10.25, 21, 32.5})) << "the middle of the samples it was made from";
    const auto respaced = open_sections({data("chunked/n5/bad/levels.n5/volume/s1")}, spaced({2, 8, 20}));
    EXPECT_EQ(respaced->info().lattice.origin, (Vec3{10.5, 22, 35}));
}

TEST_F(ReadN5Test, numbers_of_a_group_are_found_however_the_path_is_written) {
    const fs::path group = data("chunked/n5/bad/levels.n5/volume");
    fs::create_directory_symlink(fs::absolute(group / "s1"), path("link"));
    for (const fs::path& written : {group / "s0" / ".." / "s1", group / "s1" / ".", path("link")})
        EXPECT_EQ(open_sections({written})->info().lattice.spacing, (Vec3{1, 4, 10})) << written;
}

TEST_F(ReadN5Test, transform_with_named_axes_goes_before_resolutions) {
    const VolumeInfo info = open_sections({data("chunked/n5/bad/cosem.n5")})->info();
    EXPECT_EQ(info.lattice.spacing, (Vec3{0.5, 2, 5}));
    EXPECT_EQ(info.lattice.origin, (Vec3{10, 20, 30}));
    EXPECT_EQ(info.metres, std::nullopt) << "the unit is that of the resolution, which is not used";
}

TEST_F(ReadN5Test, the_unit_of_length_is_that_of_the_numbers_that_are_used) {
    const fs::path store = path("units.n5");
    fs::copy(data("chunked/n5/bad/cosem.n5"), store, fs::copy_options::recursive);
    const auto metres = [&](const char* key, const nlohmann::json& value) {
        nlohmann::json attributes = nlohmann::json::parse(text_of(store / "attributes.json"));
        attributes.erase("transform");
        attributes[key] = value;
        put_text(store / "attributes.json", attributes.dump());
        return open_sections({store})->info().metres;
    };
    EXPECT_EQ(metres("other", 1), 1e-9) << "of pixelResolution";
    EXPECT_EQ(metres("pixelResolution", {4, 4, 40}), std::nullopt);
    EXPECT_EQ(metres("units", {"um", "um", "um"}), 1e-6);
    EXPECT_EQ(metres("units", {"um", "um", "mm"}), std::nullopt);
    EXPECT_EQ(metres("units", "um"), std::nullopt);
}

TEST_F(ReadN5Test, what_is_not_read_is_refused_by_name) {
    EXPECT_EQ(read_volume({data("chunked/n5/bad/float32.n5")}).labels, expected(SampleType::kU8));
    EXPECT_THAT(refusal({data("chunked/n5/bad/bzip2.n5")}), HasSubstr("made by 'bzip2', which is not read"));
}

TEST_F(ReadN5Test, blocks_that_are_not_there_are_0) {
    const fs::path store = with_block("raw_uint16.n5", "");
    fs::remove(store / "0/0/0");
    EXPECT_EQ(read_volume({store}).labels,
              expected([](InputLabel v) { return v < 40 && v % 20 < 15 && v % 5 < 4 ? 0 : v; }));
}

TEST_F(ReadN5Test, numbers_of_each_axis_are_those_of_the_axes_that_remain) {
    const fs::path store = path("channel.n5");
    fs::copy(data("chunked/n5/raw_uint16.n5"), store, fs::copy_options::recursive);
    nlohmann::json attributes = nlohmann::json::parse(text_of(store / "attributes.json"));
    const auto insert_one = [&](const char* name, int number) {
        attributes[name].insert(attributes[name].begin() + 2, number);
    };
    attributes["resolution"] = {0.5, 2, 3};
    attributes["offset"] = {1, 2, 3};
    for (const auto& [name, number] :
         {std::pair("dimensions", 1), std::pair("blockSize", 1), std::pair("resolution", 7), std::pair("offset", 9)})
        insert_one(name, number);
    put_text(store / "attributes.json", attributes.dump());
    for (const char* row : {"0/0", "0/1", "1/0", "1/1"}) {
        fs::remove_all(store / row);
        fs::create_directories(store / row / "0");
        for (const char* last : {"0", "1"}) {
            // Two bytes, the number of axes in two, and four for each size.
            const std::string block = text_of(data("chunked/n5/raw_uint16.n5/" + std::string(row) + '/' + last));
            put_text(store / row / "0" / last,
                     block.substr(0, 3) + '\4' + block.substr(4, 8) + std::string({0, 0, 0, 1}) + block.substr(12));
        }
    }
    EXPECT_EQ(read_volume({store}).labels, expected(SampleType::kU16));
    const Lattice lattice = open_sections({store})->info().lattice;
    EXPECT_EQ(lattice.size, (std::array<std::uint32_t, 3>{5, 4, 3}));
    EXPECT_EQ(lattice.spacing, (Vec3{0.5, 2, 3}));
    EXPECT_EQ(lattice.origin, (Vec3{1, 2, 3}));
}

TEST_F(ReadN5Test, damaged_heads_are_refused) {
    const std::string block = text_of(data("chunked/n5/raw_uint16.n5/0/0/0"));
    const auto with_byte = [&](std::size_t place, char byte) {
        std::string bad = block;
        bad[place] = byte;
        return refusal({with_block("raw_uint16.n5", bad)});
    };
    EXPECT_THAT(with_byte(1, 2), HasSubstr("0/0/0: section 0: its head is not one of a block of samples"));
    EXPECT_THAT(with_byte(3, 4), HasSubstr("not one of a block"));
    EXPECT_THAT(with_byte(7, 5), HasSubstr("another size"));
    EXPECT_THAT(with_byte(7, 0), HasSubstr("another size"));
    EXPECT_THAT(with_byte(7, 3), HasSubstr("bytes where a chunk has"));
    for (std::size_t length = 0; length < block.size(); ++length) {
        EXPECT_THAT(refusal({with_block("raw_uint16.n5", block.substr(0, length))}), HasSubstr("0/0/0: section 0: "))
            << length;
    }
}

}  // namespace
}  // namespace regionmesh
