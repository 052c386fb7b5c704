# regionmesh::hdf5, dcmdata, oflog, ofstd, blosc, zstd, lz4, csv, deflate, minizip and draco: libraries of the parts of regionmesh::formats whose packages bring no CMake
# files, or a module that needs a project in C. Read when regionmesh is built, and again where an installed one is found.
# Sets `missing` to the names of the libraries that are not found.
set(REGIONMESH_HDF5_LIBRARIES hdf5)
set(REGIONMESH_DICOM_LIBRARIES dcmdata oflog ofstd)
set(REGIONMESH_ZARR_LIBRARIES blosc zstd lz4)
set(REGIONMESH_3MF_LIBRARIES minizip)
set(REGIONMESH_DRACO_LIBRARIES draco)
set(REGIONMESH_BASE_LIBRARIES csv deflate)  # needed by every build: tables of label names, VTK's models
set(REGIONMESH_WITH_BASE ON)
set(missing)
foreach(part BASE HDF5 DICOM ZARR 3MF DRACO)
    foreach(name ${REGIONMESH_${part}_LIBRARIES})
        if(REGIONMESH_WITH_${part} AND NOT TARGET regionmesh::${name})
            find_library(REGIONMESH_${name}_LIBRARY NAMES ${name}_serial ${name})  # Debian's name of HDF5, everyone else's
            find_path(REGIONMESH_${name}_INCLUDE_DIR NAMES ${name}.h lib${name}.h ${name}/zip.h ${name}/draco_features.h dcmtk/${name}/dcdatset.h dcmtk/${name}/oflog.h
                dcmtk/${name}/oftypes.h PATH_SUFFIXES ${name}/serial)
            mark_as_advanced(REGIONMESH_${name}_LIBRARY REGIONMESH_${name}_INCLUDE_DIR)
            if(REGIONMESH_${name}_LIBRARY AND REGIONMESH_${name}_INCLUDE_DIR)
                add_library(regionmesh::${name} UNKNOWN IMPORTED)
                set_target_properties(regionmesh::${name} PROPERTIES IMPORTED_LOCATION "${REGIONMESH_${name}_LIBRARY}"
                    INTERFACE_INCLUDE_DIRECTORIES "${REGIONMESH_${name}_INCLUDE_DIR}")
            else()
                list(APPEND missing ${name})
            endif()
        endif()
    endforeach()
endforeach()
