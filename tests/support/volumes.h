// Small labelled volumes in memory: from text, from noise, from cells round random points.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "regionmesh/section_reader.h"

namespace regionmesh::test {

using Size = std::array<std::uint32_t, 3>;

/// Labels in memory and the library's reader of arrays: what a test changes in the lattice or the sweep holds for the
/// sections that follow.
class ArrayVolume : public SectionReader {
public:
    /// Labels with x fastest, then y.
    ArrayVolume(Size size, std::vector<InputLabel> labels);
    ArrayVolume(const ArrayVolume& other) : info_(other.info_), labels_(other.labels_) {}
    ArrayVolume(ArrayVolume&& other) = default;

    const VolumeInfo& info() const override { return info_; }
    bool next(std::span<InputLabel> section) override;
    void rewind() override { reader_.reset(); }

    Lattice& lattice() { return info_.lattice; }
    ArrayVolume& swept(Sweep sweep);
    ArrayVolume& spaced(Vec3 spacing);
    /// As a pipe: the sections can be read once.
    ArrayVolume& once();
    /// The labels are unsigned 64-bit numbers.
    ArrayVolume& unsigned_labels();

    const Size& size() const { return info_.lattice.size; }
    InputLabel at(std::uint32_t x, std::uint32_t y, std::uint32_t z) const;
    const std::vector<InputLabel>& labels() const { return labels_; }

private:
    VolumeInfo info_;
    std::vector<InputLabel> labels_;
    std::unique_ptr<SectionReader> reader_;  // made for the first section
};

/// One list of rows a section, one character a sample: {{"112", "122"}, {"111", "111"}}. 0-9, then a = 10 and so on.
class TextVolume : public ArrayVolume {
public:
    using Section = std::vector<std::string>;
    explicit TextVolume(const std::vector<Section>& sections);
};

/// One label everywhere.
ArrayVolume solid_volume(Size size, InputLabel label = 1);

/// Each sample has one of `label_count` labels, from `first` on, independent of its neighbours.
ArrayVolume noise_volume(Size size, std::uint32_t label_count, std::uint64_t seed, InputLabel first = 0);

/// Each sample has the label of the nearest of `label_count` random points: grains.
ArrayVolume grain_volume(Size size, std::uint32_t label_count, std::uint64_t seed, InputLabel first = 0);

/// So many blocks of grains along z, cubes of `side` samples, every second one mirrored.
ArrayVolume grain_blocks(std::uint32_t side, std::uint32_t count);

/// A ball of label 1 in label 0, in the middle; its radius is in samples.
ArrayVolume ball_volume(Size size, double radius);

}  // namespace regionmesh::test
