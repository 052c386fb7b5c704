#include <gmock/gmock.h>
#include <minizip/unzip.h>

#include <fstream>
#include <pugixml.hpp>

#include "formats/surface/written_meshes.h"
#include "regionmesh/error.h"

namespace regionmesh {
namespace {

using testing::ElementsAre;

class Write3mf : public WriterTest {
protected:
    /// The text of an entry, through minizip's own reader.
    std::string entry(const std::string& name) const {
        unzFile archive = unzOpen64(path("m.3mf").c_str());
        EXPECT_TRUE(archive);
        EXPECT_EQ(unzLocateFile(archive, name.c_str(), 1), UNZ_OK) << name;
        EXPECT_EQ(unzOpenCurrentFile(archive), UNZ_OK);
        std::string text;
        char part[1000];
        for (int count; (count = unzReadCurrentFile(archive, part, sizeof part)) > 0;) text.append(part, count);
        EXPECT_EQ(unzCloseCurrentFile(archive), UNZ_OK) << "the sum of its bytes";
        unzClose(archive);
        return text;
    }

    pugi::xml_node model(const WriteOptions& options = {.background = {2}}) {
        write_mesh(nested(), nested_labels(), path("m.3mf"), options);
        EXPECT_TRUE(document_.load_string(entry("3D/3dmodel.model").c_str()));
        return document_.child("model");
    }

    pugi::xml_document document_;
};

TEST_F(Write3mf, has_the_parts_of_a_package) {
    model();
    EXPECT_THAT(entry("[Content_Types].xml"), testing::HasSubstr("3dmanufacturing-3dmodel+xml"));
    EXPECT_THAT(entry("_rels/.rels"), testing::HasSubstr("Target=\"/3D/3dmodel.model\""));
}

TEST_F(Write3mf, has_a_closed_outward_object_for_each_region) {
    const pugi::xml_node root = model();
    std::vector<double> volumes;
    for (const pugi::xml_node object : root.child("resources").children("object")) {
        std::vector<Vec3> points;
        for (const pugi::xml_node v : object.child("mesh").child("vertices"))
            points.push_back(
                {v.attribute("x").as_double(), v.attribute("y").as_double(), v.attribute("z").as_double()});
        double volume = 0;
        Vec3 area;
        for (const pugi::xml_node t : object.child("mesh").child("triangles")) {
            const Vec3 a = points.at(t.attribute("v1").as_uint()), b = points.at(t.attribute("v2").as_uint()),
                       c = points.at(t.attribute("v3").as_uint());
            volume += dot(a, cross(b, c)) / 6;
            area = area + cross(b - a, c - a);
        }
        EXPECT_NEAR(length(area), 0, 1e-12) << "closed";
        volumes.push_back(volume);
    }
    EXPECT_THAT(volumes,
                ElementsAre(testing::DoubleNear(4 / 3.0 * (64 - 8 + 1), 1e-9), testing::DoubleNear(4 / 3.0 * 8, 1e-9)));
    std::vector<std::string> built;
    for (const pugi::xml_node item : root.child("build")) built.emplace_back(item.attribute("objectid").value());
    EXPECT_THAT(built, ElementsAre("2", "3"));
}

TEST_F(Write3mf, has_names_colours_and_space) {
    const LabelNames names{{7, "a <\"core\"> & more"}};
    const LabelColours colours{{7, 0xFF8000}};
    const pugi::xml_node root =
        model({.background = {2}, .names = names, .colours = colours, .coordinates = {.space = Space::kLps}});
    const pugi::xml_node materials = root.child("resources").child("basematerials");
    const pugi::xml_node object = root.child("resources").find_child_by_attribute("object", "id", "3");
    EXPECT_STREQ(object.attribute("name").value(), "a <\"core\"> & more");
    EXPECT_STREQ(object.attribute("partnumber").value(), "7");
    EXPECT_STREQ(object.attribute("pid").value(), materials.attribute("id").value());
    EXPECT_STREQ(object.attribute("pindex").value(), "1");
    EXPECT_STREQ(materials.last_child().attribute("displaycolor").value(), "#FF8000FF");
    EXPECT_STREQ(root.find_child_by_attribute("metadata", "name", "rm:Space").child_value(), "LPS");
}

TEST_F(Write3mf, says_the_unit) {
    const auto unit_and_size = [&](std::optional<double> metres) {
        const pugi::xml_node root = model({.background = {2}, .coordinates = {.metres = metres}});
        double most = 0;
        for (const pugi::xml_node v : root.child("resources").child("object").child("mesh").child("vertices"))
            most = std::max(most, v.attribute("x").as_double());
        return std::string(root.attribute("unit").value()) + " " + std::to_string(most);
    };
    for (const double bad : {0.0, -1.0, std::nan(""), HUGE_VAL}) EXPECT_THROW(unit_and_size(bad), Error) << bad;
    EXPECT_EQ(unit_and_size({}), "millimeter 9.000000") << "what programs assume";
    EXPECT_EQ(unit_and_size(1e-3), "millimeter 9.000000");
    EXPECT_EQ(unit_and_size(1), "meter 9.000000");
    EXPECT_EQ(unit_and_size(1e-6), "micron 9.000000");
    EXPECT_EQ(unit_and_size(0.01), "centimeter 9.000000");
    EXPECT_EQ(unit_and_size(0.0254), "inch 9.000000");
    EXPECT_EQ(unit_and_size(0.3048), "foot 9.000000");
    EXPECT_EQ(unit_and_size(1e3), "meter 9000.000000");
    EXPECT_EQ(unit_and_size(1e-9), "micron 0.009000") << "nanometres, of which the format knows nothing";
}

TEST_F(Write3mf, a_region_with_open_edges_is_refused_and_one_inside_out_is_not) {
    Mesh turned;
    test::add_octahedron(turned, {}, {4, 4, 4}, 2, 0);
    write_mesh(turned, nested_labels(), path("m.3mf"), {.background = {2}});
    Mesh open = nested();
    open.remove_face(FaceId{0});
    open.compact_faces();
    try {
        write_mesh(open, nested_labels(), path("m.3mf"), {.background = {2}});
        FAIL() << "an open object was written";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::kOutput);
        EXPECT_THAT(error.what(), testing::HasSubstr("region 5 has open edges"));
    }
}

TEST_F(Write3mf, is_the_same_bytes_at_any_time) {
    model();
    const std::string first = text_of(path("m.3mf"));
    std::filesystem::remove(path("m.3mf"));
    model();
    EXPECT_EQ(text_of(path("m.3mf")), first);
}

TEST_F(Write3mf, a_full_disk_is_an_error) {
    std::filesystem::create_symlink("/dev/full", path("m.3mf"));
    try {
        write_mesh(nested(), nested_labels(), path("m.3mf"), {.background = {2}});
        FAIL() << "nothing thrown";
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::kOutput);
        EXPECT_THAT(error.what(), testing::HasSubstr("No space left on device"));
    }
}

}  // namespace
}  // namespace regionmesh
