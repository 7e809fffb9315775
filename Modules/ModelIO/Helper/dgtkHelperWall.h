// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkHelperWall_h
#define dgtkHelperWall_h

#include <cstdint>
#include <string>
#include <vector>

/// Walls around the helper programs, which decode files of strangers with other people's libraries.
namespace dgtk::helper
{

enum class Opening
{
  Nothing, ///< what is read comes as open descriptors
  Memory   ///< and may be opened again as /proc/self/fd/N where it is shared memory
};

/// From now on this process opens no file, writes none, has no network, starts no program and signals no other process,
/// where the kernel can see to it (Landlock, seccomp); elsewhere nothing changes. Libraries have to be loaded before.
void lockDown(Opening opening);

/// For whole programs of other people: from now on this process, and what it executes, reads and executes beneath
/// `readable` only, writes beneath `writable` only, has no network, and looks into no other process, where the kernel
/// can see to it; elsewhere nothing changes.
void fenceIn(const std::vector<std::string>& readable, const std::string& writable);

/// Address space in use, bytes.
std::uint64_t addressSpace();

/// Sets a soft limit (RLIMIT_...), as far as the hard one allows. False when it does not.
bool limitTo(int what, std::uint64_t value);

/// Sanitizers reserve terabytes of addresses, and open files when they report: no walls and no limits of memory then.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool isSanitized = true;
#else
constexpr bool isSanitized = false;
#endif

} // namespace dgtk::helper

#endif
