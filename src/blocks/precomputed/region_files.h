// Where the fragments and the manifests of regions go: files of their own, or shards.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "blocks/precomputed/precomputed.h"

namespace regionmesh {

/// The format neuroglancer_uint64_sharded_v1 with the identity as its hash function and without compression: the
/// lowest bits of an id are the number of its minishard, the next ones that of its shard.
struct ShardLayout {
    std::uint32_t minishard_bits = 0, shard_bits = 0;

    std::uint64_t minishard(std::uint64_t id) const { return id & ((std::uint64_t{1} << minishard_bits) - 1); }
    std::uint64_t shard(std::uint64_t id) const {
        return id >> minishard_bits & ((std::uint64_t{1} << shard_bits) - 1);
    }
    /// The name of its file.
    std::string file(std::uint64_t shard) const;
};

/// About 128 regions in a minishard and up to 64 minishards in a shard, where ids are spread evenly.
ShardLayout shard_layout(std::uint64_t regions);

/// Takes regions one after another: the fragments of each, then its manifest.
class RegionFiles {
public:
    virtual ~RegionFiles() = default;
    virtual void add_fragment(Label region, std::string_view bytes) = 0;
    virtual void add_manifest(Label region, std::string_view bytes) = 0;
    /// After the last region.
    virtual void finish() = 0;
};

/// Two files for each region: ID, and ID.index with the manifest.
std::unique_ptr<RegionFiles> files_of_regions(const Precomputed& precomputed);

/// One file for each shard. Requires regions ordered by shard, minishard and id. Holds the ids of one shard.
std::unique_ptr<RegionFiles> shards_of_regions(const Precomputed& precomputed, ShardLayout layout);

}  // namespace regionmesh
