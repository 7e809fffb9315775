// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkPictureValues_h
#define dgtkPictureValues_h

#include "dgtkViewerModule.h"

#include "dgtkDatasetPictures.h"
#include "dgtkLayerReader.h"
#include "dgtkLdi.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace dgtk
{

/// The records of a layered depth image at the pixels that were kept.
struct LdiPixels
{
  std::vector<std::uint64_t> first; ///< of each pixel, and one more: the number of all
  std::vector<LdiRecord> records;
};

/// The numbers of one picture, or of every step-th pixel of a part of it. Pixels are the image's; (0, 0) is the top
/// left one.
struct DGTKVIEWER_EXPORT PictureValues
{
  PictureLayer layer;
  ImageInfo info;   ///< of the file; of a layered depth image, of what is shown of it
  PixelRect window; ///< that was read
  int step = 1;     ///< 1: all pixels; else one in the middle of each step x step pixels
  Rows values;      ///< kept pixels, as they stand in the file; NaN or inf where a layered depth image has no record
  int surfaces = 0; ///< largest number of records in a pixel of a layered depth image
  std::shared_ptr<const LdiPixels> ldi;

  int columns() const { return this->values.width(); }
  int rows() const { return this->values.height(); }
  std::uint64_t bytes() const;
  /// The image's column that a kept column stands for.
  int x(int column) const { return this->place(column, this->window.x, this->window.width); }
  int y(int row) const { return this->place(row, this->window.y, this->window.height); }
  /// The kept column nearest to an image column inside the window.
  int column(int x) const { return (x - this->window.x) / this->step; }
  int row(int y) const { return (y - this->window.y) / this->step; }
  bool inside(int x, int y) const;
  /// Whether the pixel itself was kept.
  bool exact(int x, int y) const;
  /// The channels of a kept pixel.
  void get(int column, int row, double* channels) const;

private:
  int place(int kept, int start, int length) const;
};

struct PictureRead
{
  PixelRect window;                               ///< of no width: the whole image
  int step = 0;                                   ///< 0: the smallest that keeps `budget` and 16384 pixels a side
  std::uint64_t budget = std::uint64_t(64) << 20; ///< bytes of pixels that are kept, about
  int surface = 0;                                ///< of a layered depth image, 0 the nearest; of amodal, id - 1
  std::function<bool()> goOn;                     ///< asked now and then; false: an empty picture comes back
};

/// Masks of objects, of which one is seen; its pixels have the object's id, others 0.
bool isObjectMask(const PictureLayer& layer);

/// Reads a picture; memory is bounded by the budget and a few rows. Throws InputError for a damaged file.
DGTKVIEWER_EXPORT PictureValues readPicture(
  const std::string& path, const PictureLayer& layer, const PictureRead& read = {});

/// Width and height of a picture's file.
DGTKVIEWER_EXPORT std::pair<int, int> pictureSize(const std::string& path, const PictureLayer& layer);

} // namespace dgtk

#endif
