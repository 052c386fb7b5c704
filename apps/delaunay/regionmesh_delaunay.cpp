// SPDX-License-Identifier: GPL-3.0-or-later
//
// regionmesh-delaunay: the Delaunay tetrahedra of points. Points come on standard input, tetrahedra leave on standard
// output, as README.md beside this file says. It uses the part of CGAL that is under the GPL and is therefore under the
// GPL itself; it shares no code with regionmesh, which runs it as a process of its own.
//
// This program is free software: you can redistribute it and/or modify it under the terms of the GNU General Public
// License as published by the Free Software Foundation, either version 3 of the License, or (at your option) any later
// version. It comes without any warranty. COPYING beside this file holds the license.
#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Delaunay_triangulation_cell_base_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Spatial_sort_traits_adapter_3.h>
#include <CGAL/Triangulation_data_structure_3.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>
#include <CGAL/spatial_sort.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <boost/property_map/property_map.hpp>
#include <cerrno>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <exception>
#include <limits>
#include <new>
#include <numeric>
#include <stdexcept>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "confine.h"

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Vertex = CGAL::Triangulation_vertex_base_with_info_3<std::uint32_t, Kernel>;
using Cell = CGAL::Delaunay_triangulation_cell_base_3<Kernel>;
using Triangulation = CGAL::Delaunay_triangulation_3<Kernel, CGAL::Triangulation_data_structure_3<Vertex, Cell>>;

using Magic = std::array<char, 8>;
using Corners = std::array<std::uint32_t, 4>;
constexpr Magic kPointsMagic{'R', 'M', 'P', 'O', 'I', 'N', 'T', '1'};
constexpr Magic kTetrahedraMagic{'R', 'M', 'T', 'E', 'T', 'R', 'A', '1'};
constexpr std::uint32_t kNoPoint = std::numeric_limits<std::uint32_t>::max();
constexpr std::size_t kPiece = 1 << 16;  // points or tetrahedra read or written at a time

/// What the program ends with; README.md lists them.
enum ExitCode { kGood, kBadInput, kTooFew, kOnePlane, kOneLine, kOnePlace, kOutOfMemory, kBadOutput };

struct Failure {
    ExitCode code;
    std::string text;
};

struct Header {
    Magic magic;
    std::uint64_t count;
};

void read_all(void* to, std::size_t size) {
    for (char* next = static_cast<char*>(to); size > 0;) {
        const ssize_t count = ::read(STDIN_FILENO, next, size);
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) throw Failure{kBadInput, "standard input cannot be read: " + std::string(std::strerror(errno))};
        if (count == 0) throw Failure{kBadInput, "standard input ends before the last point"};
        next += count;
        size -= static_cast<std::size_t>(count);
    }
}

void write_all(const void* from, std::size_t size) {
    for (const char* next = static_cast<const char*>(from); size > 0;) {
        const ssize_t count = ::write(STDOUT_FILENO, next, size);
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) {
            throw Failure{kBadOutput, "standard output cannot be written: " + std::string(std::strerror(errno))};
        }
        next += count;
        size -= static_cast<std::size_t>(count);
    }
}

std::vector<Point> read_points() {
    Header header;
    read_all(&header, sizeof header);
    if (header.magic != kPointsMagic) throw Failure{kBadInput, "standard input does not hold points for this program"};
    if (header.count >= kNoPoint) {
        throw Failure{kBadInput, std::to_string(header.count) + " points; 4294967294 are the most"};
    }
    if (header.count < 4) {
        throw Failure{kTooFew, std::to_string(header.count) + " points; tetrahedra need at least four"};
    }
    std::vector<Point> points;
    points.reserve(header.count);
    std::vector<std::array<double, 3>> piece(std::min<std::size_t>(kPiece, header.count));
    while (points.size() < header.count) {
        piece.resize(std::min<std::size_t>(piece.size(), header.count - points.size()));
        read_all(piece.data(), piece.size() * sizeof piece[0]);
        for (const auto& [x, y, z] : piece) {
            if (!std::isfinite(x) || !std::isfinite(y) || !std::isfinite(z)) {
                throw Failure{kBadInput, "point " + std::to_string(points.size()) + " (from 0) is not finite"};
            }
            points.emplace_back(x, y, z);
        }
    }
    return points;
}

/// For CGAL: where the point with an index is. Its own maps take indices of 64 bits only.
struct PlaceOf {
    using key_type = std::uint32_t;
    using value_type = Point;
    using reference = const Point&;
    using category = boost::readable_property_map_tag;

    const Point* points;
    friend const Point& get(PlaceOf places, std::uint32_t index) { return places.points[index]; }
};

/// Neighbours come soon after one another. The shuffle inside starts from a fixed seed.
std::vector<std::uint32_t> order_in_space(const std::vector<Point>& points) {
    std::vector<std::uint32_t> order(points.size());
    std::iota(order.begin(), order.end(), 0);
    using Traits = CGAL::Spatial_sort_traits_adapter_3<Kernel, PlaceOf>;
    CGAL::spatial_sort(order.begin(), order.end(), Traits(PlaceOf{points.data()}));
    return order;
}

/// Spheres through five points or more are cut by CGAL's perturbation, which looks at coordinates only: the tetrahedra
/// do not depend on the order of insertion, and none is flat. Of equal points the first stands.
void insert_all(const std::vector<Point>& points, Triangulation& triangulation) {
    Triangulation::Cell_handle near;
    for (const std::uint32_t index : order_in_space(points)) {
        const std::size_t before = triangulation.number_of_vertices();
        const auto vertex = triangulation.insert(points[index], near);
        const bool is_new = triangulation.number_of_vertices() > before;
        vertex->info() = is_new ? index : std::min(vertex->info(), index);
        near = vertex->cell();
    }
}

void demand_tetrahedra(const Triangulation& triangulation, std::size_t point_count) {
    const std::string all = "all " + std::to_string(point_count) + " points lie ";
    const std::string rest = "; tetrahedra need four that do not lie in one plane";
    switch (triangulation.dimension()) {
        case 3:
            return;
        case 2:
            throw Failure{kOnePlane, all + "in one plane" + rest};
        case 1:
            throw Failure{kOneLine, all + "on one line" + rest};
        default:
            throw Failure{kOnePlace, all + "at one place" + rest};
    }
}

void write_tetrahedra(const Triangulation& triangulation) {
    const Header header{kTetrahedraMagic, triangulation.number_of_finite_cells()};
    write_all(&header, sizeof header);
    std::vector<Corners> piece;
    piece.reserve(kPiece);
    const auto flush = [&piece] {
        write_all(piece.data(), piece.size() * sizeof(Corners));
        piece.clear();
    };
    for (const auto cell : triangulation.finite_cell_handles()) {
        piece.push_back(
            {cell->vertex(0)->info(), cell->vertex(1)->info(), cell->vertex(2)->info(), cell->vertex(3)->info()});
        if (piece.size() == kPiece) flush();
    }
    flush();
}

/// Ends the program when nobody is left to read what it writes, however long it would have worked.
void end_when_alone() {
    std::thread([] {
        pollfd output{STDOUT_FILENO, 0, 0};
        while (::poll(&output, 1, -1) < 0 && errno == EINTR) {
        }
        ::_exit(kBadOutput);
    }).detach();
}

void run() {
    Triangulation triangulation;
    {
        const std::vector<Point> points = read_points();
        end_when_alone();
        insert_all(points, triangulation);
        demand_tetrahedra(triangulation, points.size());
    }
    write_tetrahedra(triangulation);
    // The memory goes back with the process: to take the cells apart one by one would only take time.
    ::_exit(kGood);
}

int complain(ExitCode code, std::string_view text) {
    std::fprintf(stderr, "regionmesh-delaunay: %.*s\n", static_cast<int>(text.size()), text.data());
    return code;
}

}  // namespace

int main(int argument_count, char**) {
    if (argument_count > 1) {
        std::puts("regionmesh-delaunay " REGIONMESH_VERSION
                  ": reads points from standard input, writes their Delaunay tetrahedra to standard output,\n"
                  "both binary. regionmesh runs it. GPL-3.0-or-later, without any warranty.");
        return kBadInput;
    }
    confine();
    try {
        run();
    } catch (const Failure& failure) {
        return complain(failure.code, failure.text);
    } catch (const std::bad_alloc&) {
        return complain(kOutOfMemory, "out of memory");
    } catch (const std::length_error&) {
        return complain(kOutOfMemory, "out of memory");
    } catch (const std::exception& error) {
        return complain(kBadInput, error.what());
    }
}
