#include "formats/array/read_pipe.h"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string>

#include "formats/array/stream_reader.h"
#include "formats/array/volume_size.h"

namespace regionmesh::formats {
namespace {

class StandardInput final : public ByteStream {
public:
    std::size_t read(std::span<std::byte> bytes) override {
        std::size_t done = 0;
        while (done < bytes.size()) {
            const ssize_t count = ::read(STDIN_FILENO, bytes.data() + done, bytes.size() - done);
            if (count < 0 && errno == EINTR) continue;
            if (count < 0) problem_ = std::string("cannot be read: ") + std::strerror(errno);
            if (count <= 0) break;
            done += static_cast<std::size_t>(count);
        }
        return done;
    }
    void rewind() override {}  // never called: VolumeInfo::can_rewind is false
    bool finish() override {
        std::byte more;
        if (read(std::span(&more, 1)) == 0) return true;
        problem_ = "goes on after the last sample; check size and type";
        return false;
    }
    const std::string& problem() const override { return problem_; }

private:
    std::string problem_ = "ends before the last sample; check size and type";
};

}  // namespace

std::unique_ptr<SectionReader> open_pipe(const ReadOptions& options) {
    const std::filesystem::path name = "standard input";
    auto stream = std::make_unique<StandardInput>();
    StreamedHeader header{};
    if (options.raw_size && options.raw_type) {
        const auto [x, y, z] = *options.raw_size;
        header = {checked_size(name, {x, y, z}), {.type = *options.raw_type}};
    } else {
        header = read_npy_header(name, *stream);
    }
    volume_bytes(name, header.size, sample_bytes(header.format));  // refuses what no file holds
    VolumeInfo info = volume_info(name, "pipe", header.format.type, header.size);
    info.can_rewind = false;
    return open_stream(std::move(stream), std::move(info), {.format = header.format}, options,
                       "sections come in this order only");
}

}  // namespace regionmesh::formats
