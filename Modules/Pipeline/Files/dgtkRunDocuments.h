// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkRunDocuments_h
#define dgtkRunDocuments_h

// Private to Pipeline.

#include "dgtkPacking.h"
#include "dgtkRunFiles.h"
#include "dgtkWorkPlan.h"
#include "dgtkWrittenModels.h"

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace dgtk
{

/// The files of a picture, but those that layers share.
std::vector<std::string> filesOf(const WorkPlan& plan, const Stage& stage, const Job& job);

/// What a run writes beside its pictures: copies of its inputs, the dataset's documents, the manifest.
class RunDocuments
{
public:
  /// Reads the inputs. `home` is the dataset's folder; a part of a run is written into another one, and only the
  /// first part (see partName()) has documents, which are those of the whole, copies of inputs and models. Throws
  /// UsageError where the run would write its inputs. `classNumbers` are those that the request gives to the scene, see
  /// requestOf().
  RunDocuments(const Stage& stage, const WorkPlan& plan, const std::string& home, const std::string& folder,
    RunSession& session, const std::string& classNumbers);

  const std::string& requestHash() const { return this->RequestHash; }
  /// Every file that the run writes, but those that layers share.
  std::vector<std::string> allNames() const;
  /// Whether files are recorded as those of the layer, camera and frame that they are of.
  JudgeOfFiles judge() const;
  /// Puts copies of all inputs into the dataset, when they are wanted there.
  void pack(RunFiles& files);
  /// Writes the geometry of the objects' models, when it is wanted.
  void writeModels(RunFiles& files) const;
  /// Ends the run; the number of documents.
  std::size_t write(RunFiles& files, const std::vector<std::string>& warnings);

private:
  std::vector<std::string> documentNames() const;
  bool isFirst() const;
  bool wantsSheet() const;
  Manifest manifest(const std::vector<std::string>& warnings) const;
  std::map<std::string, std::string> copies() const;

  const Stage& Scene;
  const WorkPlan& Plan;
  std::string Home;
  std::string Root;
  std::string ClassNumbers;
  std::vector<InputRecord> Inputs;
  std::string RequestHash;
  std::optional<Packing> Packed;
  std::vector<std::string> Geometry; ///< hashes by object id - 1
  std::optional<WrittenModels> Models;
};

} // namespace dgtk

#endif
