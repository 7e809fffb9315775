// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkDatasetScenes_h
#define dgtkDatasetScenes_h

#include "dgtkDatasetView.h"

#include <memory>
#include <string>
#include <vector>

namespace dgtk
{

/// The dataset in a folder, or those of the scenes of a folder of datasets, as one export sees them.
class DatasetScenes
{
public:
  /// Throws UsageError for datasets that do not go together: of other classes or units, or with cameras of one name
  /// once they are safe.
  DatasetScenes(const std::string& folder, const DatasetSelection& selection);

  const std::vector<const DatasetView*>& views() const { return this->Pointers; }
  const DatasetView& first() const { return *this->Pointers.front(); }
  bool many() const { return this->Many; }
  /// Of the document that names all that the folder holds.
  const std::string& manifestHash() const { return this->Hash; }

private:
  void add(const std::string& folder, const DatasetSelection& selection, const SceneOfMany& scene);
  void requireAlike() const;
  bool Many;
  std::string Hash;
  std::vector<std::unique_ptr<const DatasetView>> Views;
  std::vector<const DatasetView*> Pointers;
};

} // namespace dgtk

#endif
