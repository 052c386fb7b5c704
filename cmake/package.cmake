# Debian packages by CPack, one for each component of cmake/install.cmake; script/package runs it.
set(REGIONMESH_MAINTAINER "regionmesh authors <regionmesh@example.org>" CACHE STRING "Maintainer of the Debian packages")
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME regionmesh)
set(CPACK_PACKAGE_VENDOR regionmesh)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
option(REGIONMESH_SYSTEM_PACKAGE "The Python module is for a package of the system: it uses the system's programs" OFF)
set(CPACK_COMPONENTS_ALL program dev doc)
set(packages regionmesh:program libregionmesh-dev:dev regionmesh-doc:doc)
if(REGIONMESH_WITH_PYTHON AND REGIONMESH_SYSTEM_PACKAGE)
    list(APPEND CPACK_COMPONENTS_ALL python)
    list(APPEND packages python3-regionmesh:python)
    set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-regionmesh)
    set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
    set(CPACK_DEBIAN_PYTHON_PACKAGE_SHLIBDEPS ON)
    get_target_property(module_suffix regionmesh_python SUFFIX)  # .cpython-311-x86_64-linux-gnu.so
    string(REGEX REPLACE "^.*cpython-3([0-9]+).*$" "\\1" Python_VERSION_MINOR "${module_suffix}")
    math(EXPR next_python "${Python_VERSION_MINOR} + 1")
    set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS
        "python3 (>= 3.${Python_VERSION_MINOR}), python3 (<< 3.${next_python}), python3-numpy, regionmesh (= ${PROJECT_VERSION})")
    set(CPACK_DEBIAN_PYTHON_DESCRIPTION "checked surface models of labelled arrays (Python module)
Arrays of labels in, surface models of all regions out, with numpy arrays for
points, faces and labels.")
endif()
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_MAINTAINER "${REGIONMESH_MAINTAINER}")
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)

set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME regionmesh)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PROGRAM_DESCRIPTION "checked surface models of labelled volumes
regionmesh reads segmented scans, atlases and stacks of sections, and writes
one triangle mesh in which neighbouring regions share their faces.")

set(CPACK_DEBIAN_DEV_PACKAGE_NAME libregionmesh-dev)
set(CPACK_DEBIAN_DEV_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEV_PACKAGE_DEPENDS "zlib1g-dev, libtiff-dev, libpng-dev, libblosc-dev, libzstd-dev, liblz4-dev, libcsv-dev, libdeflate-dev, libminizip-dev, libdraco-dev, libpugixml-dev, libfmt-dev, libgmp-dev, libmpfr-dev, libtbb-dev")
set(CPACK_DEBIAN_DEV_DESCRIPTION "checked surface models of labelled volumes (C++ library)
Static libraries, headers and the files that CMake's find_package reads.")

set(CPACK_DEBIAN_DOC_PACKAGE_NAME regionmesh-doc)
set(CPACK_DEBIAN_DOC_PACKAGE_SECTION doc)
set(CPACK_DEBIAN_DOC_PACKAGE_ARCHITECTURE all)
set(CPACK_DEBIAN_DOC_DESCRIPTION "checked surface models of labelled volumes (documentation)
The pages of regionmesh as Markdown, with pictures, and examples in C++.")

install(DIRECTORY docs/ DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/regionmesh-doc/docs COMPONENT doc)
install(DIRECTORY bench/results DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/regionmesh-doc/bench COMPONENT doc
        FILES_MATCHING PATTERN "*.md" PATTERN "paper" EXCLUDE)
install(DIRECTORY examples DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/regionmesh-doc COMPONENT doc)
# Debian's policy wants a changelog in its own form, compressed without a time stamp.
file(WRITE ${PROJECT_BINARY_DIR}/changelog "regionmesh (${PROJECT_VERSION}) unstable; urgency=medium

  * CHANGELOG.md has the changes.

 -- ${REGIONMESH_MAINTAINER}  Sat, 21 Nov 2026 00:00:00 +0000
")
execute_process(COMMAND gzip -9nf ${PROJECT_BINARY_DIR}/changelog COMMAND_ERROR_IS_FATAL ANY)
# Libraries that are compiled in: their notices follow ours.
file(READ LICENSE copyright)
file(READ viewer/three.LICENSE text)
string(APPEND copyright "\n\nParts of three.js are compiled in:\n\n${text}")
set(libraries libcgal-dev nlohmann-json3-dev libcli11-dev)
if(REGIONMESH_WITH_PYTHON)
    list(APPEND libraries pybind11-dev)
endif()
foreach(library IN LISTS libraries)
    set(notice /usr/share/doc/${library}/copyright)
    if(NOT EXISTS ${notice})
        message(STATUS "${notice} is missing: packages made here lack it")
        continue()
    endif()
    file(READ ${notice} text)
    string(APPEND copyright "\n\nParts of ${library} are compiled in:\n\n${text}")
endforeach()
file(WRITE ${PROJECT_BINARY_DIR}/copyright "${copyright}")
foreach(package_component IN LISTS packages)
    string(REPLACE ":" ";" pair ${package_component})
    list(GET pair 0 package)
    list(GET pair 1 component)
    install(FILES ${PROJECT_BINARY_DIR}/copyright DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${package} COMPONENT ${component})
    install(FILES ${PROJECT_BINARY_DIR}/changelog.gz DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${package} COMPONENT ${component})
endforeach()
include(CPack)
