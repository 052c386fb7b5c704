// Numbers connected regions of samples section by section.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "regionmesh/label.h"

namespace regionmesh {

/// Gives each sample a number such that samples with one number are connected. A region has several numbers where parts
/// of it meet later in the sweep; `join` reports those. The same sections get the same numbers each time.
class RegionNumbers {
public:
    static constexpr std::uint32_t kNone = 0xFFFFFFFFu;

    RegionNumbers(std::uint32_t width, std::uint32_t height);

    /// Begins again with the first section.
    void restart();

    /// Numbers the next section and calls join(a, b) for numbers of one region. Returns false where 32 bits are too
    /// few.
    template <class Join>
    bool next(std::span<const InputLabel> section, Join&& join);

    /// Calls visit(number, label, other number, other label, axis) for each pair of neighbours with different labels,
    /// one of them in the last section. Axis 2 is that of the sweep.
    template <class Visit>
    void for_contacts(Visit&& visit) const;

    /// Numbers given since the start.
    std::uint32_t count() const { return count_; }
    std::uint32_t number(std::uint32_t u, std::uint32_t v) const { return now_.numbers[place(u, v)]; }

private:
    // A row and a column of kNone come first, so that every sample has neighbours.
    struct Layer {
        std::vector<std::uint32_t> numbers;
        std::vector<InputLabel> labels;
    };

    std::size_t place(std::uint32_t u, std::uint32_t v) const { return (std::size_t{v} + 1) * stride_ + u + 1; }
    std::uint32_t width_, height_;
    std::size_t stride_;
    Layer before_, now_;
    std::uint32_t count_ = 0;
};

template <class Join>
bool RegionNumbers::next(std::span<const InputLabel> section, Join&& join) {
    std::swap(before_, now_);
    auto sample = section.begin();
    for (std::uint32_t v = 0; v < height_; ++v)
        for (std::uint32_t u = 0; u < width_; ++u) {
            const std::size_t p = place(u, v);
            const InputLabel label = *sample++;
            std::uint32_t number = kNone;
            const auto look = [&](const Layer& layer, std::size_t q) {
                const std::uint32_t other = layer.numbers[q];
                if (other == kNone || other == number || layer.labels[q] != label) return;
                if (number == kNone)
                    number = other;
                else
                    join(number, other);
            };
            for (const std::size_t back : {std::size_t{1}, stride_, stride_ + 1}) look(now_, p - back);
            for (const std::size_t back : {std::size_t{0}, std::size_t{1}, stride_, stride_ + 1})
                look(before_, p - back);
            if (number == kNone && count_ == kNone) return false;
            now_.numbers[p] = number == kNone ? count_++ : number;
            now_.labels[p] = label;
        }
    return true;
}

template <class Visit>
void RegionNumbers::for_contacts(Visit&& visit) const {
    for (std::uint32_t v = 0; v < height_; ++v)
        for (std::uint32_t u = 0; u < width_; ++u) {
            const std::size_t p = place(u, v);
            const auto look = [&](const Layer& layer, std::size_t q, int axis) {
                const std::uint32_t other = layer.numbers[q];
                if (other != kNone && layer.labels[q] != now_.labels[p])
                    visit(now_.numbers[p], now_.labels[p], other, layer.labels[q], axis);
            };
            look(now_, p - 1, 0);
            look(now_, p - stride_, 1);
            look(before_, p, 2);
        }
}

}  // namespace regionmesh
