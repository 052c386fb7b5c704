#include "input_options.h"

#include <fmt/core.h>

#include <charconv>
#include <cmath>

namespace regionmesh::cli {
namespace {

[[noreturn]] void refuse(const std::string& flag, const std::string& text, const std::string& wanted) {
    throw Error(ErrorCode::kInput, fmt::format("{} {}: not {}", flag, text, wanted));
}

std::vector<std::string> split(const std::string& text) {
    std::vector<std::string> parts(1);
    for (char c : text) {
        if (c == ',')
            parts.emplace_back();
        else
            parts.back() += c;
    }
    return parts;
}

/// A number at the start of `text`; the rest goes to `unit`.
bool parse_leading(const std::string& text, double& number, std::string& unit) {
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    unit.assign(end, text.data() + text.size());
    return error == std::errc{} && std::isfinite(number);
}

}  // namespace

std::uint64_t parse_count(const std::string& flag, const std::string& text) {
    std::uint64_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size()) refuse(flag, text, "a whole number, such as 500000");
    return value;
}

double parse_number(const std::string& flag, const std::string& text) {
    double value = 0;
    std::string unit;
    if (!parse_leading(text, value, unit) || !unit.empty() || value < 0)
        refuse(flag, text, "a number of at least 0, such as 0.5");
    return value;
}

double parse_share(const std::string& flag, const std::string& text) {
    double value = 0;
    std::string unit;
    const bool is_number = parse_leading(text, value, unit);
    if (unit == "%") value /= 100;
    if (!is_number || (unit != "%" && !unit.empty()) || !(value >= 0 && value <= 1))
        refuse(flag, text, "a share, such as 90% or 0.9");
    return value;
}

std::uint64_t parse_bytes(const std::string& flag, const std::string& text) {
    double value = 0;
    std::string unit;
    const bool is_number = parse_leading(text, value, unit);
    constexpr std::pair<const char*, double> kUnits[] = {
        {"", 1}, {"B", 1}, {"kB", 1e3}, {"MB", 1e6}, {"GB", 1e9}, {"KiB", 0x1p10}, {"MiB", 0x1p20}, {"GiB", 0x1p30}};
    for (const auto& [name, factor] : kUnits)
        if (is_number && unit == name && value > 0 && value * factor < 0x1p62)
            return static_cast<std::uint64_t>(value * factor);
    refuse(flag, text, "a size, such as 500MiB or 2GiB");
}

void InputOptions::add_volume_options(CLI::App& command) {
    command.add_option("--sweep", sweep, "axis along which sections are read; auto: the one with the smallest section")
        ->check(CLI::IsMember({"x", "y", "z", "auto"}));
    command.add_option("--spacing", spacing, "distance of samples X,Y,Z instead of the file's own");
    command.add_option("--layer", layer, "which one, from 0, of several layers of labels, channels or times");
    command.add_option("--size", size, "raw files: samples X,Y,Z");
    command.add_option("--type", type, "raw files: uint8, int16, ... uint64, little endian");
}

void InputOptions::add_background_options(CLI::App& command) {
    command.add_option("--background", background, "label of empty space, 0 if not given; may be repeated");
    command.add_flag("--no-background", no_background, "every label is a region");
}

void InputOptions::add_label_options(CLI::App& command) {
    add_background_options(command);
    command.add_option("--boundary", boundary, "faces on the six sides of the box: cap or open")
        ->check(CLI::IsMember({"cap", "open"}));
}

std::optional<Sweep> InputOptions::sweep_of_tetrahedra() const {
    if (sweep == "auto") return {};
    return sweep == "x" ? kSweepX : sweep == "y" ? kSweepY : kSweepZ;
}

CensusOptions InputOptions::census_options() const {
    return {.cap = cap(), .background = background_labels(), .sweep = sweep_of_tetrahedra()};
}

std::unique_ptr<SectionReader> InputOptions::open(const std::vector<std::string>& inputs) const {
    ReadOptions options;
    options.sweep = sweep == "x"   ? SweepChoice::kX
                    : sweep == "y" ? SweepChoice::kY
                    : sweep == "z" ? SweepChoice::kZ
                                   : SweepChoice::kAuto;
    if (!spacing.empty()) {
        const auto parts = split(spacing);
        if (parts.size() != 3) refuse("--spacing", spacing, "three numbers X,Y,Z");
        Vec3 value;
        for (int axis = 0; axis < 3; ++axis) {
            value[axis] = parse_number("--spacing", parts[axis]);
            if (value[axis] == 0) refuse("--spacing", spacing, "three positive numbers X,Y,Z");
        }
        options.spacing = value;
    }
    if (!layer.empty()) {
        const std::uint64_t value = parse_count("--layer", layer);
        if (value > 0x7FFFFFFF) refuse("--layer", layer, "a layer, counted from 0");
        options.layer = static_cast<std::uint32_t>(value);
    }
    if (!size.empty()) {
        const auto parts = split(size);
        if (parts.size() != 3) refuse("--size", size, "three whole numbers X,Y,Z");
        std::array<std::uint32_t, 3> value;
        for (int axis = 0; axis < 3; ++axis) {
            const std::uint64_t count = parse_count("--size", parts[axis]);
            if (count == 0 || count > 0x7FFFFFFF) refuse("--size", size, "three whole numbers X,Y,Z from 1");
            value[axis] = static_cast<std::uint32_t>(count);
        }
        options.raw_size = value;
    }
    if (!type.empty()) {
        options.raw_type = parse_sample_type(type);
        if (!options.raw_type) refuse("--type", type, "a sample type, such as uint8 or int16");
    }
    return open_sections({inputs.begin(), inputs.end()}, options);
}

std::vector<InputLabel> InputOptions::background_labels() const {
    if (no_background) return {};
    if (background.empty()) return {0};
    std::vector<InputLabel> labels;
    for (const std::string& text : background) {
        const bool is_negative = !text.empty() && text[0] == '-';
        const std::uint64_t bits = parse_count("--background", is_negative ? text.substr(1) : text);
        labels.push_back(static_cast<InputLabel>(is_negative ? 0 - bits : bits));
    }
    return labels;
}

CheckOptions InputOptions::check_options(LabelTable& labels) const {
    CheckOptions options;
    options.boundary_is_open = !cap();
    for (InputLabel label : background_labels()) options.background.push_back(labels.dense(label));
    options.label_text = [&labels](Label label) { return labels.text(labels.input(label)); };
    return options;
}

}  // namespace regionmesh::cli
