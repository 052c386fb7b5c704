#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <map>
#include <numbers>

#include "formats/surface/written_meshes.h"
#include "regionmesh/write_report.h"

namespace regionmesh {
namespace {

using testing::DoubleNear;
using testing::HasSubstr;

/// Rows as cells by title. No cell of these tests has a comma.
std::vector<std::map<std::string, std::string>> table_of(const std::string& text) {
    std::istringstream lines(text);
    std::vector<std::string> titles;
    std::vector<std::map<std::string, std::string>> rows;
    for (std::string line; std::getline(lines, line);) {
        std::vector<std::string> cells{""};
        for (const char letter : line)
            if (letter == ',')
                cells.emplace_back();
            else
                cells.back() += letter;
        if (titles.empty()) {
            titles = cells;
            continue;
        }
        EXPECT_EQ(cells.size(), titles.size()) << line;
        std::map<std::string, std::string> row;
        for (std::size_t n = 0; n < std::min(cells.size(), titles.size()); ++n) row[titles[n]] = cells[n];
        rows.push_back(row);
    }
    return rows;
}

double number_in(const std::map<std::string, std::string>& row, const std::string& title) {
    return std::stod(row.at(title));
}

TEST(InterfaceTable, has_area_centroid_and_curvature) {
    const auto rows = table_of(interfaces_csv(nested(), nested_labels(), {2}, {{7, "core"}}));
    ASSERT_EQ(rows.size(), 2u);
    EXPECT_EQ(rows[0].at("label") + ' ' + rows[0].at("neighbour") + ' ' + rows[0].at("neighbour_name"), "5 7 core");
    EXPECT_EQ(rows[1].at("label") + ' ' + rows[1].at("neighbour"), "5 0");
    // An octahedron with corners at distance r: 12 edges of length sqrt(2) r, which turn by acos(1/3).
    const double area = 4 * std::sqrt(3.0), turn = 0.5 * 12 * std::numbers::sqrt2 * std::acos(1 / 3.0);
    EXPECT_THAT(number_in(rows[0], "area"), DoubleNear(4 * area, 1e-6));
    EXPECT_THAT(number_in(rows[0], "mean_curvature"), DoubleNear(-2 * turn / (4 * area), 1e-9)) << "5 is concave there";
    EXPECT_THAT(number_in(rows[1], "area"), DoubleNear(17 * area, 1e-6));
    EXPECT_THAT(number_in(rows[1], "mean_curvature"), DoubleNear((4 + 1) * turn / (17 * area), 1e-9));
    EXPECT_THAT(number_in(rows[1], "centroid_x"), DoubleNear(8 / 17.0, 1e-9));
    EXPECT_EQ(number_in(rows[1], "line_length"), 0);
}

TEST(InterfaceTable, regions_have_the_sums) {
    const auto regions = table_of(regions_csv(nested(), nested_labels(), {2}, {}));
    const double area = 4 * std::sqrt(3.0), turn = 0.5 * 12 * std::numbers::sqrt2 * std::acos(1 / 3.0);
    EXPECT_THAT(number_in(regions[0], "mean_curvature"), DoubleNear((4 + 1 - 2) * turn / (21 * area), 1e-9));
    EXPECT_THAT(number_in(regions[1], "mean_curvature"), DoubleNear(2 * turn / (4 * area), 1e-9));
    EXPECT_EQ(number_in(regions[1], "triple_line_length"), 0);
}

/// The volume of side^3 samples that `label` gives for the distances from its middle along an oblique axis and along
/// two others square to it.
template <class LabelAt>
test::ArrayVolume oblique(std::uint32_t side, LabelAt&& label) {
    const Vec3 axis = (1 / std::sqrt(14.0)) * Vec3{2, 1, 3}, across = (1 / std::sqrt(5.0)) * Vec3{1, -2, 0},
               other = cross(axis, across);
    std::vector<InputLabel> labels;
    for (std::uint32_t z = 0; z < side; ++z)
        for (std::uint32_t y = 0; y < side; ++y)
            for (std::uint32_t x = 0; x < side; ++x) {
                const Vec3 p = Vec3{x + 0.0, y + 0.0, z + 0.0} - 0.5 * (side - 1.3) * Vec3{1, 1, 1};
                labels.push_back(label(Vec3{dot(p, axis), dot(p, across), dot(p, other)}));
            }
    return {{side, side, side}, labels};
}

TEST(InterfaceTable, curvature_is_that_of_the_interface_not_of_its_jagged_line) {
    // A ball of radius 13 in two halves: the round interfaces have 1 / 13, the flat one none.
    const double radius = 13;
    test::ArrayVolume volume = oblique(35, [&](Vec3 p) -> InputLabel {
        return length(p) >= radius ? 0 : p.y + 0.3 * p.z < 0 ? 1 : 2;
    });
    const Reconstruction made = test::run(volume, {.background = {{0}}});
    std::map<std::string, double> areas;
    for (const auto& row : table_of(interfaces_csv(made.mesh, made.labels, made.background))) {
        const std::string pair = row.at("label") + ' ' + row.at("neighbour");
        areas[pair] = number_in(row, "area");
        const double wanted = pair == "1 2" ? 0 : 1 / radius;
        EXPECT_THAT(number_in(row, "mean_curvature"), DoubleNear(wanted, 0.05 / radius)) << pair;
    }
    EXPECT_EQ(areas.size(), 3u);
    for (const auto& row : table_of(regions_csv(made.mesh, made.labels, made.background))) {
        const double round = areas[row.at("label") + " 0"], share = round / (round + areas["1 2"]);
        EXPECT_THAT(number_in(row, "mean_curvature"), DoubleNear(share / radius, 0.05 / radius)) << row.at("label");
    }
}

TEST(LineTable, dihedral_angles_are_a_full_turn_and_lengths_those_of_the_report) {
    const Reconstruction& made = grains();
    double inside = 0, of_regions = 0, expected = 0;
    for (const auto& row : table_of(lines_csv(made.mesh, made.labels, made.background))) {
        if (row.at("names").find("exterior") != std::string::npos) continue;
        inside += number_in(row, "length");
        expected += number_in(row, "label_count") * number_in(row, "length");
        std::istringstream angles(row.at("angles"));
        double sum = 0, angle;
        while (angles >> angle) sum += angle;
        if (row.at("label_count") == "3") {
            EXPECT_THAT(sum, DoubleNear(360, 0.01)) << row.at("labels");
        }
    }
    EXPECT_THAT(inside, DoubleNear(made.report.check.lines.length, 1e-6 * inside));
    EXPECT_GT(inside, 10);
    for (const auto& row : table_of(regions_csv(made.mesh, made.labels, made.background)))
        of_regions += number_in(row, "triple_line_length");
    double of_background = 0;
    for (const auto& row : table_of(lines_csv(made.mesh, made.labels, made.background)))
        if (row.at("names").find("exterior") == std::string::npos && !made.background.empty() &&
            (' ' + row.at("labels") + ' ').find(" 0 ") != std::string::npos)
            of_background += number_in(row, "length");
    EXPECT_THAT(of_regions + of_background, DoubleNear(expected, 1e-6 * expected));
}

using Angles = std::array<double, 3>;

/// Three regions round the axis.
test::ArrayVolume sectors(std::uint32_t side, const Angles& angles) {
    return oblique(side, [&](Vec3 p) -> InputLabel {
        const double angle = std::atan2(p.z, p.y) * 180 / std::numbers::pi + 180;
        return angle < angles[0] ? 1 : angle < angles[0] + angles[1] ? 2 : 3;
    });
}

/// Of the regions 1, 2 and 3 at the line where they meet.
Angles angles_of(const Reconstruction& made) {
    for (const auto& row : table_of(lines_csv(made.mesh, made.labels, made.background))) {
        if (row.at("labels") != "1 2 3") continue;
        std::istringstream text(row.at("angles"));
        Angles angles{};
        for (double& angle : angles) text >> angle;
        return angles;
    }
    ADD_FAILURE() << "no such line";
    return {};
}

void expect_near(const Angles& found, const Angles& wanted, double tolerance) {
    for (int n = 0; n < 3; ++n) EXPECT_THAT(found[n], DoubleNear(wanted[n], tolerance));
}

TEST(LineTable, dihedral_angles_are_those_of_the_interfaces) {
    const Angles wanted{90, 150, 120};
    test::ArrayVolume volume = sectors(40, wanted);
    for (const double share : {0.0, 0.9})
        for (const std::uint32_t passes : {0u, SmoothOptions{}.passes}) {
            SCOPED_TRACE(testing::Message() << share << " " << passes);
            const Reconstruction made = test::run(
                volume, {.reduce = share, .smooth = {.passes = passes}, .decimate = share > 0, .background = {}});
            expect_near(angles_of(made), wanted, passes == 0 ? 6 : 2.5);
        }
}

TEST(LineTable, dihedral_angles_of_thin_wedges) {
    const Angles wanted{20, 40, 300};
    test::ArrayVolume volume = sectors(48, wanted);
    expect_near(angles_of(test::run(volume, {.decimate = false, .background = {}})), wanted, 5);
}

TEST(LineTable, dihedral_angles_of_a_lens) {
    const double radius = 24, half = 30, middle = radius * std::cos(half * std::numbers::pi / 180);
    test::ArrayVolume volume = oblique(40, [&](Vec3 p) -> InputLabel {
        const auto is_in = [&](double side) { return length(Vec3{p.x + side * middle, p.y, p.z}) < radius; };
        return is_in(1) && is_in(-1) ? 3 : p.x > 0 ? 1 : 2;
    });
    expect_near(angles_of(test::run(volume, {.decimate = false, .background = {}})), {180 - half, 180 - half, 2 * half},
                4);
}

TEST(LineTable, dihedral_angles_of_noise_add_up) {
    const Reconstruction made =
        test::run(test::noise_volume({14, 15, 16}, 5, 2), {.decimate = false, .background = {}});
    for (const auto& row : table_of(lines_csv(made.mesh, made.labels, made.background))) {
        if (row.at("label_count") != "3") continue;
        const bool is_on_box = row.at("names").find("exterior") != std::string::npos;
        std::istringstream angles(row.at("angles"));
        double sum = 0;
        for (double angle; angles >> angle;) sum += angle;
        EXPECT_THAT(sum, DoubleNear(is_on_box ? 180 : 360, 0.01)) << row.at("labels");
    }
}

TEST(LineTable, of_the_box_has_the_exterior_as_one_label) {
    const Reconstruction& made = grains();
    const std::string text = lines_csv(made.mesh, made.labels, made.background);
    EXPECT_THAT(text, HasSubstr("; exterior"));
    for (const auto& row : table_of(interfaces_csv(made.mesh, made.labels, made.background))) {
        if (row.at("neighbour_name") == "exterior") {
            EXPECT_EQ(row.at("mean_curvature"), "");
        }
        EXPECT_GT(number_in(row, "line_length"), 0);
    }
}

TEST(LineTable, of_a_model_with_holes_leaves_angles_out) {
    Mesh mesh;  // three faces at one edge, and nothing else
    for (const Vec3 p : {Vec3{0, 0, 0}, Vec3{0, 0, 2}, Vec3{1, 0, 0}, Vec3{-1, 1, 0}, Vec3{-1, -1, 0}})
        mesh.add_vertex(p);
    for (std::uint32_t n = 0; n < 3; ++n) mesh.add_face(VertexId{0}, VertexId{1}, VertexId{2 + n}, n, (n + 1) % 3);
    const auto whole = table_of(lines_csv(mesh, test::labels_from({1, 2, 3}), {}));
    ASSERT_EQ(whole.size(), 1u);
    EXPECT_EQ(whole[0].at("labels"), "1 2 3");
    EXPECT_EQ(number_in(whole[0], "length"), 2);
    mesh.add_face(VertexId{1}, VertexId{0}, VertexId{2}, 0, 3);
    const auto more = table_of(lines_csv(mesh, test::labels_from({1, 2, 3, 4}), {}));
    ASSERT_EQ(more.size(), 2u);
    EXPECT_EQ(more[0].at("labels"), "1 2 3 4");
    EXPECT_THAT(more[0].at("angles"), testing::StartsWith("- ")) << "label 1 has three faces there";
}

}  // namespace
}  // namespace regionmesh
