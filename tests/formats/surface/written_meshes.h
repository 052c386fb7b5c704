// What the tests of writers share: models to write, and words to look for.
#pragma once

#include <sstream>
#include <string>
#include <vector>

#include "formats/temporary_folder.h"
#include "regionmesh/mesh_file.h"
#include "support/labels.h"
#include "support/runs.h"
#include "support/shapes.h"

namespace regionmesh {

/// Grains in a box, smoothed and decimated.
inline const Reconstruction& grains() {
    static const Reconstruction made = [] {
        ReconstructOptions options = test::reduced(0.5);
        options.smooth.passes = 10;
        return test::run(test::grain_volume({9, 9, 9}, 6, 3, 4), options);
    }();
    return made;
}

/// Label 5 with a cavity, in it label 7, and a part of 5 beside them; all in 0.
inline Mesh nested() {
    Mesh mesh;
    test::add_octahedron(mesh, {}, {4, 4, 4}, 0, 2);
    test::add_octahedron(mesh, {}, {2, 2, 2}, 1, 0);
    test::add_octahedron(mesh, {8, 0, 0}, {1, 1, 1}, 0, 2);
    return mesh;
}
inline LabelTable nested_labels() { return test::labels_from({5, 7, 0}); }

class WriterTest : public TemporaryFolder {
protected:
    /// The text of the file that write_mesh makes.
    std::string written(const Mesh& mesh, const LabelTable& labels, const std::string& name,
                        const WriteOptions& options = {}) const {
        write_mesh(mesh, labels, path(name), options);
        return text_of(path(name));
    }
    /// Lines as words.
    static std::vector<std::vector<std::string>> rows_of(const std::string& text) {
        std::vector<std::vector<std::string>> rows;
        std::istringstream lines(text);
        for (std::string line; std::getline(lines, line);) {
            std::istringstream words(line);
            std::vector<std::string>& row = rows.emplace_back();
            for (std::string word; words >> word;) row.push_back(word);
        }
        return rows;
    }
    static std::size_t count_of(const std::string& text, const std::string& word) {
        std::size_t count = 0;
        for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++count;
        return count;
    }
};

}  // namespace regionmesh
