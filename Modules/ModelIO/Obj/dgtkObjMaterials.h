// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkObjMaterials_h
#define dgtkObjMaterials_h

#include "dgtkModelBuilder.h"
#include "dgtkModelFiles.h"

#include <map>
#include <set>
#include <string>
#include <string_view>

namespace dgtk
{

/// The materials of a Wavefront model: those of its libraries (.mtl), made when they are used.
class ObjMaterials
{
public:
  /// `path`: of the model, as given.
  ObjMaterials(const std::string& path, ModelBuilder& builder);

  /// Reads the libraries that a statement `mtllib` names: one, whose name may have blanks, or several.
  void addLibraries(std::string_view names);
  /// Moves texture coordinates to where a material that indexOf() returned places its picture.
  void place(int material, std::vector<Corner>& corners) const;
  /// Index of the material of that name; one that no library has is grey, and warned of once. "": none was named.
  int indexOf(const std::string& name);
  /// Says which other files were read. Throws InputError when one was named that the model may not have.
  void finish();

private:
  /// A picture of a material: scaled, then moved.
  struct Picture
  {
    std::string name;
    MaskValue value = MaskValue::Usual; ///< of a mask
    std::array<double, 2> scale{ 1, 1 };
    std::array<double, 2> offset{ 0, 0 };
    TextureWraps wrap{};
  };
  /// A material of a library.
  struct Entry
  {
    Material material;
    Picture picture;
    Picture mask;
    Picture emission;
    Picture normals;
    std::string folder;           ///< of its library, from the model's, with a slash at its end; "" for the model's own
    std::set<std::string> unread; ///< statements of other pictures
    std::set<std::string> unreadColors; ///< statements of colours that are not red, green and blue
    bool shines = true;                 ///< its illumination model has highlights
    bool colored = false;               ///< it says a diffuse colour
  };
  static Entry unsaid(const std::string& name); ///< what a library does not say
  static Picture readPicture(class ObjStatements& statements);

  bool addLibrary(const std::string& name);
  void readLibrary(const std::string& path);
  void readStatement(class ObjStatements& statements, Entry& entry);
  void readPictureStatement(class ObjStatements& statements, Entry& entry);
  int add(const Entry& entry);
  int addPicture(const Entry& entry, const Picture& picture);
  void placePictures(const Entry& entry, int material);

  std::string Path;
  ModelBuilder& Builder;
  ModelFiles Files;
  std::set<std::string> Read; ///< paths of libraries
  std::map<std::string, Entry> Entries;
  std::map<std::string, int> Made;
  std::set<std::string> Unread; ///< of the materials that are used
  std::map<int, Picture> Moved; ///< those that do not lie as the coordinates say, by material
};

} // namespace dgtk

#endif
