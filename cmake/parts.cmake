# The parts of regionmesh::formats that a build may leave out: an option REGIONMESH_WITH_<PART> each, which the registry
# of formats reads as 0 or 1. Sources and tests belong to a part by their names.
option(REGIONMESH_WITH_HDF5 "Read HDF5 and DREAM.3D, write DREAM.3D" ON)
option(REGIONMESH_WITH_DICOM "Read DICOM segmentations" ON)
option(REGIONMESH_WITH_ZARR "Read Zarr and N5" ON)
option(REGIONMESH_WITH_TIFF "Read TIFF" ON)
option(REGIONMESH_WITH_PNG "Read PNG" ON)
option(REGIONMESH_WITH_3MF "Write 3MF" ON)
option(REGIONMESH_WITH_DRACO "Write multi-resolution meshes for Neuroglancer" ON)
option(REGIONMESH_WITH_TABLES "Read tables of points and drill holes" ON)

set(part_of_hdf5 "/formats/[a-z]+/[a-z0-9_]*(hdf5|dream3d)[a-z0-9_]*\\.cpp$")
set(part_of_dicom "/[a-z]+/[a-z0-9_]*dicom[a-z0-9_]*\\.cpp$")
set(part_of_zarr "/formats/[a-z]+/[a-z0-9_]*(zarr|n5|store_|chunk_codec)[a-z0-9_]*\\.cpp$")
set(part_of_tiff "/formats/[a-z]+/[a-z0-9_]*(tiff|images_test)[a-z0-9_]*\\.cpp$")
set(part_of_png "/formats/[a-z]+/[a-z0-9_]*(png|images_test)[a-z0-9_]*\\.cpp$")
set(part_of_3mf "/formats/[a-z]+/[a-z0-9_]*3mf[a-z0-9_]*\\.cpp$")
set(part_of_draco "/precomputed[a-z_]*_test\\.cpp$")
set(part_of_tables "/(boreholes/[a-z0-9_]*|cli/(tetrahedra|tutorials)_test)\\.cpp$")

# Takes the files of the parts that are off out of a list.
function(leave_out_parts list)
    foreach(part hdf5 dicom zarr tiff png 3mf draco tables)
        string(TOUPPER ${part} name)
        if(NOT REGIONMESH_WITH_${name})
            list(FILTER ${list} EXCLUDE REGEX "${part_of_${part}}")
        endif()
    endforeach()
    set(${list} ${${list}} PARENT_SCOPE)
endfunction()

# Tells one source which parts are built.
function(define_parts source)
    set(definitions)
    foreach(name HDF5 DICOM ZARR TIFF PNG 3MF DRACO TABLES)
        list(APPEND definitions REGIONMESH_WITH_${name}=$<BOOL:${REGIONMESH_WITH_${name}}>)
    endforeach()
    set_source_files_properties(${source} PROPERTIES COMPILE_DEFINITIONS "${definitions}")
endfunction()
