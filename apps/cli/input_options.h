// The options that say how to read a volume, shared by all commands that do.
#pragma once

#include <CLI/CLI.hpp>
#include <memory>
#include <string>
#include <vector>

#include "regionmesh/formats.h"
#include "regionmesh/regionmesh.h"

namespace regionmesh::cli {

struct InputOptions {
    std::string sweep = "auto";
    std::string spacing, size, type, layer;
    std::vector<std::string> background;
    bool no_background = false;
    std::string boundary = "cap";

    /// Adds --sweep, --spacing, --layer, --size and --type.
    void add_volume_options(CLI::App& command);
    /// Adds --background and --no-background.
    void add_background_options(CLI::App& command);
    /// Adds these and --boundary.
    void add_label_options(CLI::App& command);
    /// That of --sweep for points and meshes; none for auto.
    std::optional<Sweep> sweep_of_tetrahedra() const;
    /// What is counted of an input of any kind.
    CensusOptions census_options() const;
    /// Throws Error(kInput) for a word that is no number.
    std::unique_ptr<SectionReader> open(const std::vector<std::string>& inputs) const;
    std::vector<InputLabel> background_labels() const;
    /// What check() should know of a model from a file; refers to `labels`, and adds the background to it.
    CheckOptions check_options(LabelTable& labels) const;
    bool cap() const { return boundary == "cap"; }
};

/// A count, share or size as typed; each throws Error(kInput) naming the flag.
std::uint64_t parse_count(const std::string& flag, const std::string& text);
double parse_number(const std::string& flag, const std::string& text);
double parse_share(const std::string& flag, const std::string& text);         // "90%" or "0.9"
std::uint64_t parse_bytes(const std::string& flag, const std::string& text);  // "2GiB", "500MB", "1000000"

}  // namespace regionmesh::cli
