# Python wrapping of the dgtk* classes by VTK's wrapper: `import dgtk` with Debian's python3.
set(dgtk_python_destination "lib/python3/dist-packages")
set(dgtk_install_rpath "${CMAKE_INSTALL_RPATH}")
set(CMAKE_INSTALL_RPATH "$ORIGIN/../../../../${CMAKE_INSTALL_LIBDIR}")
vtk_module_wrap_python(
  MODULES DGTk::Pipeline
  TARGET DGTk::PythonWrapped
  PYTHON_PACKAGE "dgtk"
  MODULE_DESTINATION "${dgtk_python_destination}"
  CMAKE_DESTINATION "${CMAKE_INSTALL_LIBDIR}/cmake/DGTk"
  INSTALL_HEADERS OFF
  BUILD_STATIC OFF)
set(CMAKE_INSTALL_RPATH "${dgtk_install_rpath}")
set(dgtk_python_init "${CMAKE_BINARY_DIR}/${dgtk_python_destination}/dgtk/__init__.py")
configure_file("${CMAKE_CURRENT_LIST_DIR}/dgtk__init__.py.in" "${dgtk_python_init}" @ONLY)
install(FILES "${dgtk_python_init}" DESTINATION "${dgtk_python_destination}/dgtk")
