# regionmesh::csv: rows and fields of tables. Its package brings no CMake files.
# Read when regionmesh is built, and again where an installed one is found.
if(NOT TARGET regionmesh::csv)
    find_library(REGIONMESH_csv_LIBRARY csv)
    find_path(REGIONMESH_csv_INCLUDE_DIR csv.h)
    mark_as_advanced(REGIONMESH_csv_LIBRARY REGIONMESH_csv_INCLUDE_DIR)
    if(REGIONMESH_csv_LIBRARY AND REGIONMESH_csv_INCLUDE_DIR)
        add_library(regionmesh::csv UNKNOWN IMPORTED)
        set_target_properties(regionmesh::csv PROPERTIES IMPORTED_LOCATION "${REGIONMESH_csv_LIBRARY}"
            INTERFACE_INCLUDE_DIRECTORIES "${REGIONMESH_csv_INCLUDE_DIR}")
    endif()
endif()
