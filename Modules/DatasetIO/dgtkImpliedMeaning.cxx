// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkDatasetDocuments.h"

#include <cstdlib>

namespace dgtk
{

namespace
{
bool isNumber(const std::string& text)
{
  char* end = nullptr;
  std::strtod(text.c_str(), &end);
  return !text.empty() && *end == '\0';
}

Meaning meaningOfNumbers(const LayerSpec& spec)
{
  const bool camera = spec.frame == "camera";
  switch (spec.channels)
  {
    case 1:
      return spec.frame == "image" ? Meaning::Mask : Meaning::Unknown;
    case 2:
      return spec.frame.empty() ? Meaning::TextureCoordinates : Meaning::Unknown;
    case 3:
      return camera ? Meaning::Direction : Meaning::Weights;
    default:
      return Meaning::Coverage;
  }
}

Meaning meaningOfLengths(const LayerSpec& spec)
{
  const bool camera = spec.frame == "camera";
  if (spec.channels == 1)
  {
    return camera ? Meaning::Depth : Meaning::Distance;
  }
  return camera ? Meaning::Displacement : Meaning::Point;
}
} // namespace

Meaning impliedMeaning(const LayerSpec& spec)
{
  const auto said = [&spec](const char* word) { return spec.unit.find(word) != std::string::npos; };
  if (spec.invalid.rfind("no ", 0) == 0)
  {
    return Meaning::Surfaces;
  }
  if (said("sRGB") || said("camera response"))
  {
    return Meaning::Picture;
  }
  if (spec.unit == "class")
  {
    return isNumber(spec.invalid) ? Meaning::Visibility : Meaning::Mask;
  }
  if (spec.unit == "mask" || spec.unit == "1/65535")
  {
    return spec.unit == "mask" ? Meaning::Mask : Meaning::Coverage;
  }
  if (!isNumber(spec.invalid))
  {
    return spec.unit.empty() || said("pixels") || said("scene units") ? Meaning::Record : Meaning::Unknown;
  }
  if (spec.unit == "id")
  {
    return spec.invalid != "0" ? Meaning::Index : spec.name == classesKey ? Meaning::Class : Meaning::Id;
  }
  if (spec.unit == "pixels")
  {
    return spec.frame == "image" ? Meaning::Displacement : Meaning::Point;
  }
  if (spec.unit == "1")
  {
    return meaningOfNumbers(spec);
  }
  if (spec.unit == "1 / scene units" && spec.frame == "camera")
  {
    return Meaning::InverseDepth;
  }
  return said("units") ? meaningOfLengths(spec) : Meaning::Unknown;
}

} // namespace dgtk
