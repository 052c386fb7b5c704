#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <utility>

#include "base/fingerprint.h"
#include "regionmesh/section_reader.h"

namespace regionmesh {

/// Sections of an input that has no name by which a run that goes on could tell it from another.
class FingerprintedSections final : public SectionReader {
public:
    explicit FingerprintedSections(std::unique_ptr<SectionReader> reader) : reader_(std::move(reader)) {}
    const VolumeInfo& info() const override { return reader_->info(); }
    bool next(std::span<InputLabel> section) override {
        if (!reader_->next(section)) return false;
        for (const InputLabel label : section) fingerprint_.add(static_cast<std::uint64_t>(label));
        return true;
    }
    void rewind() override {
        reader_->rewind();
        fingerprint_ = {};
    }
    /// Of the sections read so far.
    std::uint64_t fingerprint() const { return fingerprint_.value(); }

private:
    std::unique_ptr<SectionReader> reader_;
    Fingerprint fingerprint_;
};

}  // namespace regionmesh
