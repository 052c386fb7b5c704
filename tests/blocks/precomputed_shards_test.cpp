#include <gtest/gtest.h>

#include <cstring>
#include <fstream>
#include <map>
#include <sstream>

#include "blocks/precomputed/region_files.h"
#include "formats/temporary_folder.h"

namespace regionmesh {
namespace {

class Shards : public TemporaryFolder {};

std::uint64_t word_at(const std::string& bytes, std::uint64_t at) {
    std::uint64_t word = 0;
    EXPECT_LE(at + 8, bytes.size());
    if (at + 8 <= bytes.size()) std::memcpy(&word, bytes.data() + at, 8);
    return word;
}

/// Looks an id up as a reader does, and returns the place of its manifest; nothing where it is not found.
std::string manifest_of(const std::string& shard, const ShardLayout& layout, std::uint64_t id) {
    const std::uint64_t base = std::uint64_t{16} << layout.minishard_bits, entry = 16 * layout.minishard(id);
    const std::uint64_t first = base + word_at(shard, entry), count = (base + word_at(shard, entry + 8) - first) / 24;
    std::uint64_t found = 0, start = base;
    for (std::uint64_t n = 0; n < count; ++n) {
        found += word_at(shard, first + 8 * n);
        start += word_at(shard, first + 8 * (count + n));
        const std::uint64_t bytes = word_at(shard, first + 8 * (2 * count + n));
        if (found == id) return shard.substr(start, bytes);
        start += bytes;
    }
    return "";
}

TEST_F(Shards, find_every_id_in_its_shard_and_minishard) {
    NewFiles written(path(""));
    LabelTable labels(true);
    const Precomputed precomputed{path(""), labels, {}, written};
    const ShardLayout layout{.minishard_bits = 2, .shard_bits = 5};
    std::map<std::array<std::uint64_t, 3>, Label> order;
    for (std::uint64_t n = 0; n < 300; ++n) {
        const std::uint64_t id = n * n * n + (n % 7 == 0 ? std::uint64_t{1} << 63 : 0);
        const Label label = labels.dense(static_cast<InputLabel>(id));
        order[{layout.shard(id), layout.minishard(id), id}] = label;
    }
    const auto files = shards_of_regions(precomputed, layout);
    for (const auto& [place, label] : order) {
        files->add_fragment(label, "fragment of " + precomputed.id(label));
        files->add_manifest(label, "manifest of " + precomputed.id(label));
    }
    files->finish();
    for (const auto& [place, label] : order) {
        const std::uint64_t id = place[2];
        std::ifstream stream(path(layout.file(layout.shard(id))), std::ios::binary);
        std::stringstream bytes;
        bytes << stream.rdbuf();
        EXPECT_EQ(manifest_of(bytes.str(), layout, id), "manifest of " + std::to_string(id));
        EXPECT_NE(bytes.str().find("fragment of " + std::to_string(id) + "manifest of " + std::to_string(id)),
                  std::string::npos);
    }
    EXPECT_EQ(layout.file(10), "0a.shard");  // of 32: two digits
}

TEST(ShardLayout, grows_with_the_number_of_regions) {
    EXPECT_EQ(shard_layout(1).file(0), "0.shard");
    EXPECT_EQ(shard_layout(128).minishard_bits, 0u);
    EXPECT_EQ(shard_layout(129).minishard_bits, 1u);
    EXPECT_EQ(shard_layout(128 * 64).shard_bits, 0u);
    EXPECT_EQ(shard_layout(128 * 64 + 1).shard_bits, 1u);
    EXPECT_EQ(shard_layout(1000000).minishard_bits, 6u);
}

}  // namespace
}  // namespace regionmesh
