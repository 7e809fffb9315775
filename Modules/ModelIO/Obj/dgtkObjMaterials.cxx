// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkObjMaterials.h"

#include "dgtkError.h"
#include "dgtkFile.h"
#include "dgtkModelFolder.h"
#include "dgtkObjStatements.h"
#include "dgtkText.h"
#include "dgtkTextLines.h"

#include <algorithm>
#include <filesystem>
#include <sstream>

namespace dgtk
{

namespace
{
namespace fs = std::filesystem;
constexpr std::uint64_t largestLibrary = std::uint64_t(1) << 26;
constexpr std::size_t mostNames = 8; // in one warning

/// The next word, which stays to be read.
std::string_view ahead(ObjStatements& statements)
{
  const std::string_view rest = statements.rest();
  return rest.substr(0, rest.find_first_of(" \t"));
}
} // namespace

ObjMaterials::Entry ObjMaterials::unsaid(const std::string& name)
{
  Entry entry;
  entry.material.name = name;
  entry.material.ambient = { 0, 0, 0 };
  entry.material.diffuse = { 0.6, 0.6, 0.6 };
  return entry;
}

/// The name of a picture comes behind options such as `-s 1 1 1`.
ObjMaterials::Picture ObjMaterials::readPicture(ObjStatements& statements)
{
  static const std::map<std::string_view, int> values{ { "-blendu", 1 }, { "-blendv", 1 }, { "-boost", 1 },
    { "-mm", 2 }, { "-o", 3 }, { "-s", 3 }, { "-t", 3 }, { "-texres", 1 }, { "-clamp", 1 }, { "-bm", 1 },
    { "-imfchan", 1 }, { "-type", 1 }, { "-cc", 1 }, { "-colorspace", 1 } };
  static const std::map<std::string_view, MaskValue> channels{ { "r", MaskValue::Red }, { "g", MaskValue::Green },
    { "b", MaskValue::Blue }, { "m", MaskValue::Alpha }, { "l", MaskValue::Luminance } };
  Picture to;
  for (;;)
  {
    const std::string_view rest = statements.rest();
    const auto option = values.find(ahead(statements));
    if (option == values.end())
    {
      const bool inQuotes = rest.size() > 1 && rest.front() == '"' && rest.back() == '"';
      to.name = std::string(inQuotes ? rest.substr(1, rest.size() - 2) : rest);
      return to;
    }
    statements.word();
    std::array<double, 2>* const numbers = option->first == "-s"   ? &to.scale
                                           : option->first == "-o" ? &to.offset
                                                                   : nullptr;
    for (int i = 0; i < option->second; ++i)
    {
      const std::string_view word = ahead(statements);
      const std::optional<double> number = parseNumber(word);
      if (option->second == 3 && i > 0 && !number)
      {
        break; // the second and third number may be left out
      }
      if (numbers != nullptr && i < 2 && number)
      {
        (*numbers)[std::size_t(i)] = *number;
      }
      const auto channel = option->first == "-imfchan" ? channels.find(word) : channels.end();
      to.value = channel != channels.end() ? channel->second : to.value;
      to.wrap.fill(option->first == "-clamp" && word == "on" ? TextureWrap::Clamp : to.wrap[0]);
      statements.word();
    }
  }
}

ObjMaterials::ObjMaterials(const std::string& path, ModelBuilder& builder)
  : Path(path)
  , Builder(builder)
  , Files(fs::absolute(path).string())
{
}

void ObjMaterials::addLibraries(std::string_view names)
{
  const std::string whole(names);
  if (this->addLibrary(whole))
  {
    return;
  }
  std::istringstream words(whole);
  std::string missing;
  for (std::string word; words >> word;)
  {
    missing = this->addLibrary(word) ? missing : missing.empty() ? word : whole;
  }
  if (!missing.empty() && !this->addLibrary(fs::path(this->Path).stem().string() + ".mtl"))
  {
    this->Builder.warn("file " + missing + " not found");
  }
}

bool ObjMaterials::addLibrary(const std::string& name)
{
  const std::string path =
    name.empty() ? name : this->Files.find(folderOfFile(fs::absolute(this->Path).string()) + '/' + name);
  if (!path.empty() && this->Read.insert(path).second)
  {
    this->readLibrary(path);
  }
  return !path.empty();
}

void ObjMaterials::readLibrary(const std::string& path)
{
  const std::string text = toUtf8(readFile(path, largestLibrary));
  ObjStatements statements(path, text);
  const std::string folder = (fs::path(this->Files.relative(path)).parent_path() / "").string();
  Entry* entry = nullptr;
  while (statements.next())
  {
    if (statements.keyword() == "newmtl")
    {
      const std::string name(statements.rest());
      const auto [added, isNew] = this->Entries.try_emplace(name, unsaid(name));
      entry = isNew ? &added->second : nullptr; // the first one of a name counts
      added->second.folder = isNew ? folder : added->second.folder;
      this->Builder.model().declaredMaterials += isNew ? 1 : 0;
    }
    else if (entry)
    {
      this->readStatement(statements, *entry);
    }
  }
}

void ObjMaterials::readStatement(ObjStatements& statements, Entry& entry)
{
  Material& material = entry.material;
  const std::string_view keyword = statements.keyword();
  Eigen::Vector3d* const color = keyword == "Ka"   ? &material.ambient
                                 : keyword == "Kd" ? &material.diffuse
                                 : keyword == "Ks" ? &material.specular
                                 : keyword == "Ke" ? &material.emission
                                                   : nullptr;
  const std::string_view rest = statements.rest();
  const std::string_view first = ahead(statements);
  if (color && (first == "spectral" || first == "xyz"))
  {
    entry.unreadColors.insert(std::string(keyword) + ' ' + std::string(first));
  }
  else if (color)
  {
    Eigen::Vector3d value(0, 0, 0);
    const std::size_t count = statements.numbers(value.data(), 3);
    *color = count == 1 ? Eigen::Vector3d::Constant(value[0]) : value; // red alone is grey
    entry.colored = entry.colored || keyword == "Kd";
  }
  else if (keyword == "Ns")
  {
    statements.number(material.shininess);
  }
  else if (keyword == "d" || keyword == "Tr")
  {
    double value = keyword == "d" ? 1 : 0;
    if (rest.rfind("-halo", 0) == 0)
    {
      statements.word();
    }
    statements.number(value);
    material.opacity = keyword == "d" ? value : 1 - value;
  }
  else if (keyword == "illum")
  {
    const std::string_view model = statements.word();
    entry.shines = model != "0" && model != "1";
  }
  else if (keyword == "Pm" || keyword == "Pr")
  {
    Material::Physical physical = material.physical ? *material.physical : Material::Physical();
    statements.number(keyword == "Pm" ? physical.metallic : physical.roughness);
    material.physical = physical;
  }
  else
  {
    this->readPictureStatement(statements, entry);
  }
}

/// Programs write these statements in upper and lower case alike.
void ObjMaterials::readPictureStatement(ObjStatements& statements, Entry& entry)
{
  static const std::map<std::string, Picture Entry::*> pictures{ { "map_kd", &Entry::picture },
    { "map_d", &Entry::mask }, { "map_ke", &Entry::emission }, { "norm", &Entry::normals } };
  static const std::set<std::string> others{ "bump", "disp", "decal", "refl" };
  static const std::set<std::string> same{ "map_ka", "map_aat" }; // the picture of map_Kd as a rule; a switch
  const std::string keyword = lower(std::string(statements.keyword()));
  const auto picture = pictures.find(keyword);
  if (picture != pictures.end())
  {
    entry.*picture->second = readPicture(statements);
  }
  else if ((keyword.rfind("map_", 0) == 0 || others.count(keyword) != 0) && same.count(keyword) == 0)
  {
    entry.unread.insert(quoted(std::string(statements.keyword())));
  }
}

/// It is looked for beside the library before it is beside the model.
int ObjMaterials::addPicture(const Entry& entry, const Picture& picture)
{
  const std::string beside = entry.folder.empty() ? std::string() : entry.folder + picture.name;
  return this->Builder.addTexture(picture.name, beside, {}, picture.wrap);
}

int ObjMaterials::add(const Entry& entry)
{
  Material material = entry.material;
  if (!entry.shines || !(material.shininess > 0))
  {
    material.specular = { 0, 0, 0 }; // an exponent of 0 would shine everywhere
  }
  if (!(material.opacity > 0))
  {
    this->Builder.warn("material " + dgtk::quoted(material.name) + " has opacity 0: drawn opaque");
    material.opacity = 1;
  }
  for (const std::string& statement : entry.unreadColors)
  {
    this->Builder.warn(
      "material " + dgtk::quoted(material.name) + ": a colour of " + quoted(statement) + " is not read");
  }
  const Picture& picture = entry.picture;
  material.texture = this->addPicture(entry, picture);
  if (material.texture >= 0 && !entry.colored)
  {
    material.diffuse = { 1, 1, 1 }; // the picture as it is
  }
  MaterialAlpha alpha;
  const bool isOwn = entry.mask.name == picture.name && entry.mask.value == MaskValue::Usual;
  alpha.mask = isOwn ? MaterialAlpha::none : this->addPicture(entry, entry.mask);
  alpha.value = entry.mask.value;
  material.normalMap = this->addPicture(entry, entry.normals);
  material.emissionMap = this->addPicture(entry, entry.emission);
  if (material.emissionMap >= 0 && material.emission.isZero())
  {
    material.emission = { 1, 1, 1 }; // exporters write Ke 0 0 0 beside a picture
  }
  this->Unread.insert(entry.unread.begin(), entry.unread.end());
  const int made = this->Builder.addMaterial(material, alpha);
  this->placePictures(entry, made);
  return made;
}

/// All lie where the first one does.
void ObjMaterials::placePictures(const Entry& entry, int material)
{
  std::vector<const Picture*> named;
  for (const Picture* picture : { &entry.picture, &entry.mask, &entry.emission, &entry.normals })
  {
    if (!picture->name.empty())
    {
      named.push_back(picture);
    }
  }
  const auto liesApart = [](const Picture& picture, const Picture& from)
  { return picture.scale != from.scale || picture.offset != from.offset; };
  if (!named.empty() && liesApart(*named.front(), Picture()))
  {
    this->Moved[material] = *named.front();
  }
  if (std::any_of(named.begin(), named.end(), [&](const Picture* one) { return liesApart(*one, *named.front()); }))
  {
    this->Builder.warn("material " + dgtk::quoted(entry.material.name) +
                       " has pictures in several places: all lie where the first does");
  }
}

void ObjMaterials::place(int material, std::vector<Corner>& corners) const
{
  const auto moved = this->Moved.find(material);
  if (moved == this->Moved.end())
  {
    return;
  }
  const Picture& picture = moved->second;
  for (Corner& corner : corners)
  {
    corner.u = static_cast<float>(double(corner.u) * picture.scale[0] + picture.offset[0]);
    corner.v = static_cast<float>(double(corner.v) * picture.scale[1] + picture.offset[1]);
  }
}

int ObjMaterials::indexOf(const std::string& name)
{
  const auto made = this->Made.find(name);
  if (made != this->Made.end())
  {
    return made->second;
  }
  const auto known = this->Entries.find(name);
  if (known == this->Entries.end() && !name.empty() && !this->Entries.empty())
  {
    this->Builder.warn("material " + dgtk::quoted(name) + " is not defined: drawn grey");
  }
  const int index =
    this->add(known != this->Entries.end() ? known->second : unsaid(name.empty() ? "DefaultMaterial" : name));
  this->Made[name] = index;
  return index;
}

void ObjMaterials::finish()
{
  if (!this->Unread.empty())
  {
    std::vector<std::string> names(this->Unread.begin(), this->Unread.end());
    if (names.size() > mostNames)
    {
      names.resize(mostNames);
      names.emplace_back("...");
    }
    this->Builder.warn("pictures of " + joined(names) + " are not drawn");
  }
  this->Files.refuseOutside(this->Path);
  this->Builder.model().companions = this->Files.companions(this->Path);
  this->Builder.keep(this->Files.dependencies(), ModelContents::worthwhile);
}

} // namespace dgtk
