// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkArraySink_h
#define dgtkArraySink_h

// Private to Pipeline.

#include "dgtkLayers.h"

#include <string>
#include <vector>

namespace dgtk
{

/// An image or document in memory.
struct LayerArray
{
  std::string name;   ///< of the output: "flow_forward_class"
  std::string part;   ///< "depth" of a layered depth image; empty where the output is one array
  std::string format; ///< of a document: "json"; empty for values
  PixelType type = PixelType::UInt8;
  int channels = 1;
  bool isImage = true; ///< height x width; otherwise as many as there are
  std::vector<std::byte> data;
};

/// Arrays: the values that a layer's files hold. An output is one array, a layered depth image four: `count` of each
/// pixel, and `rgba`, `depth` and `splat` of all surfaces in the order of the pixels, near to far.
class ArraySink final : public LayerSink
{
public:
  ArraySink(const JobContext& context, const std::vector<LayerOutput>& outputs);

  void rows(std::size_t output, const Rows& rows) override;
  void surfaces(std::size_t output, const LdiRows& rows) override;
  void ranks(std::size_t output, const std::vector<CoveredId>& ranks, std::uint32_t pixels) override;
  void document(std::size_t output, const std::string& text) override;
  void shared(const std::string&, const FileRecord&) override {}

  /// All arrays in the order of the outputs, after the pass has finished.
  std::vector<LayerArray> finish();

private:
  struct Values
  {
    LayerOutput output;
    std::vector<LayerArray> arrays;
    std::vector<std::vector<CoveredId>> ranks; ///< one a run of pixels
    std::vector<std::uint32_t> pixels;         ///< of each run
  };
  void completeRanks(Values& values) const;
  std::vector<float> Ids; ///< of the objects, as Cryptomatte has them
  std::vector<Values> Outputs;
};

/// The arrays of a layered depth image, without a surface yet, and surfaces that are added to them.
enum SurfaceArray
{
  SurfaceCounts,
  SurfaceColors,
  SurfaceDepths,
  SurfaceSplats
};
std::vector<LayerArray> surfaceArrays(const std::string& name);
template <typename T>
void append(LayerArray& array, const T* values, std::size_t count)
{
  const auto* const bytes = reinterpret_cast<const std::byte*>(values);
  array.data.insert(array.data.end(), bytes, bytes + count * sizeof(T));
}

/// Throws MachineError where a picture's arrays could not fit into the machine's memory.
void requireMemory(const WorkPlan& plan, const Stage& stage, const Job& job);

} // namespace dgtk

#endif
