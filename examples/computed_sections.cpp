// A volume that is computed while it is read, and never held: shells of a gyroid, in a memory of 500 MB.
#include <regionmesh/formats.h>
#include <regionmesh/regionmesh.h>

#include <cmath>
#include <cstdio>

class Gyroid : public regionmesh::SectionReader {
public:
    Gyroid() {
        info_.source = "gyroid";
        info_.format = "computed";
        info_.lattice.size = {40, 40, 40};
        info_.lattice.spacing = {0.25, 0.25, 0.25};
    }
    const regionmesh::VolumeInfo& info() const override { return info_; }
    bool next(std::span<regionmesh::InputLabel> section) override {
        if (z_ == section_count()) return false;
        for (std::uint32_t y = 0; y < section_height(); ++y)
            for (std::uint32_t x = 0; x < section_width(); ++x) section[y * section_width() + x] = label(x, y, z_);
        ++z_;
        return true;
    }
    void rewind() override { z_ = 0; }

private:
    regionmesh::InputLabel label(std::uint32_t x, std::uint32_t y, std::uint32_t z) const {
        const double a = 0.25 * x, b = 0.25 * y, c = 0.25 * z;
        const double value = std::sin(a) * std::cos(b) + std::sin(b) * std::cos(c) + std::sin(c) * std::cos(a);
        return value > 0.3 ? 1 : value < -0.3 ? 2 : 0;
    }

    regionmesh::VolumeInfo info_;
    std::uint32_t z_ = 0;
};

int main(int argc, char** argv) {
    if (argc != 2) {
        std::fprintf(stderr, "usage: computed_sections MODEL.vtp\n");
        return 2;
    }
    try {
        Gyroid gyroid;
        const auto made = regionmesh::reconstruct(gyroid, {.reduce = 0.8, .memory = 500'000'000});
        regionmesh::write_mesh(made.mesh, made.labels, argv[1], {.background = made.background});
        std::printf("%llu faces\n", static_cast<unsigned long long>(made.report.final_faces));
        return made.report.check.violation_count() == 0 ? 0 : 3;
    } catch (const regionmesh::Error& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
}
