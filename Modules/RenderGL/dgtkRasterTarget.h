// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkRasterTarget_h
#define dgtkRasterTarget_h

#include <array>
#include <vector>

namespace dgtk
{

/// A framebuffer of our own: float colour, float ids (number of the draw, triangle, and depth where asked for), and a
/// float depth buffer. The context must be current.
class RasterTarget
{
public:
  explicit RasterTarget(bool withDepthInIds);
  ~RasterTarget();
  RasterTarget(const RasterTarget&) = delete;
  RasterTarget& operator=(const RasterTarget&) = delete;

  /// Textures that are large enough in both directions are kept: pieces of a picture differ in size, and new textures
  /// are dear to clear.
  /// Throws MachineError when OpenGL refuses.
  void resize(int width, int height);
  int width() const { return this->Width; }
  int height() const { return this->Height; }

  /// Binds it, with the outputs that are wanted.
  void bind(bool color, bool ids);
  /// Of all pixels; the scissor test must be off, and is so afterwards.
  void clear(const std::array<float, 4>& color, float idDepth = 0);
  void copyDepthFrom(const RasterTarget& other);

  /// 4 floats a pixel; rows bottom to top.
  void readColor(std::vector<float>& rgba);
  /// 2 floats a pixel; rows bottom to top.
  void readIds(std::vector<float>& ids);

  unsigned int idTexture() const { return this->Textures[1]; }

private:
  void allocate(int width, int height);
  void release();
  bool WithDepth;
  int Width = 0;
  int Height = 0;
  int AllocatedWidth = 0; // of the textures
  int AllocatedHeight = 0;
  unsigned int Framebuffer = 0;
  std::array<unsigned int, 3> Textures{}; // colour, ids, depth
};

} // namespace dgtk

#endif
