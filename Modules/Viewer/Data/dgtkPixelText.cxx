// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkPixelText.h"

#include "dgtkDatasetPoints.h"
#include "dgtkEditorLanguage.h"
#include "dgtkError.h"
#include "dgtkPictureColors.h"
#include "dgtkPixelValues.h"

#include <QCoreApplication>

#include <charconv>
#include <cmath>
#include <vector>

namespace dgtk
{

namespace
{
constexpr int pointDigits = 6;
constexpr int lengthDigits = 5;

std::string rounded(double value, int digits)
{
  char text[64];
  const auto end = std::to_chars(text, text + sizeof text, value, std::chars_format::general, digits).ptr;
  return { text, end };
}

/// Words of this file, in the language of the window.
struct PixelWords
{
  Q_DECLARE_TR_FUNCTIONS(PixelText)
};

bool isFloat(PixelType type) { return type == PixelType::Float32 || type == PixelType::Float64; }

std::string listText(const std::vector<double>& values, PixelType type)
{
  std::string text;
  for (const double value : values)
  {
    text += (text.empty() ? "" : ", ") + numberText(value, type);
  }
  return values.size() == 1 ? text : "(" + text + ")";
}

std::string unitOf(const LayerSpec& spec)
{
  return spec.unit.empty() || spec.unit == "1" ? "" : " " + unitText(spec.unit).toStdString();
}

std::string nothingText() { return PixelWords::tr("nothing").toStdString(); }

std::string objectText(const DatasetPictures& dataset, std::uint32_t id)
{
  const ObjectRecord* const object = dataset.object(id);
  const std::string number = std::to_string(id);
  if (object == nullptr)
  {
    return id == 0 ? "0 " + backgroundText() : number;
  }
  return number + " " + object->name + (object->objectClass.empty() ? "" : " (" + object->objectClass + ")");
}

std::string ldiText(const PictureValues& picture, std::size_t pixel)
{
  const LdiPixels& ldi = *picture.ldi;
  const std::uint64_t count = ldi.first[pixel + 1] - ldi.first[pixel];
  std::string text =
    (count == 1 ? PixelWords::tr("1 surface") : PixelWords::tr("%1 surfaces").arg(qulonglong(count))).toStdString();
  for (std::uint64_t i = ldi.first[pixel]; i < ldi.first[pixel + 1]; ++i)
  {
    const LdiRecord& record = ldi.records[i];
    text += (i == ldi.first[pixel] ? ": " : "; ") + numberText(record.depth, PixelType::Float64) + " rgba(" +
            std::to_string(record.rgba[0]) + ", " + std::to_string(record.rgba[1]) + ", " +
            std::to_string(record.rgba[2]) + ", " + std::to_string(record.rgba[3]) + ")";
  }
  return text;
}

std::string idText(const DatasetPictures& dataset, const PictureValues& picture, const std::vector<double>& values)
{
  const LayerSpec& spec = picture.layer.spec;
  const std::uint32_t id = idOf(values.data(), values.size());
  if (!spec.invalid.empty() && spec.invalid != "0" && std::to_string(id) == spec.invalid)
  {
    return nothingText();
  }
  switch (spec.meaning)
  {
    case Meaning::Mask:
      return id == 0 ? "0 " + outsideText() : objectText(dataset, id);
    case Meaning::Class:
    {
      const std::string name = dataset.className(id);
      return std::to_string(id) + (id == 0 ? " " + backgroundText() : name.empty() ? "" : " " + name);
    }
    case Meaning::Visibility:
      return std::to_string(id) + " " + visibilityText(id).toStdString();
    case Meaning::Index:
      return std::to_string(id);
    default:
      break;
  }
  if (values.size() < 4)
  {
    return objectText(dataset, id);
  }
  const QString covered =
    PixelWords::tr("coverage %1 / 255").arg(QString::fromStdString(numberText(values[3], PixelType::UInt8)));
  return objectText(dataset, id) + ", " + covered.toStdString();
}

std::string coverageText(const DatasetPictures& dataset, const PictureValues& picture, const double* channels)
{
  std::string text;
  for (const CoveredObject& object : coveredObjects(dataset, picture, channels))
  {
    text += (text.empty() ? "" : ", ") + objectText(dataset, object.id) + ": " +
            numberText(object.coverage, PixelType::Float32);
  }
  return text;
}

bool isNumbers(const PictureValues& picture)
{
  switch (picture.layer.spec.meaning)
  {
    case Meaning::Id:
    case Meaning::Class:
    case Meaning::Index:
    case Meaning::Visibility:
      return true;
    default:
      return isObjectMask(picture.layer);
  }
}
} // namespace

std::string numberText(double value, PixelType type)
{
  if (!std::isfinite(value))
  {
    return std::isnan(value) ? "nan" : value > 0 ? "inf" : "-inf";
  }
  char text[64];
  char* const end = text + sizeof text;
  const auto done = type == PixelType::Float32 ? std::to_chars(text, end, static_cast<float>(value))
                    : isFloat(type)            ? std::to_chars(text, end, value)
                                               : std::to_chars(text, end, static_cast<std::int64_t>(value));
  return { text, done.ptr };
}

std::string valueText(const DatasetPictures& dataset, const PictureValues& picture, int x, int y)
{
  if (!picture.inside(x, y))
  {
    return {};
  }
  const int column = picture.column(x);
  const int row = picture.row(y);
  if (picture.ldi)
  {
    return ldiText(picture, std::size_t(row) * std::size_t(picture.columns()) + std::size_t(column));
  }
  std::vector<double> values(std::size_t(picture.values.channels()));
  picture.get(column, row, values.data());
  const LayerSpec& spec = picture.layer.spec;
  if (isNumbers(picture))
  {
    return idText(dataset, picture, values);
  }
  if (spec.meaning == Meaning::Coverage && values.size() % 4 == 0)
  {
    return coverageText(dataset, picture, values.data());
  }
  std::string text = listText(values, picture.info.type);
  if (spec.meaning == Meaning::Picture || spec.meaning == Meaning::Mask || !std::isfinite(values[0]))
  {
    return text;
  }
  text += unitOf(spec);
  if (spec.meaning == Meaning::Displacement && values.size() == 2)
  {
    const std::string length = rounded(std::hypot(values[0], values[1]), lengthDigits);
    text += ", " + PixelWords::tr("%1 long").arg(QString::fromStdString(length)).toStdString();
  }
  return text;
}

std::optional<Eigen::Vector3d> worldPoint(
  const DatasetPictures& dataset, const PictureKey& key, const PictureValues& picture, int x, int y)
{
  const LayerSpec& spec = picture.layer.spec;
  const CameraRecord* const record = dataset.camera(key.camera, key.frame);
  if (record == nullptr || !givesPoints(spec) || picture.info.format == "png" || !picture.inside(x, y))
  {
    return std::nullopt;
  }
  std::vector<double> values(std::size_t(picture.values.channels()));
  picture.get(picture.column(x), picture.row(y), values.data());
  try
  {
    if (spec.meaning == Meaning::Point)
    {
      return pointOf(spec, View(), x, y, values.data());
    }
    PixelCamera eye(dataset, *record);
    const View* const view = eye.at(x, y);
    return view ? pointOf(spec, *view, x, y, values.data()) : std::nullopt;
  }
  catch (const Error&)
  {
    return std::nullopt;
  }
}

std::string pointText(const Eigen::Vector3d& point)
{
  return "(" + rounded(point.x(), pointDigits) + ", " + rounded(point.y(), pointDigits) + ", " +
         rounded(point.z(), pointDigits) + ")";
}

} // namespace dgtk
