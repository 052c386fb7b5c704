// Refuses numbers of options that lie out of their range.
#pragma once

#include <limits>

namespace regionmesh {

/// The range from `least` to `most`, both included. `text` says so in messages: "0 to 1".
struct OptionRange {
    double least, most;
    const char* text;
};

inline constexpr double kMostNumber = std::numeric_limits<double>::max();
inline constexpr OptionRange kNotNegative{0, kMostNumber, "0 or more"};
inline constexpr OptionRange kPositive{std::numeric_limits<double>::min(), kMostNumber, "more than 0"};
inline constexpr OptionRange kNotNegativeOrInfinite{0, std::numeric_limits<double>::infinity(), "0 or more"};
inline constexpr OptionRange kQualityRange{0, 0.26, "0 to 0.26"};  // an equilateral face has 0.2596 (base/triangle.h)
inline constexpr OptionRange kRoomRange{0, 8, "0 to 8"};

/// Throws Error(kUsage) for a number out of range, and for NaN.
void require_number(const char* option, double number, const OptionRange& range);

/// Throws Error(kUsage) for a value that is none of an enumeration's, which begins at 0 and ends with `last`.
template <class Enum>
void require_choice(const char* option, Enum choice, Enum last) {
    require_number(option, static_cast<double>(choice), {0, static_cast<double>(last), "its enumeration"});
}

}  // namespace regionmesh
