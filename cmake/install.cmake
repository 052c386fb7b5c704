# `cmake --install` copies the program (apps/cli), the libraries, the public headers, and the files that
# find_package(regionmesh) reads. The installed package is tested by building the examples against it.
include(CMakePackageConfigHelpers)
set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME dev)

set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/regionmesh)
configure_package_config_file(cmake/regionmesh-config.cmake.in regionmesh-config.cmake INSTALL_DESTINATION ${package_folder})
write_basic_package_version_file(regionmesh-config-version.cmake COMPATIBILITY SameMinorVersion)

set(archives $<TARGET_FILE_NAME:regionmesh_core>)
install(TARGETS regionmesh_core EXPORT regionmesh-targets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
set(without)
if(REGIONMESH_FORMATS)
    list(APPEND archives $<TARGET_FILE_NAME:regionmesh_formats>)
    install(TARGETS regionmesh_formats EXPORT regionmesh-targets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
else()
    foreach(header blocks formats label_names_file mesh_file output_file read_layers read_sections read_tetrahedra write_report write_volume page options change_model)
        list(APPEND without PATTERN ${header}.h EXCLUDE)
    endforeach()
endif()
# With code for link-time optimisation g++ compiles the libraries again for each program, as that is compiled: programs
# without optimisation crashed (g++ 12).
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_INTERPROCEDURAL_OPTIMIZATION)
    install(CODE "foreach(archive ${archives})
        set(file \"${CMAKE_INSTALL_LIBDIR}/\${archive}\")
        cmake_path(ABSOLUTE_PATH file BASE_DIRECTORY \"\${CMAKE_INSTALL_PREFIX}\")
        execute_process(COMMAND \"${CMAKE_STRIP}\" --enable-deterministic-archives -R .gnu.lto_* -R .gnu.debuglto_*
            -N __gnu_lto_slim -N __gnu_lto_v1 \"\$ENV{DESTDIR}\${file}\" COMMAND_ERROR_IS_FATAL ANY)
    endforeach()")
endif()
install(DIRECTORY include/regionmesh DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} FILES_MATCHING PATTERN "*.h" ${without})
install(EXPORT regionmesh-targets NAMESPACE regionmesh:: DESTINATION ${package_folder})
install(FILES ${PROJECT_BINARY_DIR}/regionmesh-config.cmake ${PROJECT_BINARY_DIR}/regionmesh-config-version.cmake
    cmake/exact_numbers.cmake cmake/format_libraries.cmake DESTINATION ${package_folder})
install(FILES LICENSE README.md CHANGELOG.md DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program)

# A program linked with sanitizers would have to be built with them, too.
if(REGIONMESH_FORMATS AND REGIONMESH_TESTS AND NOT REGIONMESH_SANITIZE)
    set(prefix ${PROJECT_BINARY_DIR}/installed)
    add_test(NAME install COMMAND ${CMAKE_COMMAND} --install ${PROJECT_BINARY_DIR} --prefix ${prefix})
    add_test(NAME installed_package_builds_and_runs_the_example
        COMMAND ${CMAKE_CTEST_COMMAND} --build-and-test ${PROJECT_SOURCE_DIR}/examples ${PROJECT_BINARY_DIR}/examples
            --build-generator ${CMAKE_GENERATOR}
            --build-options -DCMAKE_PREFIX_PATH=${prefix} -DCMAKE_CXX_COMPILER=${CMAKE_CXX_COMPILER} -DCMAKE_BUILD_TYPE=Debug
            --test-command reconstruct ${PROJECT_SOURCE_DIR}/tests/data/npy/uint8.npy ${PROJECT_BINARY_DIR}/examples/model.vtp)
    set(examples ${PROJECT_BINARY_DIR}/examples)
    set_tests_properties(installed_package_builds_and_runs_the_example PROPERTIES FIXTURES_SETUP examples)
    add_test(NAME example_core COMMAND ${examples}/core)
    add_test(NAME example_computed_sections COMMAND ${examples}/computed_sections ${examples}/gyroid.vtp)
    add_test(NAME example_regions COMMAND ${examples}/regions ${examples}/gyroid.vtp ${examples}/gyroid.csv)
    add_test(NAME example_select COMMAND ${examples}/select ${PROJECT_SOURCE_DIR}/tests/data/npy/uint8.npy ${examples}/part.vtp 1 30)
    set_tests_properties(example_core example_computed_sections example_regions example_select PROPERTIES FIXTURES_REQUIRED examples)
    set_tests_properties(example_regions PROPERTIES DEPENDS example_computed_sections)
    add_test(NAME installed_headers_are_the_public_ones
        COMMAND ${CMAKE_COMMAND} -D SOURCE=${PROJECT_SOURCE_DIR} -D PREFIX=${prefix} -P ${PROJECT_SOURCE_DIR}/tests/package/installed_headers.cmake)
    set_tests_properties(install PROPERTIES FIXTURES_SETUP installed_package)
    set_tests_properties(installed_package_builds_and_runs_the_example installed_headers_are_the_public_ones
        PROPERTIES FIXTURES_REQUIRED installed_package)
    add_test(NAME core_builds_and_runs_alone
        COMMAND ${CMAKE_COMMAND} -D SOURCE=${PROJECT_SOURCE_DIR} -D BINARY=${PROJECT_BINARY_DIR}/core_alone -D GENERATOR=${CMAKE_GENERATOR}
            -D COMPILER=${CMAKE_CXX_COMPILER} -D C_COMPILER=${CMAKE_C_COMPILER} -D LAUNCHER=${CMAKE_CXX_COMPILER_LAUNCHER}
            -P ${PROJECT_SOURCE_DIR}/tests/package/core_alone.cmake)
    set_tests_properties(core_builds_and_runs_alone PROPERTIES TIMEOUT 900)
endif()
