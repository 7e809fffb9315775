// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkFbxMaker.h"

#include "dgtkModelChecks.h"

#include <gtest/gtest.h>

#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <sstream>

namespace dgtk::test
{

namespace
{
class TextWriter
{
public:
  TextWriter() { this->Out.precision(17); }
  std::string run(const std::vector<FbxItem>& items)
  {
    this->Out << "; FBX project file\n";
    this->write(items);
    return this->Out.str();
  }

private:
  template <class T>
  void list(const std::vector<T>& numbers)
  {
    this->Out << '*' << numbers.size() << " {\n a: ";
    for (std::size_t i = 0; i < numbers.size(); ++i)
    {
      this->Out << (i > 0 ? "," : "") << numbers[i];
    }
    this->Out << "\n }";
  }
  void write(const std::vector<FbxItem>& items)
  {
    for (const FbxItem& item : items)
    {
      this->Out << item.name << ": ";
      for (std::size_t i = 0; i < item.values.size(); ++i)
      {
        this->Out << (i > 0 ? ", " : "");
        std::visit([this](const auto& value) { this->value(value); }, item.values[i]);
      }
      if (!item.children.empty())
      {
        this->Out << " {\n";
        this->write(item.children);
        this->Out << '}';
      }
      this->Out << '\n';
    }
  }
  void value(std::int64_t v) { this->Out << v; }
  void value(double v) { this->Out << v; }
  void value(const std::string& v) { this->Out << '"' << v << '"'; }
  template <class T>
  void value(const std::vector<T>& v)
  {
    this->list(v);
  }

  std::ostringstream Out;
};

class BinaryWriter
{
public:
  explicit BinaryWriter(const FbxBinary& how)
    : How(how)
  {
  }
  std::string run(const std::vector<FbxItem>& items, std::int64_t version)
  {
    this->Out = std::string("Kaydara FBX Binary  \0\x1a", 22) + (this->How.bigEndian ? '\1' : '\0');
    this->number(static_cast<std::uint32_t>(version));
    this->write(items);
    return this->Out;
  }

private:
  template <class T>
  std::string bytesOf(T value) const
  {
    char raw[sizeof value];
    std::memcpy(raw, &value, sizeof value);
    if (this->How.bigEndian)
    {
      std::reverse(raw, raw + sizeof raw);
    }
    return { raw, sizeof raw };
  }
  template <class T>
  void number(T value)
  {
    this->Out += this->bytesOf(value);
  }
  std::string place(std::uint64_t value) const
  {
    return this->How.wide ? this->bytesOf(value) : this->bytesOf(static_cast<std::uint32_t>(value));
  }
  void write(const std::vector<FbxItem>& items)
  {
    for (const FbxItem& item : items)
    {
      const std::size_t begin = this->Out.size();
      this->Out += this->place(0) + this->place(item.values.size()) + this->place(0);
      this->Out += static_cast<char>(item.name.size());
      this->Out += item.name;
      const std::size_t values = this->Out.size();
      for (const FbxItem::Value& value : item.values)
      {
        std::visit([this](const auto& v) { this->value(v); }, value);
      }
      const std::size_t size = this->Out.size() - values;
      if (!item.children.empty())
      {
        this->write(item.children);
      }
      const std::string head = this->place(this->Out.size()) + this->place(item.values.size()) + this->place(size);
      this->Out.replace(begin, head.size(), head);
    }
    this->Out += std::string(this->How.wide ? 25 : 13, '\0');
  }
  void value(std::int64_t v)
  {
    this->Out += 'L';
    this->number(v);
  }
  void value(double v)
  {
    this->Out += 'D';
    this->number(v);
  }
  void value(const std::string& v)
  {
    const std::size_t colons = v.find("::"); // names have their class behind them here
    const std::string text =
      colons == std::string::npos ? v : v.substr(colons + 2) + std::string("\0\1", 2) + v.substr(0, colons);
    this->Out += 'S';
    this->number(static_cast<std::uint32_t>(text.size()));
    this->Out += text;
  }
  template <class T>
  void value(const std::vector<T>& list)
  {
    using Single = std::conditional_t<std::is_same_v<T, double>, float, std::int32_t>;
    constexpr char letters[] = { 'f', 'i', 'd', 'l' };
    this->Out += letters[(this->How.singleLists ? 0 : 2) + (std::is_same_v<T, double> ? 0 : 1)];
    std::string bytes;
    for (const T item : list)
    {
      bytes += this->How.singleLists ? this->bytesOf(static_cast<Single>(item)) : this->bytesOf(item);
    }
    if (this->How.compressed)
    {
      std::string packed(::compressBound(bytes.size()), '\0');
      uLongf size = packed.size();
      ::compress(
        reinterpret_cast<Bytef*>(packed.data()), &size, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size());
      bytes = packed.substr(0, size);
    }
    this->number(static_cast<std::uint32_t>(list.size()));
    this->number(std::uint32_t(this->How.compressed ? 1 : 0));
    this->number(static_cast<std::uint32_t>(bytes.size()));
    this->Out += bytes;
  }

  FbxBinary How;
  std::string Out;
};

FbxItem& childOf(FbxItem& item, const std::string& name)
{
  const auto found = std::find_if(
    item.children.begin(), item.children.end(), [&name](const FbxItem& child) { return child.name == name; });
  return found != item.children.end() ? *found : item.children.emplace_back(FbxItem{ name });
}
} // namespace

std::int64_t FbxMaker::add(
  const std::string& type, const std::string& kind, std::vector<FbxItem> children, const std::string& name)
{
  const auto number = static_cast<std::int64_t>(1000 + this->Objects.size());
  this->Objects.push_back({ type, { number, type + "::" + name, kind }, std::move(children) });
  return number;
}

FbxItem& FbxMaker::item(std::int64_t object) { return this->Objects[static_cast<std::size_t>(object - 1000)]; }

void FbxMaker::set(std::int64_t object, const std::string& name, const Numbers& values)
{
  FbxItem p{ "P", { name, std::string("Number"), std::string(), std::string("A") } };
  for (const double value : values)
  {
    if (value == std::floor(value))
    {
      p.values.emplace_back(static_cast<std::int64_t>(value));
    }
    else
    {
      p.values.emplace_back(value);
    }
  }
  childOf(this->item(object), "Properties70").children.push_back(p);
}

void FbxMaker::setText(std::int64_t object, const std::string& name, const std::string& text)
{
  childOf(this->item(object), "Properties70")
    .children.push_back({ "P", { name, std::string("KString"), std::string(), std::string(), text } });
}

void FbxMaker::connect(std::int64_t child, std::int64_t parent, const std::string& property)
{
  FbxItem c{ "C", { std::string(property.empty() ? "OO" : "OP"), child, parent } };
  if (!property.empty())
  {
    c.values.emplace_back(property);
  }
  this->Connections.push_back(c);
}

std::int64_t FbxMaker::model(std::int64_t parent, const std::string& name)
{
  const std::int64_t model = this->add("Model", "Mesh", {}, name);
  this->connect(model, parent);
  return model;
}

std::int64_t FbxMaker::mesh(std::int64_t model, const Numbers& points, const Integers& corners)
{
  const std::int64_t mesh =
    this->add("Geometry", "Mesh", { { "Vertices", { points } }, { "PolygonVertexIndex", { corners } } });
  this->connect(mesh, model);
  return mesh;
}

std::int64_t FbxMaker::stack(double seconds, double begin)
{
  this->Stack = this->add("AnimationStack", "", {}, "Take");
  this->set(this->Stack, "LocalStart", { begin * this->ticks });
  this->set(this->Stack, "LocalStop", { (begin + seconds) * this->ticks });
  return this->layer(100, 0);
}

std::int64_t FbxMaker::layer(double weight, std::int64_t mode)
{
  const std::int64_t layer = this->add("AnimationLayer", "");
  this->set(layer, "Weight", { weight });
  this->set(layer, "BlendMode", { double(mode) });
  this->connect(layer, this->Stack);
  return layer;
}

std::int64_t FbxMaker::animate(std::int64_t layer, std::int64_t object, const std::string& property,
  const std::string& component, const std::vector<Key>& keys)
{
  Integers times;
  Numbers values;
  Integers flags;
  Integers data; // the bits of floats, as text files have them
  Integers counts;
  const auto bits = [](double value)
  {
    const auto single = static_cast<float>(value);
    std::int32_t whole = 0;
    std::memcpy(&whole, &single, sizeof whole);
    return std::int64_t(whole);
  };
  for (const Key& key : keys)
  {
    times.push_back(std::llround(key.time * this->ticks));
    values.push_back(key.value);
    flags.push_back(key.flags);
    const auto weight = [&key](int side) { return std::int64_t(std::lround(key.weights[side] * 10000)); };
    data.insert(data.end(), { bits(key.slopes[0]), bits(key.slopes[1]), weight(0) | weight(1) << 16, 0 });
    counts.push_back(1);
  }
  const std::int64_t curve = this->add("AnimationCurve", "",
    { { "KeyTime", { times } }, { "KeyValueFloat", { values } }, { "KeyAttrFlags", { flags } },
      { "KeyAttrDataFloat", { data } }, { "KeyAttrRefCount", { counts } } });
  const std::int64_t node = this->add("AnimationCurveNode", "");
  this->connect(node, layer);
  this->connect(node, object, property);
  this->connect(curve, node, component);
  return curve;
}

std::vector<FbxItem> FbxMaker::document() const
{
  FbxItem head{ "FBXHeaderExtension", {},
    { { "FBXHeaderVersion", { std::int64_t(1004) } }, { "FBXVersion", { this->version } } } };
  head.children.insert(head.children.end(), this->header.begin(), this->header.end());
  return { head, { "Definitions", {}, this->definitions }, { "Objects", {}, this->Objects },
    { "Connections", {}, this->Connections }, { "Takes", {}, this->takes } };
}

FbxItem fbxLayer(
  const std::string& type, const std::string& mapping, const std::string& reference, std::vector<FbxItem> values)
{
  FbxItem layer{ type, { std::int64_t(0) },
    { { "MappingInformationType", { mapping } }, { "ReferenceInformationType", { reference } } } };
  layer.children.insert(layer.children.end(), values.begin(), values.end());
  return layer;
}

std::shared_ptr<const Model> readChecked(const FbxMaker& maker)
{
  auto model = readBytes("fbx", maker.text());
  EXPECT_EQ(brokenPromise(*model), "");
  return model;
}

std::string FbxMaker::text() const { return TextWriter().run(this->document()); }

std::string FbxMaker::binary(const FbxBinary& how) const
{
  return BinaryWriter(how).run(
    this->document(), how.wide ? this->version : std::min<std::int64_t>(this->version, 7400));
}

} // namespace dgtk::test
