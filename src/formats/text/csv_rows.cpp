#include "formats/text/csv_rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <span>
#include <utility>

#include "formats/text/header_text.h"

namespace regionmesh::formats {
namespace {

constexpr std::size_t kPartBytes = std::size_t{1} << 16;
constexpr std::size_t kMostRowBytes = std::size_t{1} << 20;
constexpr std::size_t kMostFields = std::size_t{1} << 16;

std::span<std::byte> bytes_of(std::string& text) { return std::as_writable_bytes(std::span(text)); }

/// The most frequent of tab, semicolon and comma outside quotes.
char find_separator(std::string_view header) {
    constexpr std::string_view kSeparators = "\t;,";
    std::array<std::size_t, kSeparators.size()> counts{};
    bool is_quoted = false;
    for (const char c : header) {
        if (c == '"') is_quoted = !is_quoted;
        if (!is_quoted && (c == '\n' || c == '\r')) break;
        const std::size_t which = kSeparators.find(c);
        if (!is_quoted && which != std::string_view::npos) ++counts[which];
    }
    return kSeparators[static_cast<std::size_t>(std::max_element(counts.begin(), counts.end()) - counts.begin())];
}

}  // namespace

CsvRows::CsvRows(const std::filesystem::path& path) : file_(path) { begin(skip_to_header()); }

CsvRows::CsvRows(InputFile file, std::string text, char separator) : file_(std::move(file)), given_(std::move(text)) {
    begin(separator);
}

void CsvRows::begin(char separator) {
    csv_init(&parser_, CSV_REPALL_NL);
    csv_set_blk_size(&parser_, 4096);
    csv_set_delim(&parser_, static_cast<unsigned char>(separator));
}

std::size_t CsvRows::read(std::span<std::byte> bytes) {
    std::size_t count = 0;
    if (given_) {
        const auto rest = std::as_bytes(std::span(*given_)).subspan(place_);
        count = std::min(bytes.size(), rest.size());
        std::copy_n(rest.begin(), count, bytes.begin());
    } else {
        count = file_.read(place_, bytes);
    }
    place_ += count;
    return count;
}

/// The parser has no comments: those before the header, which may contain quotes, are skipped here.
char CsvRows::skip_to_header() {
    std::string head(kMostRowBytes, '\0');
    head.resize(file_.read(0, bytes_of(head)));
    std::string_view rest = head;
    if (rest.starts_with("\xFF\xFE") || rest.starts_with("\xFE\xFF") || rest.find('\0') != std::string_view::npos)
        fail(file_.path(), "is no text in UTF-8; save the table as CSV in UTF-8");
    if (rest.starts_with(kByteOrderMark)) rest.remove_prefix(kByteOrderMark.size());
    while (!rest.empty()) {
        const std::size_t end = std::min(rest.find_first_of("\r\n"), rest.size());
        const std::string_view line = trim(rest.substr(0, end));
        if (!line.empty() && line[0] != '#') break;
        rest.remove_prefix(end);
        if (rest.empty()) break;
        rest.remove_prefix(rest.starts_with("\r\n") ? 2 : 1);
        ++begun_;
    }
    if (rest.empty()) fail(file_.path(), "holds no table: all its lines are blank or comments");
    place_ = head.size() - rest.size();
    return find_separator(rest);
}

bool CsvRows::next() {
    while (true) {
        while (next_ == rows_.size())
            if (!parse_more()) return false;
        row_ = rows_[next_++];
        for (std::size_t i = 0; i < field_count(); ++i)
            if (!field(i).empty()) return true;
    }
}

std::string_view CsvRows::field(std::size_t index) const {
    const std::size_t at = row_.field_begin + index;
    const std::size_t begin = at == 0 ? 0 : field_ends_[at - 1];
    return trim(std::string_view(text_).substr(begin, field_ends_[at] - begin));
}

std::uint64_t CsvRows::most_rows(std::uint64_t least_bytes) const {
    std::uint64_t lines = 1, place = 0;
    for (std::string part(kPartBytes, '\0'); place < file_.size();) {
        const std::size_t count = file_.read(place, bytes_of(part));
        if (count == 0) break;
        const auto begin = part.begin(), end = begin + static_cast<std::ptrdiff_t>(count);
        lines += static_cast<std::uint64_t>(std::max(std::count(begin, end, '\n'), std::count(begin, end, '\r')));
        place += count;
    }
    return std::min(lines, (file_.size() + 1) / least_bytes);
}

void CsvRows::refuse(std::uint64_t row, const std::string& text) const {
    fail(file_.path(), fmt::format("row {}: {}", row, text));
}

/// The callbacks of the parser are called from C and must not throw; only lack of memory could make them.
bool CsvRows::parse_more() {
    if (is_at_end_) return false;
    drop_used();
    const auto take_field = [](void* bytes, std::size_t count, void* self) noexcept {
        static_cast<CsvRows*>(self)->add_field({static_cast<const char*>(bytes), count});
    };
    const auto take_row = [](int letter, void* self) noexcept { static_cast<CsvRows*>(self)->end_row(letter); };
    std::array<char, kPartBytes> part;
    const std::size_t count = read(std::as_writable_bytes(std::span(part)));
    if (csv_parse(&parser_, part.data(), count, take_field, take_row, this) != count)
        refuse(begun_, csv_strerror(csv_error(&parser_)));
    if (count < part.size()) {
        is_at_end_ = true;
        csv_set_opts(&parser_, CSV_STRICT | CSV_STRICT_FINI);  // only now: a lone quote in a field is a letter
        if (csv_fini(&parser_, take_field, take_row, this) != 0) refuse(begun_, "a quote is not closed; close it");
    }
    check_size();
    return true;
}

/// Keeps the fields of the row that is not yet complete.
void CsvRows::drop_used() {
    const std::size_t fields = rows_.empty() ? 0 : rows_.back().field_end;
    const std::size_t bytes = fields == 0 ? 0 : field_ends_[fields - 1];
    text_.erase(0, bytes);
    field_ends_.erase(field_ends_.begin(), field_ends_.begin() + static_cast<std::ptrdiff_t>(fields));
    for (std::size_t& end : field_ends_) end -= bytes;
    rows_.clear();
    next_ = 0;
}

void CsvRows::check_size() {
    const std::size_t fields = rows_.empty() ? 0 : rows_.back().field_end;
    const std::size_t bytes = fields == 0 ? 0 : field_ends_[fields - 1];
    if (field_ends_.size() - fields > kMostFields)
        refuse(begun_, fmt::format("has more than {} fields: no such table", kMostFields));
    if (text_.size() - bytes > kMostRowBytes || csv_get_buffer_size(&parser_) > kMostRowBytes)
        refuse(begun_, "is longer than 1 MiB; is a quote not closed?");
}

void CsvRows::add_field(std::string_view text) {
    is_after_cr_ = false;
    text_ += text;
    field_ends_.push_back(text_.size());
}

/// `letter` ended the line; -1 at the end of the file.
void CsvRows::end_row(int letter) {
    const std::size_t begin = rows_.empty() ? 0 : rows_.back().field_end;
    const bool belongs_to_cr = is_after_cr_ && letter == '\n' && begin == field_ends_.size();
    is_after_cr_ = letter == '\r';
    if (belongs_to_cr) return;
    rows_.push_back({begun_++, begin, field_ends_.size()});
}

}  // namespace regionmesh::formats
