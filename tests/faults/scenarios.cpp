#include "faults/scenarios.h"

#include <fstream>
#include <iterator>

#include "support/paths.h"

namespace regionmesh::faults {

namespace {

constexpr int kSide = 12;

/// Two touching balls, labels 1 and 2, in label 0: kSide samples along each axis.
std::string volume() {
    std::string labels;
    for (int z = 0; z < kSide; ++z)
        for (int y = 0; y < kSide; ++y)
            for (int x = 0; x < kSide; ++x) {
                const auto is_near = [&](int from) {
                    return (x - from) * (x - from) + (y - 5) * (y - 5) + (z - 6) * (z - 6) <= 10;
                };
                labels += static_cast<char>(is_near(4) ? 1 : is_near(8) ? 2 : 0);
            }
    return labels;
}

std::string table() {
    std::string text = "x,y,z,label\n";
    for (int n = 0; n < 60; ++n)
        text += std::to_string(n * 37 % 61) + "," + std::to_string(n * 17 % 59) + "," + std::to_string(n * 7 % 53) +
                "," + std::to_string(n % 3) + "\n";
    return text;
}

/// A tetrahedron of region 1.
constexpr const char* kModel =
    "v 0 0 0\nv 4 0 0\nv 0 4 0\nv 0 0 4\ng interface_0_1\nf 1 2 3\nf 1 4 2\nf 2 4 3\nf 1 3 4\n";

std::string data(const std::string& name) {
    std::ifstream file(test::data_folder() + "/" + name, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace

std::vector<Scenario> all_scenarios() {
    const std::map<std::string, std::string> sections{{"v.raw", volume()}}, model{{"m.obj", kModel}},
        both{{"v.raw", volume()}, {"m.obj", kModel}};
    const std::vector<std::string> read{"reconstruct", "../in/v.raw", "--size", "12,12,12", "--type", "uint8"};
    const auto reading = [&](std::vector<std::string> more) {
        more.insert(more.begin(), read.begin(), read.end());
        return more;
    };
    return {
        {"model_and_report", reading({"-o", "m.vtp", "--reduce", "50%", "--report", "r.json"}), sections},
        {"mesh_and_script", reading({"-o", "m.msh", "--threads", "2", "--report", "r.json"}), sections},
        {"regions", reading({"-o", "m.stl", "--per-region", "--regions", "r.csv", "--smooth", "off", "--threads", "1"}),
         sections},
        {"hdf5",
         {"reconstruct", "../in/v.h5", "-o", "m.dream3d", "--report", "r.json"},
         {{"v.h5", data("chunked/one.h5")}}},
        {"dicom", {"reconstruct", "../in/v.dcm", "-o", "m.ply"}, {{"v.dcm", data("dicom/explicit.dcm")}}},
        {"points", {"reconstruct", "../in/t.csv", "-o", "m.ply", "--no-background"}, {{"t.csv", table()}}},
        {"smooth", {"smooth", "../in/m.obj", "-o", "m.glb", "--report", "r.json"}, model},
        {"decimate", {"decimate", "../in/m.obj", "-o", "m.obj", "--reduce", "10%"}, model},
        {"convert", {"convert", "../in/m.obj", "m.inp"}, model},
        {"archive", {"convert", "../in/m.obj", "m.3mf"}, model},
        {"check", {"check", "../in/m.obj", "--json", "c.json"}, model},
        {"compare", {"compare", "../in/m.obj", "../in/m.obj", "--json", "c.json", "--distance", "d.vtp"}, model},
        {"voxelise",
         {"voxelise", "../in/m.obj", "--like", "../in/v.raw", "--size", "12,12,12", "--type", "uint8", "-o",
          "l.nii.gz"},
         both},
    };
}

}  // namespace regionmesh::faults
