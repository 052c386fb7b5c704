// The XML of VTK image data, without the arrays in it.
// https://docs.vtk.org/en/latest/design_documents/VTKFileFormats.html
#pragma once

#include <cstdint>
#include <string>

#include "formats/input_file.h"
#include "formats/vtk/vtk_xml_tags.h"
#include "regionmesh/lattice.h"
#include "regionmesh/section_reader.h"

namespace regionmesh::formats {

/// An array of integers, one a sample, and where its bytes lie.
struct VtiArray : VtkArrayPlace {
    SampleType type = SampleType::kU8;
    std::string name;
};

struct VtiHeader {
    Lattice lattice;  // of the samples: points, or centres of cells
    VtiArray array;
    VtkEncoding encoding;
};

/// Reads the file once up to its appended data, but holds the tags only. Throws Error(kInput) naming the file: more
/// than one piece, no array of integers or several of which none is the active scalars, another compression than zlib.
VtiHeader read_vti_header(const InputFile& file);

}  // namespace regionmesh::formats
