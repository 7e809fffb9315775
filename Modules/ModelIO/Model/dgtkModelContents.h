// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkModelContents_h
#define dgtkModelContents_h

#include "dgtkModelReader.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace dgtk
{

/// A picture that a model names, or that its own file holds.
struct ModelPicture
{
  std::string name;        ///< as written
  std::string alternative; ///< looked for when `name` is not found, or first: see isInFolder()
  std::string unescaped;   ///< what the picture is called when `name` is not found: a URI without its escapes; or ""
  std::string type;        ///< of `bytes`: "png", "jpg"; "" for a file, and for RGBA rows, top to bottom
  std::int32_t width = 0;  ///< of RGBA rows
  std::int32_t height = 0;
  std::vector<std::uint8_t> bytes;
  static constexpr std::int32_t own = -1;
  std::int32_t same = own; ///< an earlier one in the file whose bytes are meant instead
  TextureWraps wrap{};

  bool isInFile() const { return !this->type.empty() || this->width > 0; }
};

/// Whether an alternative is the name of a picture in another folder, where it is looked for first, as it is written.
bool isInFolder(const std::string& alternative, const std::string& name);

/// What the alpha of its picture means to a material.
enum class AlphaUse : std::int32_t
{
  Holes,  ///< a picture with holes is a cut-out; what is not quite opaque is painted so
  CutOff, ///< only what has an alpha times the material's opacity of a value or more is there
  Nothing ///< the material is opaque
};

/// What of a mask's texel says how much is there.
enum class MaskValue : std::int32_t
{
  Red,
  Green,
  Blue,
  Alpha,
  Luminance,
  Usual ///< its alpha where it has one, its luminance otherwise
};

struct MaterialAlpha
{
  AlphaUse use = AlphaUse::Holes;
  double cutOff = 0.5; ///< of AlphaUse::CutOff
  static constexpr std::int32_t none = -1;
  std::int32_t mask = none; ///< the picture that holds the alpha, which its own does not count beside then
  MaskValue value = MaskValue::Usual;
  double inverse = 0; ///< above 0: times this it says how much is not there
};

/// A line about a model, or the place among the lines where one about its pictures stands.
struct ModelNote
{
  static constexpr std::int32_t none = -1;
  static constexpr std::int32_t ofDecoding = -2; ///< the place of all pictures that cannot be decoded
  std::string text;
  std::int32_t picture = none; ///< the place of this one's, when it is not found
};

/// Something that what was read depends on, beside the model's own file.
struct ModelDependency
{
  enum class Kind : std::int32_t
  {
    Named,  ///< a file that the model names, as ModelFiles finds it
    Beside, ///< a file at a path relative to the model's folder
    Program ///< a program or library of the machine, known by its size and time
  };
  Kind kind = Kind::Named;
  std::string name;  ///< as written; Program: its name, or its path
  std::string found; ///< Named: path relative to the model's folder, "" when there was none; Program: the variable of
                     ///< the environment that can name it, or ""
};

/// What the files of a model say, pictures beside it apart: all that can be kept for other runs.
struct ModelContents
{
  static constexpr std::uint64_t never = ~std::uint64_t(0);
  /// Files that our own readers read within some milliseconds are not worth it.
  static constexpr std::uint64_t worthwhile = std::uint64_t(1) << 16;

  std::shared_ptr<Model> model;       ///< its textures are in `pictures`, its warnings in `notes`
  std::vector<ModelPicture> pictures; ///< of the materials' indices
  std::vector<MaterialAlpha> alpha;   ///< one a material
  std::vector<ModelNote> notes;
  std::uint64_t moreNotes = 0; ///< how many were too many
  /// All that it depends on, when it may be kept.
  std::vector<ModelDependency> dependencies;
  std::uint64_t keptFrom = never; ///< keeping it pays for files of as many bytes
};

/// Lines of a model that are kept; the rest is counted.
constexpr std::size_t mostModelWarnings = 50;

/// The model with its pictures: found, decoded if that is wanted, and looked at where alpha matters. Throws
/// MachineError as decodeTexture() does.
std::shared_ptr<Model> withPictures(ModelContents contents, const ReadOptions& options);

} // namespace dgtk

#endif
