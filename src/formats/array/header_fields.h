// Keys and values of a text header.
#pragma once

#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace regionmesh::formats {

/// Values by key, as text. Where a key may have one of several names, the first that is there counts. A value of
/// another kind than asked for is an Error(kInput) that names file, key and value.
class HeaderFields {
public:
    using Keys = std::initializer_list<std::string_view>;

    explicit HeaderFields(std::filesystem::path path) : path_(std::move(path)) {}

    /// Trims the value. The first value of a key stands.
    void add(std::string_view key, std::string_view value);

    const std::filesystem::path& path() const { return path_; }
    const std::map<std::string, std::string, std::less<>>& all() const { return values_; }
    std::string_view text(Keys keys, std::string_view otherwise = {}) const;
    /// Requires a number if there is no `otherwise`.
    std::uint64_t size(std::string_view key, std::string_view otherwise = {}) const;
    std::int64_t integer(std::string_view key, std::int64_t otherwise) const;
    double real(std::string_view key, std::string_view otherwise) const;
    bool flag(Keys keys, bool otherwise) const;
    /// Nothing if there is no such key.
    std::optional<std::vector<double>> reals(Keys keys, std::size_t count) const;

    [[noreturn]] void refuse(std::string_view key, std::string_view wanted) const;

private:
    std::filesystem::path path_;
    std::map<std::string, std::string, std::less<>> values_;
};

}  // namespace regionmesh::formats
