// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkTestSupport_h
#define dgtkTestSupport_h

#include <string>

namespace dgtk::test
{

/// A folder below the system's temporary folder that is removed with all its contents on destruction.
class TemporaryFolder
{
public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  /// The folder without a trailing slash, or a name below it.
  std::string path(const std::string& name = {}) const { return name.empty() ? this->Path : this->Path + '/' + name; }

private:
  std::string Path;
};

/// A file of the source tree: sourceFile("Data/Scenes/x.json").
std::string sourceFile(const std::string& relative);

/// The folder with further models (DGTK_EXTRA_MODELS of the environment, else of the configuration), or "" when there
/// is none.
std::string extraModels();

/// Whole contents of a file; fails the running program when it cannot be read.
std::string contentsOf(const std::string& path);

/// What the Refusal says that `act` throws, or "" where it throws nothing; anything else that it throws passes.
template <typename Refusal, typename Act>
std::string thrownBy(const Act& act)
{
  try
  {
    act();
  }
  catch (const Refusal& refusal)
  {
    return refusal.what();
  }
  return {};
}

} // namespace dgtk::test

#endif
