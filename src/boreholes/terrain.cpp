#include "boreholes/terrain.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <string_view>

#include "base/megabytes.h"
#include "formats/input_file.h"
#include "formats/text/header_text.h"

namespace regionmesh::formats {
namespace {

constexpr std::string_view kNoData = "nodata_value";
constexpr std::uint64_t kLeastHeightBytes = 2;  // "0 "

constexpr std::array<std::string_view, 8> kNames{"ncols",     "nrows",     "xllcorner", "yllcorner",
                                                 "xllcenter", "yllcenter", "cellsize",  kNoData};

/// Names, in lower case, and numbers; ends before the first word in place of a name that is none.
std::map<std::string, double> take_header(ByteReader& file) {
    std::map<std::string, double> header;
    for (;;) {
        const std::uint64_t begin = file.place(), lines = file.lines();
        const auto word = file.take_word();
        std::string name = word ? lower(shown(*word)) : std::string();
        if (begin == 0 && name.starts_with(kByteOrderMark)) name.erase(0, kByteOrderMark.size());
        if (std::ranges::find(kNames, name) == kNames.end()) {
            file.go_to(begin, lines);
            return header;
        }
        const auto number = file.take_word();
        const auto value = number ? parse_real(*number) : std::nullopt;
        if (!value || (std::isnan(*value) && name != kNoData))
            file.fail(fmt::format("header: '{}' has no number; is it an ESRI ASCII grid?", name));
        header[name] = *value;
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

Terrain::Terrain(const std::filesystem::path& path, std::uint64_t most_bytes) {
    ByteReader file(path);
    const Header header(path, take_header(file));
    columns_ = header.count("ncols");
    rows_ = header.count("nrows");
    cell_ = header.number("cellsize");
    if (!(cell_ > 0)) fail(path, fmt::format("header: cellsize is {}; it must be above 0", cell_));
    x_ = header.has("xllcenter") ? header.number("xllcenter") : header.number("xllcorner") + cell_ / 2;
    y_ = header.has("yllcenter") ? header.number("yllcenter") : header.number("yllcorner") + cell_ / 2;
    const std::size_t count = columns_ * rows_;
    if (count > (file.left() + 1) / kLeastHeightBytes)
        fail(path,
             fmt::format("holds fewer than {} heights, {} columns of {} rows; is it cut off?", count, columns_, rows_));
    if (count > most_bytes / sizeof(double))
        fail(path, fmt::format("{} heights take {}, more than {} has left; give a coarser grid or more memory", count,
                               megabytes(count * sizeof(double)), "--memory"));
    read_heights(file, header.has(std::string(kNoData)) ? header.number(std::string(kNoData)) : -9999);
}

void Terrain::read_heights(ByteReader& file, double none) {
    const std::size_t count = columns_ * rows_;
    heights_.reserve(count);
    while (const auto word = file.take_word()) {
        const auto height = parse_real(*word);
        if (!height)
            file.fail(fmt::format("row {}, column {}: '{}' is no height; mend it", heights_.size() / columns_ + 1,
                                  heights_.size() % columns_ + 1, shown(*word)));
        if (heights_.size() == count) file.fail(fmt::format("holds more than {} heights; mend ncols or nrows", count));
        heights_.push_back(*height == none ? std::numeric_limits<double>::quiet_NaN() : *height);
    }
    if (heights_.size() < count)
        file.fail(fmt::format("holds {} heights, where {} columns of {} rows are {}; is it cut off?", heights_.size(),
                              columns_, rows_, count));
}

std::optional<double> Terrain::at(double x, double y) const {
    const double last_column = static_cast<double>(columns_ - 1), last_row = static_cast<double>(rows_ - 1);
    double column = (x - x_) / cell_, row = last_row - (y - y_) / cell_;
    if (!(column >= -0.5 && column <= last_column + 0.5 && row >= -0.5 && row <= last_row + 0.5)) return {};
    column = std::clamp(column, 0.0, last_column);
    row = std::clamp(row, 0.0, last_row);
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
