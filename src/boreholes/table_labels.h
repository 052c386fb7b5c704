// The labels of a table, which may be numbers or words.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "regionmesh/tetrahedron_reader.h"

namespace regionmesh::formats {

/// Different texts, counted from 0 as they come; each is held once.
class TextTable {
public:
    std::uint32_t number_of(std::string_view text);
    const std::string& text(std::uint32_t number) const { return *texts_[number]; }
    std::uint32_t size() const { return static_cast<std::uint32_t>(texts_.size()); }

private:
    struct Hash {
        using is_transparent = void;
        std::size_t operator()(std::string_view text) const { return std::hash<std::string_view>()(text); }
    };
    std::unordered_map<std::string, std::uint32_t, Hash, std::equal_to<>> numbers_;
    std::vector<const std::string*> texts_;  // in numbers_
    std::uint32_t last_ = 0;
};

/// Collects the labels as they are written, since only the last row shows whether all of them are numbers.
class TableLabels {
public:
    explicit TableLabels(std::filesystem::path path) : path_(std::move(path)) {}

    /// The number by which labels() knows this text. Throws where another row gave the label another name, none empty.
    std::uint32_t add(std::string_view text, std::string_view name, std::uint32_t row);

    const std::string& text(std::uint32_t number) const { return texts_.text(number); }

    /// By those numbers: the labels. Whole numbers of 64 bits stay what they are ("3.0" is 3); any other text among
    /// them makes all of them words, which get labels 1, 2, ... in the order of their bytes, and their text as name.
    /// Puts is_unsigned and names into `info`.
    std::vector<InputLabel> labels(TetrahedraInfo& info) const;

private:
    struct Name {
        std::string text;
        std::uint32_t row = 0;
    };
    [[noreturn]] void refuse_names(std::uint32_t label, const Name& a, const Name& b) const;

    std::filesystem::path path_;
    TextTable texts_;
    std::vector<Name> names_;  // by number; none of them are held as long as none was given
};

}  // namespace regionmesh::formats
