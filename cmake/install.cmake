# What `cmake --install` copies: program (see cli/), library, headers, and the files that find_package(regionmesh) reads.
# The installed package is tested by building the example against it.
include(CMakePackageConfigHelpers)

set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/regionmesh)
configure_package_config_file(cmake/regionmesh-config.cmake.in regionmesh-config.cmake INSTALL_DESTINATION ${package_folder})
write_basic_package_version_file(regionmesh-config-version.cmake COMPATIBILITY SameMinorVersion)

set(libraries regionmesh_core)
if(REGIONMESH_FORMATS)
    list(APPEND libraries regionmesh_formats)
endif()
install(TARGETS ${libraries} EXPORT regionmesh-targets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(DIRECTORY include/regionmesh DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} FILES_MATCHING PATTERN "*.h")
install(EXPORT regionmesh-targets NAMESPACE regionmesh:: DESTINATION ${package_folder})
install(FILES ${PROJECT_BINARY_DIR}/regionmesh-config.cmake ${PROJECT_BINARY_DIR}/regionmesh-config-version.cmake
    cmake/exact_numbers.cmake cmake/format_libraries.cmake DESTINATION ${package_folder})
install(FILES LICENSE README.md CHANGELOG.md DESTINATION ${CMAKE_INSTALL_DOCDIR})

# A program linked with sanitizers would have to be built with them, too.
if(REGIONMESH_FORMATS AND REGIONMESH_TESTS AND NOT REGIONMESH_SANITIZE)
    set(prefix ${PROJECT_BINARY_DIR}/installed)
    add_test(NAME install COMMAND ${CMAKE_COMMAND} --install ${PROJECT_BINARY_DIR} --prefix ${prefix})
    add_test(NAME installed_package_builds_and_runs_the_example
        COMMAND ${CMAKE_CTEST_COMMAND} --build-and-test ${PROJECT_SOURCE_DIR}/examples ${PROJECT_BINARY_DIR}/examples
            --build-generator ${CMAKE_GENERATOR}
            --build-options -DCMAKE_PREFIX_PATH=${prefix} -DCMAKE_CXX_COMPILER=${CMAKE_CXX_COMPILER} -DCMAKE_BUILD_TYPE=${CMAKE_BUILD_TYPE}
            --test-command reconstruct ${PROJECT_SOURCE_DIR}/tests/data/npy/uint8.npy ${PROJECT_BINARY_DIR}/examples/model.vtp)
    set_tests_properties(install PROPERTIES FIXTURES_SETUP installed_package)
    set_tests_properties(installed_package_builds_and_runs_the_example PROPERTIES FIXTURES_REQUIRED installed_package)
endif()
