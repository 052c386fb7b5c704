// The values of options as text.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "regionmesh/label.h"
#include "regionmesh/select_sections.h"
#include "regionmesh/vec3.h"

namespace regionmesh {

/// The values that an option takes, from `low` to `high`.
struct Range {
    double low = 0, high = std::numeric_limits<double>::infinity();
    bool is_low_included = true;

    bool contains(double value) const { return (is_low_included ? value >= low : value > low) && value <= high; }
    /// "0 to 1", "at least 0", "above 0".
    std::string text() const;
};

/// Each throws Error(kUsage) with one line that names the flag, the text and what would be right.
std::uint64_t parse_count(const std::string& flag, const std::string& text, const Range& range);
double parse_number(const std::string& flag, const std::string& text, const Range& range);
double parse_share(const std::string& flag, const std::string& text);
std::uint64_t parse_bytes(const std::string& flag, const std::string& text);
/// Labels above 2^63 - 1 keep their bits.
InputLabel parse_label(const std::string& flag, const std::string& text);
/// "liver,spleen": the parts between commas, none of which is empty.
std::vector<std::string> parse_names(const std::string& flag, const std::string& text);
/// "0.5", "100,300": numbers that rise.
std::vector<double> parse_thresholds(const std::string& flag, const std::string& text);
/// Three numbers above 0.
Vec3 parse_numbers(const std::string& flag, const std::string& text);
/// Three whole numbers from 1 to 2^31 - 1.
std::array<std::uint32_t, 3> parse_counts(const std::string& flag, const std::string& text);
/// "1,5-9": labels and ranges of them.
std::vector<LabelRange> parse_label_ranges(const std::string& flag, const std::string& text);
/// "10:50,:,20:": samples along x, y, z; no number stands for the end of the volume.
std::array<SampleRange, 3> parse_sample_ranges(const std::string& flag, const std::string& text);
/// "-10.5:20,:,0:": coordinates along x, y, z.
std::array<LengthRange, 3> parse_length_ranges(const std::string& flag, const std::string& text);
/// "2", or "2,2,1" along x, y, z; each at least 1.
std::array<std::uint32_t, 3> parse_factors(const std::string& flag, const std::string& text);
bool parse_flag(const std::string& flag, const std::string& text);

/// "0.1", "1e-07": the shortest text that reads as the number.
std::string number_text(double value);
/// "2GiB": in the largest unit that divides the number.
std::string bytes_text(std::uint64_t bytes);

/// Throws Error(kUsage): "--reduce 150%: not a share, such as 90% or 0.9".
[[noreturn]] void refuse_value(const std::string& flag, const std::string& text, const std::string& wanted);

}  // namespace regionmesh
