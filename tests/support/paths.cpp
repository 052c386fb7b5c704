#include "support/paths.h"

#include <cstdlib>

namespace regionmesh::test {

namespace {

/// The tests lie in another folder than the programs. What the environment says already stands.
[[maybe_unused]] const int kHdf5IsNamed = ::setenv("REGIONMESH_HDF5_PROGRAM", REGIONMESH_HDF5_PROGRAM, 0);
[[maybe_unused]] const int kDicomIsNamed = ::setenv("REGIONMESH_DICOM_PROGRAM", REGIONMESH_DICOM_PROGRAM, 0);

}  // namespace

std::string data_folder() { return REGIONMESH_TEST_DATA; }
std::string source_folder() { return REGIONMESH_SOURCE_DIR; }
std::string program() { return REGIONMESH_PROGRAM; }
std::string hdf5_program() { return REGIONMESH_HDF5_PROGRAM; }
std::string dicom_program() { return REGIONMESH_DICOM_PROGRAM; }
std::string mpi_program() { return REGIONMESH_MPI_PROGRAM; }
std::string shim() { return REGIONMESH_SHIM; }
std::string delaunay_program() { return REGIONMESH_DELAUNAY_PROGRAM; }

}  // namespace regionmesh::test
