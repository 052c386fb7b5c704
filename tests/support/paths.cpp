#include "support/paths.h"

namespace regionmesh::test {

std::string data_folder() { return REGIONMESH_TEST_DATA; }
std::string source_folder() { return REGIONMESH_SOURCE_DIR; }
std::string program() { return REGIONMESH_PROGRAM; }
std::string delaunay_program() { return REGIONMESH_DELAUNAY_PROGRAM; }

}  // namespace regionmesh::test
