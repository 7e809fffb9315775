# find_package(DGTk) for other projects: see Testing/Consumer.
include(CMakePackageConfigHelpers)
set(dgtk_cmake_dir "${CMAKE_INSTALL_LIBDIR}/cmake/DGTk")
configure_package_config_file("${CMAKE_CURRENT_LIST_DIR}/DGTkConfig.cmake.in" "${CMAKE_BINARY_DIR}/DGTkConfig.cmake"
  INSTALL_DESTINATION "${dgtk_cmake_dir}")
write_basic_package_version_file("${CMAKE_BINARY_DIR}/DGTkConfigVersion.cmake" COMPATIBILITY SameMinorVersion)
install(FILES "${CMAKE_BINARY_DIR}/DGTkConfig.cmake" "${CMAKE_BINARY_DIR}/DGTkConfigVersion.cmake"
  DESTINATION "${dgtk_cmake_dir}" COMPONENT libdgtk-dev)
