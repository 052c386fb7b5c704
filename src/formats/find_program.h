// Finds the programs of this project that the library runs: regionmesh-delaunay, regionmesh-hdf5 and regionmesh-dicom.
#pragma once

#include <filesystem>
#include <vector>

namespace regionmesh::formats {

/// A program by its file name, and the environment variable that may name another one.
struct HelperProgram {
    const char* name;
    const char* variable;
};

inline constexpr HelperProgram kHdf5Program{.name = "regionmesh-hdf5", .variable = "REGIONMESH_HDF5_PROGRAM"};
inline constexpr HelperProgram kDicomProgram{.name = "regionmesh-dicom", .variable = "REGIONMESH_DICOM_PROGRAM"};
inline constexpr HelperProgram kDelaunayProgram{.name = "regionmesh-delaunay", .variable = "REGIONMESH_DELAUNAY"};

/// The path of the program: `given` if it is not empty, else the value of the environment variable, else the file of
/// that name in the folder of the running program, in the bin or libexec/regionmesh folder of the install prefix, or on
/// PATH, in this order. Throws Error(kInput) that names the places searched.
std::filesystem::path find_program(const HelperProgram& program, const std::filesystem::path& given = {});

/// All paths that find_program() may return.
std::vector<std::filesystem::path> places_of_program(const HelperProgram& program,
                                                     const std::filesystem::path& given = {});

}  // namespace regionmesh::formats
