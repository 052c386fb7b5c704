// The rows of a table in text, one after the other.
#pragma once

#include <csv.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "formats/input_file.h"

namespace regionmesh::formats {

/// Rows as a spreadsheet shows and counts them, from 1: what stands between quotes may hold separators and ends of
/// lines. The first row that is neither blank nor begins with # says which of tab, semicolon and comma separates.
/// Holds a bounded part of the file. Throws Error(kInput) naming the row.
class CsvRows {
public:
    explicit CsvRows(const std::filesystem::path& path);
    /// The rows of `text`, which came from a file, with that separator between fields.
    CsvRows(InputFile file, std::string text, char separator);
    ~CsvRows() { csv_free(&parser_); }
    CsvRows(const CsvRows&) = delete;
    CsvRows& operator=(const CsvRows&) = delete;

    /// Goes on to the next row that has anything in it; false where there is none.
    bool next();

    const std::filesystem::path& path() const { return file_.path(); }

    /// Of the row it stands on: its number and its fields, without blanks around them.
    std::uint64_t number() const { return row_.number; }
    std::size_t field_count() const { return row_.field_end - row_.field_begin; }
    std::string_view field(std::size_t index) const;

    /// No file of this many bytes and lines has more rows of `least_bytes` or more, ends of lines included.
    std::uint64_t most_rows(std::uint64_t least_bytes) const;

    /// Throws Error(kInput) "path: row 12: text", of the row it stands on.
    [[noreturn]] void refuse(const std::string& text) const { refuse(row_.number, text); }
    [[noreturn]] void refuse(std::uint64_t row, const std::string& text) const;

private:
    struct Row {
        std::uint64_t number = 0;
        std::size_t field_begin = 0, field_end = 0;  // in field_ends_
    };

    void begin(char separator);
    std::size_t read(std::span<std::byte> bytes);
    char skip_to_header();
    bool parse_more();
    void drop_used();
    void check_size();
    void add_field(std::string_view text);
    void end_row(int letter);

    InputFile file_;
    csv_parser parser_;
    std::optional<std::string> given_;  // read instead of the file
    std::uint64_t place_ = 0;           // in the file or the given text, of what is parsed next
    bool is_at_end_ = false;

    // Rows that are parsed: their text, and where each field of it ends. Behind them fields of a row not yet whole.
    std::string text_;
    std::vector<std::size_t> field_ends_;
    std::vector<Row> rows_;
    std::size_t next_ = 0;      // of rows_
    Row row_;                   // the one it stands on
    std::uint64_t begun_ = 1;   // number of the row not yet whole
    bool is_after_cr_ = false;  // a line feed now belongs to the carriage return before it
};

}  // namespace regionmesh::formats
