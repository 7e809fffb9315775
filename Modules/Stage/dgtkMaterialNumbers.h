// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkMaterialNumbers_h
#define dgtkMaterialNumbers_h

#include "dgtkSceneDescription.h"
#include "dgtkSceneState.h"

#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace dgtk
{

using MaterialList = std::shared_ptr<const std::vector<Material>>;

bool isFor(const MaterialOverride& change, const Material& material);

/// Gives a material the numbers and colours that an override has at a frame.
void overrideNumbers(const MaterialOverride& change, double frame, Material& material);

/// The materials of objects whose overrides have key frames. Frames of equal numbers share one list, unless others of
/// the object were asked for in between. Thread-safe.
class MaterialNumbers
{
public:
  /// `look` is the object's at any frame; it is returned itself where nothing moves.
  MaterialList at(const ObjectDescription& object, const MaterialList& look, double frame);

private:
  struct Made
  {
    MaterialList look;
    std::vector<double> numbers;
    MaterialList materials;
  };

  std::mutex Mutex;
  std::map<std::string, Made> Latest; ///< by the object's name
};

} // namespace dgtk

#endif
