// A growing array of plain data that does not copy large blocks when it grows and whose unused end costs no memory.
#pragma once

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <new>
#include <type_traits>
#include <utility>

#include "regionmesh/huge_pages.h"

namespace regionmesh {

/// Like std::vector for trivially copyable T, but grown by realloc: the C library moves large blocks by remapping
/// pages, so growth neither copies nor holds two blocks at the same time. Pages beyond `size()` are never touched.
template <class T>
class FlatArray {
    static_assert(std::is_trivially_copyable_v<T>);

public:
    FlatArray() = default;
    FlatArray(FlatArray&& other) noexcept { swap(other); }
    FlatArray& operator=(FlatArray&& other) noexcept {
        FlatArray moved(std::move(other));
        swap(moved);
        return *this;
    }
    FlatArray(const FlatArray&) = delete;
    FlatArray& operator=(const FlatArray&) = delete;
    ~FlatArray() { std::free(data_); }

    std::uint32_t size() const { return size_; }
    bool empty() const { return size_ == 0; }
    T* data() { return data_; }
    const T* data() const { return data_; }
    T& operator[](std::uint32_t i) {
        assert(i < size_);
        return data_[i];
    }
    const T& operator[](std::uint32_t i) const {
        assert(i < size_);
        return data_[i];
    }
    T* begin() { return data_; }
    T* end() { return data_ + size_; }
    const T* begin() const { return data_; }
    const T* end() const { return data_ + size_; }

    void reserve(std::size_t capacity) {
        if (capacity <= capacity_) return;
        if (capacity > std::numeric_limits<std::size_t>::max() / sizeof(T)) throw std::bad_alloc();
        T* grown = static_cast<T*>(std::realloc(static_cast<void*>(data_), capacity * sizeof(T)));
        if (!grown) throw std::bad_alloc();
        data_ = grown;
        capacity_ = capacity;
        prefer_huge_pages(data_, capacity * sizeof(T));
    }
    void push_back(const T& value) {
        const T copy = value;
        if (size_ == capacity_) reserve(capacity_ < 1024 ? 1024 : capacity_ + capacity_ / 2);
        data_[size_++] = copy;
    }
    /// New elements are copies of `value`.
    void resize(std::uint32_t size, const T& value = T{}) {
        const T copy = value;
        reserve(size);
        for (std::uint32_t i = size_; i < size; ++i) data_[i] = copy;
        size_ = size;
    }
    /// New elements have no value yet.
    void resize_for_overwrite(std::uint32_t size) {
        reserve(size);
        size_ = size;
    }
    /// Releases the unused end if it is larger than half of the used part: pages that were touched stay resident
    /// otherwise.
    void trim() {
        if (capacity_ - size_ <= std::size_t{size_} / 2 || capacity_ <= 1024) return;
        const std::size_t capacity = std::max<std::size_t>(std::size_t{size_} + size_ / 8, 1024);
        T* trimmed = static_cast<T*>(std::realloc(static_cast<void*>(data_), capacity * sizeof(T)));
        if (!trimmed) return;
        data_ = trimmed;
        capacity_ = capacity;
    }
    std::size_t bytes() const { return std::size_t{size_} * sizeof(T); }

private:
    void swap(FlatArray& other) {
        std::swap(data_, other.data_);
        std::swap(size_, other.size_);
        std::swap(capacity_, other.capacity_);
    }

    T* data_ = nullptr;
    std::uint32_t size_ = 0;
    std::size_t capacity_ = 0;
};

}  // namespace regionmesh
