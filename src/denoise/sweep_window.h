// Lets samples change their label one by one, in sweeps over a window of sections, where topology allows it.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <functional>
#include <vector>

#include "denoise/candidates.h"
#include "denoise/kuhn_link.h"
#include "denoise/smooth_labels.h"
#include "regionmesh/label.h"

namespace regionmesh {

/// A candidate on its way through the sweeps.
struct Moving {
    std::uint32_t sample;
    Label from, to;
    float distance;  // from the boundary of its region, in finest spacings
    bool is_changed = false, is_cut = false;
};

struct SweepOptions {
    std::uint32_t width = 0, height = 0, count = 0;  // samples of a section, and sections
    int sweeps = 6;
    bool cuts = false;  // threads and pinholes of one sample go
    std::uint32_t threads = 0;
};

/// Sections go through stages in order, each some sections behind the one before: first their candidates are found,
/// with all labels as they came; then sweeps change labels. A sweep has two stages, even sections and odd ones, and
/// each has four classes of samples by the parity of their places. Samples of one class are not neighbours, so the
/// order within a class does not matter, and threads do not change the result.
class SweepWindow {
public:
    using FindCandidates = std::function<void(const LabelWindow&, std::uint32_t section, std::vector<Moving>& found)>;
    /// Labels of a section after all sweeps, and its candidates.
    using HandOut = std::function<void(std::uint32_t section, const std::vector<Label>&, const std::vector<Moving>&)>;

    /// `reach`: sections on each side that `find` reads.
    SweepWindow(const SweepOptions& options, std::uint32_t reach, FindCandidates find, HandOut hand_out);

    /// Most sections that it holds.
    std::uint32_t sections() const;

    /// Sections come in order.
    void add(std::vector<Label> section);

private:
    enum class Kind { kFind, kEven, kOdd, kCut };
    struct Stage {
        Kind kind;
        std::uint32_t reach;  // sections on each side that it reads
        std::uint32_t lag;    // sections that the stage before must be ahead
        std::uint32_t done = 0;
    };
    struct Held {
        std::vector<Moving> moving = {};
        std::array<std::vector<std::uint32_t>, 4> by_class = {};  // numbers in `moving`
    };

    void plan_stages(std::uint32_t reach);
    void run(const Stage& stage, std::uint32_t section);
    void sort_classes(Held& held) const;
    void sweep(std::uint32_t section);
    void cut(std::uint32_t section);
    bool may_cut(std::uint32_t section, const Moving& candidate, const LinkLabels& link) const;
    bool are_joined(std::uint32_t section, std::uint32_t sample, Label label, LinkSet nodes) const;
    LinkLabels link_of(std::uint32_t section, std::uint32_t sample) const;

    SweepOptions options_;
    FindCandidates find_;
    HandOut hand_out_;
    std::vector<Stage> stages_;
    LabelWindow window_;
    std::deque<Held> held_;
    std::uint32_t added_ = 0, handed_out_ = 0;
};

}  // namespace regionmesh
