# In cpack, before anything is made: files, archives and the changelog have the time of the commit, so that the same
# commit is the same bytes. SOURCE_DATE_EPOCH of the environment counts before it.
if(NOT "$ENV{SOURCE_DATE_EPOCH}" MATCHES "^[0-9]+$")
  execute_process(COMMAND git -C "${CPACK_DGTK_SOURCE_DIR}" log -1 --format=%ct
    OUTPUT_VARIABLE _time OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  if(NOT _time MATCHES "^[0-9]+$") # a source without its history
    file(TIMESTAMP "${CPACK_DGTK_SOURCE_DIR}/CMakeLists.txt" _time "%s" UTC)
  endif()
  set(ENV{SOURCE_DATE_EPOCH} "${_time}")
endif()
