// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkHelperWall.h"

#include <cerrno>
#include <cstddef>
#include <cstdio>
#include <vector>

#include <fcntl.h>
#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sched.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace dgtk::helper
{

namespace
{
#if defined(__x86_64__)
constexpr std::uint32_t architecture = AUDIT_ARCH_X86_64;
#elif defined(__aarch64__)
constexpr std::uint32_t architecture = AUDIT_ARCH_AARCH64;
#else
constexpr std::uint32_t architecture = 0;
#endif

constexpr int landlockCreateRuleset = 444;
constexpr int landlockAddRule = 445;
constexpr int landlockRestrictSelf = 446;
// Rights of Landlock.
constexpr std::uint64_t execute = 1;
constexpr std::uint64_t writeFile = 2;
constexpr std::uint64_t readFile = 4;
constexpr std::uint64_t readFolder = 8;
constexpr std::uint64_t truncate = std::uint64_t(1) << 14;

/// Rules of files, of the network and of scopes. All that Landlock knows is forbidden, but for what is allowed.
/// Descriptors that are open, and shared memory, stay usable.
class Landlock
{
public:
  Landlock()
  {
    const auto abi = static_cast<int>(::syscall(landlockCreateRuleset, nullptr, 0, 1));
    if (abi < 1)
    {
      return;
    }
    const int fileRights = abi < 2 ? 13 : abi < 3 ? 14 : abi < 5 ? 15 : 16; // as the interface grew
    this->All = (std::uint64_t(1) << fileRights) - 1;
    const std::uint64_t handled[3] = { this->All, 3, 3 };
    const std::size_t size = sizeof(std::uint64_t) * (abi < 4 ? 1 : abi < 6 ? 2 : 3);
    this->Rules = static_cast<int>(::syscall(landlockCreateRuleset, handled, size, 0));
  }
  ~Landlock()
  {
    if (this->Rules >= 0)
    {
      ::close(this->Rules);
    }
  }
  Landlock(const Landlock&) = delete;
  Landlock& operator=(const Landlock&) = delete;

  void allow(const std::string& path, std::uint64_t rights)
  {
    struct __attribute__((packed))
    {
      std::uint64_t rights;
      std::int32_t place;
    } rule = { rights & this->All, ::open(path.c_str(), O_PATH | O_CLOEXEC) };
    if (this->Rules >= 0 && rule.place >= 0)
    {
      constexpr int pathBeneath = 1;
      ::syscall(landlockAddRule, this->Rules, pathBeneath, &rule, 0);
    }
    if (rule.place >= 0)
    {
      ::close(rule.place);
    }
  }
  void enforce() const
  {
    if (this->Rules >= 0)
    {
      ::syscall(landlockRestrictSelf, this->Rules, 0);
    }
  }

private:
  int Rules = -1;
  std::uint64_t All = 0;
};

/// What decoders need: memory, threads, time, and the descriptors that they have. Everything else fails.
constexpr int harmlessCalls[] = {
#ifdef __NR_open // of machines whose calls have grown
  __NR_stat,
  __NR_lstat,
  __NR_access,
  __NR_readlink,
  __NR_poll,
  __NR_select,
  __NR_dup2,
  __NR_time,
  __NR_getdents,
  __NR_arch_prctl,
#endif
  __NR_read,
  __NR_write,
  __NR_readv,
  __NR_writev,
  __NR_pread64,
  __NR_pwrite64,
  __NR_lseek,
  __NR_close,
  __NR_fstat,
  __NR_newfstatat,
  __NR_statx,
  __NR_faccessat,
  __NR_readlinkat,
  __NR_getcwd,
  __NR_getdents64,
  __NR_fcntl,
  __NR_dup,
  __NR_dup3,
  __NR_pipe2,
  __NR_eventfd2,
  __NR_ppoll,
  __NR_pselect6,
  __NR_ftruncate,
  __NR_fallocate,
  __NR_fadvise64,
  __NR_recvmsg,
  __NR_sendmsg,
  __NR_mmap,
  __NR_munmap,
  __NR_mprotect,
  __NR_mremap,
  __NR_madvise,
  __NR_msync,
  __NR_mincore,
  __NR_brk,
  __NR_memfd_create,
  __NR_membarrier,
  __NR_get_mempolicy,
  __NR_futex,
  __NR_set_robust_list,
  __NR_set_tid_address,
  __NR_exit,
  __NR_exit_group,
  __NR_sched_yield,
  __NR_sched_getaffinity,
  __NR_sched_setaffinity,
  __NR_sched_getparam,
  __NR_sched_getscheduler,
  __NR_sched_get_priority_max,
  __NR_sched_get_priority_min,
  __NR_getcpu,
  __NR_getpid,
  __NR_gettid,
  __NR_getppid,
  __NR_getuid,
  __NR_geteuid,
  __NR_getgid,
  __NR_getegid,
  __NR_uname,
  __NR_sysinfo,
  __NR_getrandom,
  __NR_clock_gettime,
  __NR_clock_getres,
  __NR_clock_nanosleep,
  __NR_nanosleep,
  __NR_gettimeofday,
  __NR_times,
  __NR_getrusage,
  __NR_rt_sigaction,
  __NR_rt_sigprocmask,
  __NR_rt_sigreturn,
  __NR_rt_sigpending,
  __NR_sigaltstack,
  __NR_restart_syscall,
  __NR_prctl,
#ifdef __NR_rseq
  __NR_rseq,
#endif
#ifdef __NR_faccessat2
  __NR_faccessat2,
#endif
#ifdef __NR_getrlimit
  __NR_getrlimit,
  __NR_setrlimit,
#endif
};

/// A program for the kernel that looks at the number of each system call.
class Filter
{
public:
  Filter()
  {
    this->load(offsetof(seccomp_data, arch));
    this->Code.push_back(BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, architecture, 1, 0));
    this->fail(EPERM);
    this->load(offsetof(seccomp_data, nr));
  }
  void allow(int call)
  {
    this->Code.push_back(BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, std::uint32_t(call), 0, 1));
    this->answer(SECCOMP_RET_ALLOW);
  }
  void refuse(int call, int error)
  {
    this->Code.push_back(BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, std::uint32_t(call), 0, 1));
    this->fail(error);
  }
  /// Allows a call when the bits `mask` of an argument are `value`.
  void allowWhen(int call, unsigned argument, std::uint32_t mask, std::uint32_t value, int error)
  {
    // the arguments' low halves come first on the machines of `architecture`
    this->Code.push_back(BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, std::uint32_t(call), 0, 5));
    this->load(std::uint32_t(offsetof(seccomp_data, args)) + 8 * argument);
    this->Code.push_back(BPF_STMT(BPF_ALU | BPF_AND | BPF_K, mask));
    this->Code.push_back(BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, value, 0, 1));
    this->answer(SECCOMP_RET_ALLOW);
    this->fail(error);
  }
  /// Everything else is refused, or allowed.
  void install(bool elseAllowed = false)
  {
    this->answer(elseAllowed ? SECCOMP_RET_ALLOW : SECCOMP_RET_ERRNO | std::uint32_t(EPERM));
    sock_fprog program = { static_cast<unsigned short>(this->Code.size()), this->Code.data() };
    // threads that libraries have started are held to it as well
    if (::syscall(__NR_seccomp, SECCOMP_SET_MODE_FILTER, SECCOMP_FILTER_FLAG_TSYNC, &program) != 0)
    {
      ::prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program);
    }
  }

private:
  void load(std::size_t offset)
  {
    this->Code.push_back(BPF_STMT(BPF_LD | BPF_W | BPF_ABS, static_cast<std::uint32_t>(offset)));
  }
  void answer(std::uint32_t value) { this->Code.push_back(BPF_STMT(BPF_RET | BPF_K, value)); }
  void fail(int error) { this->answer(SECCOMP_RET_ERRNO | (std::uint32_t(error) & SECCOMP_RET_DATA)); }
  std::vector<sock_filter> Code;
};

void denyCalls(Opening opening)
{
  Filter filter;
  for (const int call : harmlessCalls)
  {
    filter.allow(call);
  }
  // threads, no processes; with clone3 the kernel cannot tell, and the library then uses clone
  filter.allowWhen(__NR_clone, 0, CLONE_THREAD, CLONE_THREAD, EPERM);
#ifdef __NR_clone3
  filter.refuse(__NR_clone3, ENOSYS);
#endif
  // abort() of this process, and limits of this process
  filter.allowWhen(__NR_tgkill, 0, 0xffffffffu, static_cast<std::uint32_t>(::getpid()), EPERM);
  filter.allowWhen(__NR_prlimit64, 0, 0xffffffffu, 0, EPERM);
  if (opening == Opening::Memory)
  {
    constexpr std::uint32_t writing = O_ACCMODE | O_CREAT | O_TRUNC;
#ifdef __NR_open
    filter.allowWhen(__NR_open, 1, writing, O_RDONLY, EACCES);
#endif
    filter.allowWhen(__NR_openat, 2, writing, O_RDONLY, EACCES);
  }
  filter.install();
}
} // namespace

void lockDown(Opening opening)
{
  if (isSanitized || ::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0)
  {
    return;
  }
  Landlock().enforce();
  if (architecture != 0)
  {
    denyCalls(opening);
  }
}

void fenceIn(const std::vector<std::string>& readable, const std::string& writable)
{
  if (isSanitized || ::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0)
  {
    return;
  }
  Landlock landlock;
  for (const std::string& folder : readable)
  {
    landlock.allow(folder, execute | readFile | readFolder);
  }
  landlock.allow(writable, ~execute);
  landlock.allow("/dev/null", readFile | writeFile | truncate);
  landlock.allow("/dev/urandom", readFile);
  landlock.enforce();
  if (architecture != 0)
  {
    Filter filter;
    filter.allowWhen(__NR_socket, 0, 0xffffffffu, AF_UNIX, EACCES);
    for (const int call : { __NR_ptrace, __NR_process_vm_readv, __NR_process_vm_writev, __NR_kill, __NR_tkill,
           __NR_mount, __NR_umount2, __NR_bpf, __NR_perf_event_open, __NR_keyctl, __NR_add_key, __NR_request_key })
    {
      filter.refuse(call, EPERM);
    }
    filter.install(true);
  }
}

std::uint64_t addressSpace()
{
  // open beforehand: nothing can be opened behind the wall
  static const int file = ::open("/proc/self/statm", O_RDONLY | O_CLOEXEC);
  char text[64] = {};
  unsigned long long pages = 0;
  if (::pread(file, text, sizeof text - 1, 0) <= 0 || std::sscanf(text, "%llu", &pages) != 1)
  {
    return 0;
  }
  return pages * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
}

bool limitTo(int what, std::uint64_t value)
{
  rlimit now{};
  const auto which = static_cast<__rlimit_resource>(what);
  if (::getrlimit(which, &now) != 0)
  {
    return false;
  }
  const bool fits = now.rlim_max == RLIM_INFINITY || value <= now.rlim_max;
  now.rlim_cur = fits ? value : now.rlim_max;
  return ::setrlimit(which, &now) == 0 && fits;
}

} // namespace dgtk::helper
