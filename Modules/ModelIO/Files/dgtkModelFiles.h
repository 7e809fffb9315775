// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkModelFiles_h
#define dgtkModelFiles_h

#include "dgtkModelContents.h"

#include <map>
#include <set>
#include <string>
#include <vector>

namespace dgtk
{

/// The files that a model may have beside it: regular ones in its folder or below. Names are found as textures are
/// found: as written, beside the model, in any case; then as URIs, which glTF's are.
class ModelFiles
{
public:
  /// `model`: absolute path.
  explicit ModelFiles(const std::string& model);

  /// Path of a file that the model names, by its name or with the model's folder in front of it; "" when there is none
  /// that it may have. What is found is remembered.
  std::string find(const std::string& written);
  /// What was found, in order of path, spelled as the model is: for Model::companions.
  std::vector<std::string> companions(const std::string& modelAsGiven) const;
  /// What was asked for, and found or not.
  std::vector<ModelDependency> dependencies() const;
  /// Path of a file as dependencies() has it.
  std::string relative(const std::string& path) const;
  /// Throws InputError when a name led to a file that is there, and that the model may not have.
  void refuseOutside(const std::string& modelAsGiven) const;

private:
  std::string withoutFolder(const std::string& written) const;
  std::string withoutEscapes(const std::string& written) const;
  std::string locate(const std::string& written);
  std::string inAnyCase(const std::string& wanted) const;

  std::string Model;
  std::string Folder;
  std::string Outside;                      ///< as written
  std::map<std::string, std::string> Asked; ///< name -> path, or ""
  std::set<std::string> Found;
};

/// A part of a URI without its escapes ("%20").
std::string withoutPercents(const std::string& uri);

/// Without what a message to the user may not hold: control characters, the path that it starts with anyway.
std::string oneLine(std::string text, const std::string& path);

} // namespace dgtk

#endif
