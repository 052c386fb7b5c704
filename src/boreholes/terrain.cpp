#include "boreholes/terrain.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <string_view>

#include "formats/input_file.h"
#include "formats/text/header_text.h"

namespace regionmesh::formats {
namespace {

constexpr std::uint64_t kMostBytes = std::uint64_t{1} << 31;
constexpr std::uint64_t kLeastHeightBytes = 2;  // "0 "

std::string text_of(const std::filesystem::path& path) {
    const InputFile file(path);
    if (file.size() > kMostBytes) fail(path, "is larger than 2 GiB; give a coarser grid");
    std::string text(file.size(), ' ');
    text.resize(file.read(0, std::as_writable_bytes(std::span(text))));
    return text;
}

/// Names, in lower case, and numbers; ends before the first line that begins with a number.
std::map<std::string, double> take_header(const std::filesystem::path& path, std::string_view& text) {
    std::map<std::string, double> header;
    for (;;) {
        std::string_view rest = text, line = take_line(rest);
        const std::string name = lower(take_word(line));
        if (name.empty() ? rest.empty() : parse_real(name).has_value()) return header;
        const auto number = parse_finite(trim(line));
        if (!name.empty() && !number)
            fail(path, fmt::format("header: '{}' has no number; is it an ESRI ASCII grid?", shown(name)));
        if (!name.empty()) header[name] = *number;
        text = rest;
    }
}

class Header {
public:
    Header(const std::filesystem::path& path, std::map<std::string, double> numbers)
        : path_(path), numbers_(std::move(numbers)) {}

    double number(const std::string& name) const {
        const auto found = numbers_.find(name);
        if (found == numbers_.end())
            fail(path_,
                 fmt::format("header: no {}; an ESRI ASCII grid needs ncols, nrows, xllcorner, yllcorner, cellsize",
                             name));
        return found->second;
    }

    bool has(const std::string& name) const { return numbers_.contains(name); }

    std::size_t count(const std::string& name) const {
        const double value = number(name);
        if (!(value >= 2 && value <= 1e6) || value != std::floor(value))
            fail(path_, fmt::format("header: {} is {}; it must be a whole number from 2 to 1000000", name, value));
        return static_cast<std::size_t>(value);
    }

private:
    const std::filesystem::path& path_;
    std::map<std::string, double> numbers_;
};

}  // namespace

Terrain::Terrain(const std::filesystem::path& path) {
    const std::string whole = text_of(path);
    std::string_view text = whole;
    const Header header(path, take_header(path, text));
    columns_ = header.count("ncols");
    rows_ = header.count("nrows");
    cell_ = header.number("cellsize");
    if (!(cell_ > 0)) fail(path, fmt::format("header: cellsize is {}; it must be above 0", cell_));
    x_ = header.has("xllcenter") ? header.number("xllcenter") : header.number("xllcorner") + cell_ / 2;
    y_ = header.has("yllcenter") ? header.number("yllcenter") : header.number("yllcorner") + cell_ / 2;
    const std::size_t count = columns_ * rows_;
    if (count > (text.size() + 1) / kLeastHeightBytes)
        fail(path,
             fmt::format("holds fewer than {} heights, {} columns of {} rows; is it cut off?", count, columns_, rows_));
    heights_.reserve(count);
    const double none = header.has("nodata_value") ? header.number("nodata_value") : -9999;
    for (std::string_view word = take_word(text); !word.empty() || !text.empty(); word = take_word(text)) {
        if (word.empty()) continue;
        const auto height = parse_finite(word);
        if (!height) fail(path, fmt::format("height {}: '{}' is no number; mend it", heights_.size() + 1, shown(word)));
        if (heights_.size() == count) fail(path, fmt::format("holds more than {} heights; mend ncols or nrows", count));
        heights_.push_back(*height == none ? std::numeric_limits<double>::quiet_NaN() : *height);
    }
    if (heights_.size() < count)
        fail(path, fmt::format("holds {} heights, where {} columns of {} rows are {}; is it cut off?", heights_.size(),
                               columns_, rows_, count));
}

std::optional<double> Terrain::at(double x, double y) const {
    const double column = (x - x_) / cell_, row = static_cast<double>(rows_ - 1) - (y - y_) / cell_;
    if (!(column >= 0 && column <= static_cast<double>(columns_ - 1) && row >= 0 &&
          row <= static_cast<double>(rows_ - 1)))
        return {};
    const auto i = std::min(static_cast<std::size_t>(column), columns_ - 2);
    const auto j = std::min(static_cast<std::size_t>(row), rows_ - 2);
    const double a = column - static_cast<double>(i), b = row - static_cast<double>(j);
    const double* const at = heights_.data() + j * columns_ + i;
    double height = 0;
    const auto add = [&](double weight, double one) {
        if (weight > 0) height += weight * one;  // a cell of no weight need not have a height
    };
    add((1 - b) * (1 - a), at[0]);
    add((1 - b) * a, at[1]);
    add(b * (1 - a), at[columns_]);
    add(b * a, at[columns_ + 1]);
    if (std::isnan(height)) return {};
    return height;
}

}  // namespace regionmesh::formats
