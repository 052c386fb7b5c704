#include <gtest/gtest.h>

#include <cstring>
#include <nlohmann/json.hpp>

#include "formats/surface/written_meshes.h"

namespace regionmesh {
namespace {

using Json = nlohmann::json;

std::uint32_t word_at(const std::string& bytes, std::size_t offset) {
    std::uint32_t word;
    std::memcpy(&word, &bytes.at(offset), sizeof(word));
    return word;
}

struct Glb {
    explicit Glb(const std::string& bytes) {
        EXPECT_EQ(bytes.substr(0, 4), "glTF");
        EXPECT_EQ(word_at(bytes, 4), 2u);
        EXPECT_EQ(word_at(bytes, 8), bytes.size());
        const std::uint32_t length = word_at(bytes, 12);
        EXPECT_EQ(length % 4, 0u);
        EXPECT_EQ(bytes.substr(16, 4), "JSON");
        json = Json::parse(bytes.substr(20, length));
        EXPECT_EQ(word_at(bytes, 20 + length), bytes.size() - 28 - length);
        EXPECT_EQ(bytes.substr(24 + length, 4), std::string("BIN\0", 4));
        buffer = bytes.substr(28 + length);
    }
    std::uint32_t offset(const Json& accessor) const {
        return json["bufferViews"][accessor["bufferView"].get<int>()]["byteOffset"];
    }
    Vec3 point(const Json& accessor, std::uint32_t number) const {
        Vec3 p;
        for (int axis = 0; axis < 3; ++axis) {
            float value;
            std::memcpy(&value, &buffer.at(offset(accessor) + 12 * number + 4 * axis), sizeof(value));
            p[axis] = value;
        }
        return p;
    }

    Json json;
    std::string buffer;
};

TEST_F(WriterTest, glb_has_a_closed_mesh_for_each_region) {
    const Glb glb(written(nested(), nested_labels(), "m.glb", {.background = {2}, .names = {{7, "core"}}}));
    ASSERT_EQ(glb.json["meshes"].size(), 2u);
    EXPECT_EQ(glb.json["nodes"][2]["name"], "region_7 core");
    EXPECT_EQ(glb.json["nodes"][2]["extras"]["label"], 7);
    EXPECT_EQ(glb.json["buffers"][0]["byteLength"], glb.buffer.size());
    const std::array<double, 2> volumes{4 / 3.0 * (64 - 8 + 1), 4 / 3.0 * 8};
    for (std::size_t n = 0; n < 2; ++n) {
        const Json& primitive = glb.json["meshes"][n]["primitives"][0];
        const Json &points = glb.json["accessors"][primitive["attributes"]["POSITION"].get<int>()],
                   &corners = glb.json["accessors"][primitive["indices"].get<int>()];
        Box box;
        for (std::uint32_t v = 0; v < points["count"]; ++v) box.add(glb.point(points, v));
        for (int axis = 0; axis < 3; ++axis) {
            EXPECT_EQ(points["min"][axis], box.low[axis]);
            EXPECT_EQ(points["max"][axis], box.high[axis]);
        }
        double sixfold = 0;
        for (std::uint32_t f = 0; f < corners["count"].get<std::uint32_t>() / 3; ++f) {
            std::array<Vec3, 3> p;
            for (std::uint32_t k = 0; k < 3; ++k)
                p[k] = glb.point(points, word_at(glb.buffer, glb.offset(corners) + 12 * f + 4 * k));
            sixfold += dot(p[0], cross(p[1], p[2]));
        }
        EXPECT_NEAR(sixfold / 6, volumes[n], 1e-4);
    }
}

TEST_F(WriterTest, glb_points_are_relative_to_the_middle_which_the_root_restores) {
    Mesh mesh;
    test::add_octahedron(mesh, {1e7, 2e7, 3e7}, {1, 1, 1});
    const Glb glb(written(mesh, test::labels_from({1, 0}), "m.glb", {.background = {1}}));
    EXPECT_EQ(glb.json["accessors"][0]["max"], (Json{1.0, 1.0, 1.0}));
    EXPECT_EQ(glb.json["nodes"][0]["translation"], (Json{1e7, 3e7, -2e7})) << "z is up in volumes, y in glTF";
}

}  // namespace
}  // namespace regionmesh
