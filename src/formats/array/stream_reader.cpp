#include "formats/array/stream_reader.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "base/add_warning.h"
#include "formats/array/numbered_sections.h"
#include "formats/array/volume_size.h"

namespace regionmesh::formats {
namespace {

constexpr std::uint64_t kPartSamples = std::uint64_t{1} << 17;  // read and decoded at a time
constexpr std::uint64_t kMostPartBytes = std::uint64_t{1} << 20;
constexpr const char* kMore =
    "more than its samples is compressed in it; the rest was not read, nor its checksum compared";

class StreamReader final : public NumberedSections {
public:
    StreamReader(std::unique_ptr<ByteStream> stream, VolumeInfo info, const StreamLayout& layout)
        : NumberedSections(std::move(info)), stream_(std::move(stream)), layout_(layout) {}

    void rewind() override {
        NumberedSections::rewind();
        stream_->rewind();
        is_at_data_ = false;
    }

private:
    void read_section(std::uint32_t number, std::span<InputLabel> section) override {
        const auto refuse = [&] { fail_section(info_.source, number, stream_->problem()); };
        if (!is_at_data_ && !stream_->skip(layout_.offset)) refuse();
        is_at_data_ = true;
        const std::size_t bytes = sample_bytes(layout_.format), pitch = bytes * layout_.components;
        const std::size_t part = std::clamp<std::size_t>(kMostPartBytes / pitch, 1, kPartSamples);
        part_.resize(std::min(part, section.size()) * pitch);
        for (std::size_t done = 0; done < section.size();) {
            const std::size_t count = std::min(part_.size() / pitch, section.size() - done);
            if (stream_->read(std::span(part_).first(count * pitch)) < count * pitch) refuse();
            require_labels(decode_samples(part_.data() + layout_.component * bytes, pitch, layout_.format,
                                          section.subspan(done, count)),
                           number, done);
            done += count;
        }
        if (number + 1 < section_count()) return;
        if (!stream_->finish()) refuse();
        if (!stream_->is_read_to_end() && info_.warning.find(kMore) == std::string::npos)
            add_warning(info_.warning, kMore);
    }

    std::unique_ptr<ByteStream> stream_;
    StreamLayout layout_;
    std::vector<std::byte> part_;
    bool is_at_data_ = false;
};

}  // namespace

std::unique_ptr<SectionReader> open_stream(std::unique_ptr<ByteStream> stream, VolumeInfo info,
                                           const StreamLayout& given, const ReadOptions& options,
                                           const std::string& remedy) {
    StreamLayout layout = given;
    order_reals(options, layout.format, info);
    apply_options(info, options, remedy);
    return std::make_unique<StreamReader>(std::move(stream), std::move(info), layout);
}

void check_inflated(const std::filesystem::path& path, std::uint64_t packed_bytes, std::uint64_t needed) {
    if (needed / kMaxInflation <= packed_bytes) return;
    fail(path, "compressed samples of " + std::to_string(packed_bytes) + " bytes cannot hold the " +
                   std::to_string(needed) + " that its header says; the file is truncated, fetch it again");
}

}  // namespace regionmesh::formats
