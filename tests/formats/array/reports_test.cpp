// Files with the properties of public bug reports (tests/data/reports, made by make_reports.py): each is read right.
#include <gmock/gmock.h>

#include "formats/array/read_volume.h"
#include "formats/temporary_folder.h"
#include "regionmesh/mesh_file.h"
#include "regionmesh/options.h"
#include "regionmesh/read_tetrahedra.h"

namespace regionmesh {
namespace {

using testing::HasSubstr;

std::filesystem::path report(const std::string& name) { return data("reports/" + name); }

/// What make_reports.py calls `a`: two boxes.
std::vector<InputLabel> boxes() {
    std::vector<InputLabel> labels;
    for (int z = 0; z < 6; ++z)
        for (int y = 0; y < 8; ++y)
            for (int x = 0; x < 10; ++x) {
                const bool is_inside = z >= 1 && z < 5 && y >= 2 && y < 6;
                labels.push_back(!is_inside ? 0 : x >= 1 && x < 5 ? 1 : x >= 5 && x < 9 ? 2 : 0);
            }
    return labels;
}

class Reports : public TemporaryFolder {};

TEST_F(Reports, whole_floats_are_labels) { EXPECT_EQ(read_volume({report("float_labels.nii")}).labels, boxes()); }

TEST_F(Reports, the_first_value_that_is_not_whole_is_named_with_its_place) {
    std::string text = text_of(report("float_labels.nii"));
    const float half = 0.5F;
    text.replace(352 + 4 * (3 + 10 * (2 + 8 * 4)), 4, reinterpret_cast<const char*>(&half), 4);
    put_text(path("half.nii"), text);
    EXPECT_THAT(refusal({path("half.nii")}),
                HasSubstr("half.nii: section 3: sample (3, 2, 4) is 0.5, and labels are whole numbers"));
}

TEST_F(Reports, voxels_of_ome_tiff_have_their_size_and_unit) {
    const Volume volume = read_volume({report("spacing.ome.tif")});
    EXPECT_EQ(volume.labels, boxes());
    EXPECT_EQ(volume.info.lattice.spacing, (Vec3{0.2, 0.2, 1}));
    EXPECT_EQ(volume.info.metres, 1e-6);
}

TEST_F(Reports, sform_and_qform_that_mirror_each_other_are_a_warning) {
    EXPECT_THAT(read_volume({report("qform_sform.nii")}).info.warning,
                HasSubstr("one is the mirror image of the other"));
    EXPECT_EQ(read_volume({report("float_labels.nii")}).info.warning, "");
}

TEST_F(Reports, spacing_that_is_not_known_is_a_warning) {
    const auto file = report("spacings_nan.nrrd");
    EXPECT_THAT(open_sections({file})->info().warning, HasSubstr("the spacing along z is not known"));
    EXPECT_EQ(open_sections({file}, spaced({1, 1, 2}))->info().warning, "");
}

TEST_F(Reports, surface_with_one_label_a_face_has_the_exterior_outside) {
    const MeshFile file = read_mesh(report("pyvista_external.vtp"));
    EXPECT_EQ(check(file.mesh).violation_count(), 0u);
    EXPECT_TRUE(file.labels.find(1) && file.labels.find(2));
}

TEST_F(Reports, surface_without_labels_is_one_region) {
    const MeshFile file = read_mesh(report("plain.vtp"));
    EXPECT_EQ(check(file.mesh).regions.size(), 1u);
    EXPECT_TRUE(file.labels.find(1));
}

TEST_F(Reports, the_only_view_of_elements_is_their_labels) {
    const auto reader = open_tetrahedra(report("tetgen_ref.msh"));
    reader->take_points();
    std::array<LabelledTetrahedron, 2> tetrahedra;
    ASSERT_EQ(reader->next(tetrahedra), 2u);
    EXPECT_EQ(tetrahedra[0].label, 1);
    EXPECT_EQ(tetrahedra[1].label, 2);
}

TEST_F(Reports, voxels_as_cells_are_a_volume_whole_or_cut) {
    for (const char* name : {"voxels.vtu", "voxels_as_tets.vtu"}) {
        SCOPED_TRACE(name);
        EXPECT_EQ(kind_of_input({report(name).string()}), kVolumeInput);
        const Volume volume = read_volume({report(name)});
        EXPECT_EQ(volume.info.lattice.size, (std::array<std::uint32_t, 3>{4, 4, 3}));
        EXPECT_EQ(volume.info.lattice.origin, (Vec3{0.5, 0.5, 0.5}));
        std::vector<InputLabel> wanted(48, 0);
        wanted[21] = wanted[26] = 1;
        EXPECT_EQ(volume.labels, wanted);
    }
}

TEST_F(Reports, ome_zarr_0_6_has_its_axes_in_systems_of_coordinates) {
    const Volume volume = read_volume({report("v06.zarr")});
    EXPECT_EQ(volume.labels, boxes());
    EXPECT_EQ(volume.info.lattice.spacing, (Vec3{2, 3, 4}));
    EXPECT_EQ(volume.info.metres, 1e-6);
}

TEST_F(Reports, pair_of_files_is_read_by_either_name_and_so_is_analyze) {
    const std::string whole = text_of(report("float_labels.nii"));
    std::string header = whole.substr(0, 348);
    header.replace(344, 4, std::string("ni1\0", 4));
    header.replace(108, 4, std::string(4, '\0'));
    put_text(path("a.hdr"), header);
    put_text(path("a.img"), whole.substr(352));
    for (const char* name : {"a.hdr", "a.img"}) {
        const Volume volume = read_volume({path(name)});
        EXPECT_EQ(volume.labels, boxes());
        EXPECT_EQ(volume.info.format, "nifti");
    }
    header.replace(344, 4, std::string(4, '\0'));
    put_text(path("a.hdr"), header);
    const Volume analyze = read_volume({path("a.hdr")});
    EXPECT_EQ(analyze.labels, boxes());
    EXPECT_EQ(analyze.info.format, "analyze");
    EXPECT_THAT(analyze.info.warning, HasSubstr("nor which side is left"));
    std::filesystem::remove(path("a.img"));
    EXPECT_THAT(refusal({path("a.hdr")}), HasSubstr("is half of a pair"));
}

TEST_F(Reports, folder_of_masks_and_a_list_of_them_are_one_volume_named_by_files) {
    const std::filesystem::path liver = report("masks/liver.nii.gz"), spleen = report("masks/spleen.nii.gz");
    const Volume folder = read_volume({report("masks")});
    EXPECT_EQ(folder.labels, boxes());
    EXPECT_EQ(folder.info.names, (LabelNames{{1, "liver"}, {2, "spleen"}}));
    EXPECT_EQ(folder.info.type, SampleType::kU8);
    EXPECT_TRUE(folder.info.overlaps->samples.empty());
    const Volume list = read_volume({spleen, liver});
    EXPECT_EQ(list.info.names, (LabelNames{{1, "spleen"}, {2, "liver"}}));
    std::vector<InputLabel> turned = boxes();
    for (InputLabel& label : turned) label = label == 0 ? 0 : 3 - label;
    EXPECT_EQ(list.labels, turned);
}

TEST_F(Reports, one_of_several_arrays_is_chosen_by_its_name) {
    const std::string file = report("two_arrays.vti").string();
    EXPECT_THAT(refusal({file}), HasSubstr("several arrays of integers; choose one with --array NAME"));
    EXPECT_EQ(read_volume({file + ":/phase"}).labels, std::vector<InputLabel>(512, 1));
    EXPECT_EQ(read_volume({file + ":/material"}).labels, read_volume({report("damask.vti")}).labels);
    EXPECT_THAT(refusal({file + ":/none"}), HasSubstr("has no array 'none' of single numbers; its arrays: material"));
    Settings settings;
    settings.tetrahedra.array = "phase";
    EXPECT_EQ(pull(*open_lattice(settings, {file})), std::vector<InputLabel>(512, 1));
    EXPECT_THROW(open_lattice(settings, {report("labels.npy").string()}), Error);
}

/// Two masks of 3 samples in a row that share the one in the middle.
class Overlapping : public TemporaryFolder {
protected:
    void SetUp() override {
        put_mask("a.nrrd", {1, 1, 0});
        put_mask("b.nrrd", {0, 7, 7});
    }
    void put_mask(const std::string& name, std::vector<char> samples) {
        std::string text = "NRRD0004\ntype: uint8\ndimension: 3\nsizes: 3 1 1\nencoding: raw\n\n";
        text.append(samples.begin(), samples.end());
        put_text(path(name), text);
    }
};

TEST_F(Overlapping, the_last_wins_unless_priority_says_otherwise_and_pairs_are_counted) {
    const std::vector<std::filesystem::path> files{path("a.nrrd"), path("b.nrrd")};
    const Volume volume = read_volume(files);
    EXPECT_EQ(volume.labels, (std::vector<InputLabel>{1, 2, 2}));
    EXPECT_EQ(volume.info.overlaps->samples, (decltype(Overlaps::samples){{{1, 2}, 1}}));
    for (const char* word : {"A", "1"}) {
        ReadOptions options;
        options.priority = {word};
        EXPECT_EQ(read_volume(files, options).labels, (std::vector<InputLabel>{1, 1, 2}));
    }
    ReadOptions options;
    options.priority = {"c"};
    EXPECT_THAT(refusal(files, options), HasSubstr("--priority c: no region is called so"));
    EXPECT_THAT(refusal({path("a.nrrd")}, options), HasSubstr("each of its samples has one label"));
}

TEST_F(Overlapping, masks_of_several_labels_or_another_lattice_are_refused) {
    put_mask("b.nrrd", {0, 7, 8});
    EXPECT_THAT(refusal({path("a.nrrd"), path("b.nrrd")}),
                HasSubstr("b.nrrd: section 2: has the labels 7 and 8, where a mask of one region has one"));
    put_text(path("b.nrrd"), "NRRD0004\ntype: uint8\ndimension: 3\nsizes: 2 1 1\nencoding: raw\n\nab");
    EXPECT_THAT(refusal({path("a.nrrd"), path("b.nrrd")}), HasSubstr("2 x 1 x 1 samples, and"));
    put_text(path("b.nrrd"),
             "NRRD0004\ntype: uint8\ndimension: 3\nsizes: 3 1 1\nspacings: 1 1 2\nencoding: raw\n\nabc");
    EXPECT_THAT(refusal({path("a.nrrd"), path("b.nrrd")}), HasSubstr("lies elsewhere in space"));
}

TEST_F(Reports, segments_in_layers_are_all_read_with_their_names) {
    const Volume volume = read_volume({report("layers.seg.nrrd")});
    EXPECT_EQ(volume.labels, boxes());
    EXPECT_EQ(volume.info.names, (LabelNames{{1, "tumour"}, {2, "edema"}}));
    ReadOptions second;
    second.layer = 1;
    EXPECT_EQ(read_volume({report("layers.seg.nrrd")}, second).info.names, (LabelNames{{1, "edema"}}));
}

TEST_F(Reports, cropped_masks_are_those_samples) {
    ReadOptions part;
    part.select.roi[0] = {.first = 4, .end = 6};
    for (const char* name : {"masks", "layers.seg.nrrd"}) {
        const Volume volume = read_volume({report(name)}, part);
        EXPECT_EQ(volume.labels, read_volume({report("labels.npy")}, part).labels);
    }
}

}  // namespace
}  // namespace regionmesh
