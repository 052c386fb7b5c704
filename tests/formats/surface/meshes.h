// Meshes of tetrahedra as text that a test can compare.
#pragma once

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "formats/surface/tetrahedron_formats.h"
#include "formats/temporary_folder.h"
#include "regionmesh/error.h"
#include "support/paths.h"

namespace regionmesh {

inline const std::filesystem::path kMeshes = std::filesystem::path(test::data_folder()) / "meshes";

/// All tetrahedra, some at a time so that parts do not end where the file's do.
inline std::vector<LabelledTetrahedron> all_tetrahedra(TetrahedronReader& reader) {
    std::vector<LabelledTetrahedron> all, some(5);
    while (const std::size_t count = reader.next(some)) all.insert(all.end(), some.begin(), some.begin() + count);
    return all;
}

/// A line for each tetrahedron: its twelve coordinates to nine digits, and its label.
inline std::string mesh_text(TetrahedronReader& reader) {
    const LabelledPoints points = reader.take_points();
    std::string text;
    for (const LabelledTetrahedron& t : all_tetrahedra(reader)) {
        for (const std::uint32_t corner : t.corners) {
            const Vec3 p = points.positions.at(corner);
            text += fmt::format("{:.9g} {:.9g} {:.9g} ", p.x, p.y, p.z);
        }
        text += fmt::format("{}\n", t.label);
    }
    return text;
}

inline std::vector<InputLabel> labels_of(TetrahedronReader& reader) {
    std::vector<InputLabel> labels = reader.take_points().labels;
    for (const LabelledTetrahedron& t : all_tetrahedra(reader))
        if (reader.info().has_cell_labels) labels.push_back(t.label);
    return labels;
}

class MeshTest : public TemporaryFolder {
protected:
    using Opener = std::unique_ptr<TetrahedronReader> (*)(const std::filesystem::path&, const TetrahedraOptions&);
    MeshTest(Opener open, const char* name) : open_(open), name_(name) {}

    std::unique_ptr<TetrahedronReader> open_text(const std::string& text, const TetrahedraOptions& options = {}) {
        put_text(path(name_), text);
        return open_(path(name_), options);
    }
    /// What is said of a file that cannot be read to its end.
    std::string failure(const std::string& text, const TetrahedraOptions& options = {}) {
        try {
            const auto reader = open_text(text, options);
            reader->take_points();
            all_tetrahedra(*reader);
        } catch (const Error& error) {
            EXPECT_EQ(error.code(), ErrorCode::kInput);
            const std::string start = path(name_).string() + ": ", what = error.what();
            EXPECT_TRUE(what.starts_with(start)) << what;
            return what.substr(std::min(start.size(), what.size()));
        }
        return "nothing thrown";
    }
    /// Cuts and changes every part of a file, which is then read or refused.
    void damage(const std::filesystem::path& file, std::size_t stride) {
        const std::string good = text_of(file);
        for (std::size_t i = 0; i < good.size(); i += stride) {
            std::string bad = good;
            bad[i] = static_cast<char>(bad[i] ^ (i % 2 == 0 ? '\x80' : '\x03'));
            failure(bad);
            failure(good.substr(0, i));
        }
    }

private:
    Opener open_;
    const char* name_;
};

inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
    const std::size_t place = text.find(from);
    EXPECT_NE(place, std::string::npos) << from;
    return place == std::string::npos ? text : text.replace(place, from.size(), to);
}

}  // namespace regionmesh
