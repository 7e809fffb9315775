# Warnings are errors in our own code. Floating-point contraction is off: every machine computes the same bits.
add_compile_options(-Wall -Wextra -Wshadow -Wnon-virtual-dtor -Woverloaded-virtual -ffp-contract=off)
# Sources of a unity build are files that are included, and see the names of one another.
if(CMAKE_UNITY_BUILD)
  add_compile_options(-Wno-subobject-linkage -Wno-shadow)
endif()
# GCC looks for garbage of its own from half a gigabyte on only: some 4 % of its time.
add_compile_options($<$<COMPILE_LANG_AND_ID:CXX,GNU>:--param=ggc-min-heapsize=524288>)
# Only what is used is loaded: some modules are on demand (dgtkOnDemand.h).
add_link_options(-Wl,--as-needed)
# A start is the linker's work for some twenty libraries: what they call of their own needs no lookup, and they have fewer parts to map.
# gold makes no more by itself, and links in a quarter of the time; it looks for what shared libraries lack where they name nothing.
include(CheckLinkerFlag)
check_linker_flag(CXX -fuse-ld=gold DGTK_HAS_GOLD)
if(DGTK_HAS_GOLD AND NOT DGTK_SANITIZE)
  add_link_options(-fuse-ld=gold -Wl,--allow-shlib-undefined)
else()
  add_link_options(-Wl,-z,noseparate-code)
endif()
if(NOT DGTK_SANITIZE)
  add_link_options(-Wl,-Bsymbolic-functions)
endif()
option(DGTK_WERROR "Treat warnings as errors" ON)
if(DGTK_WERROR)
  add_compile_options($<$<COMPILE_LANGUAGE:CXX>:-Werror>)
endif()
if(DGTK_SANITIZE)
  # With sanitizers the compiler takes values for unset that are not.
  add_compile_options(-fsanitize=${DGTK_SANITIZE} -fno-omit-frame-pointer -g1 -Wno-maybe-uninitialized)
  add_link_options(-fsanitize=${DGTK_SANITIZE})
  add_compile_definitions(_GLIBCXX_ASSERTIONS) # indices and iterators of the standard library are looked at, too
  if(DGTK_SANITIZE MATCHES "undefined")
    add_compile_options(-fno-sanitize-recover=undefined)
  endif()
endif()
find_program(CCACHE_PROGRAM ccache)
if(CCACHE_PROGRAM AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_C_COMPILER_LAUNCHER "${CCACHE_PROGRAM}")
  set(CMAKE_CXX_COMPILER_LAUNCHER "${CCACHE_PROGRAM}")
endif()
