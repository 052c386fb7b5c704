#include "boreholes/delaunay_reader.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "formats/find_program.h"
#include "formats/surface/tetrahedron_formats.h"
#include "regionmesh/error.h"
#include "volume/exact_grid.h"

namespace regionmesh::formats {
namespace {

using Magic = std::array<char, 8>;
constexpr Magic kPointsMagic{'R', 'M', 'P', 'O', 'I', 'N', 'T', '1'};
constexpr Magic kTetrahedraMagic{'R', 'M', 'T', 'E', 'T', 'R', 'A', '1'};
constexpr std::size_t kPiece = 4096;  // tetrahedra read at a time

struct Header {
    Magic magic;
    std::uint64_t count;
};

/// Messages for the exit codes that report degenerate points.
const char* place_of_all(int exit_code) {
    switch (exit_code) {
        case 3:
            return "in one plane";
        case 4:
            return "on one line";
        case 5:
            return "at one place";
        default:
            return nullptr;
    }
}

constexpr int kOutOfMemory = 6;
constexpr int kKilled = 9;  // the signal that ends a process that takes too much memory

}  // namespace

DelaunayReader::DelaunayReader(PointTable table, std::filesystem::path program)
    : table_(std::move(table)), path_(std::move(program)), point_count_(table_.points.positions.size()) {
    table_.info.hull_is_convex = true;
}

LabelledPoints DelaunayReader::take_points() {
    assert(!program_ && !left_);
    static_assert(sizeof(Vec3) == 3 * sizeof(double));
    program_.emplace(path_);
    const Header header{kPointsMagic, point_count_};
    // A failure shows in its answer.
    if (program_->send(std::as_bytes(std::span(&header, 1)))) {
        program_->send(std::as_bytes(std::span(table_.points.positions)));
    }
    program_->end_input();
    return std::exchange(table_.points, {});
}

std::string DelaunayReader::name_of_point(std::uint32_t point) const {
    return "row " + std::to_string(table_.rows[point]);
}

std::string DelaunayReader::name_of_tetrahedron(std::uint64_t tetrahedron) const {
    return "tetrahedron " + std::to_string(tetrahedron);
}

void DelaunayReader::refuse(const std::string& what) const {
    throw Error(ErrorCode::kInput, table_.info.source + ": " + what);
}

void DelaunayReader::refuse_ending() {
    const PipedProgram::Ending ending = program_->end();
    program_.reset();
    const std::string points = std::to_string(point_count_) + " points";
    if (ending.exit_code) {
        if (const char* place = place_of_all(*ending.exit_code)) {
            refuse("all " + points + " lie " + place + "; tetrahedra need four that do not lie in one plane");
        }
    }
    std::string what = path_.string();
    if (ending.was_idle) {
        what += " did nothing for " + std::to_string(PipedProgram::kIdleSeconds.count()) + " s and was stopped";
    } else if (ending.signal) {
        what += " was killed by signal " + std::to_string(*ending.signal);
        if (*ending.signal == kKilled) what += " (out of memory?)";
    } else if (ending.exit_code == kOutOfMemory) {
        what += " ran out of memory";
    } else if (ending.exit_code.value_or(0) != 0) {
        what += " failed with exit code " + std::to_string(*ending.exit_code);
        if (!ending.last_words.empty()) what += " (" + ending.last_words + ")";
    } else {
        what += " stopped before it had written all tetrahedra";
    }
    refuse(what + "; it was given " + points + ": leave some out, or take a larger --step");
}

void DelaunayReader::read_header() {
    Header header;
    if (program_->receive(std::as_writable_bytes(std::span(&header, 1))) < sizeof header) refuse_ending();
    if (header.magic != kTetrahedraMagic) refuse(path_.string() + " did not write tetrahedra; is it another program?");
    left_ = header.count;
}

void DelaunayReader::check(const Corners& corners) const {
    if (has_repeated_corner(corners) || *std::max_element(corners.begin(), corners.end()) >= point_count_)
        refuse(path_.string() + " wrote a tetrahedron without four points; is it another version?");
}

/// Ends the program, which frees its memory, before the last tetrahedra are returned.
void DelaunayReader::finish() {
    std::byte more;
    if (program_->receive(std::span(&more, 1)) > 0) refuse(path_.string() + " wrote more than it announced");
    const PipedProgram::Ending ending = program_->end();
    program_.reset();
    if (ending.exit_code != 0) refuse(path_.string() + " failed after the last tetrahedron");
}

std::size_t DelaunayReader::next(std::span<LabelledTetrahedron> tetrahedra) {
    assert(program_ || left_);
    if (!left_) {
        read_header();
        if (*left_ == 0) finish();
    }
    const std::size_t count = std::min<std::uint64_t>({tetrahedra.size(), kPiece, *left_});
    if (count == 0) return 0;
    piece_.resize(count);
    const auto bytes = std::as_writable_bytes(std::span(piece_));
    if (program_->receive(bytes) < bytes.size()) refuse_ending();
    for (std::size_t i = 0; i < count; ++i) {
        check(piece_[i]);
        tetrahedra[i] = {.corners = piece_[i]};
    }
    *left_ -= count;
    if (*left_ == 0) finish();
    return count;
}

std::unique_ptr<TetrahedronReader> open_points(PointTable table, const TetrahedraOptions& options) {
    const std::size_t count = table.points.positions.size();
    if (count < 4)
        throw Error(ErrorCode::kInput, table.info.source + ": " + std::to_string(count) +
                                           (count == 1 ? " point" : " points") + "; tetrahedra need at least four");
    return std::make_unique<DelaunayReader>(std::move(table), find_program(kDelaunayProgram, options.delaunay));
}

std::unique_ptr<TetrahedronReader> open_table(const std::filesystem::path& path, const TetrahedraOptions& options) {
    PointTable table = read_point_table(path, options);
    move_to_exact_grid(table.points.positions);
    return open_points(std::move(table), options);
}

}  // namespace regionmesh::formats
