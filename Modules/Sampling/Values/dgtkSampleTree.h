// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkSampleTree_h
#define dgtkSampleTree_h

#include "dgtkDistributions.h"
#include "dgtkJson.h"
#include "dgtkSceneDescription.h"

#include <functional>
#include <set>
#include <string>
#include <vector>

namespace dgtk::sampletree
{

/// The items of a list of the root ("objects"); none: there is no such list.
std::vector<JsonNode>& itemsOf(JsonNode& root, const std::string& list);
/// Replaces the value of a key, or adds it.
void setMember(JsonNode& object, const std::string& key, JsonNode value);
void removeMember(JsonNode& object, const std::string& key);
/// JSON on one line.
std::string textOf(const JsonNode& node);
JsonNode keysNode(const std::vector<Key<Eigen::Vector3d>>& keys);

bool isAmong(const std::string& word, const std::vector<std::string>& words);
/// A name as part of a path, as JSON pointers have it.
std::string escaped(const std::string& name);

/// Whether geometry decides a point in it.
bool hasGeometry(const JsonNode& node);
/// Calls `visit` for each point that geometry decides, with its key path below the node ("position"); what it returns
/// true for is replaced by the point that it sets.
using PointVisitor = std::function<bool(const JsonNode& node, const std::string& path, Eigen::Vector3d& x)>;
void replacePoints(JsonNode& node, const std::string& path, const PointVisitor& visit);
/// Names of objects that are given where a camera looks and where a light shines become their centres.
void aimAtNames(JsonNode& item, const std::string& key);
/// The same of the points of a camera's path.
void aimPathAtNames(JsonNode& path);

/// A scene of the objects alone; what is not decided yet is at (1, 1, 1).
JsonNode objectsAlone(const JsonNode& root);
/// Takes items, by index, out of a list of the tree ("objects").
void removeItems(JsonNode& root, const std::string& list, const std::set<std::size_t>& out);
/// Takes their words ("object") out of `order`.
void removeWords(JsonNode& root, const std::string& word, const std::set<std::size_t>& out);
/// `objects` and all that hang on them.
std::set<std::size_t> withChildren(const SceneDescription& scene, const std::set<std::size_t>& objects);

} // namespace dgtk::sampletree

#endif
