#include "regionmesh/mesh_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <map>
#include <set>

#include "formats/surface/mesh_formats.h"
#include "formats/surface/surfaces.h"
#include "formats/temporary_folder.h"
#include "regionmesh/error.h"
#include "support/labels.h"
#include "support/paths.h"

namespace regionmesh {
namespace {

using testing::HasSubstr;

void add_face(Mesh& mesh, std::array<std::uint32_t, 3> v, Label first, Label second) {
    mesh.add_face(VertexId{v[0]}, VertexId{v[1]}, VertexId{v[2]}, first, second);
}

// A tetrahedron of `inside` within `outside`; its coordinates need all bits of a double.
Mesh tetrahedron(Label inside, Label outside) {
    Mesh mesh;
    for (const Vec3 p : {Vec3{0.1, 0, 0}, Vec3{1.0 / 3, 0, 1e-300}, Vec3{0, 1, -0.0}, Vec3{0, 0.7, 1e17}})
        mesh.add_vertex(p);
    for (const auto& v :
         {std::array{0u, 2u, 1u}, std::array{0u, 1u, 3u}, std::array{1u, 2u, 3u}, std::array{2u, 0u, 3u}})
        add_face(mesh, v, inside, outside);
    return mesh;
}

// The box 1 x 1 x 2: dense label 0 in its lower half, 1 in its upper, capped. The surface of tests/data/vtp_*.vtp.
Mesh two_boxes() {
    Mesh mesh;
    for (int i = 0; i < 12; ++i) {
        const int x = i & 1, y = i >> 1 & 1, z = i >> 2;
        const int sides = 1 << x | 1 << (2 + y) | (z == 0 ? 1 << 4 : z == 2 ? 1 << 5 : 0);
        mesh.add_vertex({1.0 * x, 1.0 * y, 1.0 * z}, static_cast<SideSet>(sides));
    }
    const auto quad = [&](std::array<std::uint32_t, 4> v, Label first, Label second) {
        add_face(mesh, {v[0], v[1], v[2]}, first, second);
        add_face(mesh, {v[0], v[2], v[3]}, first, second);
    };
    quad({0, 2, 3, 1}, 0, exterior(4));
    quad({4, 5, 7, 6}, 0, 1);
    quad({8, 9, 11, 10}, 1, exterior(5));
    for (std::uint32_t label = 0; label < 2; ++label) {
        const std::uint32_t low = 4 * label;
        quad({low, low + 1, low + 5, low + 4}, label, exterior(2));
        quad({low + 1, low + 3, low + 7, low + 5}, label, exterior(1));
        quad({low + 3, low + 2, low + 6, low + 7}, label, exterior(3));
        quad({low + 2, low, low + 4, low + 6}, label, exterior(0));
    }
    return mesh;
}

/// With the sides of the box told apart.
std::multiset<FaceWords> faces_of(const Mesh& mesh, const LabelTable& labels) {
    return faces_in_words(mesh, [&](Label label) {
        return is_exterior(label) ? "side " + std::to_string(side_of(label)) : std::to_string(labels.input(label));
    });
}

std::map<std::array<double, 3>, SideSet> sides_of(const Mesh& mesh) {
    std::map<std::array<double, 3>, SideSet> sides;
    for (std::uint32_t i = 0; i < mesh.vertex_end(); ++i)
        if (const Vec3 p = mesh.position(VertexId{i}); mesh.is_alive(VertexId{i}))
            sides[{p.x, p.y, p.z}] = mesh[VertexId{i}].sides;
    return sides;
}

void expect_same(const MeshFile& file, const Mesh& mesh, const LabelTable& labels) {
    EXPECT_EQ(file.mesh.vertex_count(), mesh.vertex_count());
    EXPECT_EQ(faces_of(file.mesh, file.labels), faces_of(mesh, labels));
    EXPECT_EQ(sides_of(file.mesh), sides_of(mesh));
}

class MeshFileTest : public TemporaryFolder {
protected:
    MeshFile round_trip(const Mesh& mesh, const LabelTable& labels, const std::string& extension,
                        const WriteOptions& options = {}) {
        write_mesh(mesh, labels, path("m" + extension), options);
        EXPECT_EQ(file_count(), 1) << "something is left beside the model";
        MeshFile file = read_mesh(path("m" + extension));
        std::filesystem::remove(path("m" + extension));
        return file;
    }
    // What the file holds, face by face.
    FileSurface surface_of(const Mesh& mesh, const LabelTable& labels, const std::string& extension,
                           const WriteOptions& options = {}) {
        write_mesh(mesh, labels, path("s" + extension), options);
        return extension == ".vtp" ? read_vtp(path("s" + extension)) : read_ply(path("s" + extension));
    }
    std::string failure_of(const std::filesystem::path& file) {
        try {
            read_mesh(file);
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::kInput);
            EXPECT_THAT(error.what(), HasSubstr(file.filename().string()));
            return error.what();
        }
        return "nothing thrown";
    }
    std::string failure_of_text(const std::string& name, const std::string& text) {
        put_text(path(name), text);
        return failure_of(path(name));
    }
};

class BothFormats : public MeshFileTest, public testing::WithParamInterface<const char*> {};
INSTANTIATE_TEST_SUITE_P(, BothFormats, testing::Values(".vtp", ".ply"),
                         [](const auto& tested) { return std::string(tested.param + 1); });

TEST_P(BothFormats, tetrahedron_comes_back_to_the_bit) {
    const LabelTable labels = test::labels_from({5, 7});
    const Mesh mesh = tetrahedron(0, 1);
    expect_same(round_trip(mesh, labels, GetParam()), mesh, labels);
}

TEST_P(BothFormats, capped_boxes_come_back_with_their_sides) {
    const LabelTable labels = test::labels_from({3, 5});
    expect_same(round_trip(two_boxes(), labels, GetParam()), two_boxes(), labels);
}

TEST_P(BothFormats, what_was_removed_is_not_written) {
    const LabelTable labels = test::labels_from({5, 7});
    Mesh mesh = tetrahedron(0, 1);
    const VertexId first{0};
    const VertexId copy = mesh.add_vertex(mesh.position(first));
    add_face(mesh, {1, 2, 3}, 0, 1);
    mesh.remove_face(FaceId{2});
    mesh.move_star(first, copy);
    const MeshFile file = round_trip(mesh, labels, GetParam());
    EXPECT_EQ(file.mesh.vertex_end(), 4u);
    EXPECT_EQ(file.mesh.face_end(), 4u);
    expect_same(file, mesh, labels);
}

TEST_P(BothFormats, smaller_label_comes_first_and_the_face_is_turned) {
    const LabelTable labels = test::labels_from({7, 5});
    expect_same(round_trip(tetrahedron(0, 1), labels, GetParam()), tetrahedron(0, 1), labels);
    const FileSurface surface = surface_of(tetrahedron(0, 1), labels, GetParam());
    EXPECT_THAT(surface.labels, testing::Each(std::array<InputLabel, 2>{5, 7}));
    EXPECT_EQ(surface.faces[0], (std::array{0u, 1u, 2u}));
}

TEST_P(BothFormats, unsigned_labels_are_ordered_as_such_and_keep_their_bits) {
    const InputLabel large = static_cast<InputLabel>(0xFFFFFFFFFFFFFFF0u);
    const LabelTable labels = test::labels_from({large, 3}, true);
    expect_same(round_trip(tetrahedron(0, 1), labels, GetParam()), tetrahedron(0, 1), labels);
    EXPECT_THAT(surface_of(tetrahedron(0, 1), labels, GetParam()).labels,
                testing::Each(std::array<InputLabel, 2>{3, large}));
}

TEST_F(MeshFileTest, large_labels_come_back_unsigned) {
    const InputLabel large = std::numeric_limits<InputLabel>::min();  // the bits of 2^63
    const LabelTable labels = test::labels_from({large, 3}, true);
    for (const char* extension : {".vtp", ".vtu", ".ply"}) {
        const MeshFile file =
            round_trip(two_boxes(), labels, extension,
                       {.background = {0}, .names = {{large, "rest"}}, .colours = {{large, 0xFF8000}}});
        expect_same(file, two_boxes(), labels);
        EXPECT_EQ(file.labels.text(large), "9223372036854775808");
        EXPECT_EQ(file.background, (std::vector<InputLabel>{large}));
        EXPECT_EQ(file.names, (LabelNames{{large, "rest"}}));
        EXPECT_EQ(file.colours, (LabelColours{{large, 0xFF8000}}));
        const LabelTable small = test::labels_from({7, 3}, true);
        EXPECT_FALSE(round_trip(two_boxes(), small, extension).labels.is_unsigned()) << extension;
    }
    for (const char* name : {"large.obj", "large.stl"}) {
        write_mesh(two_boxes(), labels, path(name));
        EXPECT_EQ(read_mesh(path(name)).labels.text(large), "9223372036854775808") << name;
    }
}

TEST_F(MeshFileTest, names_that_end_in_a_backslash_come_back) {
    const LabelNames names{{3, "left\\"}, {5, "right"}};
    for (const char* name : {"names.vtp", "names.ply", "names.obj"}) {
        write_mesh(two_boxes(), test::labels_from({3, 5}), path(name), {.names = names});
        EXPECT_EQ(read_mesh(path(name)).names, names) << name;
    }
}

TEST_P(BothFormats, background_comes_second_even_where_it_is_smaller) {
    const LabelTable labels = test::labels_from({0, 5});
    const FileSurface surface = surface_of(tetrahedron(1, 0), labels, GetParam(), {.background = {0}});
    EXPECT_THAT(surface.labels, testing::Each(std::array<InputLabel, 2>{5, 0}));
    EXPECT_EQ(surface.faces[0], (std::array{0u, 2u, 1u}));
}

TEST_P(BothFormats, exterior_comes_behind_all_others) {
    for (const WriteOptions& options : {WriteOptions{}, WriteOptions{.background = {0, 1}}}) {
        const FileSurface surface = surface_of(two_boxes(), test::labels_from({3, 5}), GetParam(), options);
        EXPECT_THAT(surface.labels,
                    testing::Each(testing::AnyOf(std::array<InputLabel, 2>{3, -1}, std::array<InputLabel, 2>{5, -1},
                                                 std::array<InputLabel, 2>{3, 5})));
        EXPECT_EQ(surface.exterior_label, -1);
    }
}

TEST_P(BothFormats, labels_of_64_bits_come_back) {
    constexpr InputLabel kLowest = std::numeric_limits<InputLabel>::min(),
                         kHighest = std::numeric_limits<InputLabel>::max();
    for (const LabelTable& labels : {test::labels_from({kLowest, kHighest}),
                                     test::labels_from({-1, std::int64_t{1} << 40}), test::labels_from({kLowest, -1})})
        expect_same(round_trip(two_boxes(), labels, GetParam()), two_boxes(), labels);
}

TEST_P(BothFormats, exterior_gives_way_to_negative_labels) {
    const LabelTable labels = test::labels_from({-4, -1});
    expect_same(round_trip(two_boxes(), labels, GetParam()), two_boxes(), labels);
    EXPECT_EQ(surface_of(two_boxes(), labels, GetParam()).exterior_label, -5);
}

TEST_P(BothFormats, exterior_beside_the_planes_of_the_box_is_one_hull) {
    Mesh mesh = two_boxes();
    mesh[VertexId{0}].position.x = -1;
    const LabelTable labels = test::labels_from({3, 5});
    const MeshFile file = round_trip(mesh, labels, GetParam());
    EXPECT_EQ(file.labels.size(), 2u);
    for (std::uint32_t v = 0; v < file.mesh.vertex_end(); ++v) EXPECT_EQ(file.mesh[VertexId{v}].sides, kOnHull);
    for (std::uint32_t f = 0; f < file.mesh.face_end(); ++f)
        for (const Label label : file.mesh[FaceId{f}].labels)
            EXPECT_TRUE(!is_exterior(label) || label == exterior(kHull));
}

TEST_P(BothFormats, empty_model_comes_back) {
    const MeshFile file = round_trip({}, LabelTable(), GetParam());
    EXPECT_EQ(file.mesh.vertex_count(), 0u);
    EXPECT_EQ(file.mesh.face_count(), 0u);
}

TEST_P(BothFormats, arrays_of_several_blocks_come_back) {
    Mesh mesh;
    constexpr std::uint32_t kCount = 100'000;
    mesh.add_vertex({0, 0, 0});
    for (std::uint32_t i = 1; i <= kCount; ++i) mesh.add_vertex({0.001 * i, 1.0 / i, 0.5 * (i % 7)});
    for (std::uint32_t i = 1; i < kCount; ++i) add_face(mesh, {0, i, i + 1}, i % 10, 10 + i % 3);
    const LabelTable labels = test::labels_from({0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12});
    expect_same(round_trip(mesh, labels, GetParam()), mesh, labels);
}

TEST_P(BothFormats, full_disk_is_an_output_error_and_leaves_nothing) {
    const auto link = path(std::string("m") + GetParam());
    std::filesystem::create_symlink("/dev/full", link);
    try {
        write_mesh(two_boxes(), test::labels_from({3, 5}), link);
        ADD_FAILURE() << "nothing thrown";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::kOutput);
        EXPECT_THAT(error.what(), HasSubstr("No space left on device"));
    }
    EXPECT_EQ(file_count(), 1);
    EXPECT_THROW(write_mesh(two_boxes(), test::labels_from({3, 5}), path("none") / link.filename()), Error);
}

TEST_P(BothFormats, damaged_files_are_refused_or_read_but_never_crash) {
    const std::string name = std::string("m") + GetParam();
    write_mesh(two_boxes(), test::labels_from({3, 5}), path(name));
    const std::string good = text_of(path(name));
    const auto try_text = [&](const std::string& text) {
        put_text(path(name), text);
        try {
            read_mesh(path(name));
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::kInput);
        }
    };
    for (std::size_t i = 0; i < good.size(); ++i) {
        try_text(good.substr(0, i));
        for (const char change : {'\x01', '\x80', '\x06'}) {
            std::string bad = good;
            bad[i] = static_cast<char>(bad[i] ^ change);
            try_text(bad);
        }
    }
}

TEST_F(MeshFileTest, extension_is_matched_in_any_case_and_others_are_refused) {
    const LabelTable labels = test::labels_from({3, 5});
    expect_same(round_trip(two_boxes(), labels, ".VTP"), two_boxes(), labels);
    try {
        write_mesh(two_boxes(), labels, path("m.xyz"));
        ADD_FAILURE() << "nothing thrown";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::kOutput);
        EXPECT_THAT(error.what(), HasSubstr("'.xyz': use one of .vtp"));
    }
    EXPECT_THAT(failure_of(path("m.xyz")), HasSubstr("has the extension '.xyz': use one of .vtp .vtu .ply"));
    EXPECT_EQ(file_count(), 0);
}

TEST_F(MeshFileTest, point_arrays_stand_in_vtp_files_and_nowhere_else) {
    Mesh mesh = two_boxes();
    mesh.add_vertex({9, 9, 9});
    mesh.remove_vertex(VertexId{12});
    std::vector<double> values(13);
    for (int n = 0; n < 13; ++n) values[n] = n / 3.0;
    const WriteOptions options{.point_arrays = {{"Distance", values}}};
    write_mesh(mesh, test::labels_from({1, 2}), path("m.vtp"), options);
    EXPECT_THAT(text_of(path("m.vtp")), HasSubstr("Name=\"Distance\""));
    const MeshFile file = read_mesh(path("m.vtp"));
    EXPECT_EQ(faces_of(file.mesh, file.labels), faces_of(mesh, test::labels_from({1, 2})));
    EXPECT_THROW(write_mesh(mesh, test::labels_from({1, 2}), path("m.ply"), options), Error);
    EXPECT_THROW(require_writable_mesh(path("m.ply"), {}, true), Error);
    const std::span<const double> few = std::span(values).first(12);
    EXPECT_THROW(write_mesh(mesh, test::labels_from({1, 2}), path("m.vtp"), {.point_arrays = {{"Distance", few}}}),
                 Error);
    EXPECT_THROW(write_mesh(mesh, test::labels_from({1, 2}), path("m.vtp"), {.point_arrays = {{"a b<", values}}}),
                 Error);
    EXPECT_EQ(file_count(), 1);
}

TEST_F(MeshFileTest, what_no_reader_would_take_is_not_written) {
    LabelTable labels;
    labels.dense(5);
    const auto refusal = [&](const Mesh& mesh, const WriteOptions& options = {}) {
        try {
            write_mesh(mesh, labels, path("m.vtp"), options);
        } catch (const Error& error) {
            return std::string(error.what());
        }
        return std::string("not refused");
    };
    EXPECT_THAT(refusal(tetrahedron(0, 7)), HasSubstr("m.vtp: face 0 has the dense label 7 of a table of 1"));
    labels.dense(6);
    Mesh mesh = tetrahedron(0, 1);
    const std::vector<double> values(4);
    EXPECT_THAT(refusal(mesh, {.point_arrays = {{"NodeType", values}}}), HasSubstr("'NodeType' already"));
    EXPECT_THAT(refusal(mesh, {.point_arrays = {{"X", values}, {"X", values}}}), HasSubstr("'X' already"));
    mesh[VertexId{2}].position.y = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THAT(refusal(mesh), HasSubstr("m.vtp: vertex 2 lies at 0, nan, -0; give finite coordinates"));
    EXPECT_TRUE(std::filesystem::is_empty(path("")));
}

TEST_F(MeshFileTest, missing_files_and_folders_are_input_errors) {
    for (const char* name : {"m.vtp", "m.vtu", "m.ply", "m.stl", "m.obj", "m.dream3d"}) {
        failure_of(path(name));
        std::filesystem::create_directory(path(name));
        failure_of(path(name));
    }
    EXPECT_THAT(failure_of(path("m.vtp")), HasSubstr("is a directory"));
    EXPECT_THAT(failure_of(path("m.ply")), HasSubstr("is a directory"));
    EXPECT_THAT(failure_of(path("none.ply")), HasSubstr("no such file"));
}

TEST_F(MeshFileTest, every_encoding_of_the_vtk_writer_is_read) {
    const LabelTable labels = test::labels_from({3, 5});
    int count = 0;
    for (const auto& entry : std::filesystem::directory_iterator(test::data_folder())) {
        if (!entry.path().filename().string().starts_with("vtp_")) continue;
        SCOPED_TRACE(entry.path());
        expect_same(read_mesh(entry.path()), two_boxes(), labels);
        ++count;
    }
    EXPECT_EQ(count, 14);
}

TEST_F(MeshFileTest, ply_errors_name_what_is_wrong) {
    write_mesh(tetrahedron(0, 1), test::labels_from({5, 7}), path("m.ply"));
    const std::string good = text_of(path("m.ply"));
    const auto changed = [&](const std::string& from, const std::string& to) {
        std::string text = good;
        return text.replace(text.find(from), from.size(), to);
    };
    const std::size_t face = good.find("end_header\n") + 11 + 4 * 25;
    std::string line = good, far = good;
    line[face] = 2;
    far[face + 1] = 9;
    EXPECT_THAT(failure_of_text("m.ply", changed("property double x", "property real x")),
                HasSubstr("'real' is no type"));
    EXPECT_THAT(failure_of_text("m.ply", changed("property double x", "property double u")),
                HasSubstr("vertices without x, y and z"));
    for (const char* count : {"vertex 18446744073709551615", "vertex 4000000000", "vertex 17"})
        EXPECT_THAT(failure_of_text("m.ply", changed("vertex 4", count)), HasSubstr("which promises"));
    EXPECT_THAT(failure_of_text("m.ply", changed("vertex 4", "vertex four")),
                HasSubstr("line 5: bad number of elements 'four'"));
    EXPECT_THAT(failure_of_text("m.ply", good.substr(0, good.size() - 1)), HasSubstr("cut short"));
    EXPECT_THAT(failure_of_text("m.ply", good + "x"), HasSubstr("1 bytes more"));
    EXPECT_THAT(failure_of_text("m.ply", "solid"), HasSubstr("no PLY file"));
    EXPECT_THAT(failure_of_text("m.ply", line), HasSubstr("face 0 has 2 corners"));
    EXPECT_THAT(failure_of_text("m.ply", far), HasSubstr("face 0 names vertex 9 of 4"));
}

TEST(FileView, node_type_counts_labels_and_sides) {
    Mesh mesh = two_boxes();
    const LabelTable labels = test::labels_from({3, 5});
    const FileView view(mesh, labels, {});
    EXPECT_EQ(view.node_type(VertexId{0}), 14);  // a corner of the box
    EXPECT_EQ(view.node_type(VertexId{4}), 14);  // two regions on an edge of the box

    // One vertex, its faces and its sides.
    const auto type_of = [&](std::initializer_list<std::array<Label, 2>> pairs, SideSet sides) {
        Mesh star;
        for (int i = 0; i < 3; ++i) star.add_vertex({1.0 * i, 0, 0}, i == 0 ? sides : SideSet{0});
        for (const auto& [first, second] : pairs) add_face(star, {0, 1, 2}, first, second);
        return FileView(star, labels, {}).node_type(VertexId{0});
    };
    EXPECT_EQ(type_of({{0, 1}}, 0), 2);
    EXPECT_EQ(type_of({{0, 1}, {1, 2}}, 0), 3);
    EXPECT_EQ(type_of({{0, 1}, {2, 3}}, 0), 4);
    EXPECT_EQ(type_of({{0, 1}, {2, 3}, {4, 5}}, 0), 4);
    EXPECT_EQ(type_of({{0, exterior(4)}}, 1 << 4), 12);
    EXPECT_EQ(type_of({{0, exterior(4)}, {0, exterior(0)}}, 1 << 4 | 1), 13);
    EXPECT_EQ(type_of({{0, exterior(4)}, {1, exterior(4)}}, 1 << 4), 13);
    EXPECT_EQ(type_of({{0, exterior(4)}, {1, exterior(4)}, {2, exterior(4)}}, 1 << 4), 14);
}

}  // namespace
}  // namespace regionmesh
