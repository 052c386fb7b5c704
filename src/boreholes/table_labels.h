// The labels of a table, which may be numbers or words.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "regionmesh/tetrahedron_reader.h"

namespace regionmesh::formats {

/// The number of an interval without a unit.
inline constexpr std::uint32_t kNoLabel = std::numeric_limits<std::uint32_t>::max();

/// Numbers distinct texts from 0 in order of first use; stores each once.
class TextTable {
public:
    TextTable() = default;
    TextTable(TextTable&&) = default;  // texts_ points into numbers_
    TextTable& operator=(TextTable&&) = default;

    std::uint32_t number_of(std::string_view text);
    const std::string& text(std::uint32_t number) const { return *texts_[number]; }
    std::uint32_t size() const { return static_cast<std::uint32_t>(texts_.size()); }

private:
    struct Hash {
        using is_transparent = void;
        std::size_t operator()(std::string_view text) const { return std::hash<std::string_view>()(text); }
    };
    std::unordered_map<std::string, std::uint32_t, Hash, std::equal_to<>> numbers_;
    std::vector<const std::string*> texts_;  // keys of numbers_
    std::uint32_t last_ = 0;
};

/// Collects labels as text, since only after the last row it is known whether all are numbers.
class TableLabels {
public:
    explicit TableLabels(std::filesystem::path path) : path_(std::move(path)) {}

    /// The index of this text in labels(). Throws Error(kInput) where an earlier row gave the label another name; an
    /// empty name is no name.
    std::uint32_t add(std::string_view text, std::string_view name, std::uint32_t row);

    const std::string& text(std::uint32_t number) const { return texts_.text(number); }
    std::uint32_t count() const { return texts_.size(); }

    /// Whether any text is no whole number.
    bool are_words() const;

    /// The labels. Whole numbers keep their value ("3.0" is 3). If any text is no such number, all texts are words:
    /// they get labels 1, 2, ... in byte order, and their text as name, and it is a warning if others are numbers. Sets
    /// is_unsigned and names in `info`, and adds to its warning. This and are_words() throw Error(kInput) where all
    /// texts are whole numbers that do not fit into 64 bits together.
    std::vector<InputLabel> labels(TetrahedraInfo& info) const;

private:
    struct Name {
        std::string text;
        std::uint32_t row = 0;
    };
    std::string warning_of_numbers() const;
    [[noreturn]] void refuse_names(std::uint32_t label, const Name& a, const Name& b) const;

    std::filesystem::path path_;
    TextTable texts_;
    std::vector<Name> names_;  // one per label index; empty until the first name
};

}  // namespace regionmesh::formats
