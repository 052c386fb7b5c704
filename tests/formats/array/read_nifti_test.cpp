#include <gmock/gmock.h>
#include <zlib.h>

#include <bit>
#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>

#include "formats/array/read_volume.h"
#include "formats/temporary_folder.h"

namespace regionmesh {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

bool is_gzipped(const std::filesystem::path& path) { return path.extension() == ".gz"; }

class ReadNiftiTest : public TemporaryFolder {
protected:
    // A good volume with `bytes` written over its header at `place`.
    std::filesystem::path patched(std::size_t place, const std::string& bytes) {
        std::string text = text_of(data("nifti/sform_uint8.nii"));
        text.replace(place, bytes.size(), bytes);
        put_text(path("patched.nii"), text);
        return path("patched.nii");
    }
    template <class Value>
    std::filesystem::path patched_value(std::size_t place, Value value) {
        const auto bytes = std::bit_cast<std::array<char, sizeof(Value)>>(value);
        return patched(place, std::string(bytes.begin(), bytes.end()));
    }
    std::filesystem::path gzipped(const std::string& name, const std::string& text) {
        const gzFile file = gzopen(path(name).c_str(), "wb");
        gzwrite(file, text.data(), static_cast<unsigned>(text.size()));
        gzclose(file);
        return path(name);
    }
};

TEST_F(ReadNiftiTest, nibabels_files_come_back_label_for_label) {
    for (const auto& file : files_in("nifti")) {
        const Volume volume = read_volume({file});
        EXPECT_EQ(volume.info.format, "nifti");
        EXPECT_EQ(volume.info.type, type_in_name(file)) << file;
        EXPECT_EQ(volume.info.lattice.size, (std::array<std::uint32_t, 3>{5, 4, 3})) << file;
        EXPECT_EQ(volume.labels, expected(type_in_name(file))) << file;
        EXPECT_EQ(volume.info.can_sweep[0], !is_gzipped(file));
        if (is_gzipped(file)) continue;
        for (const SweepChoice sweep : {SweepChoice::kX, SweepChoice::kY, SweepChoice::kZ}) {
            EXPECT_EQ(read_volume({file}, swept(sweep)).labels, volume.labels) << file;
        }
    }
}

TEST_F(ReadNiftiTest, the_unit_of_length_is_that_of_space_beside_that_of_time) {
    constexpr std::size_t kXyztUnits = 123;
    const auto metres = [&](int code) {
        return open_sections({patched(kXyztUnits, std::string(1, static_cast<char>(code)))})->info().metres;
    };
    EXPECT_EQ(metres(1 | 8), 1);
    EXPECT_EQ(metres(2 | 16), 1e-3);
    EXPECT_EQ(metres(3), 1e-6);
    for (const int code : {0, 8, 4, 7}) EXPECT_EQ(metres(code), std::nullopt) << code;
}

TEST_F(ReadNiftiTest, lattice_repeats_the_affine_that_nibabel_sees) {
    std::ifstream list(data("nifti/affines.txt"));
    int count = 0;
    for (std::string line; std::getline(list, line); ++count) {
        std::istringstream words(line);
        std::string name;
        words >> name;
        const auto reader = open_sections({data("nifti/" + name)});
        const Lattice& lattice = reader->info().lattice;
        for (int row = 0; row < 3; ++row) {
            double affine[4];
            for (double& number : affine) words >> number;
            for (int axis = 0; axis < 3; ++axis) {
                EXPECT_NEAR(lattice.direction[3 * row + axis] * lattice.spacing[axis], affine[axis], 1e-6) << name;
            }
            EXPECT_NEAR(lattice.origin[row], affine[3], 1e-6) << name;
        }
        for (int axis = 0; axis < 3; ++axis) {
            EXPECT_NEAR(length({lattice.direction[axis], lattice.direction[3 + axis], lattice.direction[6 + axis]}), 1,
                        1e-12);
        }
    }
    EXPECT_EQ(count, 10);
}

TEST_F(ReadNiftiTest, without_sform_and_qform_the_zooms_are_the_spacing) {
    const auto reader = open_sections({data("nifti/zooms_uint16.nii")});
    EXPECT_EQ(reader->info().lattice.spacing, (Vec3{0.5, 0.75, 2}));
    EXPECT_TRUE(reader->info().lattice.is_axis_aligned());
    EXPECT_EQ(reader->info().lattice.origin, (Vec3{0, 0, 0}));
}

TEST_F(ReadNiftiTest, zooms_that_are_no_lengths_are_refused_unless_the_spacing_is_given) {
    const std::string good = text_of(data("nifti/zooms_uint16.nii"));
    for (const float bad : {std::nanf(""), HUGE_VALF, 0.0f, -2.0f}) {
        std::string text = good;
        const auto bytes = std::bit_cast<std::array<char, 4>>(bad);
        text.replace(84, 4, std::string(bytes.begin(), bytes.end()));  // pixdim[2]
        put_text(path("zooms.nii"), text);
        EXPECT_THAT(refusal({path("zooms.nii")}), HasSubstr("pixdim[2] is"));
        EXPECT_EQ(open_sections({path("zooms.nii")}, {.spacing = Vec3{1, 2, 3}})->info().lattice.spacing,
                  (Vec3{1, 2, 3}));
    }
}

TEST_F(ReadNiftiTest, whole_reals_are_labels) {
    for (const char* name : {"nifti/bad/float32.nii", "nifti/bad/float64.nii.gz"})
        EXPECT_EQ(read_volume({data(name)}).labels, expected(SampleType::kU8)) << name;
}

TEST_F(ReadNiftiTest, samples_that_are_no_integers_are_refused_by_name) {
    EXPECT_THAT(refusal({data("nifti/bad/complex64.nii")}), HasSubstr("samples are complex"));
    EXPECT_THAT(refusal({patched_value<std::int16_t>(70, 128)}), HasSubstr("colours"));
    EXPECT_THAT(refusal({patched_value<std::int16_t>(70, 1)}), HasSubstr("single bits"));
    EXPECT_THAT(refusal({patched_value<std::int16_t>(70, 77)}), HasSubstr("datatype 77"));
}

TEST_F(ReadNiftiTest, one_of_several_volumes_is_chosen) {
    const auto file = data("nifti/bad/two_volumes.nii");
    EXPECT_THAT(refusal({file}), HasSubstr("holds 2 volumes (dim[4]); choose one with --layer 0 to 1"));
    ReadOptions second;
    second.layer = 1;
    EXPECT_EQ(read_volume({file}, second).labels.size(), 60u);
    second.layer = 2;
    EXPECT_THAT(refusal({file}, second), HasSubstr("there is no 2"));
}

TEST_F(ReadNiftiTest, scaled_samples_are_labels_where_they_are_whole) {
    EXPECT_EQ(read_volume({patched_value<float>(112, 2)}).labels, expected([](InputLabel v) { return 2 * v; }));
    EXPECT_THAT(refusal({patched_value<float>(112, 0.5)}),
                HasSubstr("section 0: sample (0, 1, 0) is 2.5, and labels are whole numbers"));
    const auto unit = patched_value<float>(112, 1);
    EXPECT_EQ(read_volume({unit}).labels, expected(SampleType::kU8));
    std::string text = text_of(unit);
    text.replace(116, 4, std::string("\x00\x00\x80\x3f", 4));  // scl_inter 1
    put_text(unit, text);
    EXPECT_EQ(read_volume({unit}).labels, expected([](InputLabel v) { return v + 1; }));
    EXPECT_EQ(read_volume({patched_value<float>(112, 0)}).labels, expected(SampleType::kU8));
}

TEST_F(ReadNiftiTest, headers_that_make_no_sense_are_refused) {
    EXPECT_THAT(refusal({patched_value<std::int32_t>(0, 347)}), HasSubstr("not a NIfTI file"));
    EXPECT_THAT(refusal({patched(344, "ni1")}), HasSubstr("pair"));
    EXPECT_THAT(refusal({patched(344, "abc")}), HasSubstr("not a NIfTI file"));
    EXPECT_THAT(refusal({patched_value<std::int16_t>(40, 9)}), HasSubstr("9 dimensions"));
    EXPECT_THAT(refusal({patched_value<std::int16_t>(40, 1)}), HasSubstr("1 dimensions"));
    EXPECT_THAT(refusal({patched_value<std::int16_t>(42, -3)}), HasSubstr("dim[1] is -3"));
    EXPECT_THAT(refusal({patched_value<std::int16_t>(44, 0)}), HasSubstr("empty volume: 5 x 0 x 3"));
    EXPECT_THAT(refusal({patched_value<float>(108, 12)}), HasSubstr("vox_offset"));
    EXPECT_THAT(refusal({patched_value<float>(108, 352.5)}), HasSubstr("vox_offset"));
    EXPECT_THAT(refusal({patched_value<float>(108, std::numeric_limits<float>::quiet_NaN())}), HasSubstr("vox_offset"));
    EXPECT_THAT(refusal({patched_value<float>(312 + 8, 0)}), HasSubstr("the sform is no affine map"));
    EXPECT_THAT(refusal({patched_value<float>(280, std::numeric_limits<float>::infinity())}),
                HasSubstr("the sform is no affine map"));
}

TEST_F(ReadNiftiTest, vox_offset_zero_is_352) {
    EXPECT_EQ(read_volume({patched_value<float>(108, 0)}).labels, expected(SampleType::kU8));
}

TEST_F(ReadNiftiTest, file_cut_anywhere_is_refused) {
    for (const char* name : {"sform_uint8.nii", "sform_uint8.nii.gz", "version2_int64.nii.gz"}) {
        const std::string whole = text_of(data(std::string("nifti/") + name));
        for (std::size_t length = 0; length < whole.size(); ++length) {
            put_text(path(name), whole.substr(0, length));
            EXPECT_THAT(refusal({path(name)}), StartsWith(path(name).string())) << length;
        }
    }
}

TEST_F(ReadNiftiTest, truncated_samples_are_named_by_their_section) {
    const std::string whole = text_of(data("nifti/sform_uint8.nii"));
    put_text(path("cut.nii"), whole.substr(0, whole.size() - 21));
    EXPECT_THAT(refusal({path("cut.nii")}),
                AllOf(HasSubstr("cut.nii: section 1: "), HasSubstr("39 bytes"), HasSubstr("60")));
    EXPECT_THAT(refusal({gzipped("short.nii.gz", whole.substr(0, whole.size() - 1))}),
                HasSubstr("section 2: the inflated data end here"));
    const std::string packed = text_of(data("nifti/sform_uint8.nii.gz"));
    put_text(path("cut.nii.gz"), packed.substr(0, packed.size() - 4));
    EXPECT_THAT(
        refusal({path("cut.nii.gz")}),
        HasSubstr("cut.nii.gz: section 2: the compressed stream ends early; the file is truncated, fetch it again"));
}

TEST_F(ReadNiftiTest, damaged_gzip_is_found_by_its_check_sum) {
    std::string packed = text_of(data("nifti/sform_uint8.nii.gz"));
    packed[packed.size() - 6] ^= 1;
    put_text(path("bad.nii.gz"), packed);
    EXPECT_THAT(refusal({path("bad.nii.gz")}),
                HasSubstr("section 2: the compressed stream is damaged (incorrect data check)"));
}

TEST_F(ReadNiftiTest, gzip_in_several_members_with_padding_is_one_stream) {
    const std::string whole = text_of(data("nifti/sform_uint8.nii"));
    const std::string first = text_of(gzipped("first", whole.substr(0, 380)));
    const std::string second = text_of(gzipped("second", whole.substr(380)));
    put_text(path("two.nii.gz"), first + second + std::string(100, '\0'));
    EXPECT_EQ(read_volume({path("two.nii.gz")}).labels, expected(SampleType::kU8));
}

TEST_F(ReadNiftiTest, gzip_is_known_by_its_bytes_not_its_name) {
    std::filesystem::copy_file(data("nifti/sform_uint8.nii"), path("plain.nii.gz"));
    std::filesystem::copy_file(data("nifti/sform_uint8.nii.gz"), path("packed.nii"));
    EXPECT_EQ(read_volume({path("plain.nii.gz")}).labels, expected(SampleType::kU8));
    EXPECT_EQ(read_volume({path("packed.nii")}).labels, expected(SampleType::kU8));
}

TEST_F(ReadNiftiTest, gzip_header_that_claims_more_than_can_inflate_is_refused_at_the_door) {
    std::string text = text_of(data("nifti/sform_uint8.nii"));
    text.replace(42, 6, "\xff\x7f\xff\x7f\xff\x7f");
    EXPECT_THAT(refusal({gzipped("bomb.nii.gz", text)}), HasSubstr("cannot hold the"));
}

TEST_F(ReadNiftiTest, gzip_is_swept_along_z_only) {
    EXPECT_THAT(refusal({data("nifti/sform_uint8.nii.gz")}, swept(SweepChoice::kX)),
                AllOf(HasSubstr("sform_uint8.nii.gz: cannot be read along x"), HasSubstr("--sweep z, or decompress")));
    EXPECT_EQ(open_sections({data("nifti/sform_uint8.nii.gz")})->info().sweep.axes, kSweepZ.axes);
}

TEST_F(ReadNiftiTest, gzip_can_rewind_in_the_middle) {
    const auto reader = open_sections({data("nifti/sform_uint8.nii.gz")});
    std::vector<InputLabel> section(20);
    EXPECT_TRUE(reader->next(section));
    EXPECT_TRUE(reader->next(section));
    reader->rewind();
    EXPECT_EQ(pull(*reader), expected(SampleType::kU8));
}

TEST_F(ReadNiftiTest, half_of_a_pair_is_refused) {
    put_text(path("a.hdr"), "x");
    EXPECT_THAT(refusal({path("a.hdr")}), HasSubstr("is half of a pair"));
}

/// Bytes behind the samples may be as many as there are: a file of 10 MB held 10.7 GB of zeros.
TEST_F(ReadNiftiTest, reading_a_compressed_file_ends_near_the_last_sample) {
    const std::string volume = text_of(data("nifti/sform_uint8.nii"));
    const auto cut_off = [&](std::size_t behind) {
        const std::filesystem::path file = gzipped("t.nii.gz", volume + std::string(behind, '\0'));
        std::filesystem::resize_file(file, std::filesystem::file_size(file) - 9);  // the checksum goes
        return file;
    };
    const auto read = [](const std::filesystem::path& file) {
        const auto reader = open_sections({file});
        std::vector<InputLabel> section(std::size_t{reader->section_width()} * reader->section_height());
        while (reader->next(section)) {
        }
        return reader->info().warning;
    };
    EXPECT_THAT(read(cut_off(std::size_t{3} << 20)), HasSubstr("the rest was not read, nor its checksum compared"));
    EXPECT_THROW(read(cut_off(1000)), Error) << "the checksum is near";
    EXPECT_THAT(read(gzipped("t.nii.gz", volume + std::string(1000, '\0'))), testing::Not(HasSubstr("checksum")));
}

}  // namespace
}  // namespace regionmesh
