// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkFragmentList_h
#define dgtkFragmentList_h

#include <array>
#include <cstddef>
#include <vector>

namespace dgtk
{

/// A fragment as the shader appends it.
struct Fragment
{
  float pixel;  ///< index into the target's pixels, rows from the bottom; exact, as targets have at most 2^24 pixels
  float depth;  ///< window depth, 1 at near
  float number; ///< of the draw
  float triangle;
  std::array<float, 4> rgba;
};

/// Every fragment of a drawing in one pass: shaders append to a storage buffer. The order of what comes is that of
/// chance; sorted, it is a function of the scene.
class FragmentList
{
public:
  FragmentList() = default;
  ~FragmentList();
  FragmentList(const FragmentList&) = delete;
  FragmentList& operator=(const FragmentList&) = delete;

  /// Whether the current OpenGL can do it.
  static bool supported();
  /// Fragments that fit.
  static constexpr std::size_t capacity = std::size_t(1) << 21;

  /// Empties the list and binds it for shaders that draw to a target of this width.
  void begin(int width);
  /// How many fragments were drawn, also beyond Capacity; those that fit go to `fragments`.
  std::size_t end(std::vector<Fragment>& fragments);

private:
  unsigned int Buffer = 0;
};

/// Puts fragments of `pixels` pixels in the order of pixels, in each near to far, then by draw and triangle; drops what
/// the far plane and cut pieces leave twice.
void sortFragments(std::vector<Fragment>& fragments, std::size_t pixels);

} // namespace dgtk

#endif
