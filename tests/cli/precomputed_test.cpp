// Folders for Neuroglancer, as a user makes them.
#include <cmath>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "cli/decoded_precomputed.h"
#include "cli/program.h"
#include "regionmesh/blocks.h"
#include "regionmesh/check.h"

namespace regionmesh {
namespace {

namespace fs = std::filesystem;

class PrecomputedProgram : public Program {
protected:
    /// Reconstructs grains of 24 samples along each axis into out/model, in blocks of 12 cells.
    Ran make_model(const std::string& options = "") const {
        const test::ArrayVolume volume = test::grain_volume({24, 24, 24}, 8, 3);
        std::string labels(volume.labels().begin(), volume.labels().end());
        put_text(path("grains.raw"), labels);
        return run("reconstruct " + path("grains.raw").string() +
                   " --size 24,24,24 --type uint8 --smooth light --block-size 12 -o " + out("model") + ' ' + options);
    }

    /// The same with every label a region, converted with --units um: 1000 nanometres in a unit.
    void make_precomputed(const std::string& options) const {
        ASSERT_EQ(make_model("--no-background").code, 0);
        convert("m", options);
    }
    void convert(const std::string& name, const std::string& options) const {
        const Ran ran = run("convert " + out("model") + ' ' + out(name + ".precomputed") + " --units um " + options);
        ASSERT_EQ(ran.code, 0) << ran.error;
    }

    DecodedRegion decoded(const std::string& name, const std::string& id) const {
        const fs::path folder = out(name + ".precomputed");
        const std::string data = text_of(folder / id);
        DecodedRegion region = decode_region(text_of(folder / (id + ".index")), data);
        EXPECT_EQ(region.fragment_bytes, data.size());
        return region;
    }

    nlohmann::json json_of(const std::string& name) const { return nlohmann::json::parse(text_of(out(name))); }
};

TEST_F(PrecomputedProgram, says_the_names_of_the_table_given_with_the_volume) {
    put_text(path("names.csv"), "label,name\n1,quartz\n");
    ASSERT_EQ(make_model("--names " + path("names.csv").string()).code, 0);
    ASSERT_EQ(run("convert " + out("model") + ' ' + out("m.precomputed")).code, 0);
    const auto properties = json_of("m.precomputed/names/info")["inline"];
    ASSERT_EQ(properties["ids"].size(), properties["properties"][0]["values"].size());
    for (std::size_t n = 0; n < properties["ids"].size(); ++n) {
        const std::string id = properties["ids"][n];
        EXPECT_EQ(properties["properties"][0]["values"][n], id == "1" ? "quartz" : id);
    }
}

TEST_F(PrecomputedProgram, writes_a_state_that_shows_the_model_in_its_colours) {
    ASSERT_EQ(make_model().code, 0);
    put_text(path("colours.csv"), "label,name,colour\n1,quartz,#ff8000\n2,mica,#0000ff\n");
    const Ran ran = run("convert " + out("model") + ' ' + out("m.precomputed") + " --units um --names " +
                        path("colours.csv").string());
    ASSERT_EQ(ran.code, 0) << ran.error;
    const auto state = json_of("m.precomputed/state.json"), layer = state["layers"][0];
    EXPECT_EQ(layer["source"], "precomputed://http://localhost:8080/m.precomputed");
    EXPECT_EQ(layer["segments"].size(), json_of("m.precomputed/names/info")["inline"]["ids"].size());
    EXPECT_EQ(layer["segmentColors"]["1"], "#ff8000");
    for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(state["position"][axis], 11500, 1);  // nanometres
}

TEST_F(PrecomputedProgram, refuses_negative_labels_before_it_writes) {
    put_text(path("grains.raw"), std::string(12, '\xfe') + std::string(15, '\x01'));  // -2 and 1
    ASSERT_EQ(run("reconstruct " + path("grains.raw").string() + " --size 3,3,3 --type int8 --block-size 12 -o " +
                  out("model"))
                  .code,
              0);
    const Ran ran = run("convert " + out("model") + ' ' + out("m.precomputed"));
    EXPECT_EQ(ran.code, 1);
    EXPECT_EQ(std::ranges::count(ran.error, '\n'), 1) << ran.error;
    EXPECT_THAT(ran.error, testing::HasSubstr("label -2 is negative, and ids in Neuroglancer are not"));
    EXPECT_FALSE(fs::exists(out("m.precomputed/info")));
}

/// Whether each edge is used as often in one direction as in the other.
bool is_closed(const std::vector<DecodedFace>& faces) {
    std::map<std::pair<DecodedPoint, DecodedPoint>, int> uses;
    for (const DecodedFace& face : faces)
        for (int n = 0; n < 3; ++n) {
            const DecodedPoint &a = face[n], &b = face[(n + 1) % 3];
            a < b ? ++uses[{a, b}] : --uses[{b, a}];
        }
    return std::ranges::all_of(uses, [](const auto& use) { return use.second == 0; });
}

/// The face with its smallest corner first; the orientation stays.
DecodedFace turned(DecodedFace face) {
    std::ranges::rotate(face, std::ranges::min_element(face));
    return face;
}

double volume_of(const DecodedRegion& region, std::size_t level) {
    double volume = 0;
    for (const DecodedFace& face : region.faces(level))
        volume += dot(region.position(face[0], level),
                      cross(region.position(face[1], level), region.position(face[2], level))) /
                  6;
    return volume;
}

/// The faces of a region of the model, outward, in steps.
std::vector<DecodedFace> faces_of_model(const MeshFile& model, Label label, const DecodedRegion& region) {
    std::vector<DecodedFace> faces;
    for (std::uint32_t f = 0; f < model.mesh.face_end(); ++f) {
        const Face& face = model.mesh[FaceId{f}];
        for (int side = 0; side < 2; ++side) {
            if (face.labels[side] != label) continue;
            DecodedFace corners;
            for (int n = 0; n < 3; ++n) {
                const Vec3 p = model.mesh.position(face.vertices[side == 0 ? n : 2 - n]) * 1000.0;
                for (int axis = 0; axis < 3; ++axis)
                    corners[n][axis] = std::llround((p[axis] - region.origin[axis]) / region.step(0));
                // Half a step along each axis, and what rounding of the quotient adds.
                EXPECT_LE(length(region.position(corners[n], 0) - p), region.step(0) * std::sqrt(3) / 2 * 1.0001);
            }
            faces.push_back(turned(corners));
        }
    }
    return faces;
}

bool lies_in_one_chunk(const DecodedFace& face) {
    for (int axis = 0; axis < 3; ++axis) {
        const auto [low, high] = std::minmax({face[0][axis], face[1][axis], face[2][axis]});
        if (high > (low / 65535 + 1) * 65535) return false;
    }
    return true;
}

/// By its id.
using RegionOf = std::function<DecodedRegion(const std::string&)>;

/// Of level 0.
void expect_every_face_once(const MeshFile& model, const RegionOf& region_of) {
    std::size_t whole = 0, cut = 0;
    for (const RegionReport& report : check(model.mesh).regions) {
        const std::string id = model.labels.text(model.labels.input(report.label));
        SCOPED_TRACE(id);
        const DecodedRegion region = region_of(id);
        std::multiset<DecodedFace> found;
        for (const DecodedFace& face : region.faces(0)) found.insert(turned(face));
        std::set<DecodedPoint> corners;
        for (const DecodedFace& face : found) corners.insert(face.begin(), face.end());
        for (const DecodedFace& face : faces_of_model(model, report.label, region)) {
            for (const DecodedPoint& corner : face) EXPECT_TRUE(corners.contains(corner));
            if (!lies_in_one_chunk(face)) {
                ++cut;
                continue;
            }
            ++whole;
            ASSERT_EQ(found.count(face), 1u);
            found.erase(face);
        }
        for (const DecodedFace& part : found)  // of faces that were cut
            EXPECT_TRUE(std::ranges::any_of(part, [](const DecodedPoint& corner) {
                return std::ranges::any_of(corner, [](std::int64_t place) { return place % 65535 == 0; });
            }));
        EXPECT_TRUE(is_closed(region.faces(0)));
        EXPECT_NEAR(volume_of(region, 0) / 1e9, report.volume, 1e-4 * report.volume);
    }
    EXPECT_GT(whole, 1000u);
    EXPECT_GT(cut, 100u);
}

TEST_F(PrecomputedProgram, level_0_is_the_model_with_every_face_once) {
    make_precomputed("--levels 3");
    expect_every_face_once(read_block_folder(out("model")), [&](const std::string& id) { return decoded("m", id); });
}

TEST_F(PrecomputedProgram, coarser_levels_are_closed_smaller_and_fit_together) {
    make_precomputed("--levels 3");
    const auto ids = json_of("m.precomputed/names/info")["inline"]["ids"];
    for (std::size_t level = 0; level < 3; ++level) {
        std::map<DecodedFace, int> sides;  // of each face, whichever way it is turned
        std::size_t faces = 0, earlier = 0;
        for (const std::string id : ids) {
            const DecodedRegion region = decoded("m", id);
            ASSERT_EQ(region.levels.size(), 3u);
            EXPECT_TRUE(is_closed(region.faces(level))) << id << " at level " << level;
            EXPECT_NEAR(volume_of(region, level), volume_of(region, 0), 0.1 * volume_of(region, 0)) << id;
            faces += region.faces(level).size();
            if (level > 0) earlier += region.faces(level - 1).size();
            for (DecodedFace face : region.faces(level)) {
                std::ranges::sort(face);
                ++sides[face];
            }
        }
        EXPECT_TRUE(level == 0 || faces < earlier * 2 / 3) << faces << " faces at level " << level;
        const std::int64_t box = std::llround(23000 / decoded("m", ids[0]).step(level));
        for (const auto& [face, count] : sides)  // two regions have it, or it lies on the box
            if (count != 2) {
                bool is_on_box = false;
                for (int axis = 0; axis < 3; ++axis)
                    for (const std::int64_t wall : {std::int64_t{0}, box})
                        is_on_box |= std::ranges::all_of(
                            face, [&, n = axis](const DecodedPoint& p) { return std::abs(p[n] - wall) <= 1; });
                EXPECT_TRUE(count == 1 && is_on_box) << count << " sides at level " << level;
            }
    }
}

/// Whether node `a` comes before `b` on the curve on which bits of z count more than those of y and x.
bool is_before(const std::array<std::uint32_t, 3>& a, const std::array<std::uint32_t, 3>& b) {
    int most = 2;
    for (int axis = 1; axis >= 0; --axis)
        if (((a[most] ^ b[most]) < (a[axis] ^ b[axis])) &&
            ((a[most] ^ b[most]) < ((a[most] ^ b[most]) ^ (a[axis] ^ b[axis]))))
            most = axis;
    return a[most] < b[most];
}

TEST_F(PrecomputedProgram, fragments_are_an_octree_along_the_curve_and_halved_where_the_viewer_halves_them) {
    make_precomputed("--levels 3");
    const auto info = json_of("m.precomputed/names/info");
    for (const std::string id : info["inline"]["ids"]) {
        const DecodedRegion region = decoded("m", id);
        for (std::size_t level = 0; level < region.levels.size(); ++level) {
            const auto& fragments = region.levels[level];
            for (std::size_t n = 0; n < fragments.size(); ++n) {
                EXPECT_TRUE(n == 0 || is_before(fragments[n - 1].chunk, fragments[n].chunk));
                auto parent = fragments[n].chunk;
                for (std::uint32_t& place : parent) place /= 2;
                if (level + 1 < region.levels.size()) {
                    EXPECT_TRUE(std::ranges::any_of(region.levels[level + 1], [&](const DecodedFragment& fragment) {
                        return fragment.chunk == parent;
                    }));
                }
                for (const DecodedFace& face : fragments[n].faces)
                    for (int axis = 0; axis < 3; ++axis) {
                        const std::int64_t half = std::int64_t{65535} * fragments[n].chunk[axis] + 32768;
                        const auto [low, high] = std::minmax({face[0][axis], face[1][axis], face[2][axis]});
                        EXPECT_FALSE(level > 0 && low < half && high > half);
                    }
            }
        }
        EXPECT_LT(region.scales[0], region.scales[1]);
        EXPECT_LT(region.scales[1], region.scales[2]);
    }
}

TEST_F(PrecomputedProgram, shards_hold_the_same_bytes) {
    make_precomputed("--levels 2");
    convert("s", "--levels 2 --sharded");
    const auto sharding = json_of("s.precomputed/info")["sharding"];
    EXPECT_EQ(sharding["hash"], "identity");
    ASSERT_EQ(sharding["minishard_bits"], 0);
    ASSERT_EQ(sharding["shard_bits"], 0);
    const std::string shard = text_of(out("s.precomputed/0.shard"));
    WordReader bounds(shard);
    const auto first = bounds.next<std::uint64_t>(), end = bounds.next<std::uint64_t>();
    const std::size_t count = (end - first) / 24;
    std::vector<std::uint64_t> index(3 * count);
    std::memcpy(index.data(), shard.data() + 16 + first, 24 * count);
    EXPECT_EQ(count, json_of("s.precomputed/names/info")["inline"]["ids"].size());
    std::uint64_t id = 0, start = 16;
    for (std::size_t n = 0; n < count; ++n) {
        id += index[n];
        start += index[count + n];
        const std::uint64_t bytes = index[2 * count + n];
        const std::string manifest = text_of(out("m.precomputed/" + std::to_string(id) + ".index"));
        const std::string data = text_of(out("m.precomputed/" + std::to_string(id)));
        EXPECT_EQ(shard.substr(start, bytes), manifest);
        EXPECT_EQ(shard.substr(start - data.size(), data.size()), data);
        start += bytes;
    }
}

TEST_F(PrecomputedProgram, of_a_model_in_one_file_holds_what_its_pieces_do) {
    make_precomputed("--levels 3");
    ASSERT_EQ(run("convert " + out("model") + ' ' + out("model.vtp")).code, 0);
    const Ran ran =
        run("convert " + out("model.vtp") + ' ' + out("w.precomputed") + " --no-background --units um --levels 3");
    ASSERT_EQ(ran.code, 0) << ran.error;
    EXPECT_EQ(json_of("w.precomputed/info"), json_of("m.precomputed/info"));
    const auto ids_of = [&](const std::string& name) {
        return json_of(name + ".precomputed/names/info")["inline"]["ids"].get<std::set<std::string>>();
    };
    EXPECT_EQ(ids_of("w"), ids_of("m"));
    expect_every_face_once(read_mesh(out("model.vtp")), [&](const std::string& id) { return decoded("w", id); });
    for (const std::string& id : ids_of("w")) {
        SCOPED_TRACE(id);
        const DecodedRegion region = decoded("w", id);
        ASSERT_EQ(region.levels.size(), 3u);
        for (std::size_t level = 1; level < 3; ++level) {
            EXPECT_LT(region.faces(level).size(), region.faces(level - 1).size() * 2 / 3);
            EXPECT_TRUE(is_closed(region.faces(level))) << level;
            EXPECT_NEAR(volume_of(region, level), volume_of(region, 0), 0.1 * volume_of(region, 0)) << level;
        }
    }
    ASSERT_EQ(
        run("convert " + out("model.vtp") + ' ' + out("l.precomputed") + " --background 0 --precomputed legacy").code,
        0);
    EXPECT_EQ(json_of("l.precomputed/2:0")["fragments"], nlohmann::json::array({"2:0:0"}));
    EXPECT_FALSE(fs::exists(out("l.precomputed/0:0")));  // background
}

TEST_F(PrecomputedProgram, of_a_model_in_an_oblique_box_is_closed_at_all_levels) {
    const test::ArrayVolume volume = test::grain_volume({24, 24, 24}, 8, 3);
    const std::string labels(volume.labels().begin(), volume.labels().end());
    put_text(path("grains.nrrd"),
             "NRRD0004\ntype: uint8\ndimension: 3\nspace dimension: 3\nsizes: 24 24 24\nencoding: raw\n"
             "space directions: (0.8,0.6,0) (-0.6,0.8,0) (0,0,1)\nspace origin: (5,-3,11)\n\n" +
                 labels);
    ASSERT_EQ(
        run("reconstruct " + path("grains.nrrd").string() + " --smooth light --no-background -o " + out("oblique.vtp"))
            .code,
        0);
    ASSERT_EQ(run("convert " + out("oblique.vtp") + ' ' + out("o.precomputed") + " --no-background --levels 3").code,
              0);
    for (const std::string id : json_of("o.precomputed/names/info")["inline"]["ids"])
        for (std::size_t level = 0; level < 3; ++level) {
            const DecodedRegion region = decoded("o", id);
            EXPECT_TRUE(is_closed(region.faces(level))) << id << ' ' << level;
            EXPECT_NEAR(volume_of(region, level), volume_of(region, 0), 0.1 * volume_of(region, 0)) << id;
        }
}

TEST_F(PrecomputedProgram, leaves_no_folder_that_could_be_taken_for_whole_when_it_fails) {
    for (const char* format : {"legacy", "multi"}) {
        SCOPED_TRACE(format);
        fs::remove_all(out("model"));
        ASSERT_EQ(make_model().code, 0);
        const std::string command = "convert " + out("model") + ' ' + out("m.precomputed") + " --precomputed " + format;
        ASSERT_EQ(run(command).code, 0);
        EXPECT_TRUE(fs::exists(out("m.precomputed/info")));
        fs::path last;
        for (const auto& entry : fs::directory_iterator(out("model")))
            if (entry.path().extension() == ".piece") last = std::max(last, entry.path());
        std::string bytes = text_of(last);
        bytes[bytes.size() / 2] ^= 1;
        put_text(last, bytes);
        const Ran ran = run(command);
        EXPECT_EQ(ran.code, 1) << ran.error;
        EXPECT_FALSE(fs::exists(out("m.precomputed/info")));
        for (const char* more : {"", " --sharded"}) {
            if (std::string(format) == "legacy" && *more != 0) continue;
            EXPECT_EQ(
                run("convert " + out("model") + ' ' + out("new.precomputed") + " --precomputed " + format + more).code,
                1);
            EXPECT_FALSE(fs::exists(out("new.precomputed"))) << "a folder was left";
        }
    }
}

TEST_F(PrecomputedProgram, refuses_options_without_effect) {
    ASSERT_EQ(make_model().code, 0);
    for (const auto& [options, said] :
         {std::pair("m.precomputed --precomputed legacy --sharded", "legacy meshes have neither"),
          std::pair("m.precomputed --precomputed legacy --levels 2", "legacy meshes have neither"),
          std::pair("m.precomputed --per-region", "--per-region: is "),
          std::pair("m.vtp --sharded", "--sharded: is for an output such as model.precomputed"),
          std::pair("m.pvtp --levels 2", "--levels: is for an output such as model.precomputed")}) {
        const Ran ran = run("convert " + out("model") + ' ' + out(options));
        EXPECT_EQ(ran.code, 2);
        EXPECT_EQ(std::ranges::count(ran.error, '\n'), 1) << ran.error;
        EXPECT_THAT(ran.error, testing::HasSubstr(said));
    }
}

}  // namespace
}  // namespace regionmesh
