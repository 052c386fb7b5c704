#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "formats/temporary_folder.h"
#include "page/page_geometry.h"
#include "regionmesh/formats.h"
#include "regionmesh/regionmesh.h"
#include "support/volumes.h"
#include "surface/region_colours.h"

namespace regionmesh {
namespace {

using nlohmann::json;

Reconstruction grains() {
    auto volume = test::grain_volume({14, 13, 12}, 9, 3, 1);
    return reconstruct(volume, {});
}

class Page : public TemporaryFolder {
protected:
    std::string written(const Reconstruction& made, const PageOptions& options, const LabelNames& names = {},
                        const std::string& title = "model.vtp") {
        write_page(
            path("page.html"),
            {{.mesh = made.mesh, .labels = made.labels, .title = title, .background = made.background, .names = names}},
            options);
        return text_of(path("page.html"));
    }

    /// The text of the element with the data.
    static std::string data_of(const std::string& page) {
        const std::string begin = R"(<script type="application/json" id="page-data">)";
        const std::size_t from = page.find(begin) + begin.size();
        return page.substr(from, page.find("</script>", from) - from);
    }
};

TEST_F(Page, what_does_not_fit_the_model_is_refused_and_nothing_is_written) {
    const Reconstruction made = grains();
    const std::vector<double> few(3);
    EXPECT_THROW(write_page(path("page.html"),
                            {{.mesh = made.mesh, .labels = made.labels, .title = "few", .distances = few}}, {}),
                 Error);
    EXPECT_THROW(written(made, {.report = "no JSON"}), Error);
    EXPECT_THROW(write_page(path("page.html"), {}, {}), Error);
    EXPECT_TRUE(std::filesystem::is_empty(path("")));
}

TEST_F(Page, holds_the_report_and_the_labels) {
    const Reconstruction made = grains();
    const json data = json::parse(data_of(
        written(made, {.command = "reconstruct", .report = report_json(made.report, made.labels)}, {{3, "third"}})));
    EXPECT_EQ(data["models"][0]["faces"], made.mesh.face_count());
    EXPECT_EQ(data["models"][0]["shown_faces"], made.mesh.face_count());
    EXPECT_EQ(data["report"]["quality"]["min"], made.report.check.quality.min);
    EXPECT_EQ(data["report"]["regions"][2]["label"], "3") << "as text: a number of JavaScript has 53 bits";
    EXPECT_EQ(data["models"][0]["labels"][2]["name"], "third");
}

TEST_F(Page, text_of_files_cannot_become_markup) {
    const std::string page = written(grains(), {.command_line = "</script><b>"},
                                     {{1, "</script><script>alert(1)</script>"}, {2, "<!--"}, {3, "\xff\xc3("}},
                                     "<img src=x onerror=alert(1)>");
    EXPECT_THAT(data_of(page), testing::Not(testing::HasSubstr("<")));
    EXPECT_EQ(json::parse(data_of(page))["models"][0]["labels"][0]["name"], "</script><script>alert(1)</script>");
    EXPECT_THAT(page, testing::Not(testing::HasSubstr("<img src=x")));
    EXPECT_THAT(page, testing::HasSubstr("<title>&lt;img src=x"));
}

TEST_F(Page, large_models_get_a_preview) {
    const Reconstruction made = grains();
    const json data = json::parse(data_of(written(made, {.preview_faces = made.mesh.face_count() / 2})));
    EXPECT_EQ(data["models"][0]["faces"], made.mesh.face_count());
    EXPECT_LE(data["models"][0]["shown_faces"], made.mesh.face_count() / 2);
    const json whole = json::parse(data_of(written(made, {})));
    EXPECT_EQ(data["models"][0]["fingerprint"], whole["models"][0]["fingerprint"]);
    EXPECT_EQ(data["models"][0]["labels"], whole["models"][0]["labels"]);
}

TEST_F(Page, previews_of_oblique_models_keep_their_box) {
    auto volume = test::grain_volume({14, 13, 12}, 9, 3, 1);
    volume.lattice().direction = {0.6, -0.8, 0, 0.8, 0.6, 0, 0, 0, 1};
    const Reconstruction made = reconstruct(volume, {});
    const auto corner = [&](const char* name, std::uint32_t faces) {
        const json page = json::parse(data_of(written(made, {.preview_faces = faces})));
        return page["models"][0][name].get<std::vector<double>>();
    };
    for (const char* name : {"low", "high"})
        EXPECT_THAT(corner(name, made.mesh.face_count() / 8),
                    testing::Pointwise(testing::DoubleNear(1e-9), corner(name, made.mesh.face_count())));
}

TEST_F(Page, bytes_do_not_depend_on_threads) {
    const Reconstruction made = grains();
    EXPECT_EQ(written(made, {.preview_faces = 400, .threads = 1}), written(made, {.preview_faces = 400, .threads = 3}));
}

/// Reads the bytes as viewer/src/geometry.js does.
struct Decoded {
    std::vector<std::array<int, 3>> places;
    std::vector<std::array<std::uint32_t, 3>> faces;
};

Decoded decoded(const PageGeometry& geometry) {
    Decoded made{std::vector<std::array<int, 3>>(geometry.vertices), {}};
    std::size_t at = 0;
    for (int axis = 0; axis < 3; ++axis, at += 2 * geometry.vertices)
        for (std::uint32_t v = 0, last = 0; v < geometry.vertices; ++v) {
            const int step = geometry.bytes[at + v] | geometry.bytes[at + geometry.vertices + v] << 8;
            last = (last + ((step >> 1) ^ -(step & 1))) & 0xFFFF;
            made.places[v][axis] = static_cast<int>(last);
        }
    std::uint32_t used = 0;
    const auto next_number = [&] {
        std::uint32_t number = 0;
        for (int shift = 0;; shift += 7) {
            const std::uint8_t byte = geometry.bytes[at++];
            number |= (byte & 0x7Fu) << shift;
            if (byte < 0x80) break;
        }
        const std::uint32_t corner = used - number;
        used += number == 0;
        return corner;
    };
    for (std::uint32_t f = 0; f < geometry.faces; ++f) {
        const std::uint32_t a = next_number(), b = next_number();
        made.faces.push_back({a, b, next_number()});
    }
    return made;
}

TEST(PageGeometry, keeps_places_faces_and_labels) {
    const Reconstruction made = grains();
    const FileView view(made.mesh, made.labels, made.background);
    const PageGeometry geometry = page_geometry(view, {});
    const Decoded read = decoded(geometry);
    ASSERT_EQ(read.faces.size(), made.mesh.face_count());
    // Each face as its centroid and its labels.
    using Item = std::array<long, 5>;
    std::multiset<Item> expected, found;
    const auto item = [](Vec3 middle, std::uint32_t first, std::uint32_t second) {
        return Item{std::lround(50 * middle.x), std::lround(50 * middle.y), std::lround(50 * middle.z), first, second};
    };
    view.for_faces([&](FaceId f) {
        auto [first, second] = made.mesh[f].labels;
        if (view.is_turned(f)) std::swap(first, second);
        const auto place = [&](Label l) { return is_exterior(l) ? made.labels.size() : view.rank(l); };
        const auto [a, b, c] = made.mesh.corners(f);
        expected.insert(item((1.0 / 3) * (a + b + c), place(first), place(second)));
    });
    std::uint32_t f = 0;
    for (const PagePair& pair : geometry.pairs)
        for (const std::uint32_t end = f + pair.faces; f < end; ++f) {
            Vec3 middle{};
            for (const std::uint32_t v : read.faces[f])
                for (int axis = 0; axis < 3; ++axis)
                    middle[axis] += (geometry.low[axis] +
                                     read.places[v][axis] / 65535.0 * (geometry.high[axis] - geometry.low[axis])) /
                                    3;
            found.insert(item(middle, pair.first, pair.second));
        }
    std::vector<Item> difference;
    std::ranges::set_difference(expected, found, std::back_inserter(difference));
    EXPECT_LT(difference.size(), expected.size() / 50) << "a few centroids round the other way";
}

TEST(RegionColours, of_neighbours_differ) {
    const Reconstruction made = grains();
    const FileView view(made.mesh, made.labels, made.background);
    const std::vector<std::uint32_t> colours = region_colours(view);
    ASSERT_EQ(colours.size(), made.labels.size());
    int pairs = 0;
    view.for_faces([&](FaceId f) {
        const auto [a, b] = made.mesh[f].labels;
        if (is_exterior(a) || is_exterior(b)) return;
        ++pairs;
        EXPECT_NE(colours[view.rank(a)], colours[view.rank(b)]);
    });
    EXPECT_GT(pairs, 100);
}

TEST(RegionColours, given_ones_stay_and_neighbours_differ_from_them) {
    const Reconstruction made = grains();
    FileView view(made.mesh, made.labels, made.background);
    const std::vector<std::uint32_t> palette = region_colours(view);
    const Label first = view.ordered_labels()[0];
    for (const std::uint32_t given : {0x123456u, palette[1], palette[2]}) {
        const LabelColours colours{{made.labels.input(first), given}, {-77, 0xFFFFFF}};
        view.set_given_colours(colours);
        const std::vector<std::uint32_t> chosen = region_colours(view);
        EXPECT_EQ(chosen[0], given);
        view.for_faces([&](FaceId f) {
            const auto [a, b] = made.mesh[f].labels;
            if (is_exterior(a) || is_exterior(b)) return;
            EXPECT_NE(chosen[view.rank(a)], chosen[view.rank(b)]);
        });
    }
}

}  // namespace
}  // namespace regionmesh
