// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkExportPixels.h"

#include "dgtkError.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>

namespace dgtk
{

namespace
{
constexpr double noNumber = std::numeric_limits<double>::quiet_NaN();

DecodedPixels allOf(const std::string& path)
{
  const ImageData data = readLayerFile(path);
  DecodedPixels pixels{ data.info.width, data.info.height, data.info.channels, {} };
  const PictureFile file(
    path.substr(0, path.rfind('/')), path.substr(path.rfind('/') + 1), pixels.width, pixels.height);
  pixels.values.reserve(std::size_t(pixels.width) * pixels.height * pixels.channels);
  for (int y = 0; y < pixels.height; ++y)
  {
    for (int x = 0; x < pixels.width; ++x)
    {
      for (int c = 0; c < pixels.channels; ++c)
      {
        pixels.values.push_back(file.at(x, y, c));
      }
    }
  }
  return pixels;
}

/// Codes of a PNG: value = (code - offset) scale, none where the code is `nothing`.
DecodedPixels decodeLinear(const std::string& path, const PixelEncoding& encoding)
{
  DecodedPixels pixels = allOf(path);
  const double scale = numberOf(encoding, "scale", 1);
  const double offset = numberOf(encoding, "offset", 0);
  const double none = numberOf(encoding, "nothing", noNumber);
  std::transform(pixels.values.begin(), pixels.values.end(), pixels.values.begin(),
    [&](double code) { return code == none ? noNumber : (code - offset) * scale; });
  return pixels;
}

/// Numbers of a .pfm, .npy, .flo, ...; none where they are not finite, or `nothing`.
DecodedPixels decodeFloat(const std::string& path, const PixelEncoding& encoding)
{
  DecodedPixels pixels = allOf(path);
  const double none = numberOf(encoding, "nothing", noNumber);
  std::transform(pixels.values.begin(), pixels.values.end(), pixels.values.begin(),
    [&](double value) { return std::isfinite(value) && value != none ? value : noNumber; });
  return pixels;
}

struct Decoder
{
  const char* kind;
  DecodePixels decode;
};
constexpr Decoder decoders[] = {
  { "linear", &decodeLinear },
  { "float", &decodeFloat },
  { "dpt", &decodeDpt },
  { "colmap", &decodeColmap },
  { "flow-pfm", &decodeFlowPfm },
  { "hdf5", &decodeHdf5 },
  { "kitti-flow", &decodeKittiFlow },
  { "sintel-disparity", &decodeSintelDisparity },
};

const Decoder* findDecoder(const std::string& kind)
{
  const auto* found =
    std::find_if(std::begin(decoders), std::end(decoders), [&](const Decoder& one) { return kind == one.kind; });
  return found == std::end(decoders) ? nullptr : found;
}

/// One file, and what it has to show.
struct Comparison
{
  const ExportedFrom& source;
  const ExportedFile& exported;
  const DatasetFile& file() const { return this->exported.file; }
  const PixelEncoding& encoding() const { return this->exported.encoding; }
  std::string path() const { return this->source.path(this->file().path); }
  PicturePointer layer(const std::vector<std::string>& extensions = {}) const
  {
    return this->source.picture(this->file().camera, this->file().frame, this->file().layer, extensions);
  }
  void requireSize(int width, int height) const
  {
    const CameraRecord* camera = this->source.camera(this->file().camera, this->file().frame);
    if (!camera || camera->width != width || camera->height != height)
    {
      throw InputError(this->path(), "size differs from the camera's");
    }
  }
};

Offender offenderAt(const Comparison& one, int x, int y, double found, double expected)
{
  return { one.file().path, x, y, numberText(found), numberText(expected) };
}

void forPixels(int width, int height, const std::function<void(int x, int y)>& visit)
{
  for (int y = 0; y < height; ++y)
  {
    for (int x = 0; x < width; ++x)
    {
      visit(x, y);
    }
  }
}

/// The file is one of the dataset's, byte for byte.
void judgeCopy(const Comparison& one, Meter& meter)
{
  const std::vector<DatasetFile> all = one.source.filesOf(one.file().camera, one.file().frame);
  const bool same = std::any_of(all.begin(), all.end(),
    [&](const DatasetFile& file) { return file.layer == one.file().layer && file.sha256 == one.file().sha256; });
  meter.equal(same, [&] { return Offender{ one.file().path, -1, -1, "other bytes", "the dataset's file" }; });
}

/// Colours, in levels of 8 bits.
void judgePicture(const Comparison& one, Meter& meter)
{
  const DecodedPixels found = decodePicture(one.path());
  const PicturePointer expected = one.layer({ "png" });
  one.requireSize(found.width, found.height);
  meter.Tolerance = numberOf(one.encoding(), "rounding", 0);
  const double level = expected->type() == PixelType::UInt16 ? 257 : 1;
  forPixels(found.width, found.height,
    [&](int x, int y)
    {
      for (int c = 0; c < std::min(found.channels, expected->channels()); ++c)
      {
        const double want = expected->at(x, y, c) / level;
        const double apart = beyond(std::abs(found.at(x, y, c) - want), level > 1 ? 0.5 : 0);
        meter.add(apart, [&] { return offenderAt(one, x, y, found.at(x, y, c), want); });
      }
    });
  meter.equal(meter.Tolerance < meter.Largest + 1, // it is what was lost, and allows no more
    [&] { return offenderAt(one, -1, -1, meter.Tolerance, meter.Largest); });
}

/// The transfer function of IEC 61966-2-1, of 0 to 1.
double lightOf(double v) { return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4); }
double codeOf(double light) { return light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1 / 2.4) - 0.055; }

/// Pixels that are the mean light of four of the layer's.
void judgeHalfPicture(const Comparison& one, Meter& meter)
{
  const DecodedPixels found = decodePicture(one.path());
  const PicturePointer expected = one.layer({ "png" });
  one.requireSize(2 * found.width, 2 * found.height);
  meter.Tolerance = numberOf(one.encoding(), "rounding", 0) + 1e-6; // a tie may be taken either way
  forPixels(found.width, found.height,
    [&](int x, int y)
    {
      for (int c = 0; c < std::min(found.channels, expected->channels()); ++c)
      {
        double light = 0;
        for (int k = 0; k < 4; ++k)
        {
          light += lightOf(expected->at(2 * x + k % 2, 2 * y + k / 2, c) / 255) / 4;
        }
        const double want = 255 * codeOf(light);
        meter.add(found.at(x, y, c) - want, [&] { return offenderAt(one, x, y, found.at(x, y, c), want); });
      }
    });
}

/// Not zero where the layer `objects` has one of the ids.
void judgeMask(const Comparison& one, Meter& meter)
{
  const DecodedPixels found = allOf(one.path());
  const PicturePointer ids = one.source.picture(one.file().camera, one.file().frame, "objects");
  one.requireSize(found.width, found.height);
  const std::vector<double>& wanted = one.encoding().numbers.at("ids");
  forPixels(found.width, found.height,
    [&](int x, int y)
    {
      const bool inside = std::find(wanted.begin(), wanted.end(), double(ids->id(x, y))) != wanted.end();
      meter.equal((found.at(x, y) != 0) == inside, [&] { return offenderAt(one, x, y, found.at(x, y), inside); });
    });
}

/// Codes of ids: `codes` is id, code, id, code, ...; three channels are a number, R the lowest byte unless
/// `high_first`. Ids that are not listed are `nothing` (0).
void judgeIds(const Comparison& one, Meter& meter)
{
  const DecodedPixels found = allOf(one.path());
  const PicturePointer ids = one.layer();
  one.requireSize(found.width, found.height);
  std::map<std::uint32_t, double> codes;
  const std::vector<double>& pairs = one.encoding().numbers.at("codes");
  for (std::size_t i = 0; i < pairs.size(); i += 2)
  {
    codes[static_cast<std::uint32_t>(pairs[i])] = pairs.at(i + 1);
  }
  const bool highFirst = numberOf(one.encoding(), "high_first", 0) != 0;
  const auto codeAt = [&](int x, int y)
  {
    if (found.channels < 3)
    {
      return found.at(x, y);
    }
    const double first = found.at(x, y, 0);
    const double last = found.at(x, y, 2);
    return (highFirst ? last : first) + 256 * found.at(x, y, 1) + 65536 * (highFirst ? first : last);
  };
  forPixels(found.width, found.height,
    [&](int x, int y)
    {
      const auto code = codes.find(ids->id(x, y));
      const double expected = code == codes.end() ? numberOf(one.encoding(), "nothing", 0) : code->second;
      meter.equal(codeAt(x, y) == expected, [&] { return offenderAt(one, x, y, codeAt(x, y), expected); });
    });
}

/// Values of the dataset's layer in the format's unit; NaN where there is none, or its class is not asked for.
class ExpectedValues
{
public:
  explicit ExpectedValues(const Comparison& one)
    : Layer(one.layer())
    , Factors(factorsOf(one.encoding()))
  {
    const DatasetFile& file = one.file();
    for (const auto& [key, wanted] : one.encoding().numbers)
    {
      if (key == "left_out")
      {
        this->Objects = one.source.picture(file.camera, file.frame, "objects");
        this->LeftOut = wanted;
      }
      if (key.rfind("classes", 0) == 0)
      {
        const std::string layer = key == "classes" ? file.layer : key.substr(std::string("classes_of_").size());
        this->Classes.push_back({ one.source.picture(file.camera, file.frame, layer + "_class", { "png" }), wanted });
      }
    }
    if (this->Classes.empty())
    {
      this->Usual = one.source.classesOf(file.camera, file.frame, file.layer);
    }
  }
  double at(int x, int y, int c) const
  {
    for (const auto& [picture, wanted] : this->Classes)
    {
      if (std::find(wanted.begin(), wanted.end(), picture->at(x, y)) == wanted.end())
      {
        return noNumber;
      }
    }
    if (this->Usual && this->Usual->at(x, y) == 0)
    {
      return noNumber;
    }
    if (this->Objects &&
        std::find(this->LeftOut.begin(), this->LeftOut.end(), double(this->Objects->id(x, y))) != this->LeftOut.end())
    {
      return noNumber;
    }
    const double value = this->Layer->at(x, y, c);
    return std::isfinite(value) ? value * this->Factors[std::size_t(c) % this->Factors.size()] : noNumber;
  }
  int channels() const { return this->Layer->channels(); }
  double rounding(int x, int y, int c) const { return this->Layer->rounding(this->Layer->at(x, y, c)); }

private:
  static std::vector<double> factorsOf(const PixelEncoding& encoding)
  {
    const auto found = encoding.numbers.find("factor");
    return found == encoding.numbers.end() ? std::vector<double>{ 1 } : found->second;
  }
  PicturePointer Layer;
  std::vector<std::pair<PicturePointer, std::vector<double>>> Classes;
  PicturePointer Usual; ///< classes, where none are wanted: all but 0 are
  std::vector<double> Factors;
  PicturePointer Objects; ///< where some are left out
  std::vector<double> LeftOut;
};

/// Whether the format has a code for a value.
bool hasCode(const PixelEncoding& encoding, double value)
{
  const double code = value / numberOf(encoding, "scale", 1) + numberOf(encoding, "offset", 0);
  return encoding.numbers.count("most") == 0 ||
         (code > numberOf(encoding, "least", 0) - 0.5 && code < numberOf(encoding, "most", 0) + 0.5);
}

void judgeValues(const Comparison& one, const Decoder& decoder, Meter& meter)
{
  constexpr double half = 5.97e-8; // half of the distance of neighbouring float32, of their size
  const DecodedPixels found = decoder.decode(one.path(), one.encoding());
  const ExpectedValues expected(one);
  one.requireSize(found.width, found.height);
  const bool codes = one.encoding().numbers.count("rounding") > 0;
  meter.Tolerance = codes ? numberOf(one.encoding(), "rounding", 0) * (1 + 1e-9) : 0;
  const double most = numberOf(one.encoding(), "scale", 1) / 2; // of whole codes
  meter.equal(meter.Tolerance <= most * (1 + 1e-6), [&] { return offenderAt(one, -1, -1, meter.Tolerance, most); });
  forPixels(found.width, found.height,
    [&](int x, int y)
    {
      const int channels = std::min(found.channels, expected.channels());
      bool there = true; // a pixel is there with all its values, or not at all
      for (int c = 0; c < channels; ++c)
      {
        const double want = expected.at(x, y, c);
        there = there && std::isfinite(want) && hasCode(one.encoding(), want);
      }
      for (int c = 0; c < channels; ++c)
      {
        const double value = found.at(x, y, c);
        const double want = expected.at(x, y, c);
        const double slack = codes ? 1e-12 * std::abs(want) : half * std::abs(want);
        const double apart = there ? beyond(std::abs(value - want), slack) : 0;
        meter.add(std::isfinite(value) == there ? apart : infinite, [&] { return offenderAt(one, x, y, value, want); });
      }
    });
}

/// What a layer of the moved point's disparities gains over the layer `disparity`, as float32.
void judgeChange(const Comparison& one, Meter& meter)
{
  constexpr double half = 5.97e-8;
  const DecodedPixels found = decodeFloat(one.path(), one.encoding());
  const ExpectedValues there(one);
  const PicturePointer here = one.source.picture(one.file().camera, one.file().frame, "disparity");
  one.requireSize(found.width, found.height);
  forPixels(found.width, found.height,
    [&](int x, int y)
    {
      const double want = there.at(x, y, 0) - here->at(x, y);
      const double value = found.at(x, y);
      const bool same = std::isfinite(value) == std::isfinite(want);
      const double apart = std::isfinite(want) ? beyond(std::abs(value - want), half * std::abs(want)) : 0;
      meter.add(same ? apart : infinite, [&] { return offenderAt(one, x, y, value, want); });
    });
}

/// The dataset has no such layer of the picture.
void judgeNothing(const Comparison& one, Meter& meter)
{
  const DecodedPixels found = allOf(one.path());
  one.requireSize(found.width, found.height);
  const double none = numberOf(one.encoding(), "nothing", noNumber);
  const bool right = one.source.file(one.file().camera, one.file().frame, one.file().layer).empty();
  forPixels(found.width, found.height,
    [&](int x, int y)
    {
      for (int c = 0; c < std::min(found.channels, 2); ++c)
      {
        meter.equal(right && found.at(x, y, c) == none, [&] { return offenderAt(one, x, y, found.at(x, y, c), none); });
      }
    });
}

struct Judge
{
  const char* kind;
  void (*compare)(const Comparison&, Meter&);
  const char* unit;
};
constexpr Judge judges[] = {
  { "copy", &judgeCopy, "" },
  { "picture", &judgePicture, "levels" },
  { "half-picture", &judgeHalfPicture, "levels" },
  { "mask", &judgeMask, "" },
  { "ids", &judgeIds, "" },
  { "disparity-change", &judgeChange, "px" },
  { "nothing", &judgeNothing, "" },
};
} // namespace

double numberOf(const PixelEncoding& encoding, const std::string& key, double usual)
{
  const auto found = encoding.numbers.find(key);
  return found == encoding.numbers.end() || found->second.size() != 1 ? usual : found->second[0];
}

DecodedPixels decodePng(const std::string& path, const PixelEncoding&) { return allOf(path); }

void judgePixels(const ExportedFrom& source, const ExportedFile& file, Results& results)
{
  const Comparison one{ source, file };
  const std::string& kind = file.encoding.kind;
  const auto* special =
    std::find_if(std::begin(judges), std::end(judges), [&](const Judge& judge) { return kind == judge.kind; });
  const Decoder* decoder = findDecoder(kind);
  Meter meter(0);
  if (special != std::end(judges))
  {
    special->compare(one, meter);
  }
  else if (decoder)
  {
    judgeValues(one, *decoder, meter);
  }
  else
  {
    results.unusable(file.file.layer, file.file.path, "is coded as " + quoted(kind) + ", which nobody can read");
    return;
  }
  const char* unit = special != std::end(judges) ? special->unit : "in the format's unit";
  results.add({ file.file.layer, unit, { file.file.path } }, meter);
}

} // namespace dgtk
