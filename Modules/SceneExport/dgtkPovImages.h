// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkPovImages_h
#define dgtkPovImages_h

#include "dgtkModel.h"

#include <array>
#include <map>
#include <string>
#include <tuple>
#include <vector>

namespace dgtk
{

/// The pictures of a scene as POV-Ray reads them. Textures must have an image.
class PovImages
{
public:
  virtual ~PovImages() = default;
  /// `png "picture.png"`: the colours of a texture, times `tint`; of a cut-out one, those beside its holes in them.
  virtual std::string color(const Texture& texture, const Eigen::Vector3d& tint, bool cutOut) = 0;
  /// `pgm "picture_mask.pgm"`: 255 where a texel is, 0 where it is missing.
  virtual std::string mask(const Texture& texture) = 0;
};

/// A texture's own file when that is a PNG without alpha that POV-Ray finds by its name relative to the scene; others
/// are written beside the scene.
class PovImagesBeside final : public PovImages
{
public:
  /// `scene` is the path of the .pov file. No picture is written in place of one of `inputs`.
  PovImagesBeside(const std::string& scene, std::vector<std::string> inputs);

  std::string color(const Texture& texture, const Eigen::Vector3d& tint, bool cutOut) override;
  std::string mask(const Texture& texture) override;
  const std::vector<std::string>& files() const { return this->Files; }

private:
  std::string own(const Texture& texture) const;
  std::string pathOf(const std::string& end) const;
  std::string write(const std::string& end, const std::string& contents);
  int number(const Image& image, const Eigen::Vector3d& tint, bool cutOut);

  std::string Folder;
  std::string Stem;
  std::vector<std::string> Inputs;
  std::map<std::tuple<const Image*, double, double, double, bool>, int> Numbers;
  int Next = 0;
  std::map<std::string, std::string> Written; ///< name -> reference
  std::vector<std::string> Files;
};

/// Contents of a .ppm with the colours of a picture times `tint`, holes filled as in `withoutHoles()` if it is cut out.
std::string povPpm(const Image& image, const Eigen::Vector3d& tint, bool cutOut);
/// Contents of a .pgm: 255 where a texel is, 0 where it is missing.
std::string povMaskPgm(const Image& image);
/// Whether a texture's own file is a PNG whose colours POV-Ray reads as they are.
bool povReads(const Texture& texture);
/// A name with nothing in it that POV-Ray's strings or a file system may not hold.
std::string povPlainName(std::string name);

} // namespace dgtk

#endif
