// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkSampleRule_h
#define dgtkSampleRule_h

#include "dgtkSamplingModule.h"

#include "dgtkAgainError.h"
#include "dgtkError.h"
#include "dgtkJson.h"

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace dgtk
{

/// What an object or a camera of a random scene asks for beyond values (`place`, `path`, `require`), its random values
/// drawn.
struct SampleRule
{
  std::size_t index = 0; ///< of the object or the camera in the description
  std::string path;      ///< of the rule; its own draws have paths that begin with it: "objects/cup#3/place"
  JsonDocument rule;     ///< numbers and names alone; errors of a JsonCursor in it name the rule's place in the file
  std::string lacks{};   ///< of an object: why the sample has nothing to put it on or in; "": it has
};

/// What became of a rule: a line of samples.json.
struct SampleNote
{
  std::string path;                                     ///< of the rule
  bool kept = true;                                     ///< false: the object or the camera is left out of the sample
  std::string why;                                      ///< of what is left out; one line
  int attempts = 0;                                     ///< that were made, with the last one
  std::vector<std::pair<std::string, double>> measured; ///< name -> value, in the order in which they are written
};

/// A value that was drawn.
struct SampleValue
{
  std::string path;  ///< of the value, as its draws have it: "parameters/n", "objects/cup#3/scale"
  std::string value; ///< JSON on one line
};

/// A rule of a sample cannot be kept and says that the sample is refused then. Its text: PATH: why.
class DGTKSAMPLING_EXPORT SampleRefused : public Error
{
public:
  SampleRefused(const std::string& path, const std::string& why, int attempts);
  const std::string& path() const noexcept { return this->Path; }
  const std::string& why() const noexcept { return this->Why; }
  int attempts() const noexcept { return this->Attempts; }

private:
  std::string Path;
  std::string Why;
  int Attempts;
};

/// Nobody waits for the sample any more.
class DGTKSAMPLING_EXPORT SampleStopped : public AgainError
{
public:
  SampleStopped();
};

} // namespace dgtk

#endif
