// The rows of a CSV table, in order.
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

/// Rows as a spreadsheet shows and counts them, from 1: text in quotes may contain separators and line ends. The first
/// row that is neither blank nor begins with # decides which of tab, semicolon and comma is the separator. Holds a
/// bounded part of the file. Throws Error(kInput) naming the row.
class CsvRows {
public:
    explicit CsvRows(const std::filesystem::path& path);
    /// The rows of `text`, which came from a file, with that separator between fields.
    CsvRows(InputFile file, std::string text, char separator);
    ~CsvRows() { csv_free(&parser_); }
    CsvRows(const CsvRows&) = delete;
    CsvRows& operator=(const CsvRows&) = delete;

    /// Moves to the next row that is not empty; false where there is none.
    bool next();

    const std::filesystem::path& path() const { return file_.path(); }

    /// Number and fields of the current row; fields have no blanks around them.
    std::uint64_t number() const { return row_.number; }
    std::size_t field_count() const { return row_.field_end - row_.field_begin; }
    std::string_view field(std::size_t index) const;

    /// An upper bound on the number of rows, if each takes `least_bytes` or more, line end included.
    std::uint64_t most_rows(std::uint64_t least_bytes) const;

    /// Throws Error(kInput) "path: row 12: text" for the current row or another.
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
    std::uint64_t place_ = 0;           // of the next byte to parse, in the file or the given text
    bool is_at_end_ = false;

    // Parsed rows: their text and the ends of their fields; then the fields of a row not yet complete.
    std::string text_;
    std::vector<std::size_t> field_ends_;
    std::vector<Row> rows_;
    std::size_t next_ = 0;      // of rows_
    Row row_;                   // the current one
    std::uint64_t begun_ = 1;   // number of the row not yet complete
    bool is_after_cr_ = false;  // a line feed now belongs to the preceding carriage return
};

}  // namespace regionmesh::formats
