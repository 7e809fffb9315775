# Sources of a module stand in its folder or, by subject, in folders of it. Headers are included by their names alone.

# dgtk_module_folders(<module>): after vtk_module_add_module(), the subfolders that hold headers.
function(dgtk_module_folders module)
  file(GLOB_RECURSE headers LIST_DIRECTORIES false "${CMAKE_CURRENT_SOURCE_DIR}/*/*.h")
  list(FILTER headers EXCLUDE REGEX "/Testing/")
  list(TRANSFORM headers REPLACE "/[^/]*$" "")
  list(REMOVE_DUPLICATES headers)
  list(TRANSFORM headers REPLACE "(.+)" "$<BUILD_INTERFACE:\\1>")
  target_include_directories("${module}" PUBLIC ${headers})
endfunction()

# dgtk_library_on_demand(<name> <module> SOURCES <file>... LINK <target>...): a part of a module that is a library of its
# own, which stands beside the module's and is loaded when it is needed (dgtkOnDemand.h).
function(dgtk_library_on_demand name module)
  cmake_parse_arguments(PARSE_ARGV 2 _o "" "" "SOURCES;LINK")
  add_library(${name} SHARED ${_o_SOURCES})
  target_link_libraries(${name} PRIVATE ${_o_LINK})
  target_include_directories(${name} PRIVATE "$<TARGET_PROPERTY:${module},INCLUDE_DIRECTORIES>")
  set_target_properties(${name} PROPERTIES VERSION "${PROJECT_VERSION}" SOVERSION "${dgtk_soversion}")
  install(TARGETS ${name} LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT dgtk NAMELINK_SKIP)
  set_property(GLOBAL APPEND PROPERTY dgtk_libraries_on_demand ${name})
endfunction()

# dgtk_find_source(<variable> <file>): where a file of that name stands, in the module's folder or one of its folders.
function(dgtk_find_source variable file)
  file(GLOB_RECURSE found RELATIVE "${CMAKE_CURRENT_SOURCE_DIR}" "${CMAKE_CURRENT_SOURCE_DIR}/${file}")
  list(LENGTH found count)
  if(NOT count EQUAL 1)
    message(FATAL_ERROR "${CMAKE_CURRENT_SOURCE_DIR}: expected one ${file}, found ${count}")
  endif()
  set("${variable}" "${found}" PARENT_SCOPE)
endfunction()
