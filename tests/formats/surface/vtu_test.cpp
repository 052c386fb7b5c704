#include "formats/surface/meshes.h"

namespace regionmesh {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class ReadVtuMesh : public MeshTest {
protected:
    ReadVtuMesh() : MeshTest(formats::open_vtu, "mesh.vtu") {}
};

std::string array(const std::string& attributes, const std::string& text) {
    return "<DataArray " + attributes + " format=\"ascii\">" + text + "</DataArray>\n";
}

/// Two tetrahedra on one face, in a piece.
std::string piece(const std::string& labels = array("type=\"Int32\" Name=\"region\"", "3 5")) {
    return "<Piece NumberOfPoints=\"5\" NumberOfCells=\"2\"><Points>" +
           array("type=\"Float32\" NumberOfComponents=\"3\"", "0 0 0  1 0 0  0 1 0  0 0 1  0 0 -1") +
           "</Points><Cells>" + array("type=\"Int32\" Name=\"connectivity\"", "0 1 2 3  0 2 1 4") +
           array("type=\"Int32\" Name=\"offsets\"", "4 8") + array("type=\"UInt8\" Name=\"types\"", "10 10") +
           "</Cells><CellData>" + labels + "</CellData></Piece>\n";
}

std::string grid(const std::string& pieces) {
    return "<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" byte_order=\"LittleEndian\"><UnstructuredGrid>\n" +
           pieces + "</UnstructuredGrid></VTKFile>\n";
}

TEST_F(ReadVtuMesh, all_encodings_hold_what_vtk_and_meshio_find_in_them) {
    int seen = 0;
    for (const auto& entry : std::filesystem::directory_iterator(kMeshes)) {
        const std::string name = entry.path().stem().string();
        if (entry.path().extension() != ".vtu" || name == "vtk_points") continue;
        ++seen;
        const auto reader = formats::open_vtu(entry.path(), {});
        EXPECT_EQ(reader->info().format, "vtu");
        EXPECT_TRUE(reader->info().has_cell_labels) << name;
        EXPECT_EQ(mesh_text(*reader), text_of(kMeshes / (name.starts_with("vtk") ? "vtk.txt" : "meshio.txt"))) << name;
    }
    EXPECT_EQ(seen, 16);
}

TEST_F(ReadVtuMesh, labels_may_be_those_of_points) {
    const auto reader = formats::open_vtu(kMeshes / "vtk_points.vtu", {});
    EXPECT_FALSE(reader->info().has_cell_labels);
    EXPECT_THAT(labels_of(*reader), ElementsAre(10, 11, 12, 10, 11, 12, 10, 11, 12, 10, 11, 12));
}

TEST_F(ReadVtuMesh, the_unit_of_length_is_read) {
    const auto metres = [&](const std::string& attributes, const std::string& text) {
        const std::string fields = "<FieldData>" + array(attributes, text) + "</FieldData>";
        return open_text(grid(fields + piece()))->info().metres;
    };
    const std::string attributes = "type=\"Float64\" Name=\"MetresPerUnit\" NumberOfTuples=\"1\"";
    EXPECT_EQ(metres(attributes, "0.001"), 0.001);
    EXPECT_EQ(metres(attributes, "-1"), std::nullopt) << "no length";
    EXPECT_EQ(metres("type=\"Float64\" Name=\"MetresPerUnit\" NumberOfTuples=\"2\"", "1 1"), std::nullopt);
    EXPECT_EQ(open_text(grid(piece()))->info().metres, std::nullopt);
}

TEST_F(ReadVtuMesh, pieces_are_read_one_after_the_other) {
    const auto reader = open_text(grid(piece() + "<Piece NumberOfPoints=\"0\" NumberOfCells=\"0\"></Piece>" +
                                       piece(array("type=\"Int32\" Name=\"region\"", "7 -9"))));
    EXPECT_EQ(reader->take_points().positions.size(), 10u);
    const auto tetrahedra = all_tetrahedra(*reader);
    ASSERT_EQ(tetrahedra.size(), 4u);
    EXPECT_THAT(tetrahedra[3].corners, ElementsAre(5, 7, 6, 9));
    EXPECT_EQ(tetrahedra[3].label, -9);
    EXPECT_EQ(reader->name_of_tetrahedron(3), "cell 3");
}

TEST_F(ReadVtuMesh, cells_are_named_by_their_place_among_all) {
    const auto reader = formats::open_vtu(kMeshes / "vtk_ascii.vtu", {});
    EXPECT_EQ(reader->name_of_tetrahedron(0), "cell 1") << "a triangle is before it";
    EXPECT_EQ(reader->name_of_point(4), "point 4");
}

TEST_F(ReadVtuMesh, z_is_scaled) {
    const auto reader = open_text(grid(piece()), {.scale_z = 2.5});
    EXPECT_EQ(reader->take_points().positions[4], (Vec3{0, 0, -2.5}));
    EXPECT_EQ(reader->info().scale_z, 2.5);
}

TEST_F(ReadVtuMesh, the_array_whose_name_means_regions_has_the_labels) {
    const std::string ids = array("type=\"Int64\" Name=\"GlobalIds\"", "0 1"),
                      other = array("type=\"Int64\" Name=\"rank\"", "8 9"),
                      region = array("type=\"UInt64\" Name=\"Region\"", "1 18446744073709551615"),
                      real = array("type=\"Float64\" Name=\"label\"", "4 1e3"),
                      colour = array("type=\"UInt8\" Name=\"colour\" NumberOfComponents=\"3\"", "1 2 3 4 5 6");
    EXPECT_THAT(labels_of(*open_text(grid(piece(ids + other + colour)))), ElementsAre(8, 9));
    EXPECT_THAT(labels_of(*open_text(grid(piece(ids + other + region)))), ElementsAre(1, -1));
    EXPECT_TRUE(open_text(grid(piece(region)))->info().is_unsigned);
    EXPECT_THAT(labels_of(*open_text(grid(piece(ids + real)))), ElementsAre(4, 1000));
    EXPECT_THAT(labels_of(*open_text(grid(piece(other + real)))), ElementsAre(4, 1000)) << "no guess against a name";
    EXPECT_THAT(labels_of(*open_text(grid(piece(real + region)))), ElementsAre(1, -1));
    EXPECT_THAT(labels_of(*open_text(grid(piece(ids + other + region)), {.array = "GlobalIds"})), ElementsAre(0, 1));
    EXPECT_EQ(
        failure(grid(piece(other + array("type=\"Int8\" Name=\"part\"", "1 2")))),
        "has several arrays of integers, and no name that means regions; say which with --array NAME; its arrays: "
        "rank (cells, Int64); part (cells, Int8)");
    EXPECT_EQ(
        failure(grid(piece(ids))),
        "has no array of integers that could be labels; say which with --array NAME; its arrays: GlobalIds (cells, "
        "Int64)");
    EXPECT_EQ(failure(grid(piece(other)), {.array = "lobe"}), "has no array 'lobe'; its arrays: rank (cells, Int64)");
    EXPECT_THAT(failure(grid(piece(colour)), {.array = "colour"}), HasSubstr("has 3 components"));
}

TEST_F(ReadVtuMesh, ids_that_the_grid_declares_are_no_labels) {
    const std::string text =
        piece(array("type=\"Int64\" Name=\"a\"", "0 1") + array("type=\"Int64\" Name=\"b\"", "4 6"));
    EXPECT_THAT(labels_of(*open_text(grid(replaced(text, "<CellData>", "<CellData GlobalIds=\"a\">")))),
                ElementsAre(4, 6));
}

TEST_F(ReadVtuMesh, reals_must_be_whole_to_be_labels) {
    EXPECT_EQ(failure(grid(piece(array("type=\"Float32\" Name=\"label\"", "4 0.5")))),
              "array 'label': has 0.5 where a whole number below 2^53 is needed");
    EXPECT_THAT(failure(grid(piece(array("type=\"Float64\" Name=\"label\"", "4 9007199254740992")))),
                HasSubstr("below 2^53"));
}

TEST_F(ReadVtuMesh, copies_of_another_pieces_cells_are_passed_over) {
    const std::string ghosts = array("type=\"UInt8\" Name=\"vtkGhostType\"", "1 0");
    const auto reader = open_text(grid(piece(array("type=\"Int32\" Name=\"region\"", "3 5") + ghosts)));
    const auto tetrahedra = all_tetrahedra(*reader);
    ASSERT_EQ(tetrahedra.size(), 1u);
    EXPECT_EQ(tetrahedra[0].label, 5);
    EXPECT_EQ(reader->name_of_tetrahedron(0), "cell 1");
}

TEST_F(ReadVtuMesh, other_solids_are_refused_by_name) {
    EXPECT_EQ(failure(replaced(grid(piece()), "10 10", "10 12")),
              "cell 1 is a hexahedron: split the cells into tetrahedra, as Tetrahedralize of ParaView does");
    EXPECT_EQ(failure(replaced(grid(piece()), "10 10", "24 10")),
              "cell 0 is a quadratic tetrahedron: write the mesh with linear elements, of four nodes");
    EXPECT_THAT(failure(replaced(grid(piece()), "10 10", "10 99")), HasSubstr("cell 1 is of VTK's type 99: "));
}

TEST_F(ReadVtuMesh, bad_cells_and_points_are_named) {
    EXPECT_EQ(failure(replaced(grid(piece()), "0 2 1 4", "0 2 1 5")),
              "cell 1 names point 5; there are 5, counted from 0");
    EXPECT_EQ(failure(replaced(grid(piece()), "0 2 1 4", "0 2 1 -4")),
              "cell 1 names point -4; there are 5, counted from 0");
    EXPECT_EQ(failure(replaced(grid(piece()), "0 2 1 4", "0 2 1 1")), "cell 1 names a point twice; mend or drop it");
    EXPECT_EQ(failure(replaced(grid(piece()), "4 8", "3 8")), "cell 0 has 3 nodes; a tetrahedron has 4");
    EXPECT_EQ(failure(replaced(grid(piece()), "4 8", "4 3")), "cell 1 ends at offset 3 and begins at 4");
    EXPECT_EQ(failure(replaced(grid(piece()), "0 1 0", "0 nan 0")), "point 2 has a coordinate that is not finite");
    EXPECT_EQ(failure(grid(piece()), {.scale_z = 1e308 * 10}), "point 0 has a coordinate that is not finite");
}

TEST_F(ReadVtuMesh, arrays_that_are_missing_or_short_are_named) {
    EXPECT_EQ(failure(replaced(grid(piece()), "Name=\"types\"", "Name=\"kinds\"")), "needs the array 'types' in Cells");
    EXPECT_THAT(failure(replaced(grid(piece()), "10 10", "10")), HasSubstr("array 'types': "));
    EXPECT_THAT(failure(replaced(grid(piece()), "NumberOfCells=\"2\"", "NumberOfCells=\"4294967295\"")),
                HasSubstr("array 'types': "));
    EXPECT_THAT(failure(replaced(grid(piece()), "NumberOfCells=\"2\"", "NumberOfCells=\"4294967296\"")),
                HasSubstr("a count of at most 4294967295 is needed"));
    EXPECT_THAT(failure(replaced(grid(piece()), "<CellData>", "<CellData/><Else>") + "</Else>"), HasSubstr("no XML"));
}

TEST_F(ReadVtuMesh, a_surface_model_is_told_from_a_mesh) {
    const std::string text =
        replaced(replaced(replaced(grid(piece()), "10 10", "5 5"), "4 8", "3 6"), "3  0 2 1 4", "0 2 1");
    EXPECT_EQ(failure(text), "has no tetrahedra: a surface model? `regionmesh check` reads those");
}

TEST_F(ReadVtuMesh, damaged_files_are_read_or_refused) {
    for (const char* name :
         {"vtk_ascii.vtu", "vtk_binary_zlib_32.vtu", "vtk_raw_plain_64.vtu", "vtk_base64_zlib_64.vtu"})
        damage(kMeshes / name, 61);
}

}  // namespace
}  // namespace regionmesh
