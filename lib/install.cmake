# SPDX-License-Identifier: Apache-2.0
# What an installed etendue gives to others: headers, the library, a CMake package and a pkg-config file. Both find
# their prefix from where they lie, so that the installed tree may be moved.
include(CMakePackageConfigHelpers)
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/etendue)

install(TARGETS etendue_lib EXPORT etendue-lib ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(EXPORT etendue-lib NAMESPACE etendue:: DESTINATION ${package_dir})
install(DIRECTORY etendue DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} FILES_MATCHING PATTERN "*.hpp")
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})

configure_package_config_file(etendue-config.cmake.in etendue-config.cmake INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(etendue-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/etendue-config.cmake ${CMAKE_CURRENT_BINARY_DIR}/etendue-config-version.cmake
        DESTINATION ${package_dir})

file(RELATIVE_PATH ETENDUE_PC_TO_PREFIX /prefix/${CMAKE_INSTALL_LIBDIR}/pkgconfig /prefix)
configure_file(etendue.pc.in etendue.pc @ONLY)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/etendue.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
