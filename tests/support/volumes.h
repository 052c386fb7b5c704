// Small labelled volumes in memory: from text, from noise, from cells round random points.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "regionmesh/section_reader.h"

namespace regionmesh::test {

using Size = std::array<std::uint32_t, 3>;

/// Labels in memory, handed out section by section along any sweep.
class ArrayVolume : public SectionReader {
public:
    /// Labels with x fastest, then y.
    ArrayVolume(Size size, std::vector<InputLabel> labels);

    const VolumeInfo& info() const override { return info_; }
    bool next(std::span<InputLabel> section) override;
    void rewind() override { section_ = 0; }

    Lattice& lattice() { return info_.lattice; }
    ArrayVolume& swept(Sweep sweep);
    ArrayVolume& spaced(Vec3 spacing);
    /// As a pipe: the sections can be read once.
    ArrayVolume& once();

    const Size& size() const { return info_.lattice.size; }
    InputLabel at(std::uint32_t x, std::uint32_t y, std::uint32_t z) const;
    const std::vector<InputLabel>& labels() const { return labels_; }

private:
    VolumeInfo info_;
    std::vector<InputLabel> labels_;
    std::uint32_t section_ = 0;
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
