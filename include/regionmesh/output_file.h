// A file that stands under its name only when it is whole.
#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace regionmesh {

/// Writes under a temporary name in the directory of `path` (`.name.part-<pid>`) and renames in `commit`; without that
/// the destructor removes it, and what stood under `path` before still stands. A link is followed. A path that is there
/// and is no regular file (a device, a pipe) is written in place. Every write is checked: a failure throws
/// Error(kOutput) that names the file and the reason. Does not survive loss of power: nothing is forced to the disk.
class OutputFile {
public:
    explicit OutputFile(const std::filesystem::path& path);
    ~OutputFile();
    OutputFile(const OutputFile&) = delete;
    OutputFile& operator=(const OutputFile&) = delete;

    void write(std::string_view bytes);
    /// Writes over bytes written before. Requires a file that can be sought, which a pipe cannot.
    void overwrite(std::uint64_t offset, std::string_view bytes);
    /// Bytes written so far.
    std::uint64_t size() const { return size_; }
    /// Closes the file under its temporary name. Nothing may be written afterwards.
    void close();
    /// Closes the file if that is to be done, and gives it its name.
    void commit();

private:
    void open_temporary();
    void put(std::string_view bytes);
    [[noreturn]] void fail(int error_number) const;

    std::filesystem::path path_;       // as the caller named it, for messages
    std::filesystem::path target_;     // links followed
    std::filesystem::path temporary_;  // empty when there is none to remove
    std::FILE* file_ = nullptr;
    std::uint64_t size_ = 0;
};

/// Files that belong together: none has its name before all are whole.
class OutputFiles {
public:
    /// Closes the file before, so that any number can wait.
    OutputFile& add(const std::filesystem::path& path);
    /// Gives all files their names. Should the system refuse one of them, those before it stand.
    void commit();

private:
    std::vector<std::unique_ptr<OutputFile>> files_;
};

/// Throws Error(kOutput) where a file could not be written at `path`; leaves all as it is. For a look before long work.
void require_writable(const std::filesystem::path& path);

}  // namespace regionmesh
