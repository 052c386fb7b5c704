// Which array of VTK image data has the labels, and where its samples lie.
#pragma once

#include "formats/vtk/vtk_xml.h"
#include "regionmesh/lattice.h"
#include "regionmesh/section_reader.h"

namespace regionmesh::formats {

struct VtiHeader {
    Lattice lattice;  // of the samples: points, or centres of cells
    pugi::xml_node array;
    SampleType type = SampleType::kU8;
};

/// Throws Error(kInput) naming the file: more than one piece, no array of integers, or several of which none is the
/// active scalars.
VtiHeader read_vti_header(const VtkXml& xml);

}  // namespace regionmesh::formats
