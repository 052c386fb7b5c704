// Files that get their name only when they are complete.
#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace regionmesh {

/// Writes under a temporary name in the folder of `path` (`.name.part-<pid>`) and renames in commit(); without commit()
/// the destructor removes the temporary file, and an earlier file at `path` stays. Follows links. Writes an existing
/// path that is no regular file (a device, a pipe) in place. Every write is checked: a failure throws Error(kOutput)
/// that names the file and the reason. Does not force data to disk, so it does not protect against loss of power.
class OutputFile {
public:
    explicit OutputFile(const std::filesystem::path& path);
    ~OutputFile();
    OutputFile(const OutputFile&) = delete;
    OutputFile& operator=(const OutputFile&) = delete;

    void write(std::string_view bytes);
    /// Replaces bytes written before. Requires a seekable file, which a pipe is not.
    void overwrite(std::uint64_t offset, std::string_view bytes);
    /// Bytes written so far.
    std::uint64_t size() const { return size_; }
    /// Closes the file under its temporary name. No writes may follow.
    void close();
    /// Closes the file if it is open, and renames it.
    void commit();

private:
    void open_temporary();
    void put(std::string_view bytes);
    [[noreturn]] void fail(int error_number) const;

    std::filesystem::path path_;       // as given, for messages
    std::filesystem::path target_;     // links followed
    std::filesystem::path temporary_;  // empty where there is none
    std::FILE* file_ = nullptr;
    std::uint64_t size_ = 0;
};

/// Files that belong together: none gets its name before all are complete.
class OutputFiles {
public:
    /// Closes the previous file, so that the number of files is not limited by open descriptors.
    OutputFile& add(const std::filesystem::path& path);
    /// Renames all files. If one fails, those before it keep their new names.
    void commit();

private:
    std::vector<std::unique_ptr<OutputFile>> files_;
};

/// Throws Error(kOutput) where no file can be written at `path`; changes nothing. For a check before long work.
void require_writable(const std::filesystem::path& path);

}  // namespace regionmesh
