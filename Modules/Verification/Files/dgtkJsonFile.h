// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkJsonFile_h
#define dgtkJsonFile_h

// Private to Verification; for sources only, nlohmann's header is heavy.

#include "dgtkError.h"
#include "dgtkFile.h"

#include <nlohmann/json.hpp>

#include <string>

namespace dgtk
{

/// Runs what takes a document apart; a missing key or a wrong type is an InputError of the file.
template <typename Body>
auto useJson(const std::string& path, const Body& body)
{
  try
  {
    return body();
  }
  catch (const nlohmann::json::exception& error)
  {
    throw InputError(path, 0, std::string("cannot be used: ") + error.what());
  }
}

inline nlohmann::json readJsonFile(const std::string& path)
{
  return useJson(path, [&] { return nlohmann::json::parse(readFile(path)); });
}

} // namespace dgtk

#endif
