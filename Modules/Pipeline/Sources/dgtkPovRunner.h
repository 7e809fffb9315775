// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkPovRunner_h
#define dgtkPovRunner_h

// Private to Pipeline.

#include <atomic>
#include <string>
#include <vector>

namespace dgtk
{

/// What POV-Ray complains about.
struct PovComplaint
{
  std::string file; ///< as POV-Ray names it; "" when it names none
  long line = 0;
  std::string what;
};

/// The first error in what POV-Ray printed; `what` is empty when there is none.
PovComplaint povComplaint(const std::string& printed);

/// Path of the program `povray` on PATH. Throws MachineError, with the package to install, when there is none.
std::string findPovRay();

/// Runs POV-Ray, one process a call, in a folder. Thread-safe.
class PovRunner
{
public:
  /// `cancel`: ends processes when it becomes true; may be null.
  PovRunner(std::string program, std::string folder, const std::atomic<bool>* cancel);

  /// Runs with `arguments` in the folder and waits; starts it again, a few times, where its own threads did not begin
  /// in time. What it prints goes to <folder>/<name>.log, which is removed. Throws MachineError, with file and line,
  /// when it fails; InputError when it fails on a picture; MachineError also when cancelled.
  void run(const std::vector<std::string>& arguments, const std::string& name) const;

  const std::string& folder() const { return this->Folder; }

private:
  int start(const std::vector<std::string>& arguments, const std::string& log) const;
  int wait(int process) const;
  [[noreturn]] void fail(int status, const std::string& printed) const;

  std::string Program;
  std::string Folder;
  const std::atomic<bool>* Cancel;
};

} // namespace dgtk

#endif
