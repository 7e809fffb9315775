// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkDatasetDocuments.h"
#include "dgtkError.h"
#include "dgtkFile.h"
#include "dgtkJsonText.h"
#include "dgtkText.h"

#include <charconv>
#include <cmath>

namespace dgtk
{

Eigen::Matrix<double, 3, 4> Calibration::cameraMatrix() const
{
  Eigen::Matrix3d viewport;
  viewport << this->width / 2.0, 0, this->x + this->width / 2.0, //
    0, this->height / 2.0, this->y + this->height / 2.0,         //
    0, 0, 1;
  return viewport * this->K * this->Rt;
}

Calibration makeCalibration(const Eigen::Matrix4d& projection, const Eigen::Matrix4d& modelView, int width, int height)
{
  const bool orthographic = projection.row(3) == Eigen::RowVector4d(0, 0, 0, 1);
  const int kept = orthographic ? 3 : 2;
  constexpr int rows[] = { 0, 1, 3 };
  Calibration result;
  for (int i = 0; i < 3; ++i)
  {
    result.K.row(i) << projection(rows[i], 0), projection(rows[i], 1), projection(rows[i], kept);
  }
  result.Rt.topRows(2) = modelView.topRows(2);
  result.Rt.row(2) = modelView.row(kept);
  result.width = width;
  result.height = height;
  return result;
}

namespace
{
template <typename M>
std::string rowsText(const M& matrix)
{
  std::string text;
  for (int i = 0; i < matrix.rows(); ++i)
  {
    for (int j = 0; j < matrix.cols(); ++j)
    {
      text += (j > 0 ? " " : "") + shortest(matrix(i, j));
    }
    text += '\n';
  }
  return text;
}

/// Words of a text with the lines that they stand on.
class Words
{
public:
  explicit Words(const std::string& path)
    : Path(path)
    , Text(readFile(path, 1 << 16))
  {
  }

  std::string next()
  {
    while (this->Position < this->Text.size() && isSpace(this->Text[this->Position]))
    {
      this->Line += this->Text[this->Position++] == '\n';
    }
    const std::size_t start = this->Position;
    while (this->Position < this->Text.size() && !isSpace(this->Text[this->Position]))
    {
      ++this->Position;
    }
    return this->Text.substr(start, this->Position - start);
  }

  void expect(const std::string& word)
  {
    const std::string found = this->next();
    if (found != word)
    {
      this->fail(word.empty() ? "the end of the file" : "'" + word + "'", found);
    }
  }

  template <typename T>
  T number(const char* expected)
  {
    const std::string word = this->next();
    T value{};
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (word.empty() || error != std::errc() || end != word.data() + word.size() || !std::isfinite(double(value)))
    {
      this->fail(expected, word);
    }
    return value;
  }

  template <typename M>
  void matrix(M& to)
  {
    for (int i = 0; i < to.rows(); ++i)
    {
      for (int j = 0; j < to.cols(); ++j)
      {
        to(i, j) = this->number<double>("a number");
      }
    }
  }

private:
  static bool isSpace(char c) { return c == ' ' || c == '\n' || c == '\t' || c == '\r'; }
  [[noreturn]] void fail(const std::string& expected, const std::string& found) const
  {
    throw InputError(
      this->Path, this->Line, "is not a calibration", expected, found.empty() ? "the end of the file" : quoted(found));
  }

  std::string Path;
  std::string Text;
  std::size_t Position = 0;
  long Line = 1;
};
} // namespace

std::string calibrationText(const Calibration& calibration)
{
  return "K\n" + rowsText(calibration.K) + "R|t\n" + rowsText(calibration.Rt) + "Viewport\n" +
         std::to_string(calibration.x) + ' ' + std::to_string(calibration.y) + ' ' + std::to_string(calibration.width) +
         ' ' + std::to_string(calibration.height) + '\n';
}

Calibration readCalibration(const std::string& path)
{
  Words words(path);
  Calibration result;
  words.expect("K");
  words.matrix(result.K);
  words.expect("R|t");
  words.matrix(result.Rt);
  words.expect("Viewport");
  result.x = words.number<int>("an integer");
  result.y = words.number<int>("an integer");
  result.width = words.number<int>("an integer");
  result.height = words.number<int>("an integer");
  words.expect("");
  return result;
}

} // namespace dgtk
