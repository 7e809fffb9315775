// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkJsonFile_h
#define dgtkJsonFile_h

// Private to Verification; for sources only, nlohmann's header is heavy.

#include "dgtkError.h"
#include "dgtkFile.h"
#include "dgtkJsonFault.h"

#include <nlohmann/json.hpp>

#include <stdexcept>
#include <string>
#include <vector>

namespace dgtk
{

/// Runs what takes a document apart; a missing key, a list too short or a wrong type is an InputError of the file.
template <typename Body>
auto useJson(const std::string& path, const Body& body)
{
  try
  {
    return body();
  }
  catch (const nlohmann::json::exception& error)
  {
    throw jsonFault(path, 0, error.what());
  }
  catch (const std::out_of_range&)
  {
    throw InputError(path, "cannot be used: a list is too short or too long, or it names something that is not there");
  }
}

inline nlohmann::json readJsonFile(const std::string& path)
{
  const std::string text = readFile(path);
  if (text.find('\0') != std::string::npos)
  {
    throw InputError(path, "cannot be used: it has a character 0, which ends a text");
  }
  return useJson(path, [&] { return nlohmann::json::parse(text); });
}

/// The size of a list, which has to be this; used within useJson().
inline std::size_t requireSize(const nlohmann::json& list, std::size_t size)
{
  if (!list.is_array() || list.size() != size)
  {
    throw std::out_of_range("a list of another length");
  }
  return size;
}

/// A list of so many numbers; used within useJson().
inline std::vector<double> numberList(const nlohmann::json& list, std::size_t count)
{
  requireSize(list, count);
  return list;
}

} // namespace dgtk

#endif
