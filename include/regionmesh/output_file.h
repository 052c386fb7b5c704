// Files that get their name only when they are complete.
#pragma once

#include <sys/stat.h>

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace regionmesh {

/// How files are written.
struct OutputOptions {
    bool force = false;         // replaces files that are read-only
    bool sync = true;           // forces data, and the name, to disk before the file counts as written
    std::uint32_t threads = 0;  // most that compress; 0: one per core
};

/// Writes under a temporary name in the folder of `path` (`.name.part-<pid>`) and renames in commit(); without commit()
/// the destructor removes the temporary file, and an earlier file at `path` stays. A new file keeps the permissions of
/// the earlier one, and its owner where the system allows it. Follows links. Writes
/// an existing path that is no regular file (a device, a pipe that somebody reads) in place. Every write is checked.
/// Throws Error(kOutput) that names the file and the reason: a write that failed, a read-only file without
/// OutputOptions::force, a pipe that nobody reads, a link that leads nowhere.
class OutputFile {
public:
    explicit OutputFile(const std::filesystem::path& path, const OutputOptions& options = {});
    ~OutputFile();
    OutputFile(const OutputFile&) = delete;
    OutputFile& operator=(const OutputFile&) = delete;

    void write(std::string_view bytes);
    /// Replaces bytes written before. Requires a seekable file, which a pipe is not.
    void overwrite(std::uint64_t offset, std::string_view bytes);
    const OutputOptions& options() const { return options_; }
    /// Bytes written so far.
    std::uint64_t size() const { return size_; }
    /// Closes the file under its temporary name. Writes that follow throw Error(kOutput).
    void close();
    /// Closes the file if it is open, and renames it. Does nothing the second time.
    void commit();

private:
    friend class OutputFiles;

    void open();
    void open_in_place();
    void open_temporary(mode_t mode);
    void keep_permissions(const struct stat& earlier);
    void require_open() const;
    void put(std::string_view bytes);
    void take_name();
    void give_back_name();
    void finish();
    void remove_temporary();
    [[noreturn]] void fail(int error_number) const;
    [[noreturn]] void fail(const std::string& reason) const;

    std::filesystem::path path_;       // path as given, for messages
    std::filesystem::path target_;     // links followed
    std::filesystem::path temporary_;  // empty where there is none
    OutputOptions options_;
    std::FILE* file_ = nullptr;
    std::uint64_t size_ = 0;
    enum class Name { kTemporary, kNew, kExchanged, kReplaced } name_ = Name::kTemporary;
};

/// Files that belong together: a model, what lies beside it, its report. None gets its name before all are complete,
/// and where one cannot be renamed those before it get their earlier content back.
class OutputFiles {
public:
    explicit OutputFiles(const OutputOptions& options = {}) : options_(options) {}
    /// Closes the previous file, so that the number of files is not limited by open descriptors. Throws Error(kOutput)
    /// for a file that was added before.
    OutputFile& add(const std::filesystem::path& path);
    /// Renames all files.
    void commit();

private:
    OutputOptions options_;
    std::vector<std::unique_ptr<OutputFile>> files_;
    std::set<std::filesystem::path> targets_;
};

/// Throws Error(kOutput) where no file can be written at `path`: for a check before long work. Removes temporary files
/// that runs which were killed have left for this path, and for NAME-*.EXTENSION where `per_region`; changes nothing
/// else.
void require_writable(const std::filesystem::path& path, const OutputOptions& options = {}, bool per_region = false);

/// Makes the folder unless it is there, or another process makes it meanwhile. Throws Error(kOutput).
void make_folder(const std::filesystem::path& folder);

/// For programs, called once before the first thread starts: SIGINT, SIGTERM and SIGHUP remove the temporary files of
/// all outputs, then end the process as they do by default. Signals that the process ignores stay ignored. A commit is
/// not interrupted.
void remove_outputs_on_signals();

/// Removes the temporary files of all outputs, for a process that is about to end without its destructors.
void remove_outputs() noexcept;

/// Ends the process from any thread, after the temporary files of all outputs are removed. A commit that has begun is
/// waited for, and its outputs stay.
[[noreturn]] void end_without_outputs(int exit_code) noexcept;

}  // namespace regionmesh
