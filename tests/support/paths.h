// Where the tests find their data, the sources and the programs under test.
#pragma once

#include <string>

namespace regionmesh::test {

std::string data_folder();
std::string source_folder();
std::string program();
/// Empty where it was not built.
std::string delaunay_program();
std::string hdf5_program();
std::string dicom_program();
std::string mpi_program();
/// The library that lets the calls of a program fail (tests/faults/shim.cpp). Empty under sanitizers.
std::string shim();

}  // namespace regionmesh::test
