// Parts of the folders that Neuroglancer's data source `precomputed` reads.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "blocks/precomputed/levels.h"
#include "formats/report/json_parts.h"
#include "regionmesh/blocks.h"
#include "regionmesh/label_table.h"
#include "regionmesh/output_file.h"
#include "regionmesh/vec3.h"

namespace regionmesh {

/// The new files of a folder, which go again unless all of them are written.
class NewFiles {
public:
    explicit NewFiles(std::filesystem::path folder) : folder_(std::move(folder)) {}
    ~NewFiles();
    NewFiles(const NewFiles&) = delete;
    NewFiles& operator=(const NewFiles&) = delete;

    /// Gives a file of the folder its name.
    void commit(OutputFile& file, const std::string& name);
    void keep() { names_.clear(); }

private:
    std::filesystem::path folder_;
    std::vector<std::string> names_;
};

/// What is written, and where.
struct Precomputed {
    std::filesystem::path output;
    const LabelTable& labels;
    PrecomputedOptions options;  // options with what a folder says itself
    NewFiles& files;

    /// Nanometres in a unit of the model.
    double nanometres() const { return options.metres.value_or(1) * 1e9; }
    /// Not the exterior, not background.
    bool is_region(Label label) const;
    /// The name of a region in Neuroglancer: a decimal number. Throws Error(kInput) for a negative label.
    std::string id(Label label) const;
    /// Writes a file of the folder.
    void write(const std::string& name, std::string_view content) const;
};

/// The regions that were written, with their faces, the box of their vertices in nanometres, and what `info` says of
/// the meshes.
struct WrittenRegions {
    std::map<Label, std::uint64_t> faces;
    Box box;
    Json info;
    double rounded_share_of_edge = 0;  // rounded share of edge as PrecomputedResult has it
};

/// Single-resolution: ID:0 and one fragment for each part of the model.
WrittenRegions write_legacy_meshes(const Precomputed& precomputed, ModelLevels& model);

/// Multi-resolution: ID and ID.index, or shards. Throws Error(kOutput) in a build without Draco.
WrittenRegions write_multi_resolution_meshes(const Precomputed& precomputed, ModelLevels& model);

/// The names of the regions, `names/info`, and `state.json`, a state of the viewer.
void write_segment_names(const Precomputed& precomputed, const WrittenRegions& regions);
void write_viewer_state(const Precomputed& precomputed, const WrittenRegions& regions);

}  // namespace regionmesh
