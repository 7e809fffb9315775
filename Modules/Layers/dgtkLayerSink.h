// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkLayerSink_h
#define dgtkLayerSink_h

#include "dgtkLayersModule.h"

#include "dgtkCryptomatte.h"
#include "dgtkLayerWriter.h"
#include "dgtkLdi.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace dgtk
{

/// One image or document that a layer makes of a picture.
struct DGTKLAYERS_EXPORT LayerOutput
{
  std::string layer;                ///< as the manifest names it: "flow_forward_class"
  std::string name;                 ///< among the outputs of the picture: "correspondence_right_class"
  std::string path;                 ///< of its files, relative to the dataset and without extension
  std::vector<std::string> formats; ///< of its files, at least one
  LayerSpec spec;                   ///< of its values, as the writers of files know it
  int width = 0;                    ///< pixels; 0 for documents
  int height = 0;
  bool isOneOfMany = false; ///< so many that they cannot be open together: each is closed with its last row

  /// Paths of its files, one a format.
  std::vector<std::string> files() const;
};

/// Takes what the passes of layers make. Outputs are numbered as the pass was given them; different ones may be given
/// by different threads at the same time. Throws MachineError where something cannot be kept.
class LayerSink
{
public:
  virtual ~LayerSink() = default;
  /// The next full-width rows of an image, top to bottom.
  virtual void rows(std::size_t output, const Rows& rows) = 0;
  /// The next rows of a layered depth image.
  virtual void surfaces(std::size_t output, const LdiRows& rows) = 0;
  /// The next `pixels` pixels of an image of coverages, all with these ranks, the largest coverage first.
  virtual void ranks(std::size_t output, const std::vector<CoveredId>& ranks, std::uint32_t pixels) = 0;
  /// A whole document, in its only format.
  virtual void document(std::size_t output, const std::string& text) = 0;
  /// A file that the layer has written beside, relative to the dataset; other pictures may use it, too.
  virtual void shared(const std::string& layer, const FileRecord& file) = 0;
};

} // namespace dgtk

#endif
