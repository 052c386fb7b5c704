# regionmesh::hdf5, and regionmesh::blosc, zstd and lz4 that chunks are packed with. Not all of their packages bring CMake
# files, and CMake's own module for HDF5 wants a project that speaks C. Read when regionmesh is built, and again where an
# installed one is found.
set(hdf5_names hdf5_serial hdf5)  # Debian's name, everyone else's
foreach(name hdf5 blosc zstd lz4)
    if(NOT TARGET regionmesh::${name})
        find_library(REGIONMESH_${name}_LIBRARY NAMES ${${name}_names} ${name})
        find_path(REGIONMESH_${name}_INCLUDE_DIR ${name}.h PATH_SUFFIXES ${name}/serial)
        mark_as_advanced(REGIONMESH_${name}_LIBRARY REGIONMESH_${name}_INCLUDE_DIR)
        if(REGIONMESH_${name}_LIBRARY AND REGIONMESH_${name}_INCLUDE_DIR)
            add_library(regionmesh::${name} UNKNOWN IMPORTED)
            set_target_properties(regionmesh::${name} PROPERTIES IMPORTED_LOCATION "${REGIONMESH_${name}_LIBRARY}"
                INTERFACE_INCLUDE_DIRECTORIES "${REGIONMESH_${name}_INCLUDE_DIR}")
        endif()
    endif()
endforeach()
