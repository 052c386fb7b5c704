// Labels back on the lattice: which region of a surface model each sample lies in.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "regionmesh/label_table.h"
#include "regionmesh/lattice.h"
#include "regionmesh/mesh.h"
#include "regionmesh/section_reader.h"

namespace regionmesh {

class SampleLines;

/// The label of a sample that lies in no region.
inline constexpr Label kNoRegion = exterior(0);

struct VoxeliseOptions {
    Lattice lattice;  // where the samples lie, in the space of the mesh
    Sweep sweep = {};
    std::vector<Label> background = {};  // regions whose faces with the exterior are not in the mesh
};

/// Hands out the labels of the samples of a lattice, section by section, from a closed labelled surface.
///
/// A line of samples runs along the first axis of the sweep. Each face that the line crosses takes it from one region
/// to another; the region of a sample is the one that was entered once more than it was left. Which faces a line
/// crosses, and on which side of a face a sample lies, are signs of determinants of the coordinates as given, and
/// exact. Ties are broken by symbolic perturbation (Edelsbrunner and Muecke 1990): every sample is moved by (e^3, e,
/// e^2) along x, y, z of the lattice for an infinitely small e, toward the inside of the box of the model along each
/// axis. A sample on a capped side of the box therefore has the region inside.
///
/// An oblique lattice has its vertices turned into the axes of the lattice first; there the coordinates are rounded. So
/// vertices within 1e-9 spacings of samples on a side of the box of the model are moved to where these lie, and also
/// where a side of the model and samples of another lattice differ by rounding alone. If all coordinates are numbers of
/// single precision, as in .dream3d and binary .stl files, so are vertices that its rounding may have moved away from
/// such samples (docs/how-to/voxelise.md says how far).
class Voxeliser {
public:
    /// Holds a reference to the mesh. Memory: 8 bytes a face, 8 bytes a vertex, and the crossings of the sections
    /// filled at a time. Faces are sorted on at most `threads` threads (0: one per core). Throws Error(kInput) for a
    /// lattice that require_lattice() refuses, and for what require_sweep() does.
    Voxeliser(const Mesh& mesh, const VoxeliseOptions& options, std::uint32_t threads = 1);

    /// Fills the labels of the next section, size[axes[0]] * size[axes[1]] samples with axes[0] fastest; kNoRegion
    /// outside all regions, or the first background label where there is one. False when all sections were handed out.
    /// Throws Error(kUsage) for room of another size.
    bool next(std::span<Label> section);
    /// Fills the labels of the sections that come next, on at most `threads` threads (0: one per core), and returns how
    /// many: fewer than asked at the end.
    std::uint32_t next(std::span<const std::span<Label>> sections, std::uint32_t threads);

    /// Goes on with this section, which is not before the next one.
    void skip_to(std::uint32_t section);

    /// Samples so far at which the surface contradicts itself: no region, or several, were entered once more than
    /// they were left. 0 for a closed surface. Such a sample is counted as outside.
    std::uint64_t contradictions() const { return contradictions_; }

private:
    struct Crossing {
        std::uint64_t sample;  // first_of(row) + index of the first one beyond the face (row length if none is)
        Label left, entered;
    };
    /// Room for one section.
    struct Scratch {
        std::vector<Crossing> crossings;
        std::vector<std::pair<Label, int>> entered;  // times entered less times left, of regions where this is not 0
        std::uint64_t contradictions = 0;
    };
    /// Sections: from the first one at or above, to before the first one above.
    struct Sections {
        std::uint32_t first, end;
    };
    struct ActiveFace {
        FaceId face;
        Sections sections;
    };

    void find_sides(SampleLines& lines);
    Vec3 in_sweep(Vec3 p) const;
    Vec3 in_lines(VertexId v) const;
    Vec3 place(VertexId v) const;
    void find_sections(std::uint32_t threads);
    Sections sections_of(FaceId f) const;
    void sort_faces();
    void activate(std::uint32_t first, std::uint32_t begin, std::uint32_t end);
    void label_section(std::uint32_t section, std::span<Label> labels, Scratch& scratch) const;
    void cross(FaceId f, std::uint32_t section, std::vector<Crossing>& crossings) const;
    void label_row(std::span<const Crossing> crossings, std::uint64_t first, std::span<Label> labels,
                   Scratch& scratch) const;
    bool is_outside(Label label) const;
    std::uint64_t first_of(std::uint32_t row) const { return std::uint64_t{row} * (size_[0] + 1); }
    std::uint32_t first_at_or_above(int axis, double low) const;
    std::uint32_t end_at_or_below(int axis, double high) const;

    const Mesh& mesh_;
    VoxeliseOptions options_;
    std::shared_ptr<const SampleLines> lines_;
    std::array<std::uint32_t, 3> size_;             // along the axes of the sweep
    std::array<std::array<double, 2>, 3> sides_{};  // one per axis: the samples nearest to either end of the model
    std::vector<Sections> sections_of_;             // one per vertex
    std::vector<FaceId> order_;                     // faces that reach sections, by the first of these
    std::vector<std::uint32_t> start_;              // start of the faces of each section in order_
    std::vector<ActiveFace> active_;                // faces that reach the sections in hand
    std::vector<Scratch> scratch_;                  // one per section in hand
    IntoAxes into_axes_;
    bool is_mirrored_ = false, is_turned_ = false;
    double rounding_ = 0;  // share of a coordinate that is lost; 0 where none is
    std::uint32_t section_ = 0;
    std::uint64_t contradictions_ = 0;
};

/// How well a model agrees with the sections that it was made from.
struct SampleAgreement {
    std::uint64_t samples = 0;
    std::uint64_t wrong = 0;           // whose region differs from their label
    std::uint64_t contradictions = 0;  // Voxeliser::contradictions()
    struct Counts {
        std::uint64_t in_sections = 0, in_model = 0, in_both = 0;
        Counts& operator+=(const Counts& other) {
            in_sections += other.in_sections;
            in_model += other.in_model;
            in_both += other.in_both;
            return *this;
        }
        /// Dice's coefficient: 2 |A and B| / (|A| + |B|); 1 where both are empty.
        double dice() const {
            const std::uint64_t sum = in_sections + in_model;
            return sum == 0 ? 1 : 2.0 * static_cast<double>(in_both) / static_cast<double>(sum);
        }
    };
    std::vector<Counts> regions;      // one per dense label; background labels count with the first
    std::optional<Label> background;  // the first of them
    /// Over all regions but the background: 2 sum |A and B| / sum (|A| + |B|).
    double dice() const;
};

/// Adds a section of samples to the counts: as the sections have them, and as the model has them. Labels that only the
/// sections have are added to `labels`.
void add_samples(SampleAgreement& counts, LabelTable& labels, const std::vector<Label>& background,
                 std::span<const InputLabel> given, std::span<const Label> found);

/// Voxelises the mesh on the lattice of the reader, and compares sample by sample. `labels` is the table of the mesh;
/// labels that only the sections have are added to it. Rewinds the reader if it can, and reads it to its end, on at
/// most `threads` threads (0: one per core). Throws what the reader throws.
SampleAgreement compare_samples(const Mesh& mesh, LabelTable& labels, const std::vector<Label>& background,
                                SectionReader& reader, std::uint32_t threads = 0);

}  // namespace regionmesh
