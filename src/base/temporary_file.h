// Temporary storage on disk.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

namespace regionmesh {

/// A file without a name in the folder $TMPDIR, or /tmp: the system deletes it with this object or with the process.
/// Grows at its end and can be read at any offset. Throws Error(kOutput) if the disk is full, and says what to do.
class TemporaryFile {
public:
    TemporaryFile();
    TemporaryFile(TemporaryFile&& other) noexcept;
    TemporaryFile& operator=(TemporaryFile&&) = delete;
    ~TemporaryFile();

    std::uint64_t size() const { return size_; }
    void append(std::span<const std::byte> bytes);
    /// Fills `bytes` from `offset`. Requires that all of them were appended.
    void read(std::uint64_t offset, std::span<std::byte> bytes) const;

    template <class T>
    void append_items(std::span<const T> items) {
        static_assert(std::is_trivially_copyable_v<T>);
        append(std::as_bytes(items));
    }
    /// Reads `count` items from `offset` and returns the offset after them.
    template <class T>
    std::uint64_t read_items(std::uint64_t offset, std::uint64_t count, std::vector<T>& items) const {
        static_assert(std::is_trivially_copyable_v<T>);
        items.resize(count);
        read(offset, std::as_writable_bytes(std::span(items)));
        return offset + count * sizeof(T);
    }

private:
    int descriptor_ = -1;
    std::uint64_t size_ = 0;
};

}  // namespace regionmesh
