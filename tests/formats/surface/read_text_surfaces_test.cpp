// STL, OBJ and PLY as people write them: small texts.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cctype>
#include <cmath>
#include <cstring>
#include <numbers>
#include <tuple>

#include "formats/surface/mesh_formats.h"
#include "formats/surface/surfaces.h"
#include "formats/temporary_folder.h"
#include "regionmesh/check.h"
#include "regionmesh/error.h"

namespace regionmesh {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using LabelPair = std::array<InputLabel, 2>;

/// A tetrahedron with its right angles at `at`, and one leg of `size` along x; outward.
std::vector<std::array<Vec3, 3>> tetrahedron(Vec3 at, double size) {
    const Vec3 a = at, b = at + Vec3{size, 0, 0}, c = at + Vec3{0, 1, 0}, d = at + Vec3{0, 0, 1};
    std::vector<std::array<Vec3, 3>> faces{{a, c, b}, {a, b, d}, {a, d, c}, {b, c, d}};
    if (size < 0)
        for (auto& face : faces) std::swap(face[1], face[2]);
    return faces;
}

std::string words(Vec3 p) { return fmt::format("{} {} {}", p.x, p.y, p.z); }

std::string solid(const std::string& name, const std::vector<std::array<Vec3, 3>>& faces) {
    std::string text = "solid " + name + "\n";
    for (const auto& face : faces) {
        text += " facet normal 0 0 0\n  outer loop\n";
        for (const Vec3& p : face) text += "   vertex " + words(p) + "\n";
        text += "  endloop\n endfacet\n";
    }
    return text + "endsolid " + name + "\n";
}

class TextSurfaces : public TemporaryFolder {
protected:
    MeshFile read(const std::string& name, const std::string& text, const ReadMeshOptions& options = {}) {
        put_text(path(name), text);
        return read_mesh(path(name), options);
    }
    std::string failure_of(const std::string& name, const std::string& text) {
        try {
            read(name, text);
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::kInput);
            EXPECT_THAT(error.what(), HasSubstr(name));
            EXPECT_THAT(error.what(), testing::Not(HasSubstr("\n")));
            return error.what();
        }
        return "nothing thrown";
    }
    void expect_no_crash(const std::string& name, const std::string& good) {
        for (std::size_t n = 0; n < good.size(); ++n) {
            for (const char change : {'\x01', '\x80', '\x10'}) {
                std::string bad = good;
                bad[n] = static_cast<char>(bad[n] ^ change);
                for (const std::string& text : {bad, good.substr(0, n)}) {
                    put_text(path(name), text);
                    try {
                        read_mesh(path(name), {.weld = 0.01, .orient = true});
                    } catch (const Error&) {
                    }
                }
            }
        }
    }
};

TEST_F(TextSurfaces, each_solid_is_a_region_and_common_faces_become_one) {
    // Mirror images of each other, on both sides of x = 0.
    const MeshFile file =
        read("m.stl", solid("liver", tetrahedron({}, 1)) + solid("region_7 spleen", tetrahedron({}, -1)));
    EXPECT_EQ(file.mesh.vertex_count(), 5u);
    EXPECT_EQ(file.mesh.face_count(), 7u);
    EXPECT_EQ(file.names, (LabelNames{{1, "liver"}, {7, "spleen"}}));
    EXPECT_NEAR(volume_of(file, 1), 1.0 / 6, 1e-9);
    EXPECT_NEAR(volume_of(file, 7), 1.0 / 6, 1e-9);
    const CheckReport report = check(file.mesh);
    EXPECT_EQ(report.violation_count(), 0u);
    EXPECT_EQ(report.region_pairs, 1u);
}

TEST_F(TextSurfaces, names_of_solids_are_no_comments_of_ours) {
    const MeshFile file =
        read("m.stl", solid("region 2 b", tetrahedron({}, 1)) + solid("background 1", tetrahedron({5, 0, 0}, 1)) +
                          solid("c SPACE=RAS", tetrahedron({9, 0, 0}, 1)));
    EXPECT_EQ(file.names, (LabelNames{{1, "region 2 b"}, {2, "background 1"}, {3, "c"}}));
    EXPECT_NEAR(volume_of(file, 1), 1.0 / 6, 1e-6);
    EXPECT_FALSE(file.background && !file.background->empty());
    EXPECT_EQ(file.coordinates.space, Space::kRas);
}

TEST_F(TextSurfaces, solids_of_one_name_are_two_regions_and_without_one_too) {
    const auto low = tetrahedron({}, 1), high = tetrahedron({5, 0, 0}, 1);
    EXPECT_EQ(read("m.stl", solid("part", low) + solid("part", high)).labels.size(), 2u);
    EXPECT_EQ(read("m.stl", solid("", low) + solid("", high)).labels.size(), 2u);
    EXPECT_EQ(read("m.stl", solid("3", low) + solid("region_3", high)).labels.size(), 1u);
}

TEST_F(TextSurfaces, binary_stl_may_begin_with_solid) {
    std::string text = "solid of some program" + std::string(59, ' ') + std::string(4, '\0');
    text[80] = 4;
    for (const auto& face : tetrahedron({1, 2, 3}, 1)) {
        text += std::string(12, '\0');
        for (Vec3 p : face)
            for (int axis = 0; axis < 3; ++axis) {
                const float value = static_cast<float>(p[axis]);
                text.append(reinterpret_cast<const char*>(&value), sizeof value);
            }
        text += std::string(2, '\0');
    }
    const MeshFile file = read("m.stl", text);
    EXPECT_EQ(file.mesh.vertex_count(), 4u);
    EXPECT_NEAR(volume_of(file, 1), 1.0 / 6, 1e-6);
    text[84 + 12 + 3] = '\x7f';
    text[84 + 12 + 2] = '\xff';
    EXPECT_THAT(failure_of("m.stl", text), HasSubstr("not finite"));
    EXPECT_THAT(failure_of("m.stl", text + "x"), HasSubstr("line"));
}

TEST_F(TextSurfaces, stl_errors_name_the_line) {
    const std::string good = solid("a", tetrahedron({}, 1));
    const auto changed = [&](const std::string& from, const std::string& to) {
        std::string text = good;
        return text.replace(text.find(from), from.size(), to);
    };
    EXPECT_THAT(failure_of("m.stl", changed("vertex 0", "vertex x")), HasSubstr("line 4: 'x' stands where"));
    EXPECT_THAT(failure_of("m.stl", changed("vertex 0", "vertex 1e999")), HasSubstr("'1e999'"));
    EXPECT_THAT(failure_of("m.stl", changed("   vertex 0", "   corner 0")), HasSubstr("'corner' is no word"));
    EXPECT_THAT(failure_of("m.stl", changed("endfacet", "endloop")), HasSubstr("more than three vertices"));
    EXPECT_THAT(failure_of("m.stl", good.substr(0, good.find("endfacet"))), HasSubstr("cut short"));
    EXPECT_THAT(failure_of("m.stl", good.substr(0, good.find("endsolid"))), HasSubstr("within a solid"));
    EXPECT_THAT(failure_of("m.stl", ""), HasSubstr("has no solid"));
}

TEST_F(TextSurfaces, obj_groups_are_interfaces_or_regions) {
    const std::string points =
        "# exterior_label -1\n# region 4 left half\nv 0 0 0\nv 1 0 0 0.5 0.5 0.5\nv 0 1 0\nv 0 0 1\nv -1 0 0\n";
    // The tetrahedra on both sides of x = 0; corners in all ways of writing them.
    const MeshFile pairs =
        read("m.obj", points +
                          "g interface_3_4\nf 1 4 3\n"
                          "g interface_3_-1\nf 1/1 3/2 2/3\nf 1//1 2//1 4//1\nf -4/1/1 -3/1/1 -2/1/1\n"
                          "g interface_4_-1\nf 1 5 3\nf 1 \\\n 4 5\nf 5 4 3\n");
    EXPECT_EQ(pairs.mesh.face_count(), 7u);
    EXPECT_NEAR(volume_of(pairs, 3), 1.0 / 6, 1e-12);
    EXPECT_NEAR(volume_of(pairs, 4), 1.0 / 6, 1e-12);
    EXPECT_EQ(pairs.names, (LabelNames{{4, "left half"}}));
    EXPECT_EQ(check(pairs.mesh).violation_count(), 0u);

    const std::string right = "f 1 4 3\nf 1 3 2\nf 1 2 4\nf 2 3 4\n", left = "f 1 3 4\nf 1 5 3\nf 1 4 5\nf 5 4 3\n";
    for (const char* word : {"g", "o", "usemtl"}) {
        const std::string w = word;
        const MeshFile regions = read("m.obj", points + w + " right\n" + right + w + " left\n" + left);
        EXPECT_EQ(faces_of(regions).size(), 7u) << "the face between was not joined";
        EXPECT_NEAR(volume_of(regions, 1), 1.0 / 6, 1e-12);
        EXPECT_NEAR(volume_of(regions, 2), 1.0 / 6, 1e-12);
        EXPECT_EQ(regions.names.at(1), "right");
    }
}

TEST_F(TextSurfaces, comments_of_other_programs_name_no_background) {
    const std::string rest = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\ng tooth\nf 1 4 3\nf 1 3 2\nf 1 2 4\nf 2 3 4\n";
    const MeshFile foreign = read("m.obj", "# background 1 green, exported by another program\n" + rest);
    EXPECT_FALSE(foreign.background && !foreign.background->empty());
    EXPECT_EQ(read("m.obj", "# background 1\n" + rest).background, std::vector<InputLabel>{1});
}

TEST_F(TextSurfaces, obj_errors_name_the_line) {
    EXPECT_THAT(failure_of("m.obj", ""), HasSubstr("is empty"));
    EXPECT_THAT(failure_of("m.obj", "v 0 0\n"), HasSubstr("line 1: '' stands where a coordinate belongs"));
    EXPECT_THAT(failure_of("m.obj", "v 0 0 0\nf 1 2 1\n"), HasSubstr("line 2: a face names point '2' of 1"));
    EXPECT_THAT(failure_of("m.obj", "v 0 0 0\nf 1 0 1\n"), HasSubstr("names point '0'"));
    EXPECT_THAT(failure_of("m.obj", "v 0 0 0\nf 1 1\n"), HasSubstr("fewer than three corners"));
    EXPECT_EQ(read("m.obj", "# nothing\n").mesh.face_count(), 0u);
}

TEST_F(TextSurfaces, files_of_other_kinds_are_no_obj) {
    EXPECT_THAT(failure_of("m.obj", "# a note\n\nhello, this is\nV 0 0 0\n"),
                HasSubstr("of another kind of file in line 3: 'hello,'"));
    EXPECT_THAT(failure_of("m.obj", solid("a", tetrahedron({}, 1))), HasSubstr("'solid'"));
    EXPECT_EQ(read("m.obj", "mtllib m.mtl\no a\nvn 0 0 1\ns off\n").mesh.face_count(), 0u);
    // Words of its own in a file with points.
    const std::string tetrahedron = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2 # below\nf 1 2 4\nf 2 3 4\nf 1 4 3\n";
    EXPECT_EQ(read("m.obj", "shadow_obj none\n" + tetrahedron).mesh.face_count(), 4u);
}

TEST_F(TextSurfaces, line_ends_and_marks_of_other_programs) {
    const std::string obj = "g region_5\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n";
    const MeshFile marked = read("m.obj", "\xEF\xBB\xBF" + obj);
    EXPECT_NEAR(volume_of(marked, 5), 1.0 / 6, 1e-12);
    const auto with_ends = [](std::string text, const std::string& end) {
        for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos; at += end.size())
            text.replace(at, 1, end);
        return text;
    };
    const std::string ply =
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
        "element face 1\nproperty list uchar int vertex_index\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
    const std::string stl = solid("a", tetrahedron({}, 1));
    for (const auto& [name, text, faces] :
         {std::tuple("m.obj", obj, 4u), std::tuple("m.ply", ply, 1u), std::tuple("m.stl", stl, 4u)}) {
        EXPECT_EQ(read(name, with_ends(text, "\r\n")).mesh.face_count(), faces);
        EXPECT_THAT(failure_of(name, with_ends(text, "\r")), HasSubstr("line 1: has carriage returns within"));
    }
    std::string capital = stl;
    for (char& c : capital) c = static_cast<char>(std::toupper(c));
    EXPECT_EQ(read("m.stl", capital).mesh.face_count(), 4u);
    EXPECT_EQ(read("m.ply", "ply \t" + ply.substr(3)).mesh.face_count(), 1u);
}

TEST_F(TextSurfaces, polygons_back_to_back_are_cut_alike_wherever_they_begin) {
    // Two prisms over the same polygon, on both sides of z = 0: corners 1 to n of each are those of the polygon.
    for (const std::uint32_t n : {4u, 5u, 70u}) {
        std::string points;
        for (const double z : {0, 1, -1})
            for (std::uint32_t k = 0; k < n; ++k) {
                const double angle = 2 * std::numbers::pi * k / n;
                points += n == 4 ? fmt::format("v {} {} {}\n", int(k == 1 || k == 2), int(k >= 2),
                                               z)  // both diagonals are equal
                                 : fmt::format("v {} {} {}\n", std::cos(angle), std::sin(angle), z);
            }
        const auto polygon = [&](std::uint32_t ring, std::uint32_t first, bool is_turned) {
            std::string line = "f";
            for (std::uint32_t k = 0; k < n; ++k)
                line += fmt::format(" {}", ring * n + (is_turned ? first + n - k : first + k) % n + 1);
            return line + "\n";
        };
        const auto walls = [&](std::uint32_t ring) {
            std::string lines;
            for (std::uint32_t k = 0; k < n; ++k) {
                const std::uint32_t next = (k + 1) % n, a = k + 1, b = next + 1, c = ring * n + b, d = ring * n + a;
                lines +=
                    ring == 1 ? fmt::format("f {} {} {} {}\n", a, b, c, d) : fmt::format("f {} {} {} {}\n", b, a, d, c);
            }
            return lines;
        };
        for (std::uint32_t first = 0; first < n; first += n < 10 ? 1 : 7) {
            for (std::uint32_t other = 0; other < n; other += n < 10 ? 1 : 23) {
                const MeshFile file =
                    read("m.obj", points + "g upper\n" + polygon(0, first, true) + polygon(1, 0, false) + walls(1) +
                                      "g lower\n" + polygon(0, other, false) + polygon(2, 0, true) + walls(2));
                EXPECT_EQ(file.mesh.face_count(), 3 * (n - 2) + 4 * n) << n << ' ' << first << ' ' << other;
                EXPECT_EQ(check(file.mesh).violation_count(), 0u) << n << ' ' << first << ' ' << other;
                EXPECT_NEAR(volume_of(file, 1), volume_of(file, 2), 1e-12);
                EXPECT_GT(volume_of(file, 1), 0.9);
            }
        }
    }
}

TEST_F(TextSurfaces, ply_labels_have_many_names) {
    const auto text = [](const std::string& properties, const std::string& values) {
        return "ply\r\nformat ascii 1.0\r\ncomment made by hand\r\nelement camera 1\r\nproperty list uchar int dots\r\n"
               "element vertex 4\r\nproperty float z\r\nproperty uchar red\r\nproperty float y\r\nproperty float x\r\n"
               "element face 1\r\n" +
               properties + "end_header\r\n3 7 8 9\r\n0 255 0 0\r\n0 255 0 1\r\n0 255 1 1\r\n0 255 2 0\r\n" + values +
               "\r\n";
    };
    const auto labels = [&](const std::string& properties, const std::string& values) {
        put_text(path("m.ply"), text(properties, values));
        return read_ply(path("m.ply"));
    };
    const std::string list = "property list uchar int vertex_index\r\n";
    const FileSurface two = labels("property int label0\r\n" + list + "property short label1\r\n", "7 4 0 1 2 3 -1");
    EXPECT_EQ(two.points[3], (Vec3{0, 2, 0}));
    EXPECT_THAT(two.labels, ElementsAre(LabelPair{7, -1}, LabelPair{7, -1}));
    EXPECT_THAT(two.faces, ElementsAre(std::array{0u, 2u, 3u}, std::array{0u, 1u, 2u}));
    EXPECT_THAT(labels(list + "property int label_1\r\nproperty int label_2\r\n", "3 0 1 2 5 6").labels,
                ElementsAre(LabelPair{5, 6}));
    EXPECT_THAT(labels(list + "property double region\r\n", "3 0 1 2 9").labels, ElementsAre(LabelPair{9, -1}));
    EXPECT_THAT(labels(list, "3 0 1 2").labels, ElementsAre(LabelPair{1, -1}));
    EXPECT_THAT(failure_of("m.ply", text(list + "property float label\r\n", "3 0 1 2 0.5")),
                HasSubstr("face 0 has a label that is no integer"));
    EXPECT_THAT(failure_of("m.ply", text(list + "property list uchar int label\r\n", "3 0 1 2 1 7")),
                HasSubstr("has lists in 'label'"));
    EXPECT_THAT(failure_of("m.ply", text(list, "3 0 1 4")), HasSubstr("face 0 names vertex 4 of 4"));
    EXPECT_THAT(failure_of("m.ply", text(list, "3 0 one 2")),
                HasSubstr("line 18: 'one' stands where a number belongs"));
    EXPECT_THAT(failure_of("m.ply", text("", "")), HasSubstr("list vertex_indices"));
    EXPECT_THAT(failure_of("m.ply", text(list, "3 0 1 2\r\n3 0 2 3")),
                HasSubstr("line 19: '3' stands behind all that the header promises"));
}

TEST_F(TextSurfaces, points_are_joined_within_a_distance_and_no_farther) {
    auto faces = tetrahedron({}, 1);
    double shift = 0;
    for (auto& face : faces)
        for (Vec3& p : face) p.x += shift += 1e-7;
    const std::string text = solid("a", faces);
    const auto corners = [&](std::optional<double> weld) {
        return read("m.stl", text, {.weld = weld}).mesh.vertex_count();
    };
    EXPECT_EQ(corners({}), 12u);
    EXPECT_EQ(corners(1e-7), 12u);
    EXPECT_EQ(corners(2e-5), 4u);
    EXPECT_EQ(corners(1e9), 0u) << "faces without corners of their own are dropped";
    for (const double bad : {-1.0, std::nan(""), HUGE_VAL}) EXPECT_THROW(corners(bad), Error) << bad;
    const MeshFile welded = read("m.stl", text, {.weld = 2e-5});
    EXPECT_EQ(check(welded.mesh).violation_count(), 0u);
    EXPECT_NEAR(welded.mesh.position(VertexId{0}).x, faces[0][0].x, 1e-9) << "the first point is kept";
}

TEST_F(TextSurfaces, faces_that_look_opposite_ways_are_turned_on_request) {
    // Both boxes inside out in places; what is outside has the only volume below 0.
    auto right = tetrahedron({}, 1), left = tetrahedron({}, -1);
    std::string text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv -1 0 0\n";
    text +=
        "g interface_3_4\nf 1 4 3\ng interface_3_-1\nf 1 2 3\nf 1 2 4\nf 2 3 4\ng interface_4_-1\nf 1 3 5\nf 1 4 5\nf "
        "5 3 4\n";
    put_text(path("m.obj"), text);
    EXPECT_GT(check(read_mesh(path("m.obj")).mesh).counts[static_cast<int>(ViolationKind::kOrientation)], 0u);
    const MeshFile turned = read_mesh(path("m.obj"), {.orient = true});
    EXPECT_EQ(check(turned.mesh).violation_count(), 0u);
    EXPECT_NEAR(volume_of(turned, 3), 1.0 / 6, 1e-12);
    EXPECT_NEAR(volume_of(turned, 4), 1.0 / 6, 1e-12);
    // A sheet of two regions: what is outside is the exterior.
    const std::string inside_out =
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\ng interface_3_-1\nf 1 2 3\nf 1 4 2\nf 1 3 4\nf 2 4 3\n";
    put_text(path("m.obj"), inside_out);
    EXPECT_LT(volume_of(read_mesh(path("m.obj")), 3), 0);
    EXPECT_GT(volume_of(read_mesh(path("m.obj"), {.orient = true}), 3), 0);
}

TEST_F(TextSurfaces, a_folder_is_a_region_for_each_file) {
    std::filesystem::create_directory(path("parts"));
    put_text(path("parts/left lung.stl"), solid("x", tetrahedron({}, -1)));
    put_text(path("parts/12.stl"), solid("y", tetrahedron({}, 1)));
    put_text(path("parts/notes.txt"), "nothing");
    const MeshFile file = read_mesh(path("parts"));
    EXPECT_EQ(file.mesh.face_count(), 7u);
    EXPECT_EQ(file.names, (LabelNames{{1, "left lung"}}));
    EXPECT_NEAR(volume_of(file, 12), 1.0 / 6, 1e-9);
    put_text(path("parts/pair.obj"), "v 0 0 0\nv 1 0 0\nv 0 1 0\ng interface_1_2\nf 1 2 3\n");
    EXPECT_EQ(read_mesh(path("parts")).labels.size(), 3u) << "a file in a folder is one region";
    std::filesystem::create_directory(path("empty"));
    EXPECT_THROW(read_mesh(path("empty")), Error);
}

TEST_F(TextSurfaces, files_of_a_folder_come_into_the_space_of_the_first_that_names_one) {
    const Vec3 at{2, 3, 5};
    std::filesystem::create_directory(path("parts"));
    put_text(path("parts/1.stl"), solid("a SPACE=LPS", tetrahedron(at, 1)));
    put_text(path("parts/2.stl"), solid("b SPACE=RAS", tetrahedron(at, 1)));
    const auto low_of = [&](Space space) {
        const MeshFile file = read_mesh(path("parts"), {.space = space});
        EXPECT_EQ(file.coordinates.space, space == Space::kUnknown ? Space::kLps : space);
        Box first, second;
        for (std::uint32_t f = 0; f < file.mesh.face_end(); ++f)
            for (const Vec3 p : file.mesh.corners(FaceId{f}))
                (file.labels.input(file.mesh[FaceId{f}].labels[0]) == 1 ? first : second).add(p);
        return std::array{first.low, second.low};
    };
    EXPECT_THAT(low_of(Space::kUnknown), ElementsAre(Vec3{2, 3, 5}, Vec3{-3, -4, 5}));
    EXPECT_THAT(low_of(Space::kRas), ElementsAre(Vec3{-3, -4, 5}, Vec3{2, 3, 5}));
}

TEST_F(TextSurfaces, damaged_texts_are_refused_or_read_but_never_crash) {
    expect_no_crash("m.stl", solid("a", {tetrahedron({}, 1)[0]}));
    expect_no_crash("m.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\ng a\nf 1/2/3 2 3\ng interface_1_2\nf -1 -2 -3\n");
    expect_no_crash("m.ply",
                    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
                    "element face 1\nproperty list uchar int vertex_index\nproperty int label\nend_header\n"
                    "0 0 0\n1 0 0\n0 1 0\n3 0 1 2 7\n");
}

}  // namespace
}  // namespace regionmesh
