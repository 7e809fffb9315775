// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkSampleDrawer_h
#define dgtkSampleDrawer_h

#include "dgtkDocumentModule.h"

#include "dgtkSampler.h"
#include "dgtkSceneDocument.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace dgtk
{

/// What came of drawing a sample of a random scene.
struct DrawnSample
{
  int number = 0;
  std::optional<std::uint64_t> seed; ///< of the draws; none when the random scene could not be read
  std::optional<LoadedScene> scene; ///< none: see `fault`; its path is "", relative paths start beside the random scene
  bool refused = false;             ///< by a rule of the scene; otherwise a fault is one of the scene or its files
  std::string fault;                ///< one line; "" when there is a scene
  std::vector<SampleValue> values;  ///< as far as they were drawn
  std::vector<SampleNote> notes;    ///< as samples.json has them
};

/// Whether a file is a .json scene that plain readers refuse because values are random. Throws nothing: what cannot be
/// read is no random scene.
DGTKDOCUMENT_EXPORT bool isRandomScene(const std::string& path);

/// Draws samples of a random scene with all their models, one after the other; what is read for one serves the next.
/// Not thread-safe.
class DGTKDOCUMENT_EXPORT SampleDrawer
{
public:
  explicit SampleDrawer(const std::string& path);

  /// The sample that `dgtk sample` writes of the file as it is now. `seed`: instead of the scene's. None when
  /// `outdated` said so in between.
  std::optional<DrawnSample> draw(
    int number, std::optional<std::uint64_t> seed = {}, const std::function<bool()>& outdated = {});

private:
  void read(std::optional<std::uint64_t> seed);

  std::string Path;
  std::unique_ptr<Sampler> Source;
  std::optional<std::uint64_t> Seed;
  ModelLibrary Models; ///< of the last samples
};

} // namespace dgtk

#endif
