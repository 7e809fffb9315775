# Python wrapping of the dgtk* classes by VTK's wrapper: `import dgtk` with Debian's python3.
set(dgtk_python_destination "lib/python3/dist-packages")
set(dgtk_install_rpath "${CMAKE_INSTALL_RPATH}")
set(CMAKE_INSTALL_RPATH "$ORIGIN/../../../../${CMAKE_INSTALL_LIBDIR}")
vtk_module_wrap_python(
  MODULES DGTk::Pipeline DGTk::FromVTK
  TARGET DGTk::PythonWrapped
  PYTHON_PACKAGE "dgtk"
  MODULE_DESTINATION "${dgtk_python_destination}"
  CMAKE_DESTINATION "${CMAKE_INSTALL_LIBDIR}/cmake/DGTk"
  COMPONENT python3-dgtk
  INSTALL_HEADERS OFF
  BUILD_STATIC OFF)
set(CMAKE_INSTALL_RPATH "${dgtk_install_rpath}")
# The package's own files; those in .in learn what was built.
set(dgtk_python_sources "${PROJECT_SOURCE_DIR}/Modules/Pipeline/Python")
set(dgtk_python_package "${CMAKE_BINARY_DIR}/${dgtk_python_destination}/dgtk")
file(GLOB dgtk_python_files CONFIGURE_DEPENDS RELATIVE "${dgtk_python_sources}"
  "${dgtk_python_sources}/*.py" "${dgtk_python_sources}/*.py.in" "${dgtk_python_sources}/*.pyi" "${dgtk_python_sources}/py.typed")
foreach(dgtk_python_file IN LISTS dgtk_python_files)
  string(REGEX REPLACE "\\.in$" "" dgtk_python_built "${dgtk_python_file}")
  if(dgtk_python_built STREQUAL dgtk_python_file)
    configure_file("${dgtk_python_sources}/${dgtk_python_file}" "${dgtk_python_package}/${dgtk_python_built}" COPYONLY)
  else()
    configure_file("${dgtk_python_sources}/${dgtk_python_file}" "${dgtk_python_package}/${dgtk_python_built}" @ONLY)
  endif()
  install(FILES "${dgtk_python_package}/${dgtk_python_built}" DESTINATION "${dgtk_python_destination}/dgtk" COMPONENT python3-dgtk)
endforeach()
