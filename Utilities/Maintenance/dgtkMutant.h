// SPDX-License-Identifier: BSD-3-Clause
// Force-included in every source of the build of Utilities/Maintenance/mutate, and in no other. All mutants are
// compiled in; the environment says which one is on (DGTK_MUTANT), or which file notes those that are reached
// (DGTK_MUTANT_TRACE).
#ifndef dgtkMutant_h
#define dgtkMutant_h
#ifdef __cplusplus

#include <cstdlib>
#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

enum
{
  dgtkMutantBytes = 4096 // of the file: a byte a mutant
};

struct [[gnu::visibility("hidden")]] dgtkMutantState
{
  int On = 0;
  char* Reached = nullptr;

  dgtkMutantState()
  {
    if (const char* on = std::getenv("DGTK_MUTANT"))
    {
      this->On = std::atoi(on);
    }
    const char* trace = std::getenv("DGTK_MUTANT_TRACE");
    const int file = trace ? ::open(trace, O_RDWR | O_CLOEXEC) : -1;
    if (file >= 0)
    {
      void* bytes = ::mmap(nullptr, dgtkMutantBytes, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
      this->Reached = bytes == MAP_FAILED ? nullptr : static_cast<char*>(bytes);
      ::close(file);
    }
  }
};

// One for each library and program, which needs nobody to link with, set before all else of it: helpers of the product
// shut themselves in later, and some end without destructors, so plain stores into a shared page must do.
[[gnu::visibility("hidden")]] inline dgtkMutantState dgtkMutantNow;

[[gnu::visibility("hidden")]] inline bool dgtkMutant(int id)
{
  if (dgtkMutantNow.Reached && !dgtkMutantNow.Reached[id]) // threads share the line of a page that nobody writes again
  {
    dgtkMutantNow.Reached[id] = 1;
  }
  return dgtkMutantNow.On == id;
}

#endif
#endif
