#include "regionmesh/output_file.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "regionmesh/error.h"

namespace regionmesh {
namespace {

constexpr std::size_t kBufferBytes = 1 << 18;
constexpr std::size_t kLongestName =
    200;                               // of the 255 bytes of a file name: leaves room for the rest of a temporary name
constexpr int kMostTemporaries = 100;  // left by killed processes with the same process id

}  // namespace

OutputFile::OutputFile(const std::filesystem::path& path) : path_(path), target_(path) {
    std::error_code ignored;
    const auto status = std::filesystem::status(path, ignored);
    if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status)) {
        file_ = std::fopen(path.c_str(), "wb");
    } else {
        if (std::filesystem::is_symlink(path, ignored)) {
            const auto followed = std::filesystem::weakly_canonical(path, ignored);
            if (!followed.empty()) target_ = followed;
        }
        open_temporary();
    }
    if (!file_) fail(errno);
    std::setvbuf(file_, nullptr, _IOFBF, kBufferBytes);
}

void OutputFile::open_temporary() {
    const std::string name =
        fmt::format(".{}.part-{}", target_.filename().string().substr(0, kLongestName), ::getpid());
    for (int attempt = 0; attempt < kMostTemporaries; ++attempt) {
        const auto temporary = target_.parent_path() / (attempt == 0 ? name : fmt::format("{}-{}", name, attempt));
        file_ = std::fopen(temporary.c_str(), "wbx");
        if (file_) temporary_ = temporary;
        if (file_ || errno != EEXIST) return;
    }
}

OutputFile::~OutputFile() {
    if (file_) std::fclose(file_);
    std::error_code ignored;
    if (!temporary_.empty()) std::filesystem::remove(temporary_, ignored);
}

void OutputFile::write(std::string_view bytes) {
    put(bytes);
    size_ += bytes.size();
}

void OutputFile::overwrite(std::uint64_t offset, std::string_view bytes) {
    if (::fseeko(file_, static_cast<off_t>(offset), SEEK_SET) != 0) fail(errno);
    put(bytes);
    if (::fseeko(file_, 0, SEEK_END) != 0) fail(errno);
}

void OutputFile::put(std::string_view bytes) {
    if (std::fwrite(bytes.data(), 1, bytes.size(), file_) != bytes.size()) fail(errno);
}

void OutputFile::close() {
    std::FILE* const file = file_;
    file_ = nullptr;
    if (file && std::fclose(file) != 0) fail(errno);
}

void OutputFile::commit() {
    close();
    if (temporary_.empty()) return;
    std::error_code error;
    std::filesystem::rename(temporary_, target_, error);
    if (error) fail(error.value());
    temporary_.clear();
}

void OutputFile::fail(int error_number) const {
    throw Error(ErrorCode::kOutput, fmt::format("{}: cannot be written: {}", path_.string(),
                                                std::generic_category().message(error_number)));
}

OutputFile& OutputFiles::add(const std::filesystem::path& path) {
    if (!files_.empty()) files_.back()->close();
    return *files_.emplace_back(std::make_unique<OutputFile>(path));
}

void OutputFiles::commit() {
    for (const auto& file : files_) file->close();
    for (const auto& file : files_) file->commit();
}

void require_writable(const std::filesystem::path& path) {
    std::error_code ignored;
    const auto status = std::filesystem::status(path, ignored);
    if (!std::filesystem::exists(status) || std::filesystem::is_regular_file(status)) const OutputFile probe(path);
}

}  // namespace regionmesh
