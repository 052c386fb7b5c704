#include <cstring>

#include "formats/surface/meshes.h"

namespace regionmesh {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Pair;

class ReadMshMesh : public MeshTest {
protected:
    ReadMshMesh() : MeshTest(formats::open_msh, "mesh.msh") {}
};

const std::string kNodes2 = "$Nodes\n5\n10 0 0 0\n20 1 0 0\n5 0 1 0\n30 0 0 1\n7 0 0 -1\n$EndNodes\n";
const std::string kElements2 =
    "$Elements\n3\n1 2 2 4 1 10 20 5\n2 4 2 7 1 10 20 5 30\n4 4 2 9 2 10 5 20 7\n$EndElements\n";
const std::string kMesh2 = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n" + kNodes2 + kElements2;
const std::string kMesh4 = R"($MeshFormat
4.1 0 8
$EndMeshFormat
$PhysicalNames
2
2 7 "skin"
3 7 "grey matter"
$EndPhysicalNames
$Entities
1 0 0 2
1 0 0 0 0
1 0 0 0 1 1 1 2 7 8 0
2 0 0 -1 1 1 0 0 1 3
$EndEntities
$Nodes
2 5 1 5
2 3 1 3
1
2
3
0 0 0 0.5 0.5
1 0 0 0.5 0.5
0 1 0 0.5 0.5
3 1 0 2
4
5
0 0 1
0 0 -1
$EndNodes
$Elements
3 3 1 9
2 3 2 1
1 1 2 3
3 1 4 1
8 1 2 3 4
3 2 4 1
9 1 3 2 5
$EndElements
)";

/// Bytes of numbers, in either order.
struct Binary {
    bool is_big_endian;
    std::string text = {};

    template <class Number>
    Binary& add(std::initializer_list<Number> numbers) {
        for (const Number number : numbers) {
            char bytes[sizeof(Number)];
            std::memcpy(bytes, &number, sizeof(Number));
            if (is_big_endian) std::reverse(bytes, bytes + sizeof(Number));
            text.append(bytes, sizeof(Number));
        }
        return *this;
    }
    Binary& ints(std::initializer_list<std::int32_t> numbers) { return add(numbers); }
    Binary& sizes(std::initializer_list<std::uint64_t> numbers) { return add(numbers); }
    Binary& reals(std::initializer_list<double> numbers) { return add(numbers); }
    Binary& words(const std::string& words) {
        text += words;
        return *this;
    }
};

std::string binary_2(bool is_big_endian) {
    Binary b{is_big_endian};
    b.words("$MeshFormat\n2.2 1 8\n").ints({1}).words("\n$EndMeshFormat\n$Nodes\n5\n");
    b.ints({10}).reals({0, 0, 0}).ints({20}).reals({1, 0, 0}).ints({5}).reals({0, 1, 0});
    b.ints({30}).reals({0, 0, 1}).ints({7}).reals({0, 0, -1}).words("\n$EndNodes\n$Elements\n3\n");
    b.ints({2, 1, 2, 1, 4, 1, 10, 20, 5});
    b.ints({4, 2, 2, 2, 7, 1, 10, 20, 5, 30, 4, 9, 2, 10, 5, 20, 7}).words("\n$EndElements\n");
    return b.text;
}

std::string binary_4(bool is_big_endian) {
    Binary b{is_big_endian};
    b.words("$MeshFormat\n4.1 1 8\n").ints({1}).words("\n$EndMeshFormat\n$Entities\n").sizes({0, 0, 0, 2});
    b.ints({1}).reals({0, 0, 0, 1, 1, 1}).sizes({1}).ints({7}).sizes({0});
    b.ints({2}).reals({0, 0, 0, 1, 1, 1}).sizes({2}).ints({-9, 7}).sizes({1}).ints({3});
    b.words("\n$EndEntities\n$Nodes\n").sizes({1, 5, 5, 30}).ints({3, 1, 0}).sizes({5, 10, 20, 5, 30, 7});
    b.reals({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, -1}).words("\n$EndNodes\n$Elements\n").sizes({3, 3, 1, 4});
    b.ints({2, 3, 2}).sizes({1, 1, 10, 20, 5}).ints({3, 1, 4}).sizes({1, 2, 10, 20, 5, 30});
    b.ints({3, 2, 4}).sizes({1, 4, 10, 5, 20, 7}).words("\n$EndElements\n");
    return b.text;
}

TEST_F(ReadMshMesh, all_files_of_gmsh_hold_what_meshio_finds_in_them) {
    int seen = 0;
    for (const auto& entry : std::filesystem::directory_iterator(kMeshes)) {
        const std::string name = entry.path().stem().string();
        if (entry.path().extension() != ".msh" || !name.starts_with("gmsh")) continue;
        ++seen;
        const bool has_groups = !name.ends_with("_volumes");
        const auto reader = formats::open_msh(entry.path(), {});
        EXPECT_TRUE(reader->info().has_cell_labels) << name;
        EXPECT_EQ(mesh_text(*reader), text_of(kMeshes / (has_groups ? "gmsh_physical.txt" : "gmsh_geometrical.txt")))
            << name;
        LabelNames names;
        if (has_groups) names = {{7, "left"}, {9, "right"}};
        EXPECT_EQ(reader->info().names, names) << name;
    }
    EXPECT_EQ(seen, 8);
}

TEST_F(ReadMshMesh, text_and_binary_of_either_byte_order_hold_the_same) {
    const std::string expected = mesh_text(*open_text(kMesh2));
    EXPECT_EQ(expected, "0 0 0 1 0 0 0 1 0 0 0 1 7\n0 0 0 0 1 0 1 0 0 0 0 -1 9\n");
    for (const bool is_big_endian : {false, true}) {
        EXPECT_EQ(mesh_text(*open_text(binary_2(is_big_endian))), expected);
        EXPECT_EQ(mesh_text(*open_text(binary_4(is_big_endian))), expected);
    }
}

TEST_F(ReadMshMesh, nodes_and_elements_go_by_their_tags) {
    const auto reader = open_text(kMesh2, {.scale_z = 3});
    EXPECT_EQ(reader->name_of_point(2), "node 5");
    EXPECT_EQ(reader->name_of_tetrahedron(0), "element 2");
    EXPECT_EQ(reader->name_of_tetrahedron(1), "element 4");
    EXPECT_EQ(reader->take_points().positions[3], (Vec3{0, 0, 3}));
    EXPECT_EQ(reader->name_of_point(4), "node 7");
}

TEST_F(ReadMshMesh, the_label_is_the_first_physical_group_of_the_volume) {
    const auto reader = open_text(kMesh4);
    EXPECT_THAT(labels_of(*reader), ElementsAre(7, 0)) << "the second volume has no group";
    EXPECT_THAT(reader->info().names, ElementsAre(Pair(7, "grey matter")));
    EXPECT_EQ(open_text(kMesh4, {.array = "gmsh:geometrical"})->info().names.size(), 0u);
}

TEST_F(ReadMshMesh, without_groups_the_label_is_the_volume) {
    EXPECT_THAT(labels_of(*open_text(replaced(replaced(kMesh2, "2 7 1 10", "2 0 1 10"), "2 9 2 10", "2 0 2 10"))),
                ElementsAre(1, 2));
    EXPECT_THAT(labels_of(*open_text(replaced(kMesh4, "1 1 1 2 7 8 0", "1 1 1 0 0"))), ElementsAre(1, 2));
    EXPECT_THAT(labels_of(*open_text(kMesh2, {.array = "gmsh:geometrical"})), ElementsAre(1, 2));
}

TEST_F(ReadMshMesh, an_element_of_several_groups_is_taken_once) {
    const std::string twice =
        replaced(replaced(kMesh2, "\n3\n1 2", "\n4\n1 2"), "4 4 2 9", "3 4 2 8 1 10 20 5 30\n4 4 2 9");
    const auto reader = open_text(twice);
    EXPECT_THAT(labels_of(*reader), ElementsAre(7, 9));
    EXPECT_EQ(reader->name_of_tetrahedron(1), "element 4");
}

std::string view(const std::string& kind, const std::string& name, const std::string& records, int components = 1) {
    return fmt::format("${0}\n1\n\"{1}\"\n1\n0.0\n3\n0\n{2}\n{3}\n{4}$End{0}\n", kind, name, components,
                       std::count(records.begin(), records.end(), '\n'), records);
}

TEST_F(ReadMshMesh, a_view_has_the_labels_where_it_is_asked_for) {
    const std::string text = kMesh2 + view("ElementData", "tissue", "4 40\n2 20\n") +
                             view("NodeData", "lobe", "10 1\n20 2\n5 3\n30 -4\n7 5e0\n") +
                             view("NodeData", "u", "10 0 0 1\n", 3);
    EXPECT_THAT(labels_of(*open_text(text)), ElementsAre(7, 9));
    EXPECT_THAT(labels_of(*open_text(text, {.array = "tissue"})), ElementsAre(20, 40));
    const auto reader = open_text(text, {.array = "lobe"});
    EXPECT_FALSE(reader->info().has_cell_labels);
    EXPECT_THAT(labels_of(*reader), ElementsAre(1, 2, 3, -4, 5));
    EXPECT_EQ(failure(text, {.array = "brain"}),
              "has no array 'brain'; its arrays: gmsh:physical (cells, tags); gmsh:geometrical (cells, tags); tissue "
              "(cells, view); lobe (points, view); u (points, view, 3 components)");
    EXPECT_THAT(failure(text, {.array = "u"}), HasSubstr("has 3 components"));
    EXPECT_THAT(failure(replaced(text, "5 3\n", "5 3.5\n"), {.array = "lobe"}),
                HasSubstr("node 5 has 3.5 in 'lobe': labels are whole numbers below 2^53"));
    EXPECT_THAT(failure(replaced(text, "5 3\n", "50 3\n"), {.array = "lobe"}),
                HasSubstr("element 2 has node 5, which has no value in 'lobe'"));
    EXPECT_THAT(failure(replaced(text, "4 40\n", "3 40\n"), {.array = "tissue"}),
                HasSubstr("element 4 has no value in 'tissue'"));
}

TEST_F(ReadMshMesh, views_that_meshio_writes_are_read) {
    for (const char* name : {"views_22_ascii.msh", "views_41_binary.msh"}) {
        EXPECT_EQ(mesh_text(*formats::open_msh(kMeshes / name, {})), text_of(kMeshes / "meshio.txt")) << name;
        const auto reader = formats::open_msh(kMeshes / name, {.array = "tissue"});
        EXPECT_THAT(labels_of(*reader), ElementsAre(10, 11, 12, 10, 11, 12, 10, 11, 12, 10, 11, 12)) << name;
    }
}

TEST_F(ReadMshMesh, of_several_steps_of_a_view_the_first_counts) {
    const std::string text =
        kMesh2 + view("ElementData", "phase", "2 1\n4 2\n") + view("ElementData", "phase", "2 3\n4 4\n");
    EXPECT_THAT(labels_of(*open_text(text, {.array = "phase"})), ElementsAre(1, 2));
}

TEST_F(ReadMshMesh, a_view_named_as_regions_goes_before_volumes) {
    const std::string bare = replaced(replaced(kMesh2, "2 7 1 10", "2 0 1 10"), "2 9 2 10", "2 0 1 10");
    EXPECT_THAT(labels_of(*open_text(bare + view("ElementData", "stress", "2 1\n4 2\n") +
                                     view("ElementData", "Region", "2 11\n4 12\n"))),
                ElementsAre(11, 12));
}

TEST_F(ReadMshMesh, unknown_sections_are_passed_over) {
    const std::string comments = "$Comments\n$Nodes of mine\n$EndComments\n",
                      periodic = "$Periodic\n1\n2 3 4\n$EndPeriodic\n";
    EXPECT_EQ(mesh_text(*open_text(comments + replaced(kMesh2, "$Nodes", periodic + "$Nodes") + comments)),
              mesh_text(*open_text(kMesh2)));
}

TEST_F(ReadMshMesh, other_solids_are_refused_by_name) {
    EXPECT_EQ(
        failure(replaced(kMesh2, "4 4 2 9 2 10 5 20 7", "4 5 2 9 2 10 5 20 7 1 2 3 4")),
        "line 16: element 4 is a hexahedron: split the cells into tetrahedra; Gmsh meshes without recombining make "
        "them");
    EXPECT_THAT(
        failure(replaced(kMesh2, "4 4 2 9", "4 11 2 9")),
        HasSubstr("element 4 is a tetrahedron of 10 nodes: mesh the geometry again with elements of first order"));
    EXPECT_THAT(failure(replaced(kMesh2, "4 4 2 9", "4 99 2 9")), HasSubstr("element 4 is of type 99: "));
}

TEST_F(ReadMshMesh, other_versions_and_files_are_refused_with_a_remedy) {
    const std::string remedy = "write it as MSH 4.1: gmsh old.msh -save -format msh41 -o new.msh";
    EXPECT_EQ(failure(replaced(kMesh2, "2.2 0 8", "4 0 8")), "line 2: is MSH 4; " + remedy);
    EXPECT_EQ(failure("$NOD\n1\n1 0 0 0\n$ENDNOD\n"), "is MSH 1.0; " + remedy);
    EXPECT_EQ(failure("(0 \"GAMBIT\")\n"), "is no mesh of Gmsh, which begins with $MeshFormat");
    EXPECT_EQ(failure(""), "is no mesh of Gmsh, which begins with $MeshFormat");
    EXPECT_THAT(failure(replaced(kMesh4, "$Entities", "$PartitionedEntities")), HasSubstr("write it as MSH 2.2"));
}

TEST_F(ReadMshMesh, a_surface_mesh_is_told_from_a_mesh) {
    const std::string text = replaced(kMesh2, kElements2, "$Elements\n1\n1 2 2 4 1 10 20 5\n$EndElements\n");
    EXPECT_EQ(failure(text), "has no tetrahedra: a surface model? mesh its volumes with Gmsh, gmsh -3");
}

TEST_F(ReadMshMesh, bad_nodes_and_elements_are_named) {
    EXPECT_EQ(failure(replaced(kMesh2, "10 5 20 7", "10 5 20 8")), "element 4 names node 8, which $Nodes has not");
    EXPECT_EQ(failure(replaced(kMesh2, "10 5 20 7", "10 5 20 5")), "element 4 names a node twice; mend or drop it");
    EXPECT_EQ(failure(replaced(kMesh2, "7 0 0 -1", "5 0 0 -1")), "line 11: node 5 stands twice in $Nodes");
    EXPECT_EQ(failure(replaced(kMesh2, "7 0 0 -1", "7 0 0 nan")),
              "line 10: node 7 has a coordinate that is not finite");
    EXPECT_THAT(failure(replaced(kMesh2, "10 20 5 30", "10 20 -5 30")),
                HasSubstr("-5 stands where a count or number from 0 on is needed"));
}

TEST_F(ReadMshMesh, counts_that_lie_are_found) {
    EXPECT_THAT(failure(replaced(kMesh2, "$Nodes\n5", "$Nodes\n4")), HasSubstr("$EndNodes is needed here"));
    EXPECT_THAT(failure(replaced(kMesh2, "$Nodes\n5", "$Nodes\n999999999999")), HasSubstr("stands where a"));
    EXPECT_THAT(failure(replaced(kMesh2, "$Elements\n3", "$Elements\n2")), HasSubstr("$EndElements is needed here"));
    EXPECT_THAT(failure(replaced(kMesh4, "2 3 1 3\n1\n", "2 3 1 18446744073709551615\n1\n")), HasSubstr("line "));
    EXPECT_THAT(failure(kMesh2.substr(0, kMesh2.size() - 5)), HasSubstr("$Elements has no end"));
    EXPECT_THAT(failure(kMesh2 + kNodes2), HasSubstr("a second $Nodes"));
}

TEST_F(ReadMshMesh, a_section_may_end_anywhere_in_what_is_held_of_a_file) {
    const std::string expected = mesh_text(*open_text(kMesh2)), end = "$EndComments\n";
    for (std::size_t before = 0; before < end.size(); ++before) {
        const std::size_t held = 1 << 20;
        const std::string comments = "$Comments\n" + std::string(held - 10 - before, '-') + end;
        EXPECT_EQ(mesh_text(*open_text(comments + kMesh2)), expected) << before;
    }
}

TEST_F(ReadMshMesh, damaged_files_are_read_or_refused) {
    for (const char* name : {"gmsh_22_ascii.msh", "gmsh_22_binary.msh", "gmsh_41_ascii.msh", "gmsh_41_binary.msh"})
        damage(kMeshes / name, 61);
}

}  // namespace
}  // namespace regionmesh
