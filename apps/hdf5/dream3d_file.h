// DREAM.3D files, version 8: a triangle geometry in HDF5.
// https://www.dream3d.io (the file has groups and arrays as objects, each with an id, a type and its dimensions)
#pragma once

#include <string>

namespace regionmesh::hdf5 {

/// The bytes of the file of a model on standard input, which README.md describes. Throws std::bad_alloc where memory
/// runs out, and std::runtime_error with one line where the input is none.
std::string make_dream3d();

}  // namespace regionmesh::hdf5
