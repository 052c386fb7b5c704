#include "formats/input_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

#include "formats/text/header_text.h"
#include "regionmesh/error.h"

namespace regionmesh::formats {
namespace {

std::string why_not_opened(int error) {
    if (error == ENOENT || error == ENOTDIR) return "no such file; check the path";
    if (error == EACCES || error == EPERM) return "permission denied; make the file readable";
    return std::string("cannot be opened: ") + std::strerror(error);
}

}  // namespace

void fail(const std::filesystem::path& path, const std::string& text) {
    std::string line = path.string() + ": " + text;
    // Text from a damaged file or a library must not break the line.
    for (char& c : line) {
        if (static_cast<unsigned char>(c) < ' ' || c == '\x7f') c = '?';
    }
    throw Error(ErrorCode::kInput, line);
}

void fail_section(const std::filesystem::path& path, std::uint64_t section, const std::string& text) {
    fail(path, "section " + std::to_string(section) + ": " + text);
}

InputFile::InputFile(const std::filesystem::path& path) : path_(path) {
    // O_NONBLOCK: a named pipe is refused below instead of blocking.
    const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    if (descriptor < 0) fail(path, why_not_opened(errno));
    struct stat status {};
    const bool has_status = ::fstat(descriptor, &status) == 0;
    if (!has_status || !S_ISREG(status.st_mode)) {
        ::close(descriptor);
        fail(path, has_status && S_ISDIR(status.st_mode) ? "is a directory where a file is expected; name a file in it"
                                                         : "is not a regular file; copy it to one");
    }
    descriptor_ = descriptor;
    size_ = static_cast<std::uint64_t>(status.st_size);
}

InputFile::InputFile(InputFile&& other) noexcept
    : path_(std::move(other.path_)), descriptor_(std::exchange(other.descriptor_, -1)), size_(other.size_) {}

InputFile::~InputFile() {
    if (descriptor_ >= 0) ::close(descriptor_);
}

std::size_t InputFile::read(std::uint64_t offset, std::span<std::byte> bytes) const {
    std::size_t done = 0;
    while (done < bytes.size()) {
        const ssize_t count =
            ::pread(descriptor_, bytes.data() + done, std::min(bytes.size() - done, std::size_t{1} << 30),
                    static_cast<off_t>(offset + done));
        if (count == 0) break;
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) fail(path_, std::string("cannot be read: ") + std::strerror(errno));
        done += static_cast<std::size_t>(count);
    }
    return done;
}

std::string InputFile::text() const {
    std::string text(size_, '\0');
    text.resize(read(0, std::as_writable_bytes(std::span(text))));
    if (text.starts_with(kByteOrderMark)) text.erase(0, kByteOrderMark.size());
    return text;
}

}  // namespace regionmesh::formats
