// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkThesisScene.h"

#include "dgtkError.h"
#include "dgtkSceneRules.h"
#include "dgtkSceneText.h"
#include "dgtkText.h"
#include "dgtkThesisLexer.h"

#include <algorithm>

namespace dgtk::scenefile
{

namespace
{
using Kind = SceneItem::Kind;
using Vector = Eigen::Vector3d;

/// One line of a key frame: < position > { w, < x, y, z > } [ scale ].
struct KeyLine
{
  Vector position;
  Quaternion orientation;
  Vector scale{ 1, 1, 1 };
  bool hasScale = false;
};

class Reader
{
public:
  Reader(const std::string& file, const std::string& folder, const std::string& contents)
    : Lexer(file, contents)
  {
    this->Scene.file = file;
    this->Scene.folder = folder;
  }

  SceneDescription read()
  {
    const long items = this->Lexer.count("number of objects");
    for (long i = 1; i <= items; ++i)
    {
      this->readItem("object " + std::to_string(i) + " of " + std::to_string(items));
    }
    const long frames = this->Lexer.count("number of key frames");
    int previous = -1;
    for (long i = 1; i <= frames; ++i)
    {
      previous = this->readKeyFrame("key frame " + std::to_string(i) + " of " + std::to_string(frames), previous);
    }
    if (!this->Lexer.atEnd())
    {
      this->Lexer.fail("text after the last key frame", "the end of the file");
    }
    this->finish();
    nameAll(this->Scene);
    validateRelations(this->Scene, locateByName(this->Scene));
    return std::move(this->Scene);
  }

private:
  void readItem(const std::string& what)
  {
    if (this->Lexer.atEnd())
    {
      this->Lexer.fail(what, "glObject_AC, glObject_3DS, glObject_Md2, glObject_Light or glObject_Camera");
    }
    const long line = this->Lexer.line();
    ThesisLexer before = this->Lexer;
    const std::string tag = lower(std::string(this->Lexer.word()));
    const bool model = tag == "globject_ac" || tag == "globject_3ds" || tag == "globject_md2";
    if (!model && tag != "globject_light" && tag != "globject_camera")
    {
      before.fail(what, "glObject_AC, glObject_3DS, glObject_Md2, glObject_Light or glObject_Camera");
    }
    this->Lexer.expect(":", what);
    if (model)
    {
      this->readModel(tag, line, what);
    }
    else if (tag == "globject_light")
    {
      this->readLight(line, what);
    }
    else
    {
      this->readCamera(line, what);
    }
  }

  void readModel(const std::string& tag, long line, const std::string& what)
  {
    ObjectDescription object;
    object.line = line;
    object.model = this->Lexer.restOfLine();
    const std::string fault = faultOfText(object.model, false);
    const std::string extension = extensionOf(object.model);
    if (!fault.empty())
    {
      throw InputError(this->Scene.file, line, what, "the name of a model file", quoted(object.model));
    }
    if ((tag == "globject_3ds" && extension != "3ds") || (tag == "globject_md2" && extension != "md2"))
    {
      throw InputError(this->Scene.file, line, what, "a model that ends in ." + tag.substr(9), quoted(object.model));
    }
    this->add(Kind::Object, this->Scene.objects, std::move(object));
  }

  void readLight(long line, const std::string& what)
  {
    LightDescription light;
    light.line = line;
    light.name = this->Lexer.restOfLine('(');
    const std::string fault = faultOfText(light.name, true);
    if (!fault.empty())
    {
      throw InputError(this->Scene.file, line, what, fault, quoted(light.name));
    }
    if (this->Lexer.take("("))
    {
      light.diffuse = this->Lexer.vector(rules::light, what + ": diffuse colour");
      light.specular = this->Lexer.vector(rules::light, what + ": specular colour");
      light.ambient = this->Lexer.vector(rules::light, what + ": ambient colour");
      this->Lexer.expect(")", what);
    }
    this->add(Kind::Light, this->Scene.lights, std::move(light));
  }

  void readCamera(long line, const std::string& what)
  {
    CameraDescription camera;
    camera.line = line;
    this->Lexer.expect("(", what);
    camera.fovY.value = this->Lexer.number(rules::fovY, what + ": field of view");
    camera.near = this->Lexer.number(rules::length, what + ": near");
    camera.far = this->Lexer.number(rules::length, what + ": far");
    camera.aspect = this->Lexer.number(rules::aspect, what + ": aspect");
    this->Lexer.expect(")", what);
    this->Lexer.expect("[", what);
    camera.eye.value = this->Lexer.vector(rules::coordinate, what + ": eye");
    camera.lookAt.value = this->Lexer.vector(rules::coordinate, what + ": look-at point");
    camera.up.value = this->Lexer.vector(rules::coordinate, what + ": up");
    this->Lexer.expect("]", what);
    this->add(Kind::Camera, this->Scene.cameras, std::move(camera));
  }

  template <typename Item>
  void add(Kind kind, std::vector<Item>& items, Item item)
  {
    this->Scene.order.push_back({ kind, items.size() });
    items.push_back(std::move(item));
  }

  int readKeyFrame(const std::string& what, int previous)
  {
    if (this->Lexer.atEnd())
    {
      this->Lexer.fail(what, "a frame number");
    }
    ThesisLexer before = this->Lexer;
    const double number = this->Lexer.number(rules::frame, what);
    const int frame = static_cast<int>(number);
    if (number != frame)
    {
      before.fail(what, rules::frame.text);
    }
    if (frame <= previous)
    {
      before.fail(what + (frame == previous ? " has the frame number of the one before" : " is out of order"),
        "more than " + std::to_string(previous));
    }
    for (const SceneItem& item : this->Scene.order)
    {
      this->readKeys(item, frame);
    }
    if (this->Scene.order.empty())
    {
      this->Scene.extraKeyFrames.push_back(frame);
    }
    return frame;
  }

  void readKeys(const SceneItem& item, int frame)
  {
    const std::string where = " at frame " + std::to_string(frame);
    const std::string number = std::to_string(item.index + 1);
    if (item.kind == Kind::Object)
    {
      ObjectDescription& object = this->Scene.objects[item.index];
      const KeyLine line = this->readKeyLine("model " + number + where);
      object.position.keys.push_back({ frame, line.position });
      append(frame, line, object.orientation, object.scale);
    }
    else if (item.kind == Kind::Light)
    {
      LightDescription& light = this->Scene.lights[item.index];
      const KeyLine line = this->readKeyLine("light " + number + where);
      light.position.keys.push_back({ frame, line.position });
      append(frame, line, light.unused.orientation, light.unused.scale);
    }
    else
    {
      CameraDescription& camera = this->Scene.cameras[item.index];
      const KeyLine eye = this->readKeyLine("eye of camera " + number + where);
      camera.eye.keys.push_back({ frame, eye.position });
      append(frame, eye, camera.unusedEye.orientation, camera.unusedEye.scale);
      const KeyLine lookAt = this->readKeyLine("look-at point of camera " + number + where);
      camera.lookAt.keys.push_back({ frame, lookAt.position });
      append(frame, lookAt, camera.unusedLookAt.orientation, camera.unusedLookAt.scale);
    }
  }

  KeyLine readKeyLine(const std::string& what)
  {
    KeyLine line;
    this->Lexer.expect("<", what);
    line.position = this->Lexer.vector(rules::coordinate, what + ": position");
    this->Lexer.expect(">", what);
    this->Lexer.expect("{", what);
    ThesisLexer before = this->Lexer;
    line.orientation.w = this->Lexer.number(rules::coordinate, what + ": orientation");
    this->Lexer.expect("<", what);
    const Vector axis = this->Lexer.vector(rules::coordinate, what + ": orientation");
    this->Lexer.expect(">", what);
    this->Lexer.expect("}", what);
    line.orientation = { line.orientation.w, axis[0], axis[1], axis[2] };
    const std::string fault = faultOf(line.orientation);
    if (!fault.empty())
    {
      throw InputError(this->Scene.file, before.line(), what + ": orientation is not a rotation", fault,
        "length " + plainNumber(line.orientation.norm()));
    }
    if (this->Lexer.take("["))
    {
      line.hasScale = true;
      for (int i = 0; i < 3; ++i)
      {
        before = this->Lexer;
        line.scale[i] = this->Lexer.number(rules::scale, what + ": scale");
        if (line.scale[i] == 0)
        {
          before.fail(what + ": scale is out of range", rules::scale.text);
        }
      }
      this->Lexer.expect("]", what);
    }
    return line;
  }

  /// A line without scale has scale 1; a track of scales begins where the first one is given.
  static void append(int frame, const KeyLine& line, Track<Quaternion>& orientation, Track<Vector>& scale)
  {
    if (line.hasScale && scale.keys.empty())
    {
      for (const Key<Quaternion>& key : orientation.keys)
      {
        scale.keys.push_back({ key.frame, Vector(1, 1, 1) });
      }
    }
    orientation.keys.push_back({ frame, line.orientation });
    if (line.hasScale || !scale.keys.empty())
    {
      scale.keys.push_back({ frame, line.scale });
    }
  }

  template <typename T>
  static void useFirstKey(Track<T>& track)
  {
    if (track.animated())
    {
      track.value = track.keys.front().value;
    }
  }

  static void tidy(UnusedKeys& unused)
  {
    const std::vector<Key<Quaternion>>& keys = unused.orientation.keys;
    const Quaternion identity;
    if (std::all_of(keys.begin(), keys.end(), [&](const Key<Quaternion>& key) { return key.value == identity; }))
    {
      unused.orientation.keys.clear();
    }
    useFirstKey(unused.orientation);
    useFirstKey(unused.scale);
  }

  void finish()
  {
    for (ObjectDescription& object : this->Scene.objects)
    {
      useFirstKey(object.position);
      useFirstKey(object.orientation);
      useFirstKey(object.scale);
    }
    for (LightDescription& light : this->Scene.lights)
    {
      useFirstKey(light.position);
      tidy(light.unused);
    }
    for (CameraDescription& camera : this->Scene.cameras)
    {
      tidy(camera.unusedEye);
      tidy(camera.unusedLookAt);
    }
  }

  ThesisLexer Lexer;
  SceneDescription Scene;
};
} // namespace

SceneDescription readThesisScene(const std::string& file, const std::string& folder, const std::string& contents)
{
  return Reader(file, folder, contents).read();
}

} // namespace dgtk::scenefile
