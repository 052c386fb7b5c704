// Random access to a file, and errors that name it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

namespace regionmesh::formats {

/// Throws Error(kInput) "path: text".
[[noreturn]] void fail(const std::filesystem::path& path, const std::string& text);

/// Throws Error(kInput) "path: section 17: text"; sections count from 0.
[[noreturn]] void fail_section(const std::filesystem::path& path, std::uint64_t section, const std::string& text);

/// A regular file. Its length is determined once, when it is opened.
class InputFile {
public:
    /// Throws Error(kInput) where the file is missing, a directory, not readable or not a regular file.
    explicit InputFile(const std::filesystem::path& path);
    InputFile(InputFile&& other) noexcept;
    InputFile& operator=(InputFile&&) = delete;
    ~InputFile();

    const std::filesystem::path& path() const { return path_; }
    std::uint64_t size() const { return size_; }

    /// Fills `bytes` from `offset` and returns the number of bytes read, fewer than asked for only at the end of the
    /// file.
    std::size_t read(std::uint64_t offset, std::span<std::byte> bytes) const;

    /// All of it, for small files; without the mark of UTF-8 that some editors begin a file with.
    std::string text() const;

private:
    std::filesystem::path path_;
    int descriptor_ = -1;
    std::uint64_t size_ = 0;
};

}  // namespace regionmesh::formats
