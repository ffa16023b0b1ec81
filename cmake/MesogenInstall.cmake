install(TARGETS mesogen_command EXPORT MesogenTargets RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(DIRECTORY python/mesogen DESTINATION lib/mesogen/python PATTERN __pycache__ EXCLUDE)
install(DIRECTORY app/templates DESTINATION share/mesogen)
install(FILES LICENSE README.md ARCHITECTURE.md CHANGELOG.md DESTINATION share/doc/mesogen)
file(GLOB pages CONFIGURE_DEPENDS docs/*.md)
install(FILES ${pages} docs/quickstart.png DESTINATION share/doc/mesogen/docs)
install(DIRECTORY cases studies DESTINATION share/mesogen)
install(DIRECTORY docs/accuracy docs/stability docs/performance docs/study DESTINATION share/doc/mesogen/docs)
install(DIRECTORY examples DESTINATION share/doc/mesogen)

# What an earlier Mesogen left beside this one would be loaded instead of it.
foreach(set IN ITEMS x86-64-v3 x86-64-v4)
  if(NOT set IN_LIST MESOGEN_INSTRUCTION_SETS)
    install(CODE "file(REMOVE \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/lib/glibc-hwcaps/${set}/libmesogen_sph.so\")")
  endif()
endforeach()

# find_package(Mesogen), from an installation and, without one, from the build folder.
include(CMakePackageConfigHelpers)
set(package lib/cmake/Mesogen)
configure_package_config_file(cmake/MesogenConfig.cmake.in ${CMAKE_BINARY_DIR}/${package}/MesogenConfig.cmake
                              INSTALL_DESTINATION ${package} NO_SET_AND_CHECK_MACRO NO_CHECK_REQUIRED_COMPONENTS_MACRO)
write_basic_package_version_file(${CMAKE_BINARY_DIR}/${package}/MesogenConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_BINARY_DIR}/${package}/MesogenConfig.cmake ${CMAKE_BINARY_DIR}/${package}/MesogenConfigVersion.cmake
              cmake/MesogenAddPlugin.cmake cmake/MesogenCuda.cmake cmake/MesogenCompileOptions.cmake DESTINATION ${package})
install(EXPORT MesogenTargets NAMESPACE Mesogen:: DESTINATION ${package})
export(EXPORT MesogenTargets NAMESPACE Mesogen:: FILE ${CMAKE_BINARY_DIR}/${package}/MesogenTargets.cmake)
file(COPY cmake/MesogenAddPlugin.cmake cmake/MesogenCuda.cmake cmake/MesogenCompileOptions.cmake DESTINATION ${CMAKE_BINARY_DIR}/${package})
