// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkPovAppearance_h
#define dgtkPovAppearance_h

#include "dgtkPovSession.h"

namespace dgtk
{

/// What is said of an object behind its shapes.
struct PovModifiers
{
  Eigen::Affine3d transform = Eigen::Affine3d::Identity();
  PovTexturePointer texture;
  Eigen::Affine3d atTexture = Eigen::Affine3d::Identity(); ///< transform when the texture was given
  bool invisible = false;

  /// `replaceTexture`: also where a part of the shape has its own.
  void apply(PovShape& shape, bool replaceTexture) const;
};

/// Reads textures: pigments (their colour, or the mean of several; a picture), finishes, and what they are declared as.
class PovAppearance
{
public:
  explicit PovAppearance(PovSession& session)
    : Session(session)
    , Stream(session.stream)
    , Default(std::make_shared<PovTexture>())
  {
  }
  /// The block after `texture`, `pigment`, `finish` or `material`; `base` is what it changes, null: the default. A
  /// block that only names a declared texture is that one.
  PovTexturePointer texture(const std::string& kind, const PovTexturePointer& base);
  /// Reads the next modifier of an object; false, and nothing taken, when none comes.
  bool modifier(PovModifiers& to);
  /// Reads the block after #default.
  void readDefault();
  const PovTexturePointer& defaultTexture() const { return this->Default; }

  /// Whether a word begins what texture() reads.
  static bool begins(const PovToken& token);

private:
  using Colors = std::vector<Eigen::Vector3d>;
  void pigment(PovPigment& to);
  bool pigmentWord(const PovToken& word, PovPigment& to);
  void colorMap(Colors& colors);
  void imageMap(PovPigment& to);
  void finish(PovFinish& to);
  PovTexturePointer body(char close, const std::string& kind, const PovTexturePointer& base, PovTexture& to);
  PovTexturePointer declared(PovTexture& to);
  bool part(PovTexture& to);
  void otherWord(const std::string& kind, bool isLast);
  PovTexturePointer textureMap(PovTexture& to);

  PovSession& Session;
  PovStream& Stream;
  PovTexturePointer Default;
  bool MapWarned = false; ///< maps of textures are warned of once
};

} // namespace dgtk

#endif
