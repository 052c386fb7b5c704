#include "blocks/sample_hashes.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/fingerprint.h"
#include "base/hash.h"
#include "regionmesh/error.h"

namespace regionmesh {
namespace {

namespace fs = std::filesystem;

constexpr std::uint32_t kTile = SampleHashes::kTile;

fs::path hashes_path(const fs::path& folder) { return folder / kSampleHashes; }

std::uint32_t tiles_along(std::uint32_t samples) { return (samples + kTile - 1) / kTile; }

/// Whole tiles round a box, across the sweep.
IndexBox tiled(const IndexBox& box, const Lattice& lattice, const Sweep& sweep) {
    IndexBox whole = box;
    for (const int axis : {sweep.axes[0], sweep.axes[1]}) {
        whole.low[axis] = box.low[axis] / kTile * kTile;
        whole.high[axis] = std::min(tiles_along(box.high[axis]) * kTile, lattice.size[axis]);
    }
    return whole;
}

}  // namespace

SampleHashes::SampleHashes(const std::array<std::uint32_t, 3>& volume, const Sweep& sweep, const IndexBox& box)
    : volume_(volume), sweep_(sweep), box_(box) {
    const auto [u, v, w] = sweep.axes;
    tiles_ = {{box.low[u] / kTile, box.low[v] / kTile, box.low[w]},
              {tiles_along(box.high[u]), tiles_along(box.high[v]), box.high[w]}};
}

void SampleHashes::grow_to(std::uint32_t number) { sums_.resize(std::max(sums_.size(), offset(number + 1))); }

void SampleHashes::add(std::uint32_t number, std::span<const Label> section, const LabelTable& labels,
                       const std::array<std::uint32_t, 3>& end) {
    const auto [u, v, w] = sweep_.axes;
    if (number >= end[w]) return;
    grow_to(number);
    const std::uint32_t columns = box_.size()[u], last = std::min(end[u], box_.high[u]);
    Label label = section[0];
    std::uint64_t hash = mix64(static_cast<std::uint64_t>(labels.input(label)));
    for (std::uint32_t y = box_.low[v]; y < std::min(end[v], box_.high[v]); ++y) {
        const Label* const row = section.data() + std::size_t{y - box_.low[v]} * columns - box_.low[u];
        const std::uint64_t place = (std::uint64_t{number} * volume_[v] + y) * volume_[u];
        std::uint64_t* const sums = sums_.data() + offset(number) + std::size_t{y / kTile - tiles_.low[1]} * width();
        for (std::uint32_t x = box_.low[u]; x < last;) {
            const std::uint32_t tile = x / kTile, tile_end = std::min((tile + 1) * kTile, last);
            std::uint64_t sum = 0;
            for (; x < tile_end; ++x) {
                if (row[x] != label) {
                    label = row[x];
                    hash = mix64(static_cast<std::uint64_t>(labels.input(label)));
                }
                sum += mix64(hash ^ (place + x));
            }
            sums[tile - tiles_.low[0]] += sum;
        }
    }
}

void SampleHashes::add(const SampleHashes& part) {
    const auto [x, y, z] = part.tiles_.low;
    if (part.sums_.empty()) return;
    grow_to(z + static_cast<std::uint32_t>(part.sums_.size() / part.section_tiles()) - 1);
    for (std::uint32_t n = z; part.offset(n) < part.sums_.size(); ++n)
        for (std::uint32_t row = 0; row < part.height(); ++row) {
            const std::uint64_t* const from = part.sums_.data() + part.offset(n) + std::size_t{row} * part.width();
            std::uint64_t* const to =
                sums_.data() + offset(n) + std::size_t{row + y - tiles_.low[1]} * width() + (x - tiles_.low[0]);
            for (std::uint32_t tile = 0; tile < part.width(); ++tile) to[tile] += from[tile];
        }
}

namespace {

/// Sections of a box, out of those of whole tiles.
class ComparedSections final : public BoxSections {
public:
    ComparedSections(std::unique_ptr<BoxSections> tiles, const IndexBox& read, const IndexBox& box,
                     const LabelTable& labels, const ComparedLabels::Run& run, const formats::InputFile& file)
        : tiles_(std::move(tiles)),
          read_(read),
          box_(box),
          labels_(labels),
          run_(run),
          file_(file),
          next_(box.low[run.sweep.axes[2]]) {}

    void next(std::span<Label> section) override {
        if (read_ == box_) {
            tiles_->next(section);
            compare(section);
        } else {
            const auto [u, v, w] = run_.sweep.axes;
            const std::size_t columns = read_.size()[u], width = box_.size()[u];
            section_.resize(columns * read_.size()[v]);
            tiles_->next(section_);
            compare(section_);
            const Label* from = section_.data() + (box_.low[v] - read_.low[v]) * columns + box_.low[u] - read_.low[u];
            for (std::size_t row = 0; row < box_.size()[v]; ++row)
                std::copy_n(from + row * columns, width, section.data() + row * width);
        }
        ++next_;
    }

private:
    void compare(std::span<const Label> section) {
        if (std::ranges::max(section) >= labels_.size())
            formats::fail(run_.source, "has labels that the folder does not have; remove the folder, and run again");
        const auto [u, v, w] = run_.sweep.axes;
        IndexBox one = read_;
        one.low[w] = next_;
        one.high[w] = next_ + 1;
        SampleHashes found(run_.lattice.size, run_.sweep, one);
        found.add(next_, section, labels_);
        wanted_.resize(found.width());
        const std::uint64_t columns = tiles_along(run_.lattice.size[u]), rows = tiles_along(run_.lattice.size[v]);
        const std::uint32_t first_column = read_.low[u] / kTile, first_row = read_.low[v] / kTile;
        for (std::uint32_t row = 0; row < found.height(); ++row) {
            const std::uint64_t at = ((next_ * rows) + first_row + row) * columns + first_column;
            const auto bytes = std::as_writable_bytes(std::span(wanted_));
            if (file_.read(at * sizeof(std::uint64_t), bytes) != bytes.size())
                formats::fail(file_.path(), "the file ends early; remove the folder, and run again");
            for (std::uint32_t tile = 0; tile < found.width(); ++tile)
                if (found.sums()[std::size_t{row} * found.width() + tile] != wanted_[tile])
                    refuse(first_column + tile, first_row + row);
        }
    }

    [[noreturn]] void refuse(std::uint32_t column, std::uint32_t row) const {
        std::array<std::string, 3> ranges;
        const auto tile = [&](int axis, std::uint32_t n) {
            ranges[axis] = fmt::format("{} to {}", n * kTile, std::min((n + 1) * kTile, run_.lattice.size[axis]) - 1);
        };
        tile(run_.sweep.axes[0], column);
        tile(run_.sweep.axes[1], row);
        ranges[run_.sweep.axes[2]] = fmt::format("{}", next_);
        throw Error(ErrorCode::kInput,
                    fmt::format("{}: its samples at x {}, y {}, z {} are not those that {} was begun with; give the "
                                "volume that it was begun with, or another folder",
                                run_.source, ranges[0], ranges[1], ranges[2], run_.folder.string()));
    }

    std::unique_ptr<BoxSections> tiles_;
    IndexBox read_, box_;
    const LabelTable& labels_;
    const ComparedLabels::Run& run_;
    const formats::InputFile& file_;
    std::uint64_t next_;
    std::vector<Label> section_;
    std::vector<std::uint64_t> wanted_;
};

/// Of all hashes in a file, in their order.
std::uint64_t fingerprint_of(const formats::InputFile& file) {
    Fingerprint fingerprint;
    std::vector<std::uint64_t> hashes(1 << 13);
    const auto bytes = std::as_writable_bytes(std::span(hashes));
    std::uint64_t offset = 0;
    while (const std::size_t read = file.read(offset, bytes)) {
        for (std::size_t n = 0; n < read / sizeof hashes[0]; ++n) fingerprint.add(hashes[n]);
        offset += read;
    }
    return fingerprint.value();
}

}  // namespace

ComparedLabels::ComparedLabels(const LabelBoxes& boxes, const LabelTable& labels, const Run& run)
    : boxes_(boxes), labels_(labels), run_(run), file_(hashes_path(run.folder)) {
    const auto [u, v, w] = run.sweep.axes;
    const auto& size = run.lattice.size;
    const std::uint64_t tiles = std::uint64_t{tiles_along(size[u])} * tiles_along(size[v]) * size[w];
    if (file_.size() != tiles * sizeof(std::uint64_t) || fingerprint_of(file_) != run.fingerprint)
        formats::fail(file_.path(), "is not the file that the run wrote; remove the folder, and run again");
}

std::unique_ptr<BoxSections> ComparedLabels::open(const IndexBox& box) const {
    const IndexBox read = tiled(box, run_.lattice, run_.sweep);
    return std::make_unique<ComparedSections>(boxes_.open(read), read, box, labels_, run_, file_);
}

std::uint64_t write_sample_hashes(const SampleHashes& hashes, const fs::path& folder, const OutputOptions& options) {
    OutputFile file(hashes_path(folder), options);
    file.write({reinterpret_cast<const char*>(hashes.sums().data()), hashes.sums().size_bytes()});
    file.commit();
    Fingerprint fingerprint;
    for (const std::uint64_t sum : hashes.sums()) fingerprint.add(sum);
    return fingerprint.value();
}

}  // namespace regionmesh
