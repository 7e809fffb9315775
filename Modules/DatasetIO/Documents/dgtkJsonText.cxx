// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkJsonText.h"

#include "dgtkText.h"

#include <cmath>

namespace dgtk
{

std::string jsonNumber(double value)
{
  if (!std::isfinite(value))
  {
    return "null";
  }
  const std::string text = shortest(value);
  return text.find_first_of(".e") == std::string::npos ? text + ".0" : text;
}

std::string jsonMatrix(const Eigen::Ref<const Eigen::MatrixXd>& matrix)
{
  std::string out = "[";
  for (Eigen::Index i = 0; i < matrix.rows(); ++i)
  {
    out += i > 0 ? ", " : "";
    std::string row;
    for (Eigen::Index j = 0; j < matrix.cols(); ++j)
    {
      row += (j > 0 ? ", " : "") + jsonNumber(matrix(i, j));
    }
    out += matrix.cols() == 1 ? row : "[" + row + "]";
  }
  return out + "]";
}

JsonObject& JsonObject::raw(const std::string& key, const std::string& value)
{
  const std::string member = jsonString(key) + ": " + value;
  this->Block += (this->Block.empty() ? "\n" : ",\n") + std::string(this->Indent, ' ') + member;
  this->Line += (this->Line.empty() ? "" : ", ") + member;
  return *this;
}

std::string JsonObject::block() const
{
  return "{" + this->Block + "\n" + std::string(std::max(0, this->Indent - 2), ' ') + "}";
}

std::string JsonObject::line() const { return "{" + this->Line + "}"; }

void JsonArray::add(const std::string& item)
{
  this->Items += (this->Items.empty() ? "\n" : ",\n") + std::string(this->Indent, ' ') + item;
}

std::string JsonArray::block() const
{
  return this->Items.empty() ? "[]" : "[" + this->Items + "\n" + std::string(std::max(0, this->Indent - 2), ' ') + "]";
}

} // namespace dgtk
