// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkSceneRandom_h
#define dgtkSceneRandom_h

#include "dgtkSceneModule.h"

#include "dgtkJson.h"
#include "dgtkSceneDescription.h"

#include <optional>
#include <string>
#include <vector>

namespace dgtk
{

/// The words by which a .json scene says that a value is random: "uniform", "choice" ...
DGTKSCENE_EXPORT const std::vector<std::string>& randomWords();

/// The word of an object that stands for a random value; "" for any other node. `key`: what it is the value of.
DGTKSCENE_EXPORT std::string randomWordOf(const std::string& key, const JsonNode& node);

/// Keys of a random scene, of an object and of a camera that a plain scene does not have.
DGTKSCENE_EXPORT const std::vector<std::string>& randomSceneKeys();
DGTKSCENE_EXPORT const std::vector<std::string>& randomObjectKeys();
DGTKSCENE_EXPORT const std::vector<std::string>& randomCameraKeys();

/// The first place of a document that makes it a random scene; none: it is a plain one.
DGTKSCENE_EXPORT std::optional<JsonCursor> firstRandom(const JsonDocument& document);

/// readScene() of a tree: errors name the document's file and the lines that its nodes know.
DGTKSCENE_EXPORT SceneDescription readSceneTree(
  const JsonDocument& document, const std::string& file, const std::string& folder);

} // namespace dgtk

#endif
