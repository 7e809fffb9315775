# dgtk_add_tests(<Module> <source>... [LINK <targets>...] [SHARDS <n>] [TIMEOUT <seconds>])
# One GoogleTest program, Test<Module>, of the module's Testing folder. It is one test of CTest, or SHARDS of them that run
# beside one another: starting a process a case costs more than most cases do. With DGTK_TEST_EACH_CASE each case is a test.
include(GoogleTest)

# Seconds that tests may take; with sanitizers, which are ten times slower, what ctest's --timeout says.
function(dgtk_limit_tests seconds)
  if(NOT DGTK_SANITIZE)
    set_tests_properties(${ARGN} PROPERTIES TIMEOUT ${seconds})
  endif()
endfunction()

# The interpreter of tests of Python. It is not instrumented: what our modules in it need comes before all else.
set(dgtk_test_python /usr/bin/python3)
if(DGTK_SANITIZE MATCHES "address")
  set(_preload "")
  foreach(library IN ITEMS asan ubsan stdc++)
    execute_process(COMMAND "${CMAKE_CXX_COMPILER}" -print-file-name=lib${library}.so
      OUTPUT_VARIABLE file OUTPUT_STRIP_TRAILING_WHITESPACE)
    string(APPEND _preload "${file}:")
  endforeach()
  list(PREPEND dgtk_test_python env "LD_PRELOAD=${_preload}" DGTK_TEST_PATIENCE=20 DGTK_TEST_SANITIZED=1)
endif()

option(DGTK_TEST_EACH_CASE "Each GoogleTest case is a test of CTest: slower, for finding one" OFF)
function(dgtk_add_tests module)
  cmake_parse_arguments(PARSE_ARGV 1 _t "" "TIMEOUT;SHARDS" "LINK")
  add_executable(Test${module} ${_t_UNPARSED_ARGUMENTS})
  target_link_libraries(Test${module} PRIVATE DGTk::${module} dgtk_test_support GTest::gmock GTest::gtest_main ${_t_LINK})
  if(NOT _t_TIMEOUT)
    set(_t_TIMEOUT 300)
  endif()
  if(DGTK_TEST_EACH_CASE)
    gtest_discover_tests(Test${module} DISCOVERY_MODE PRE_TEST DISCOVERY_TIMEOUT 60
      TEST_PREFIX "${module}." PROPERTIES TIMEOUT ${_t_TIMEOUT})
  elseif(_t_SHARDS)
    math(EXPR last "${_t_SHARDS} - 1")
    foreach(shard RANGE ${last})
      add_test(NAME ${module}.${shard} COMMAND Test${module} --gtest_brief=1)
      dgtk_limit_tests(${_t_TIMEOUT} ${module}.${shard})
      set_tests_properties(${module}.${shard} PROPERTIES
        ENVIRONMENT "GTEST_TOTAL_SHARDS=${_t_SHARDS};GTEST_SHARD_INDEX=${shard}")
    endforeach()
  else()
    add_test(NAME ${module} COMMAND Test${module} --gtest_brief=1)
    dgtk_limit_tests(${_t_TIMEOUT} ${module})
  endif()
endfunction()
