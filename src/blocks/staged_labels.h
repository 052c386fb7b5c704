// The labels of a volume on disk, dense, so that any box of them can be read: the volume re-blocked once.
#pragma once

#include <filesystem>
#include <functional>
#include <span>

#include "blocks/label_boxes.h"
#include "formats/input_file.h"
#include "regionmesh/label_table.h"
#include "regionmesh/output_file.h"
#include "regionmesh/section_reader.h"

namespace regionmesh {

/// A file of 32-bit dense labels, section by section as the volume is swept. Reading a box reads its rows and no more.
class StagedLabels final : public LabelBoxes {
public:
    using OnStrip = std::function<void(std::span<const Label> low, std::span<const Label> high, bool is_last)>;

    /// Reads the volume once and writes its labels, numbered by `labels`. Calls `on_strip` for two consecutive sections
    /// at a time. The file has its name only when it is complete.
    static void write(SectionReader& reader, LabelTable& labels, const std::filesystem::path& path,
                      const OutputOptions& options, const OnStrip& on_strip = {});

    /// Throws Error(kInput) where the file is missing or of another size than the volume.
    StagedLabels(const std::filesystem::path& path, const Lattice& lattice, const Sweep& sweep);

    void read(const IndexBox& box, std::uint32_t number, std::span<Label> section) const override;

private:
    formats::InputFile file_;
    Lattice lattice_;
    Sweep sweep_;
};

}  // namespace regionmesh
