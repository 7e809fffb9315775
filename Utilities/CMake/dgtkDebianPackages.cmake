# `cpack` makes Debian packages of the build: one for each component of the install rules, of the component's name.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME dgtk)
set(CPACK_PACKAGE_VERSION "${PROJECT_VERSION}")
set(CPACK_PACKAGE_CONTACT "DGTk developers <dgtk@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "") # each package has its own
set(CPACK_PACKAGING_INSTALL_PREFIX "/usr")
set(CPACK_STRIP_FILES ON)
set(CPACK_PROJECT_CONFIG_FILE "${CMAKE_CURRENT_LIST_DIR}/dgtkPackageTime.cmake")
set(CPACK_PRE_BUILD_SCRIPTS "${CMAKE_CURRENT_LIST_DIR}/dgtkPackageFiles.cmake")
set(CPACK_DGTK_SOURCE_DIR "${PROJECT_SOURCE_DIR}")
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)

set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SOURCE dgtk)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS "${CMAKE_LIBRARY_OUTPUT_DIRECTORY}")
set(dgtk_same "(= ${PROJECT_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE})")

# dgtk_debian_package(<name> SECTION <section> SUMMARY <line> DESCRIPTION <text> [DEPENDS ...] [RECOMMENDS ...]
#                     [SUGGESTS ...] [CONTROL <files of the package's control folder>...])
# DEPENDS: what dpkg-shlibdeps cannot see, as it is opened by name or started.
set(CPACK_COMPONENTS_ALL "")
macro(dgtk_debian_package name)
  cmake_parse_arguments(_deb "" "SECTION;SUMMARY;DESCRIPTION" "DEPENDS;RECOMMENDS;SUGGESTS;CONTROL" ${ARGN})
  string(TOUPPER "${name}" _NAME)
  list(APPEND CPACK_COMPONENTS_ALL "${name}")
  set(CPACK_DEBIAN_${_NAME}_PACKAGE_NAME "${name}")
  set(CPACK_DEBIAN_${_NAME}_PACKAGE_SECTION "${_deb_SECTION}")
  set(CPACK_DEBIAN_${_NAME}_DESCRIPTION "${_deb_SUMMARY}\n${_deb_DESCRIPTION}")
  set(CPACK_DEBIAN_${_NAME}_PACKAGE_CONTROL_EXTRA "${_deb_CONTROL}")
  foreach(_field IN ITEMS DEPENDS RECOMMENDS SUGGESTS)
    list(JOIN _deb_${_field} ", " CPACK_DEBIAN_${_NAME}_PACKAGE_${_field})
  endforeach()
endmacro()

# For those who pack programs that link the libraries.
set(_shlibs "")
get_property(_on_demand GLOBAL PROPERTY dgtk_libraries_on_demand)
list(TRANSFORM _on_demand REPLACE "^dgtk" "DGTk::")
foreach(_module IN LISTS dgtk_modules _on_demand)
  string(REPLACE "DGTk::" "libdgtk" _library "${_module}")
  string(APPEND _shlibs "${_library} ${dgtk_soversion} dgtk (>= ${PROJECT_VERSION})\n")
endforeach()
file(CONFIGURE OUTPUT "${CMAKE_BINARY_DIR}/debian/dgtk/shlibs" CONTENT "${_shlibs}" @ONLY)

dgtk_debian_package(dgtk SECTION graphics
  SUMMARY "images and exact ground truth from described 3D scenes"
  DESCRIPTION
"DGTk renders scenes of models, lights, cameras and motion, and writes for
every pixel what is seen there: depth, objects, normals, positions,
correspondence, optical flow and more, for computer vision and image-based
rendering. It works without a display.
.
This package has the program dgtk, the programs that read models and pictures
for it, and the shared libraries."
  DEPENDS libegl1 libgl1-mesa-dri # opened by name: EGL, and Mesa's driver for machines without a graphics processor
  SUGGESTS povray blender # started: --renderer povray, models in .blend
  CONTROL "${CMAKE_BINARY_DIR}/debian/dgtk/shlibs")
if(DGTK_EDITOR)
  dgtk_debian_package(dgtk-editor SECTION graphics
    SUMMARY "desktop editor of DGTk's scenes"
    DESCRIPTION
"Scenes without writing files: objects, lights, cameras and key frames in
three dimensions, ground truth beside them while they are edited,
correspondences, and a viewer of datasets."
    DEPENDS "dgtk ${dgtk_same}"
    RECOMMENDS qttranslations5-l10n) # loaded by name: the texts of Qt's own dialogs
endif()
if(DGTK_PYTHON)
  math(EXPR _next "${Python3_VERSION_MINOR} + 1")
  dgtk_debian_package(python3-dgtk SECTION python
    SUMMARY "DGTk's images and ground truth as NumPy arrays"
    DESCRIPTION
"The Python package dgtk loads scenes and renders their layers into arrays.
Its classes are VTK's and can be used as such."
    DEPENDS "dgtk ${dgtk_same}" python3-numpy python3-vtk9
      "python3 (>= ${Python3_VERSION_MAJOR}.${Python3_VERSION_MINOR})" "python3 (<< ${Python3_VERSION_MAJOR}.${_next})"
    CONTROL "${CMAKE_BINARY_DIR}/debian/python3-dgtk/postinst" "${CMAKE_BINARY_DIR}/debian/python3-dgtk/prerm")
  foreach(_script IN ITEMS postinst prerm)
    configure_file("${PROJECT_SOURCE_DIR}/Utilities/Debian/python3-dgtk.${_script}" "${CMAKE_BINARY_DIR}/debian/python3-dgtk/${_script}" COPYONLY)
  endforeach()
endif()
dgtk_debian_package(libdgtk-dev SECTION libdevel
  SUMMARY "headers and CMake package of DGTk's libraries"
  DESCRIPTION
"For programs that use DGTk's libraries: find_package(DGTk) of CMake, targets
DGTk::Core, DGTk::Pipeline and others."
  DEPENDS "dgtk ${dgtk_same}" libeigen3-dev libvtk9-dev) # DGTkConfig.cmake looks for these
set(CPACK_DEBIAN_LIBDGTK-DEV_PACKAGE_SHLIBDEPS OFF) # of headers and links there are none to look for
include(CPack)
