// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkAc3dLines.h"
#include "dgtkAc3dObject.h"
#include "dgtkError.h"
#include "dgtkFile.h"

#include <cctype>
#include <map>

namespace dgtk
{

namespace
{
constexpr std::size_t deepestObject = 1000;

/// An OBJECT whose kids are being read.
struct Level
{
  long long kids;
  long long kidsLeft;
  Affine3 root_from_object;
  std::string texture;
};

class Ac3dParser
{
public:
  Ac3dParser(const std::string& path, const std::string& text, std::size_t bytes, const ReadOptions& options)
    : Lines(path, text)
    , Builder(path, "ac3d", bytes, options)
    , Object(Lines, Builder, Materials)
  {
  }

  ModelContents parse()
  {
    this->header();
    while (this->Lines.next())
    {
      const Words& words = this->Lines.words();
      if (!words.empty())
      {
        this->statement(words);
      }
    }
    this->checkEnd();
    this->finishObject();
    while (!this->Levels.empty())
    {
      this->MissingKids += this->Levels.back().kidsLeft > 0 ? 1 : 0;
      this->Levels.pop_back();
    }
    this->report();
    this->Builder.keep({}, ModelContents::worthwhile);
    return this->Builder.finish();
  }

private:
  /// Real files promise more kids than follow; but a file that ends in the middle of something was cut short.
  void checkEnd() const
  {
    if (this->InObject && this->Object.surfacesLeft() > 0)
    {
      this->Lines.fail("ends within the surfaces of an object", std::to_string(this->Object.surfacesLeft()) + " more",
        "the end of the file");
    }
    if (this->InObject && !this->Levels.empty())
    {
      this->Lines.fail("ends within an object", "'kids'", "the end of the file");
    }
    if (!this->Levels.empty() && this->Levels.back().kidsLeft == this->Levels.back().kids)
    {
      this->Lines.fail("ends before the kids of an object", std::to_string(this->Levels.back().kids) + " objects",
        "the end of the file");
    }
  }

  void header()
  {
    std::string_view first;
    while (first.empty() && this->Lines.next())
    {
      first = this->Lines.line();
    }
    if (first.size() < 5 || first.substr(0, 4) != "AC3D" || !std::isxdigit(static_cast<unsigned char>(first[4])))
    {
      this->Lines.fail("is not an AC3D file", "'AC3D' and a version digit", quoted(std::string(first)));
    }
  }

  void statement(const Words& words)
  {
    const std::string_view key = words[0];
    if (key == "OBJECT")
    {
      this->beginObject();
    }
    else if (key == "kids")
    {
      this->kids(this->Lines.count(words, "kids"));
    }
    else if (key == "MATERIAL" || key == "MAT")
    {
      Material material;
      material.name = words.size() > 1 ? std::string(words[1]) : std::string();
      this->Materials.push_back(this->Builder.addMaterial(material));
      this->materialFields(words, 2);
    }
    else if (key == "rgb" || key == "amb" || key == "emis" || key == "spec" || key == "shi" || key == "trans")
    {
      this->materialFields(words, 0); // of a MAT ... ENDMAT block
    }
    else if (key == "data")
    {
      this->skipData(this->Lines.count(words, "characters"));
    }
    else if (this->InObject)
    {
      this->Object.statement(words);
    }
    else if (key == "SURF" || key == "numvert" || key == "refs")
    {
      this->Lines.fail("geometry outside of an object", "OBJECT", quoted(std::string(key)));
    }
  }

  void materialFields(const Words& words, std::size_t at)
  {
    if (this->Materials.empty())
    {
      return;
    }
    Material m = this->Builder.model().materials[static_cast<std::size_t>(this->Materials.back())];
    static const std::map<std::string_view, Eigen::Vector3d Material::*> colors = { { "rgb", &Material::diffuse },
      { "amb", &Material::ambient }, { "emis", &Material::emission }, { "spec", &Material::specular } };
    while (at < words.size())
    {
      const std::string_view key = words[at++];
      const auto color = colors.find(key);
      if (color != colors.end())
      {
        m.*color->second = this->Lines.vector(words, at, "colour of a material");
        at += 3;
      }
      else if (key == "shi")
      {
        m.shininess = this->Lines.number(words, at++, "shininess of a material");
      }
      else if (key == "trans")
      {
        m.opacity = 1 - this->Lines.number(words, at++, "transparency of a material");
      }
    }
    this->Builder.setMaterial(this->Materials.back(), m);
  }

  /// The `length` characters that follow the line. Counts are not always right where line ends were converted: what
  /// starts a statement within the last few characters is not skipped.
  void skipData(long long length)
  {
    long long left = length;
    long long lines = 0;
    while (left > 0 && this->Lines.next())
    {
      const Words& words = this->Lines.words();
      if (lines > 0 && left <= 2 * lines + 1 && !words.empty() && Ac3dLines::isKeyword(words[0]))
      {
        this->Lines.again();
        return;
      }
      left -= static_cast<long long>(this->Lines.line().size()) + 1;
      ++lines;
      if (left <= 0)
      {
        return;
      }
    }
    if (left > 0)
    {
      this->Builder.warn("the data of an object ends before its " + std::to_string(length) + " characters");
    }
  }

  void beginObject()
  {
    this->finishObject();
    this->closeLevels();
    this->InObject = true;
    this->HasObjects = true;
    this->Object.begin(this->Levels.empty() ? Affine3() : this->Levels.back().root_from_object,
      this->Levels.empty() ? std::string() : this->Levels.back().texture);
  }

  /// The object's own part is complete: its kids follow, if any.
  void kids(long long number)
  {
    if (!this->InObject)
    {
      return;
    }
    Level level{ number, number, this->Object.rootFromObject(), this->Object.texture() };
    this->KnowsKids = true;
    this->finishObject();
    if (number > 0)
    {
      if (this->Levels.size() >= deepestObject)
      {
        this->Lines.fail("objects are nested too deeply", "at most " + std::to_string(deepestObject) + " levels");
      }
      this->Levels.push_back(std::move(level));
    }
    this->closeLevels();
  }

  void closeLevels()
  {
    while (!this->Levels.empty() && this->Levels.back().kidsLeft == 0)
    {
      this->Levels.pop_back();
    }
  }

  void finishObject()
  {
    if (!this->InObject)
    {
      return;
    }
    this->InObject = false;
    this->ObjectsWithoutKids += this->KnowsKids ? 0 : 1;
    this->KnowsKids = false;
    this->Object.end();
    if (!this->Levels.empty())
    {
      --this->Levels.back().kidsLeft;
    }
  }

  void report()
  {
    this->Builder.model().declaredMaterials = this->Materials.size();
    const auto warn = [this](std::size_t count, const char* text)
    {
      if (count > 0)
      {
        this->Builder.warn(std::to_string(count) + text);
      }
    };
    if (!this->HasObjects)
    {
      this->Builder.warn("no OBJECT in the file");
    }
    warn(this->MissingKids, " object(s) promise more kids than follow");
    warn(this->ObjectsWithoutKids, " object(s) end without 'kids'");
    warn(this->Lines.shortLists(), " list(s) of vertices or corners are shorter than their count");
    this->Object.report();
  }

  Ac3dLines Lines;
  ModelBuilder Builder;
  std::vector<int> Materials; ///< the file's -> the model's
  std::vector<Level> Levels;
  Ac3dObject Object;
  bool InObject = false;
  bool KnowsKids = false;
  bool HasObjects = false;
  std::size_t MissingKids = 0;
  std::size_t ObjectsWithoutKids = 0;
};
} // namespace

ModelContents readAc3d(const std::string& path, const ReadOptions& options);
ModelContents readAc3d(const std::string& path, const ReadOptions& options)
{
  std::string bytes = readFile(path);
  const std::size_t size = bytes.size();
  const std::string text = toUtf8(std::move(bytes));
  return Ac3dParser(path, text, size, options).parse();
}

} // namespace dgtk
