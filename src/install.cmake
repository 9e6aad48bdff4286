# Installs the headers, the library, a CMake package (pbmpm::pbmpm) and a pkg-config file; with PBMPM_STATIC also the static library, pbmpm::static and
# pbmpm-static.pc.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(package_dir "${CMAKE_INSTALL_LIBDIR}/cmake/pbmpm")
install(TARGETS ${libraries} EXPORT pbmpm
    RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}" # a DLL
    LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}"
    ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}")
install(DIRECTORY "${PROJECT_SOURCE_DIR}/include/pbmpm" DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}" FILES_MATCHING PATTERN "*.h" PATTERN "*.hpp")
install(EXPORT pbmpm NAMESPACE pbmpm:: FILE pbmpm-targets.cmake DESTINATION "${package_dir}")
configure_package_config_file(pbmpm-config.cmake.in pbmpm-config.cmake INSTALL_DESTINATION "${package_dir}")
install(FILES "${CMAKE_CURRENT_BINARY_DIR}/pbmpm-config.cmake" DESTINATION "${package_dir}")

# Before 1.0 a new minor version may change the interface.
write_basic_package_version_file("${CMAKE_CURRENT_BINARY_DIR}/pbmpm-config-version.cmake" COMPATIBILITY SameMinorVersion)
install(FILES "${CMAKE_CURRENT_BINARY_DIR}/pbmpm-config-version.cmake" DESTINATION "${package_dir}")

# The paths in the .pc file are relative to itself, so an installed tree may be moved.
file(RELATIVE_PATH pc_to_prefix "/${CMAKE_INSTALL_LIBDIR}/pkgconfig" "/")
list(JOIN PBMPM_MATERIALS_BUILT " " pc_materials)

# write_pc(NAME LIBRARY [CFLAG])
function(write_pc name pc_libs)
    set(pc_cflags ${ARGN})
    configure_file(pbmpm.pc.in ${name}.pc @ONLY)
    install(FILES "${CMAKE_CURRENT_BINARY_DIR}/${name}.pc" DESTINATION "${CMAKE_INSTALL_LIBDIR}/pkgconfig")
endfunction()

set(archive "-L\${libdir} -l:libpbmpm.a") # by its file: -lpbmpm would take the shared one beside it
if(APPLE) # whose linker knows no such option; a blank in the path ends it
    set(archive "\${libdir}/libpbmpm.a")
endif()
string(APPEND archive " -pthread -lm")
if(BUILD_SHARED_LIBS)
    write_pc(pbmpm "-L\${libdir} -lpbmpm")
    if(PBMPM_STATIC)
        write_pc(pbmpm-static "${archive}" " -DPBMPM_STATIC")
    endif()
else()
    write_pc(pbmpm "${archive}" " -DPBMPM_STATIC")
endif()
