#include <algorithm>
#include <cassert>
#include <utility>
#include <vector>

#include "regionmesh/io/flat_reader.h"
#include "regionmesh/io/gzip_stream.h"
#include "regionmesh/io/nifti_header.h"
#include "regionmesh/io/read_formats.h"
#include "regionmesh/io/volume_size.h"

namespace regionmesh::io {
namespace {

constexpr std::uint64_t kPartSamples = std::uint64_t{1} << 17;  // inflated and turned into labels at a time

/// Inflates forward, along z.
class GzipNiftiReader final : public SectionReader {
public:
    GzipNiftiReader(InputFile file, VolumeInfo info, const NiftiHeader& header)
        : stream_(std::move(file)), info_(std::move(info)), header_(header) {}

    const VolumeInfo& info() const override { return info_; }

    bool next(std::span<InputLabel> section) override {
        assert(section.size() == std::size_t{section_width()} * section_height());
        if (next_ == section_count()) return false;
        if (!is_at_data_ && !stream_.skip(header_.data_offset)) refuse();
        is_at_data_ = true;
        const std::size_t bytes = sample_bytes(header_.format.type);
        part_.resize(std::min<std::uint64_t>(kPartSamples, section.size()) * bytes);
        for (std::size_t done = 0; done < section.size();) {
            const std::size_t count = std::min(part_.size() / bytes, section.size() - done);
            if (stream_.read(std::span(part_).first(count * bytes)) < count * bytes) refuse();
            decode_samples(part_.data(), bytes, header_.format, section.subspan(done, count));
            done += count;
        }
        if (next_ + 1 == section_count() && !stream_.finish()) refuse();
        ++next_;
        return true;
    }

    void rewind() override {
        stream_.rewind();
        is_at_data_ = false;
        next_ = 0;
    }

private:
    [[noreturn]] void refuse() const { fail_section(stream_.file().path(), next_, stream_.problem()); }

    GzipStream stream_;
    VolumeInfo info_;
    NiftiHeader header_;
    std::vector<std::byte> part_;
    bool is_at_data_ = false;
    std::uint32_t next_ = 0;
};

VolumeInfo nifti_info(const std::filesystem::path& path, const NiftiHeader& header) {
    VolumeInfo info = volume_info(path, "nifti", header.format.type, header.lattice.size);
    info.lattice = header.lattice;
    return info;
}

std::unique_ptr<SectionReader> open_gzipped(InputFile file, const ReadOptions& options) {
    const std::filesystem::path path = file.path();
    const std::uint64_t packed_bytes = file.size();
    GzipStream start{InputFile(path)};
    std::vector<std::byte> bytes(kNifti2HeaderBytes);
    bytes.resize(start.read(bytes));
    if (bytes.size() < kNifti1HeaderBytes) fail(path, start.problem());
    const NiftiHeader header = parse_nifti_header(path, bytes);
    const std::uint64_t sample = sample_bytes(header.format.type);
    const std::uint64_t needed = volume_bytes(path, header.lattice.size, sample);
    if (needed / kMaxInflation > packed_bytes || header.data_offset / kMaxInflation > packed_bytes) {
        fail(path, "a gzip file of " + std::to_string(packed_bytes) + " bytes cannot hold the " +
                       std::to_string(needed) +
                       " bytes of samples that its header says; the file is truncated, fetch it again");
    }
    VolumeInfo info = nifti_info(path, header);
    apply_options(info, options, "give --sweep z, or decompress the file first (gunzip)");
    return std::make_unique<GzipNiftiReader>(std::move(file), std::move(info), header);
}

}  // namespace

std::unique_ptr<SectionReader> open_nifti(const std::filesystem::path& path, const ReadOptions& options) {
    InputFile file(path);
    std::vector<std::byte> bytes(kNifti2HeaderBytes);
    bytes.resize(file.read(0, bytes));
    if (bytes.size() > 2 && bytes[0] == std::byte{0x1f} && bytes[1] == std::byte{0x8b}) {
        return open_gzipped(std::move(file), options);
    }
    const NiftiHeader header = parse_nifti_header(path, bytes);
    VolumeInfo info = nifti_info(path, header);
    info.can_sweep = {true, true, true};
    return open_flat(std::move(file), std::move(info), {.offset = header.data_offset, .format = header.format},
                     options);
}

}  // namespace regionmesh::io
