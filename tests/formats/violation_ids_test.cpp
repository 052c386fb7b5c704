// The numbers in a report of violations are those of points and faces in the file.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>

#include "cli/program.h"
#include "regionmesh/check.h"
#include "regionmesh/formats.h"
#include "support/runs.h"
#include "support/shapes.h"

namespace regionmesh {
namespace {

using nlohmann::json;
using testing::ElementsAre;

class ViolationIds : public Program {
protected:
    json read_json(const std::string& name) const { return json::parse(text_of(out(name))); }
};

Vec3 place_of(const json& at) { return {at[0], at[1], at[2]}; }

/// The labels of the faces at a vertex or of a face, -1 for the exterior.
std::set<InputLabel> labels_at(const MeshFile& file, const json& violation) {
    std::set<InputLabel> labels;
    const auto add = [&](FaceId f) {
        for (const Label label : file.mesh[f].labels)
            labels.insert(is_exterior(label) ? file.labels.exterior_label() : file.labels.input(label));
    };
    if (violation["vertices"].empty())
        for (const std::uint32_t f : violation["faces"]) add(FaceId{f});
    else
        file.mesh.for_star(VertexId{violation["vertices"][0].get<std::uint32_t>()}, [&](FaceId f, int) { add(f); });
    return labels;
}

/// Looks every violation up in the file; returns how many there are.
int expect_found(const json& violations, const MeshFile& file) {
    int count = 0;
    for (const json& violation : violations) {
        if (!violation.contains("at")) continue;
        ++count;
        SCOPED_TRACE(violation.dump());
        for (const std::uint32_t v : violation["vertices"]) EXPECT_LT(v, file.mesh.vertex_count());
        for (const std::uint32_t f : violation["faces"]) EXPECT_LT(f, file.mesh.face_count());
        if (violation["vertices"].empty()) {
            const auto p = file.mesh.corners(FaceId{violation["faces"][0].get<std::uint32_t>()});
            EXPECT_EQ(place_of(violation["at"]), p[0] / 3 + p[1] / 3 + p[2] / 3);
        } else {
            const std::uint32_t v = violation["vertices"][0];
            EXPECT_EQ(place_of(violation["at"]), file.mesh.position(VertexId{v}));
            EXPECT_NE(violation["text"].get<std::string>().find(" " + std::to_string(v)), std::string::npos);
        }
        const std::set<InputLabel> here = labels_at(file, violation);
        for (const InputLabel label : violation["labels"]) EXPECT_TRUE(here.contains(label)) << label;
    }
    return count;
}

/// Regions of cells at random touch themselves, and many vertices and faces go.
Reconstruction touching() {
    const test::ArrayMesh mesh = test::cell_mesh_of(test::noise_volume({7, 7, 7}, 3, 1));
    return test::run(mesh, {.reduce = 0.3, .smooth = {.passes = 0}, .background = {}});
}

TEST_F(ViolationIds, of_a_run_are_those_of_the_written_file) {
    const Reconstruction made = touching();
    EXPECT_LT(made.report.final_faces, made.report.initial_faces);
    EXPECT_EQ(made.mesh.vertex_count(), made.mesh.vertex_end()) << "no free places";
    EXPECT_EQ(made.mesh.face_count(), made.mesh.face_end());
    write_text(out("r.json"), report_json(made.report, made.labels));
    for (const std::string name : {"m.vtp", "m.vtu", "m.ply"}) {
        write_mesh(made.mesh, made.labels, out(name));
        EXPECT_GT(expect_found(read_json("r.json")["violations"], read_mesh(out(name))), 10) << name;
    }
}

TEST_F(ViolationIds, of_decimate_are_those_of_the_written_file) {
    // Grains, of which a face is gone.
    Reconstruction made = test::run(test::grain_volume({12, 12, 12}, 6, 5));
    made.mesh.remove_face(FaceId{made.mesh.face_end() / 2});
    write_mesh(made.mesh, made.labels, out("cracked.vtp"));
    EXPECT_EQ(run("decimate " + out("cracked.vtp") + " -o " + out("m.vtp") + " --no-background --reduce 80% --report " +
                  out("r.json"))
                  .code,
              3);
    const json violations = read_json("r.json")["violations"];
    EXPECT_GE(expect_found(violations, read_mesh(out("m.vtp"))), 3) << "three edges are open";
    for (const json& violation : violations) EXPECT_EQ(violation["kind"], "open_edge");
}

/// An octahedron of 1 in 2, with a vertex without a face, and without its third face.
Mesh damaged(LabelTable& labels) {
    Mesh mesh;
    mesh.add_vertex({7, 7, 7});
    for (const InputLabel label : {1, 2}) labels.dense(label);
    test::add_octahedron(mesh);
    mesh.remove_face(FaceId{2});
    return mesh;
}

TEST_F(ViolationIds, of_check_are_those_of_the_file_that_was_read) {
    LabelTable labels;
    const Mesh mesh = damaged(labels);
    for (const std::string name : {"m.vtp", "m.vtu", "m.ply", "m.obj", "m.dream3d"}) {
        SCOPED_TRACE(name);
        write_mesh(mesh, labels, out(name));
        EXPECT_EQ(run("check " + out(name) + " --no-background --json " + out("c.json")).code, 3);
        const json violations = read_json("c.json")["violations"];
        EXPECT_EQ(expect_found(violations, read_mesh(out(name))), 7);
        std::set<std::vector<int>> unused, open;
        for (const json& violation : violations)
            (violation["kind"] == "unused_vertex" ? unused : open)
                .insert(violation["vertices"].get<std::vector<int>>());
        EXPECT_THAT(unused, ElementsAre(ElementsAre(0)));
        EXPECT_THAT(open, ElementsAre(ElementsAre(1, 4), ElementsAre(1, 5), ElementsAre(4, 5)));
    }
}

TEST_F(ViolationIds, of_faces_are_rows_of_a_vtp_file) {
    // In text, so that rows can be seen: faces 1 and 3 are the same.
    const std::string array = "<DataArray type=\"Int64\" format=\"ascii\" Name=";
    put_text(path("m.vtp"),
             "<VTKFile type=\"PolyData\" version=\"1.0\"><PolyData><Piece NumberOfPoints=\"4\" NumberOfPolys=\"5\">"
             "<Points><DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">"
             "0 0 0 1 0 0 0 1 0 0 0 1</DataArray></Points><Polys>" +
                 array + "\"connectivity\">0 2 1  0 1 3  0 3 2  0 1 3  1 2 3</DataArray>" + array +
                 "\"offsets\">3 6 9 12 15</DataArray></Polys><CellData>" +
                 "<DataArray type=\"Int64\" format=\"ascii\" NumberOfComponents=\"2\" Name=\"BoundaryLabels\">"
                 "1 2 1 2 1 2 1 2 1 2</DataArray></CellData></Piece></PolyData></VTKFile>");
    EXPECT_EQ(run("check " + path("m.vtp").string() + " --no-background --json " + out("c.json")).code, 3);
    std::set<std::string> kinds;
    const json violations = read_json("c.json")["violations"];
    for (const json& violation : violations) {
        kinds.insert(violation["kind"]);
        if (violation["kind"] == "duplicate_face") {
            EXPECT_THAT(violation["faces"].get<std::vector<int>>(), ElementsAre(1, 3));
        }
    }
    EXPECT_TRUE(kinds.contains("duplicate_face"));
}

}  // namespace
}  // namespace regionmesh
