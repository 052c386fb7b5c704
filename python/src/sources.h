// Where labels come from: arrays, calls into Python, files.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "regionmesh/array_sections.h"
#include "regionmesh/options.h"
#include "regionmesh/prepare_sections.h"
#include "regionmesh/section_reader.h"

namespace regionmesh::python {

namespace py = pybind11;

/// A reader, and the Python object that its samples lie in.
struct Source {
    py::object owner;
    std::unique_ptr<SectionReader> reader;
    OpenAlong open = {};                     // opens the same samples again; empty: they come along one axis alone
    SweepChoice sweep = SweepChoice::kAuto;  // with which `reader` was opened
};

/// The sections of a source, prepared as Settings::prepare says. They refer to the source.
PreparedSections prepared(Source& source, const PrepareOptions& options);

/// Where samples lie, as Python passes it: x, y, z; the direction in row-major order; the metres in a unit of length;
/// the name of the space, which may be empty.
struct Frame {
    std::array<double, 3> spacing, origin;
    std::array<double, 9> direction;
    std::optional<double> metres;
    std::string space;
};

Lattice lattice_of(const Frame& frame, const ArraySize& size);

/// A view of an array [z, y, x]. Throws TypeError for samples that are no integers in the byte order of the machine.
Source array_source(const py::array& array, const Frame& frame, const ArrayOptions& rest);

/// Calls `next` for each section [y, x] along z, and `rewind`, if it is not None, to begin again. Both are called with
/// the GIL, on any thread, one at a time.
struct SectionCalls {
    py::object next, rewind;
    std::array<std::uint32_t, 3> size;  // x, y, z
    std::string type;                   // as in --type
};
Source call_source(SectionCalls calls, const Frame& frame, const ArrayOptions& rest);

/// The labels to keep; none: all. The others become background before anything else is chosen.
using KeptLabels = std::optional<std::vector<InputLabel>>;

/// A UserWarning of what a reader says, if it says anything.
void warn_of(const std::string& source, const std::string& warning);

Source file_source(const std::vector<std::string>& paths, const OptionValues& options, const KeptLabels& kept);

/// The part of a source that the labels and the options roi, box, downsample and min-region choose. Sources of files
/// are chosen from when they are opened.
Source select(Source source, const OptionValues& options, const KeptLabels& kept);

}  // namespace regionmesh::python
