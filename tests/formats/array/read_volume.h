// Whole volumes, read by open_sections, for the tests of its formats.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "regionmesh/error.h"
#include "regionmesh/read_sections.h"
#include "support/paths.h"

namespace regionmesh {

using Paths = std::vector<std::filesystem::path>;

inline std::filesystem::path data(const std::string& name) { return std::filesystem::path(test::data_folder()) / name; }

/// The dataset of an HDF5 file of tests/data/chunked, as an input names it.
inline std::filesystem::path inside(const std::string& file, const std::string& dataset) {
    return data("chunked/" + file).string() + ":" + dataset;
}

constexpr std::array kSweeps{SweepChoice::kX, SweepChoice::kY, SweepChoice::kZ};

struct Volume {
    VolumeInfo info;
    std::vector<InputLabel> labels;  // x fastest, then y, whatever the sweep
};

/// Pulls all sections once more from `reader`, and puts their labels where they lie in the volume.
inline std::vector<InputLabel> pull(SectionReader& reader) {
    const auto& size = reader.info().lattice.size;
    const auto& axes = reader.info().sweep.axes;
    const std::array<std::size_t, 3> pitch{1, size[0], std::size_t{size[0]} * size[1]};
    std::vector<InputLabel> labels(pitch[2] * size[2]);
    std::vector<InputLabel> section(std::size_t{reader.section_width()} * reader.section_height());
    std::size_t count = 0;
    for (; reader.next(section); ++count) {
        for (std::size_t i = 0; i < section.size(); ++i) {
            const std::size_t first = i % reader.section_width(), second = i / reader.section_width();
            labels[first * pitch[axes[0]] + second * pitch[axes[1]] + count * pitch[axes[2]]] = section[i];
        }
    }
    EXPECT_EQ(count, reader.section_count());
    EXPECT_FALSE(reader.next(section));
    return labels;
}

inline Volume read_volume(const Paths& inputs, const ReadOptions& options = {}) {
    const auto reader = open_sections(inputs, options);
    Volume volume{reader->info(), pull(*reader)};
    if (volume.info.can_rewind) {
        reader->rewind();
        EXPECT_EQ(pull(*reader), volume.labels) << "after rewind";
    }
    return volume;
}

/// The text of the Error, one line, with which opening or reading ends.
inline std::string refusal(const Paths& inputs, const ReadOptions& options = {}) {
    try {
        const auto reader = open_sections(inputs, options);
        pull(*reader);
    } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::kInput);
        EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
        return error.what();
    }
    return "nothing thrown";
}

inline ReadOptions swept(SweepChoice sweep) {
    ReadOptions options;
    options.sweep = sweep;
    return options;
}

inline ReadOptions raw(std::optional<std::array<std::uint32_t, 3>> size, std::optional<SampleType> type,
                       SweepChoice sweep = SweepChoice::kAuto) {
    ReadOptions options = swept(sweep);
    options.raw_size = size;
    options.raw_type = type;
    return options;
}

inline ReadOptions spaced(Vec3 spacing) {
    ReadOptions options;
    options.spacing = spacing;
    return options;
}

/// What make_data.py puts at v = x + 5 y + 20 z of its 5 x 4 x 3 volumes.
inline std::vector<InputLabel> expected(const std::function<InputLabel(InputLabel)>& rule) {
    std::vector<InputLabel> labels;
    for (InputLabel v = 0; v < 60; ++v) labels.push_back(rule(v));
    return labels;
}

inline std::vector<InputLabel> expected(SampleType type) {
    return expected([type](InputLabel v) -> InputLabel {
        switch (type) {
            case SampleType::kU1:
                return v % 3 == 0;
            case SampleType::kI8:
            case SampleType::kI16:
            case SampleType::kI32:
            case SampleType::kI64:
                return v - 30;
            case SampleType::kU64:
                return static_cast<InputLabel>(static_cast<std::uint64_t>(v) + (std::uint64_t{1} << 63));
            default:
                return v;
        }
    });
}

/// The type in the name of a file: "plain_uint16.tif".
inline SampleType type_in_name(const std::filesystem::path& path) {
    const std::string name = path.filename().string();
    const std::string word = name.substr(0, name.find('.'));
    return parse_sample_type(word.substr(word.rfind('_') + 1)).value();
}

/// A 5 x 4 x 3 volume whose name tells its type comes back label for label, along every axis that it can be swept
/// along.
inline void expect_as_named(const std::filesystem::path& file, const std::string& format) {
    SCOPED_TRACE(file);
    const SampleType type = type_in_name(file);
    const Volume volume = read_volume({file});
    EXPECT_EQ(volume.info.format, format);
    EXPECT_EQ(volume.info.type, type);
    EXPECT_EQ(volume.info.lattice.size, (std::array<std::uint32_t, 3>{5, 4, 3}));
    EXPECT_EQ(volume.labels, expected(type));
    for (std::size_t axis = 0; axis < 3; ++axis) {
        if (volume.info.can_sweep[axis]) {
            EXPECT_EQ(read_volume({file}, swept(kSweeps[axis])).labels, volume.labels) << "xyz"[axis];
        } else {
            EXPECT_NE(refusal({file}, swept(kSweeps[axis])).find("only along z"), std::string::npos);
        }
    }
}

/// origin, and direction * spacing by rows.
inline void expect_in_space(const VolumeInfo& info, Vec3 origin, const std::array<double, 9>& matrix) {
    for (int row = 0; row < 3; ++row) {
        EXPECT_NEAR(info.lattice.origin[row], origin[row], 1e-12) << info.source;
        for (int axis = 0; axis < 3; ++axis) {
            EXPECT_NEAR(info.lattice.direction[3 * row + axis] * info.lattice.spacing[axis], matrix[3 * row + axis],
                        1e-12)
                << info.source << row << axis;
        }
    }
}

/// The regular files of a folder of tests/data, without those below it.
inline Paths files_in(const std::string& folder) {
    Paths files;
    for (const auto& entry : std::filesystem::directory_iterator(data(folder))) {
        if (entry.is_regular_file() && entry.path().extension() != ".txt") files.push_back(entry.path());
    }
    EXPECT_FALSE(files.empty()) << folder;
    return files;
}

}  // namespace regionmesh
