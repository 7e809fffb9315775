// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkPovColorSource.h"

#include "dgtkError.h"
#include "dgtkFile.h"
#include "dgtkPovRunner.h"
#include "dgtkThreadPool.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <mutex>
#include <optional>

namespace dgtk
{

namespace
{
/// Of a range of rows.
constexpr int rangePixels = 1 << 20;
constexpr double top = 65535;

/// Rows of a .ppm of 16 bits; `skip` rows are passed over.
void readRows(const std::string& path, int width, int skip, int rows, float* rgb)
{
  std::ifstream file(path, std::ios::binary);
  std::string word;
  for (int numbers = 0; numbers < 4 && file >> word;)
  {
    if (word[0] == '#')
    {
      std::getline(file, word);
      continue;
    }
    ++numbers; // P6, width, height, 65535
  }
  file.get();
  const std::size_t row = std::size_t(width) * 3;
  file.seekg(static_cast<std::streamoff>(row * 2 * skip), std::ios::cur);
  std::vector<unsigned char> bytes(row * 2 * rows);
  if (!file.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size())))
  {
    throw MachineError(path + ": POV-Ray's picture is not whole");
  }
  for (std::size_t i = 0; i < row * rows; ++i)
  {
    rgb[i] = static_cast<float>((bytes[2 * i] << 8 | bytes[2 * i + 1]) / top);
  }
}
} // namespace

/// What all pictures share.
struct PovColorSource::Studio
{
  PovColorSettings settings;
  ThreadPool& pool;
  std::string program;
  std::string folder;
  std::optional<PovRunner> runner;
  std::optional<PovLibrary> library;
  int pictures = 0;

  Studio(const PovColorSettings& s, ThreadPool& p)
    : settings(s)
    , pool(p)
    , program(findPovRay())
    , folder(s.folder + "/.povray")
  {
  }
  ~Studio()
  {
    if (this->runner)
    {
      this->clear();
    }
  }

  void clear() const
  {
    std::error_code error;
    std::filesystem::remove_all(this->folder, error);
  }
  void open()
  {
    if (!this->runner)
    {
      this->clear(); // of a run that was killed
      makeFolders(this->folder);
      this->runner.emplace(this->program, this->folder, this->settings.cancel);
      this->library.emplace(this->folder, "");
    }
  }
  bool inOnePiece() const
  {
    const PovOptions options = povOptionsOf(this->settings.options);
    return options.radiosity || options.lens.has_value();
  }
};

/// A camera at a frame.
struct PovColorSource::Picture
{
  std::shared_ptr<Studio> studio; // a worker may be the last to let go of a picture
  std::shared_ptr<const SceneState> state;
  View view;
  std::string name;
  std::once_flag once;
  bool drawn = false;

  Picture(const std::shared_ptr<Studio>& s, const std::shared_ptr<const SceneState>& theState, const View& theView)
    : studio(s)
    , state(theState)
    , view(theView)
    , name("picture" + std::to_string(s->pictures++))
  {
  }
  ~Picture()
  {
    if (this->drawn)
    {
      this->remove(this->path(this->name, ".ppm"));
    }
  }

  std::string path(const std::string& stem, const char* extension) const
  {
    return this->studio->folder + '/' + stem + extension;
  }
  void remove(const std::string& path) const
  {
    std::error_code error;
    std::filesystem::remove(path, error);
  }

  /// Into <stem>.ppm.
  void draw(const std::string& stem, const PovRows& rows) const
  {
    const OptionValues& options = this->studio->settings.options;
    const PovScene scene = makePovScene(*this->state, this->view, povOptionsOf(options), *this->studio->library, rows);
    writeFile(this->path(stem, ".pov"), scene.text);
    const int height = rows.count > 0 ? rows.count : this->view.model->height();
    std::vector<std::string> words{ "+I" + stem + ".pov", "+O" + stem + ".ppm", "+FP16",
      "+W" + std::to_string(this->view.model->width()), "+H" + std::to_string(height), "File_Gamma=sRGB", "Dither=off",
      "-UA", "+Q9", "-D", "-P", "-V", "-C", "+WT1" };
    const std::vector<std::string> more =
      povAntialias(povAntialiasOf(options).value_or(this->studio->settings.samples));
    words.insert(words.end(), more.begin(), more.end());
    this->studio->runner->run(words, stem);
    this->remove(this->path(stem, ".pov"));
  }

  void range(const PovRows& rows, float* rgb) const
  {
    const std::string stem = this->name + '_' + std::to_string(rows.first);
    this->draw(stem, rows);
    readRows(this->path(stem, ".ppm"), this->view.model->width(), 0, rows.count, rgb);
    this->remove(this->path(stem, ".ppm"));
  }

  std::vector<float> color(const PixelRect& band)
  {
    const int width = this->view.model->width();
    std::vector<float> rgb(std::size_t(width) * band.height * 3);
    if (this->studio->inOnePiece())
    {
      std::call_once(this->once, [this] { this->draw(this->name, {}), this->drawn = true; });
      readRows(this->path(this->name, ".ppm"), width, band.y, band.height, rgb.data());
      return rgb;
    }
    const int rows = std::max(1, rangePixels / width);
    this->studio->pool.parallelFor((band.height + rows - 1) / rows,
      [&](int i)
      {
        const int first = i * rows;
        this->range(
          { band.y + first, std::min(rows, band.height - first) }, rgb.data() + std::size_t(width) * first * 3);
      });
    return rgb;
  }
};

PovColorSource::PovColorSource(const PovColorSettings& settings, ThreadPool& pool)
  : Self(std::make_shared<Studio>(settings, pool))
{
}

PovColorSource::~PovColorSource() = default;

void PovColorSource::setScene(const std::shared_ptr<const SceneState>& state, const View& view)
{
  this->Self->open();
  this->Current = std::make_shared<Picture>(this->Self, state, view);
}

std::function<std::vector<float>()> PovColorSource::colorOf(const PixelRect& band)
{
  return [picture = this->Current, band] { return picture->color(band); };
}

} // namespace dgtk
