// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkRunFiles.h"

#include <algorithm>

namespace dgtk
{

void RunFiles::add(const DatasetFile& file)
{
  this->Log.add(file);
  this->Files.push_back(file);
}

bool RunFiles::addOnce(const DatasetFile& file)
{
  const bool isNew = this->Shared.insert(file.path).second;
  if (isNew)
  {
    this->Files.push_back(file);
  }
  return isNew;
}

void RunFiles::add(const std::vector<FinishedFile>& files, const std::string& camera, int frame)
{
  for (const FinishedFile& finished : files)
  {
    DatasetFile file{ finished.record.path, finished.record.bytes, finished.record.sha256, finished.layer, camera,
      frame };
    if (!finished.shared)
    {
      this->add(file);
      continue;
    }
    file.camera.clear();
    file.frame = -1;
    if (this->addOnce(file) && !this->Log.find(file.path))
    {
      this->Log.add(file);
    }
  }
}

bool RunFiles::has(const std::vector<std::string>& names) const
{
  return std::all_of(
    names.begin(), names.end(), [this](const std::string& name) { return this->Log.find(name).has_value(); });
}

bool RunFiles::keep(const std::vector<std::string>& own, const std::vector<std::string>& shared)
{
  if (!this->has(own) || !this->has(shared))
  {
    return false;
  }
  for (const std::string& name : own)
  {
    this->Files.push_back(*this->Log.find(name));
  }
  for (const std::string& name : shared)
  {
    this->addOnce(*this->Log.find(name));
  }
  return true;
}

} // namespace dgtk
