// SPDX-License-Identifier: BSD-3-Clause
// dgtk-fence BYTES SECONDS WRITABLE READABLE... -- PROGRAM ARGUMENT...: executes a program of other people with limits
// of memory and processor time, behind a fence (dgtkHelperWall.h), with WRITABLE as its home.
#include "dgtkHelperWall.h"

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

#include <sys/resource.h>
#include <unistd.h>

int main(int argc, char** argv)
{
  int at = 4;
  std::vector<std::string> readable;
  for (; at < argc && std::strcmp(argv[at], "--") != 0; ++at)
  {
    readable.emplace_back(argv[at]);
  }
  if (at + 1 >= argc)
  {
    std::fputs("dgtk-fence is a part of DGTk: it executes one program for the library\n", stderr);
    return 2;
  }
  const char* const writable = argv[3];
  for (const char* name : { "HOME", "TMPDIR", "XDG_CACHE_HOME", "XDG_CONFIG_HOME", "BLENDER_USER_RESOURCES" })
  {
    ::setenv(name, writable, 1);
  }
  for (const char* name : { "PYTHONPATH", "PYTHONHOME", "PYTHONSTARTUP", "LD_PRELOAD", "DISPLAY", "WAYLAND_DISPLAY" })
  {
    ::unsetenv(name);
  }
  dgtk::helper::limitTo(RLIMIT_CORE, 0);
  dgtk::helper::limitTo(RLIMIT_AS, std::strtoull(argv[1], nullptr, 10));
  dgtk::helper::limitTo(RLIMIT_CPU, std::strtoull(argv[2], nullptr, 10));
  dgtk::helper::fenceIn(readable, writable);
  ::execv(argv[at + 1], argv + at + 1);
  return 127;
}
