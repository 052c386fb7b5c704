#include "blocks/precomputed/region_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <optional>

namespace regionmesh {
namespace {

constexpr std::uint64_t kRegionsOfMinishard = 128;
constexpr std::uint32_t kMostMinishardBits = 6;

std::string_view bytes_of(const std::vector<std::uint64_t>& numbers) {
    return {reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(std::uint64_t)};
}

class FilesOfRegions final : public RegionFiles {
public:
    explicit FilesOfRegions(const Precomputed& precomputed) : precomputed_(precomputed) {}

    void add_fragment(Label region, std::string_view bytes) override {
        if (!file_) file_.emplace(precomputed_.output / precomputed_.id(region), precomputed_.options.output);
        file_->write(bytes);
    }
    void add_manifest(Label region, std::string_view bytes) override {
        if (file_) precomputed_.files.commit(*file_, precomputed_.id(region));
        file_.reset();
        precomputed_.write(precomputed_.id(region) + ".index", bytes);
    }
    void finish() override {}

private:
    const Precomputed& precomputed_;
    std::optional<OutputFile> file_;
};

class ShardsOfRegions final : public RegionFiles {
public:
    ShardsOfRegions(const Precomputed& precomputed, ShardLayout layout) : precomputed_(precomputed), layout_(layout) {}

    void add_fragment(Label region, std::string_view bytes) override {
        open(number(region));
        file_->write(bytes);
    }
    void add_manifest(Label region, std::string_view bytes) override {
        const std::uint64_t id = number(region);
        open(id);
        entries_.push_back({id, file_->size() - index_bytes(), bytes.size()});
        file_->write(bytes);
    }
    void finish() override {
        if (file_) close();
    }

private:
    struct Entry {
        std::uint64_t id, start, bytes;  // id, start and bytes of the manifest, from the end of the shard's index
    };

    std::uint64_t number(Label region) const { return static_cast<std::uint64_t>(precomputed_.labels.input(region)); }
    std::uint64_t index_bytes() const { return std::uint64_t{16} << layout_.minishard_bits; }

    void open(std::uint64_t id) {
        const std::uint64_t shard = layout_.shard(id);
        if (file_ && shard == shard_) return;
        if (file_) close();
        shard_ = shard;
        file_.emplace(precomputed_.output / layout_.file(shard), precomputed_.options.output);
        file_->write(std::string(index_bytes(), '\0'));
    }

    /// Writes the index of each minishard, as three lists of differences, and where they are.
    void close() {
        std::vector<std::uint64_t> index;
        for (std::uint64_t minishard = 0; minishard < std::uint64_t{1} << layout_.minishard_bits; ++minishard) {
            std::vector<std::uint64_t> ids, starts, sizes;
            std::uint64_t last_id = 0, last_end = 0;
            for (const Entry& entry : entries_) {
                if (layout_.minishard(entry.id) != minishard) continue;
                ids.push_back(entry.id - last_id);
                starts.push_back(entry.start - last_end);
                sizes.push_back(entry.bytes);
                last_id = entry.id;
                last_end = entry.start + entry.bytes;
            }
            index.push_back(file_->size() - index_bytes());
            for (const auto* list : {&ids, &starts, &sizes}) file_->write(bytes_of(*list));
            index.push_back(file_->size() - index_bytes());
        }
        file_->overwrite(0, bytes_of(index));
        precomputed_.files.commit(*file_, layout_.file(shard_));
        file_.reset();
        entries_.clear();
    }

    const Precomputed& precomputed_;
    ShardLayout layout_;
    std::uint64_t shard_ = 0;
    std::optional<OutputFile> file_;
    std::vector<Entry> entries_;
};

}  // namespace

std::string ShardLayout::file(std::uint64_t shard) const {
    return fmt::format("{:0{}x}.shard", shard, (shard_bits + 3) / 4);
}

ShardLayout shard_layout(std::uint64_t regions) {
    const std::uint64_t minishards = (regions + kRegionsOfMinishard - 1) / kRegionsOfMinishard;
    const auto bits = static_cast<std::uint32_t>(std::bit_width(std::max<std::uint64_t>(minishards, 1) - 1));
    const std::uint32_t minishard_bits = std::min(bits, kMostMinishardBits);
    return {minishard_bits, bits - minishard_bits};
}

std::unique_ptr<RegionFiles> files_of_regions(const Precomputed& precomputed) {
    return std::make_unique<FilesOfRegions>(precomputed);
}

std::unique_ptr<RegionFiles> shards_of_regions(const Precomputed& precomputed, ShardLayout layout) {
    return std::make_unique<ShardsOfRegions>(precomputed, layout);
}

}  // namespace regionmesh
