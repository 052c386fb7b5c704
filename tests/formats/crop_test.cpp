// Readers that leave out all samples but those of a box read the labels that the whole has there.
#include <gtest/gtest.h>

#include <set>

#include "formats/array/read_volume.h"

namespace regionmesh {
namespace {

namespace fs = std::filesystem;

/// All good volumes below some folders of the test data that can be opened without options.
std::vector<fs::path> volumes() {
    std::vector<fs::path> found;
    for (const char* folder : {"npy", "nifti", "nrrd", "meta", "mgh", "inr", "vti", "tiff", "chunked"})
        for (auto entry = fs::recursive_directory_iterator(data(folder)); entry != fs::recursive_directory_iterator();
             ++entry) {
            const std::string extension = entry->path().extension();
            const bool is_store = extension == ".zarr" || extension == ".n5";
            if (entry->path().filename() == "bad" || is_store) entry.disable_recursion_pending();
            if (is_store || (entry->is_regular_file() && entry->path().string().find("/bad/") == std::string::npos))
                found.push_back(entry->path());
        }
    return found;
}

std::unique_ptr<SectionReader> open_if_good(const fs::path& path, SweepChoice sweep) {
    try {
        return open_sections({path}, {.sweep = sweep});
    } catch (const Error&) {
        return nullptr;  // a part of another file, or no such sweep
    }
}

/// Of a volume with a sample at least along each axis: without the first and the last where there are more than two.
IndexBox inner_box(const std::array<std::uint32_t, 3>& size) {
    IndexBox box{{0, 0, 0}, size};
    for (int axis = 0; axis < 3; ++axis) {
        box.low[axis] = size[axis] > 1 ? 1 : 0;
        box.high[axis] = size[axis] > 2 ? size[axis] - 1 : size[axis];
    }
    return box;
}

void expect_part(const Volume& whole, const IndexBox& box, SectionReader& reader) {
    const auto size = box.size(), all = whole.info.lattice.size;
    ASSERT_EQ(reader.info().lattice.size, size);
    const std::vector<InputLabel> labels = pull(reader);
    std::size_t n = 0, wrong = 0;
    for (std::uint32_t z = box.low[2]; z < box.high[2]; ++z)
        for (std::uint32_t y = box.low[1]; y < box.high[1]; ++y)
            for (std::uint32_t x = box.low[0]; x < box.high[0]; ++x)
                wrong += labels[n++] != whole.labels[(std::size_t{z} * all[1] + y) * all[0] + x];
    EXPECT_EQ(wrong, 0u);
    const Vec3 corner = whole.info.lattice.place_of({double(box.low[0]), double(box.low[1]), double(box.low[2])});
    EXPECT_LT(length(reader.info().lattice.origin - corner), 1e-9);
}

TEST(Crop, gives_the_labels_of_the_whole_in_every_format_and_sweep) {
    std::set<std::string> formats;
    for (const fs::path& path : volumes())
        for (const SweepChoice sweep : {SweepChoice::kX, SweepChoice::kY, SweepChoice::kZ}) {
            const auto first = open_if_good(path, sweep);
            if (!first) continue;
            SCOPED_TRACE(path.string() + " sweep " + std::to_string(static_cast<int>(sweep)));
            const auto reader = open_sections({path}, {.sweep = sweep});
            const IndexBox box = inner_box(reader->info().lattice.size);
            if (!reader->crop(box)) continue;
            formats.insert(reader->info().format);
            const Volume whole{first->info(), pull(*first)};
            expect_part(whole, box, *reader);
            // A part of the part, after all sections were read.
            const IndexBox inside = inner_box(box.size());
            ASSERT_TRUE(reader->crop(inside));
            IndexBox nested = box;
            for (int axis = 0; axis < 3; ++axis) {
                nested.high[axis] = box.low[axis] + inside.high[axis];
                nested.low[axis] = box.low[axis] + inside.low[axis];
            }
            expect_part(whole, nested, *reader);
        }
    for (const char* format : {"npy", "nifti", "nrrd", "metaimage", "mgh", "zarr", "n5", "hdf5", "tiff"})
        EXPECT_TRUE(formats.contains(format)) << format << " cannot be read in boxes";
}

}  // namespace
}  // namespace regionmesh
