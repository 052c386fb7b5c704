# regionmesh::gmp and regionmesh::mpfr: the exact numbers behind the predicates. Their packages bring no CMake files.
# Read when regionmesh is built, and again where an installed one is found.
foreach(name gmp mpfr)
    if(NOT TARGET regionmesh::${name})
        find_library(REGIONMESH_${name}_LIBRARY ${name})
        mark_as_advanced(REGIONMESH_${name}_LIBRARY)
        if(REGIONMESH_${name}_LIBRARY)
            add_library(regionmesh::${name} UNKNOWN IMPORTED)
            set_target_properties(regionmesh::${name} PROPERTIES IMPORTED_LOCATION "${REGIONMESH_${name}_LIBRARY}")
        endif()
    endif()
endforeach()
