// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkPictureColors_h
#define dgtkPictureColors_h

#include "dgtkViewerModule.h"

#include "dgtkLayerColors.h"
#include "dgtkPictureValues.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace dgtk
{

/// Values between which a layer's colours change, in the layer's unit.
struct PictureRange
{
  double low = 0;
  double high = 1;
  bool operator==(const PictureRange& o) const { return this->low == o.low && this->high == o.high; }
};

/// What the colours of a picture mean.
struct PictureLegend
{
  enum class Kind
  {
    None,     ///< the colours are the content
    Ramp,     ///< of one number
    Swatches, ///< names
    Wheel,    ///< of a flow, up to `range.high`
    Axes      ///< red, green and blue are components
  };
  struct Swatch
  {
    Rgb color{};
    std::string text;
  };
  Kind kind = Kind::None;
  bool hasRange = false;        ///< whether the colours follow a range that can be chosen
  PictureRange range;           ///< that was used
  PictureRange found;           ///< of the picture itself
  std::string unit;             ///< "" for none
  std::vector<Swatch> swatches; ///< the most frequent first
  std::size_t hidden = 0;       ///< names that are left out of `swatches`
  std::string text;             ///< a sentence
};

/// A picture in readable colours.
struct PictureColors
{
  std::vector<std::uint32_t> pixels; ///< 0xffRRGGBB of the kept pixels, row by row
  PictureLegend legend;
};

/// `range`: in place of the picture's own, for layers that have one.
DGTKVIEWER_EXPORT PictureColors colorPicture(
  const DatasetPictures& dataset, const PictureValues& picture, const std::optional<PictureRange>& range = {});

/// The colour at a position of a ramp's legend, 0 the low end of its range, 1 the high end.
DGTKVIEWER_EXPORT Rgb legendColor(const PictureValues& picture, const PictureLegend& legend, double position);

/// Whether a ramp has equal steps of the logarithm.
DGTKVIEWER_EXPORT bool legendIsLogarithmic(const PictureValues& picture, const PictureLegend& legend);

/// What id 0 of objects and classes stands for, in the language of the window.
DGTKVIEWER_EXPORT std::string backgroundText();
/// Likewise of amodal masks.
DGTKVIEWER_EXPORT std::string outsideText();

/// An object and the part of a pixel that it covers, in the order of a coverage file's ranks.
struct CoveredObject
{
  std::uint32_t id = 0; ///< 0: background, or a name that objects.json does not have
  double coverage = 0;
};
/// The ranks of a pixel of a Cryptomatte file that are not empty. `channels`: as readPicture() has them.
DGTKVIEWER_EXPORT std::vector<CoveredObject> coveredObjects(
  const DatasetPictures& dataset, const PictureValues& picture, const double* channels);

} // namespace dgtk

#endif
