# dgtk_add_tests(<Module> <source>... [LINK <targets>...])
# One GoogleTest program, Test<Module>, of the module's Testing folder; each case is a test of CTest.
include(GoogleTest)
function(dgtk_add_tests module)
  cmake_parse_arguments(PARSE_ARGV 1 _t "" "TIMEOUT" "LINK")
  add_executable(Test${module} ${_t_UNPARSED_ARGUMENTS})
  target_link_libraries(Test${module} PRIVATE DGTk::${module} dgtk_test_support GTest::gmock GTest::gtest_main ${_t_LINK})
  if(NOT _t_TIMEOUT)
    set(_t_TIMEOUT 300)
  endif()
  gtest_discover_tests(Test${module} DISCOVERY_MODE PRE_TEST DISCOVERY_TIMEOUT 60
    TEST_PREFIX "${module}." PROPERTIES TIMEOUT ${_t_TIMEOUT})
endfunction()
