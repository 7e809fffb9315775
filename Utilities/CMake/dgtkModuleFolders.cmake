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

# dgtk_find_source(<variable> <file>): where a file of that name stands, in the module's folder or one of its folders.
function(dgtk_find_source variable file)
  file(GLOB_RECURSE found RELATIVE "${CMAKE_CURRENT_SOURCE_DIR}" "${CMAKE_CURRENT_SOURCE_DIR}/${file}")
  list(LENGTH found count)
  if(NOT count EQUAL 1)
    message(FATAL_ERROR "${CMAKE_CURRENT_SOURCE_DIR}: expected one ${file}, found ${count}")
  endif()
  set("${variable}" "${found}" PARENT_SCOPE)
endfunction()
