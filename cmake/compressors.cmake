# regionmesh::blosc, regionmesh::zstd and regionmesh::lz4: what chunks are packed with. Not all of their packages bring
# CMake files. Read when regionmesh is built, and again where an installed one is found.
foreach(name blosc zstd lz4)
    if(NOT TARGET regionmesh::${name})
        find_library(REGIONMESH_${name}_LIBRARY ${name})
        find_path(REGIONMESH_${name}_INCLUDE_DIR ${name}.h)
        mark_as_advanced(REGIONMESH_${name}_LIBRARY REGIONMESH_${name}_INCLUDE_DIR)
        if(REGIONMESH_${name}_LIBRARY AND REGIONMESH_${name}_INCLUDE_DIR)
            add_library(regionmesh::${name} UNKNOWN IMPORTED)
            set_target_properties(regionmesh::${name} PROPERTIES IMPORTED_LOCATION "${REGIONMESH_${name}_LIBRARY}"
                INTERFACE_INCLUDE_DIRECTORIES "${REGIONMESH_${name}_INCLUDE_DIR}")
        endif()
    endif()
endforeach()
