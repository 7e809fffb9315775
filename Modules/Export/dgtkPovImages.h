// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkPovImages_h
#define dgtkPovImages_h

// Private to Export.

#include "dgtkModel.h"

#include <array>
#include <map>
#include <string>
#include <tuple>
#include <vector>

namespace dgtk
{

/// The pictures of a scene as POV-Ray reads them.
class PovImages
{
public:
  /// `scene` is the path of the .pov file.
  explicit PovImages(const std::string& scene);

  /// `png "picture.png"`: the colours of a texture, times `tint`. Its own file when that is a PNG without alpha that
  /// POV-Ray finds by its name relative to the scene; else a .ppm is written. The texture must have an image.
  std::string color(const Texture& texture, const Eigen::Vector3d& tint);
  /// `pgm "picture_mask.pgm"`: 255 where a texel is, 0 where it is missing.
  std::string mask(const Texture& texture);

  const std::vector<std::string>& files() const { return this->Files; }

private:
  std::string own(const Texture& texture) const;
  std::string write(const Image& image, const std::string& end, int channels, const std::vector<std::uint8_t>& values);
  int number(const Image& image, const Eigen::Vector3d& tint);

  std::string Folder;
  std::string Stem;
  std::map<std::tuple<const Image*, double, double, double>, int> Numbers;
  std::map<std::string, std::string> Written; ///< name -> reference
  std::vector<std::string> Files;
};

} // namespace dgtk

#endif
