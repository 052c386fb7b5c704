// The labels of a volume on disk, dense, so that any box of them can be read: those of inputs that must be read in
// order.
#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "blocks/label_boxes.h"
#include "formats/input_file.h"
#include "regionmesh/label_table.h"
#include "regionmesh/output_file.h"
#include "regionmesh/section_reader.h"

namespace regionmesh {

/// A file of 32-bit dense labels, section by section as the volume is swept. Reading a box reads its rows and no more.
class StagedLabels final : public LabelBoxes {
public:
    /// Throws Error(kInput) where the file is missing or of another size than the volume.
    StagedLabels(const std::filesystem::path& path, const Lattice& lattice, const Sweep& sweep);

    std::unique_ptr<BoxSections> open(const IndexBox& box) const override;
    const std::filesystem::path& path() const { return file_.path(); }

private:
    formats::InputFile file_;
    Lattice lattice_;
    Sweep sweep_;
};

/// The labels of the input out of such a file, as a reader that can_crop().
class StagedReader final : public SectionReader {
public:
    /// All must outlive it. `labels` is the table of the file.
    StagedReader(const StagedLabels& staged, const LabelTable& labels, const VolumeInfo& info);

    const VolumeInfo& info() const override { return info_; }
    bool next(std::span<InputLabel> section) override;
    void rewind() override;
    bool crop(const IndexBox& box) override;

private:
    const StagedLabels& staged_;
    const LabelTable& labels_;
    VolumeInfo info_;
    IndexBox box_;
    std::unique_ptr<BoxSections> sections_;
    std::uint32_t next_ = 0;
    std::vector<Label> section_;
};

/// Writes such a file.
class StagingFile {
public:
    StagingFile(const std::filesystem::path& path, const OutputOptions& options) : file_(path, options) {}

    /// Appends a section.
    void write(std::span<const Label> section) {
        file_.write({reinterpret_cast<const char*>(section.data()), section.size_bytes()});
    }
    /// The file has its name only now.
    void commit() { file_.commit(); }

private:
    OutputFile file_;
};

}  // namespace regionmesh
