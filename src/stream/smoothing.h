// Smoothing between the mesher and what comes after: batches in, the same batches out, some strips later.
#pragma once

#include <deque>
#include <vector>

#include "mesh/chunk.h"
#include "smooth/smoother.h"

namespace regionmesh {

/// Each batch is a layer of the smoother. What comes out differs from what went in by the places only.
class Smoothing {
public:
    Smoothing(const SmoothOptions& options, const LayerOrder& order) : smoother_(options, order) {}

    /// The batch of the next strip; throws HeldTooFew. Vertices to come lie at `plane` or beyond along the sweep.
    void add(const Chunk& batch, bool is_last, double plane);
    /// The next batch that is done, in the order in which they came; false when there is none yet.
    bool next(Chunk& batch);

    /// Strips held at most.
    std::uint32_t most_strips() const { return smoother_.most_layers(); }
    /// All that was not handed out lies here or beyond along the sweep.
    double floor() const { return smoother_.floor(); }
    const SmoothReport& report() const { return smoother_.report(); }

private:
    /// Numbers that the smoother gave to the vertices that a batch carries and leaves open.
    struct Strip {
        std::vector<std::uint32_t> carried, open;
    };
    void hand_out(std::uint32_t layer, const Strip& strip, Chunk& batch);

    Smoother smoother_;
    std::deque<Strip> strips_;         // not handed out
    std::vector<std::uint32_t> open_;  // of the last batch added
    std::uint32_t handed_out_ = 0;
};

}  // namespace regionmesh
