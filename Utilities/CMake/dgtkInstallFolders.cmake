# Where things are installed, below any prefix.
#
# Libraries that other programs link stand in Debian's folder of libraries, where the loader finds them by itself: with the
# prefix /usr that is lib/<architecture>, and it is the same with every other prefix, so that one build is both installed
# and packed. What the editor alone loads stands below it, without versions. Programs and libraries find one another by
# paths relative to their own: a prefix may be moved, and a package unpacked anywhere.
set(DGTK_LIBDIR "lib/${CMAKE_LIBRARY_ARCHITECTURE}" CACHE STRING "Folder of the libraries, below the prefix")
set(CMAKE_INSTALL_LIBDIR "${DGTK_LIBDIR}")
include(GNUInstallDirs)
set(dgtk_private_libdir "${CMAKE_INSTALL_LIBDIR}/dgtk")
file(RELATIVE_PATH dgtk_lib_from_bin "/${CMAKE_INSTALL_BINDIR}" "/${CMAKE_INSTALL_LIBDIR}")
