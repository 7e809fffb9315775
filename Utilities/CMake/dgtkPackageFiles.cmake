# In cpack, when all components are installed: what packages of Debian have besides.
function(dgtk_run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE result ERROR_VARIABLE error OUTPUT_VARIABLE output)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "${ARGN}: ${result} ${error}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

# dgtk_gzip(<file>): without its name and time.
function(dgtk_gzip file)
  dgtk_run(gzip -9nf "${file}")
endfunction()

# The licence as a file in the format of copyright files.
function(dgtk_write_copyright file)
  file(READ "${CPACK_DGTK_SOURCE_DIR}/LICENSE" licence)
  string(REGEX MATCH "Copyright \\(c\\) ([^\n]+)" _ "${licence}")
  set(holder "${CMAKE_MATCH_1}")
  string(REGEX REPLACE "^.*Copyright [^\n]+\n+" "" terms "${licence}")
  string(STRIP "${terms}" terms)
  string(REGEX REPLACE "\n" "\n " terms " ${terms}")
  string(REPLACE "\n \n" "\n .\n" terms "${terms}")
  file(WRITE "${file}" "Format: https://www.debian.org/doc/packaging-manuals/copyright-format/1.0/\nUpstream-Name: DGTk\n\n"
    "Files: *\nCopyright: ${holder}\nLicense: BSD-3-Clause\n${terms}\n\n"
    "Files: usr/lib/*/libdgtkCore.so.*\nCopyright: ${holder}\n The OpenSSL Project Authors\nLicense: BSD-3-Clause and Apache-2.0\n"
    "Comment: SHA-256 is linked from OpenSSL's archive.\n\n"
    "License: Apache-2.0\n /usr/share/common-licenses/Apache-2.0 has it.\n")
endfunction()

function(dgtk_write_changelog file)
  dgtk_run(date -R -u -d "@$ENV{SOURCE_DATE_EPOCH}")
  file(WRITE "${file}" "dgtk (${CPACK_PACKAGE_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE}) unstable; urgency=medium\n\n"
    "  * DGTk ${CPACK_PACKAGE_VERSION}.\n\n -- ${CPACK_PACKAGE_CONTACT}  ${output}")
  dgtk_gzip("${file}")
endfunction()

foreach(package IN LISTS CPACK_COMPONENTS_ALL)
  set(root "${CPACK_TEMPORARY_DIRECTORY}/${package}")
  dgtk_write_copyright("${root}/usr/share/doc/${package}/copyright")
  dgtk_write_changelog("${root}/usr/share/doc/${package}/changelog.Debian")
  file(GLOB pages "${root}/usr/share/man/man1/*.1")
  foreach(page IN LISTS pages)
    dgtk_gzip("${page}")
  endforeach()
  dgtk_run(chmod -R u=rwX,go=rX "${root}")
endforeach()
