#include "formats/array/soft_labels.h"

#include <gmock/gmock.h>

#include <cmath>
#include <cstring>

#include "formats/array/read_volume.h"
#include "formats/codec/sample_format.h"
#include "formats/temporary_folder.h"

namespace regionmesh {
namespace {

using testing::HasSubstr;

TEST(OrderedLabels, are_ordered_as_the_reals_and_nan_is_least) {
    const double values[]{-INFINITY, -2.5, -1e-300, 0, 1e-300, 0.5, 1, 1e9, INFINITY};
    for (std::size_t n = 1; n < std::size(values); ++n)
        EXPECT_LT(formats::ordered_label(values[n - 1]), formats::ordered_label(values[n]));
    EXPECT_EQ(formats::ordered_label(-0.0), formats::ordered_label(0.0));
    EXPECT_LT(formats::ordered_label(NAN), formats::ordered_label(-INFINITY));
    EXPECT_LT(formats::ordered_label(-NAN), formats::ordered_label(-INFINITY));
}

class SoftLabels : public TemporaryFolder {
protected:
    std::filesystem::path put_npy(const std::string& name, const std::string& shape, const std::string& type,
                                  const std::string& bytes) {
        std::string head = "{'descr': '" + type + "', 'fortran_order': False, 'shape': (" + shape + "), }";
        head.resize((head.size() + 11 + 63) / 64 * 64 - 11, ' ');
        head += '\n';
        put_text(path(name), "\x93NUMPY\x01" + std::string(1, '\0') + static_cast<char>(head.size()) +
                                 std::string(1, '\0') + head + bytes);
        return path(name);
    }
    static std::string floats(const std::vector<float>& values) {
        std::string bytes(values.size() * 4, '\0');
        std::memcpy(bytes.data(), values.data(), bytes.size());
        return bytes;
    }
    static ReadOptions at(std::vector<double> threshold, bool argmax = false) {
        ReadOptions options;
        options.threshold = std::move(threshold);
        options.argmax = argmax;
        return options;
    }
};

using LabelList = std::vector<InputLabel>;

TEST_F(SoftLabels, threshold_makes_labels_of_grey_values_and_of_shares) {
    const auto grey = put_npy("grey.npy", "1, 2, 3", "|u1", std::string("\x00\x63\x64\x65\xC8\xFF", 6));
    EXPECT_EQ(read_volume({grey}, at({100})).labels, (LabelList{0, 0, 1, 1, 1, 1}));
    EXPECT_EQ(read_volume({grey}, at({100, 200})).labels, (LabelList{0, 0, 1, 1, 2, 2}));
    const auto shares = put_npy("shares.npy", "1, 2, 3", "<f4", floats({0, 0.4999F, 0.5F, 1, NAN, -3}));
    const Volume volume = read_volume({shares}, at({0.5}));
    EXPECT_EQ(volume.labels, (LabelList{0, 0, 1, 1, 0, 0}));
    EXPECT_EQ(volume.info.type, SampleType::kU8);
    EXPECT_THAT(refusal({shares}), HasSubstr("give --threshold V"));
}

TEST_F(SoftLabels, threshold_applies_after_the_scale_of_the_file) {
    std::string nifti = text_of(data("reports/float_labels.nii"));
    const float slope = 0.5F;
    std::memcpy(nifti.data() + 112, &slope, 4);
    put_text(path("scaled.nii"), nifti);
    const LabelList labels = read_volume({path("scaled.nii")}, at({0.75})).labels;
    const LabelList whole = read_volume({data("reports/float_labels.nii")}).labels;
    for (std::size_t n = 0; n < whole.size(); ++n) EXPECT_EQ(labels[n], whole[n] == 2);
}

TEST_F(SoftLabels, argmax_takes_the_largest_of_the_volumes_of_a_file_first_or_last) {
    // Three volumes of two equal sections of 2 x 2 samples; the last sample is a tie.
    const std::vector<std::vector<float>> volumes{
        {0.6F, 0.1F, 0.2F, 0.4F}, {0.3F, 0.8F, 0.2F, 0.4F}, {0.1F, 0.1F, 0.6F, 0.2F}};
    std::string bytes, turned;
    for (const auto& volume : volumes) bytes += floats(volume) + floats(volume);
    const auto first = put_npy("first.npy", "3, 2, 2, 2", "<f4", bytes);
    EXPECT_EQ(read_volume({first}, at({}, true)).labels, (LabelList{0, 1, 2, 0, 0, 1, 2, 0}));
    EXPECT_EQ(read_volume({first}, at({0.7}, true)).labels, (LabelList{0, 1, 0, 0, 0, 1, 0, 0}));
    EXPECT_THAT(refusal({first}), HasSubstr("choose one with --layer 0 to 2"));
    // Two of them, behind x, in three sections of 3 x 3.
    for (int n = 0; n < 27; ++n) turned += floats({n == 5 ? 0.25F : 0.5F, n == 6 ? 0.75F : 0.4F});
    const auto last = put_npy("last.npy", "3, 3, 3, 2", "<f4", turned);
    LabelList wanted(27, 0);
    wanted[5] = wanted[6] = 1;
    EXPECT_EQ(read_volume({last}, at({}, true)).labels, wanted);
    const auto one = put_npy("one.npy", "1, 2, 2", "<f4", floats({0, 1, 0, 1}));
    EXPECT_THAT(refusal({one}, at({}, true)), HasSubstr("compares several volumes of shares, and this is one"));
    ReadOptions layer = at({}, true);
    layer.layer = 1;
    EXPECT_THAT(refusal({first}, layer), HasSubstr("leave out --layer"));
}

TEST_F(SoftLabels, argmax_of_files_counts_from_1_and_is_0_where_none_reaches_half) {
    const auto a = put_npy("liver.npy", "1, 2, 2", "<f4", floats({0.9F, 0.2F, 0.1F, 0.51F}));
    const auto b = put_npy("spleen.npy", "1, 2, 2", "<f4", floats({0.05F, 0.7F, 0.2F, 0.6F}));
    const Volume volume = read_volume({a, b}, at({}, true));
    EXPECT_EQ(volume.labels, (LabelList{1, 2, 0, 2}));
    EXPECT_EQ(volume.info.names, (LabelNames{{1, "liver"}, {2, "spleen"}}));
    EXPECT_EQ(read_volume({a, b}, at({0.15}, true)).labels, (LabelList{1, 2, 2, 2}));
    // Without argmax each file is a mask.
    EXPECT_EQ(read_volume({a, b}, at({0.5})).labels, (LabelList{1, 2, 0, 2}));
    EXPECT_EQ(read_volume({a, b}, at({0.5})).info.overlaps->total(), 1u);
}

}  // namespace
}  // namespace regionmesh
