// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkPovText_h
#define dgtkPovText_h

#include "dgtkFile.h"
#include "dgtkRigid3.h"

#include <Eigen/Core>

#include <optional>
#include <string>

namespace dgtk
{

/// Shortest text that reads back as the same number.
std::string povNumber(double value);
std::string povNumber(float value);

/// "<x, y, z>"
template <class Vector>
std::string povVector(const Vector& v)
{
  std::string text = "<";
  for (Eigen::Index i = 0; i < v.size(); ++i)
  {
    text += (i > 0 ? ", " : "") + povNumber(v[i]);
  }
  return text + '>';
}

/// "rgb <r, g, b>"
inline std::string povColor(const Eigen::Vector3d& color) { return "rgb " + povVector(color); }

/// "matrix <12 numbers>": the language multiplies row vectors, so that the columns of `linear` come one after another.
std::string povMatrix(const Affine3& target_from_source);

/// " scale 64", or "" for 1.
std::string povScale(double scale);

/// Text in memory, or on its way into a file.
class PovText
{
public:
  PovText() = default;
  explicit PovText(const std::string& path) { this->File.emplace(path); }
  PovText& operator<<(const std::string& text)
  {
    this->Text += text;
    if (this->File && this->Text.size() > (1 << 20))
    {
      this->flush();
    }
    return *this;
  }
  /// Completes the file.
  void commit()
  {
    this->flush();
    this->File->commit();
  }
  /// Of one in memory.
  const std::string& text() const { return this->Text; }

private:
  void flush()
  {
    this->File->write(this->Text);
    this->Text.clear();
  }
  std::optional<AtomicFile> File;
  std::string Text;
};

} // namespace dgtk

#endif
