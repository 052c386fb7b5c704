#include "regionmesh/output_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <exception>
#include <system_error>
#include <utility>

#include "formats/part_files.h"
#include "regionmesh/error.h"

namespace regionmesh {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kBufferBytes = 1 << 18;
constexpr int kMostTemporaries = 100;  // left by killed processes with the same process id
constexpr mode_t kPermissions = 07777, kAnyWrite = 0222, kPrivate = 0600, kAsUsual = 0666;

fs::path folder_of(const fs::path& path) { return path.has_parent_path() ? path.parent_path() : fs::path("."); }

/// Some file systems have no folders to force; what they cannot do is no failure.
bool sync_file(int file) {
    int done = 0;
    while ((done = ::fsync(file)) != 0 && errno == EINTR) {
    }
    return done == 0 || errno == EINVAL || errno == EROFS || errno == ENOTSUP;
}

bool sync_folder(const fs::path& folder) {
    const int file = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (file < 0) return errno == EACCES;  // a folder that may be written but not read
    const bool is_done = sync_file(file);
    const int problem = errno;
    ::close(file);
    errno = problem;
    return is_done;
}

}  // namespace

OutputFile::OutputFile(const fs::path& path, const OutputOptions& options)
    : path_(path), target_(path), options_(options) {
    open();
    std::setvbuf(file_, nullptr, _IOFBF, kBufferBytes);
}

void OutputFile::open() {
    struct stat link {
    }, status{};
    const bool exists = ::stat(path_.c_str(), &status) == 0;
    if (exists && !S_ISREG(status.st_mode)) return open_in_place();
    if (::lstat(path_.c_str(), &link) == 0 && S_ISLNK(link.st_mode)) {
        std::error_code error;
        target_ = fs::weakly_canonical(path_, error);
        // Still a link: it names itself in the end.
        if (error || target_.empty() || fs::is_symlink(target_, error))
            fail("is a link that leads nowhere; remove it or name a file");
    }
    if (exists && !options_.force && ((status.st_mode & kAnyWrite) == 0 || ::access(target_.c_str(), W_OK) != 0))
        fail("is read-only; make it writable, give another name or --force");
    open_temporary(exists ? kPrivate : kAsUsual);
    if (exists) keep_permissions(status);
}

/// A device, or a pipe, to which a link may lead that no path follows, as /dev/stdout.
void OutputFile::open_in_place() {
    // O_NONBLOCK: a pipe that nobody reads is refused instead of waited for.
    const int file = ::open(path_.c_str(), O_WRONLY | O_TRUNC | O_CLOEXEC | O_NONBLOCK);
    if (file < 0 && errno == ENXIO) fail("is a pipe that nobody reads; start its reader first");
    if (file < 0) fail(errno);
    ::fcntl(file, F_SETFL, ::fcntl(file, F_GETFL) & ~O_NONBLOCK);
    file_ = ::fdopen(file, "wb");
    if (!file_) {
        ::close(file);
        fail(ENOMEM);
    }
}

void OutputFile::open_temporary(mode_t mode) {
    int file = -1;
    for (int attempt = 0; file < 0 && attempt < kMostTemporaries; ++attempt) {
        fs::path temporary = folder_of(target_) / formats::part_name(target_, attempt);
        file = formats::create_part(this, temporary, mode);
        if (file >= 0) temporary_ = std::move(temporary);  // allocates nothing: the file would be left behind
        if (file < 0 && errno != EEXIST) break;
    }
    int problem = errno;
    if (file >= 0) {
        ::flock(file, LOCK_EX | LOCK_NB);  // tells other runs that the file is in use, where the file system has locks
        file_ = ::fdopen(file, "wb");
        problem = errno;
        if (!file_) ::close(file);
    }
    if (file_) return;
    remove_temporary();
    fail(problem);
}

/// The file was private until now: an earlier one may have been, too. Root also keeps the owner; for others the file
/// becomes theirs, as any new file.
void OutputFile::keep_permissions(const struct stat& earlier) {
    const int file = ::fileno(file_);
    if (earlier.st_uid != ::geteuid() || earlier.st_gid != ::getegid())
        (void)!::fchown(file, earlier.st_uid, earlier.st_gid);
    // File systems without permissions refuse, and need none.
    if (::fchmod(file, earlier.st_mode & kPermissions) != 0 && errno != EPERM && errno != ENOTSUP) {
        const int problem = errno;
        std::fclose(file_);
        remove_temporary();
        fail(problem);
    }
}

OutputFile::~OutputFile() {
    if (file_) std::fclose(file_);
    remove_temporary();
}

void OutputFile::write(std::string_view bytes) {
    put(bytes);
    size_ += bytes.size();
}

void OutputFile::overwrite(std::uint64_t offset, std::string_view bytes) {
    require_open();
    if (::fseeko(file_, static_cast<off_t>(offset), SEEK_SET) != 0) {
        if (errno == ESPIPE)
            fail("is a pipe, and this format is not written in one go; name a file, or a .ply or .stl");
        fail(errno);
    }
    put(bytes);
    if (::fseeko(file_, 0, SEEK_END) != 0) fail(errno);
}

void OutputFile::require_open() const {
    if (!file_) fail("is closed already; nothing can follow");
}

void OutputFile::put(std::string_view bytes) {
    if (bytes.empty()) return;  // data() may be null, which fwrite does not allow
    require_open();
    if (std::fwrite(bytes.data(), 1, bytes.size(), file_) != bytes.size()) fail(errno);
}

void OutputFile::close() {
    if (!file_) return;
    const bool is_flushed = std::fflush(file_) == 0;
    const bool is_safe = is_flushed && (!options_.sync || temporary_.empty() || sync_file(::fileno(file_)));
    const int problem = errno;
    std::FILE* const file = file_;
    file_ = nullptr;
    const bool is_closed = std::fclose(file) == 0;
    if (!is_flushed || !is_safe) fail(problem);
    if (!is_closed) fail(errno);
}

void OutputFile::commit() {
    if (name_ == Name::kReplaced) return;
    close();
    const formats::PartsHeld held;
    take_name();
    finish();
}

/// Gives the file its name, and keeps the earlier file under the temporary one where the system can exchange the two.
void OutputFile::take_name() {
    if (temporary_.empty()) return;
    const char *from = temporary_.c_str(), *to = target_.c_str();
    if (::renameat2(AT_FDCWD, from, AT_FDCWD, to, RENAME_EXCHANGE) == 0) {
        name_ = Name::kExchanged;
    } else if (::renameat2(AT_FDCWD, from, AT_FDCWD, to, RENAME_NOREPLACE) == 0) {
        name_ = Name::kNew;
    } else if (::rename(from, to) == 0) {
        name_ = Name::kReplaced;
    } else {
        fail(errno);
    }
}

/// Gives the earlier file its name back, as far as the system can.
void OutputFile::give_back_name() {
    if (name_ == Name::kExchanged)
        ::renameat2(AT_FDCWD, temporary_.c_str(), AT_FDCWD, target_.c_str(), RENAME_EXCHANGE);
    if (name_ == Name::kNew) ::unlink(target_.c_str());
    if (name_ != Name::kReplaced) name_ = Name::kTemporary;
}

/// Removes the earlier file: from here on the new one stays.
void OutputFile::finish() {
    if (temporary_.empty()) return;
    if (name_ == Name::kExchanged) ::unlink(temporary_.c_str());
    name_ = Name::kReplaced;
    if (options_.sync && !sync_folder(folder_of(target_))) fail(errno);
}

void OutputFile::remove_temporary() {
    if (!temporary_.empty() && (name_ == Name::kTemporary || name_ == Name::kExchanged)) ::unlink(temporary_.c_str());
    formats::forget_part(this);
}

void OutputFile::fail(int error_number) const {
    const char* advice = error_number == ENOENT ? "; make its folder first" : "";
    fail("cannot be written: " + std::generic_category().message(error_number) + advice);
}

void OutputFile::fail(const std::string& reason) const {
    throw Error(ErrorCode::kOutput, fmt::format("{}: {}", path_.string(), reason));
}

OutputFile& OutputFiles::add(const fs::path& path) {
    if (!files_.empty()) files_.back()->close();
    auto file = std::make_unique<OutputFile>(path, options_);
    if (!file->temporary_.empty() && !targets_.insert(file->target_).second)
        file->fail("is one of these files already; give another name");
    return *files_.emplace_back(std::move(file));
}

void OutputFiles::commit() {
    for (const auto& file : files_) file->close();
    const formats::PartsHeld held;
    try {
        for (const auto& file : files_) file->take_name();
    } catch (...) {
        for (const auto& file : files_) file->give_back_name();
        throw;
    }
    // All have their names now: what fails with one must not keep the earlier bytes of the others.
    std::exception_ptr problem;
    for (const auto& file : files_) {
        try {
            file->finish();
        } catch (...) {
            if (!problem) problem = std::current_exception();
        }
    }
    if (problem) std::rethrow_exception(problem);
}

void require_writable(const fs::path& path, const OutputOptions& options, bool per_region) {
    std::error_code ignored;
    const auto status = fs::status(path, ignored);
    if (fs::exists(status) && !fs::is_regular_file(status)) {
        if (fs::is_directory(status)) const OutputFile refused(path, options);
        return;
    }
    const fs::path target = fs::is_symlink(path, ignored) ? fs::weakly_canonical(path, ignored) : path;
    formats::remove_stale_parts(target, per_region);
    const OutputFile probe(path, options);
}

void make_folder(const fs::path& folder) {
    std::error_code error;
    if (!fs::is_directory(folder, error)) fs::create_directory(folder, error);
    if (error)
        throw Error(ErrorCode::kOutput, folder.string() + ": cannot be made: " + error.message() +
                                            "; name a folder in one that exists and may be written");
}

}  // namespace regionmesh
