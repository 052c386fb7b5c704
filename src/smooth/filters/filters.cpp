// The table of the smoothing filters. A new filter is a file with its class, a row here and a name in SmoothFilter.
#include <algorithm>
#include <array>
#include <cassert>

#include "smooth/filters/filter.h"
#include "smooth/filters/nifpms.h"
#include "smooth/filters/relax.h"
#include "smooth/tuning.h"

namespace regionmesh {
namespace {

struct FilterRow {
    SmoothFilter filter;
    std::unique_ptr<Filter> (*make)(const FilterInput& input);
    std::uint64_t bytes_per_face;  // bytes per face in addition to the window that all filters with passes share
};

template <class F>
std::unique_ptr<Filter> make(const FilterInput& input) {
    return std::make_unique<F>(input);
}

constexpr std::array kRows{
    FilterRow{SmoothFilter::kTaubin, make<Relaxation>, 0},
    FilterRow{SmoothFilter::kLaplacian, make<Relaxation>, 0},
    FilterRow{SmoothFilter::kNifpms, make<Nifpms>, Nifpms::kBytesPerFace},
};

const FilterRow& row_of(SmoothFilter filter) {
    const auto row = std::ranges::find(kRows, filter, &FilterRow::filter);
    assert(row != kRows.end());
    return *row;
}

}  // namespace

std::unique_ptr<Filter> make_filter(const FilterInput& input) { return row_of(input.options.filter).make(input); }

std::uint64_t window_bytes_per_face(SmoothFilter filter, double faces_per_sample, std::uint64_t shared) {
    if (filter != SmoothFilter::kLattice) return shared + row_of(filter).bytes_per_face;
    return faces_per_sample > smoothing::kDenseFaces ? smoothing::kDenseLatticeBytesPerFace
                                                     : smoothing::kLatticeBytesPerFace;
}

}  // namespace regionmesh
