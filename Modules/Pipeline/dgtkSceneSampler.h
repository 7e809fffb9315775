// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class dgtkSceneSampler
 * @brief Plain scenes of one with random values.
 *
 * Methods that can fail return false and leave a line in GetErrorMessage().
 */
#ifndef dgtkSceneSampler_h
#define dgtkSceneSampler_h

#include "dgtkPipelineModule.h"
#include "vtkObject.h"

#include <memory> // private state
#include <string> // texts

class DGTKPIPELINE_EXPORT dgtkSceneSampler : public vtkObject
{
public:
  static dgtkSceneSampler* New();
  vtkTypeMacro(dgtkSceneSampler, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The random scene: a .json file, or such a text, whose relative paths start in `folder`.
   */
  bool Load(const std::string& path);
  bool LoadText(const std::string& json, const std::string& folder);
  ///@}

  /**
   * The seed of the draws, from 0 to 2^53 - 1, in place of the scene's; -1: the scene's.
   */
  vtkSetMacro(Seed, long long);
  vtkGetMacro(Seed, long long);

  /**
   * Draws a sample, numbered from 0 to 999999. GetDescription() then is its .json text; its relative paths start in
   * `folder`.
   */
  bool Draw(int sample, const std::string& folder);
  std::string GetDescription() const;

  /**
   * Of the sample that was drawn last: the objects and cameras that it has not, since their rules could not be kept; a
   * line each, of the rule's path and why.
   */
  std::string GetLeftOut() const;

  ///@{
  /**
   * What went wrong last, as of dgtkScene.
   */
  std::string GetErrorMessage() const;
  int GetErrorCode() const;
  ///@}

  /**
   * A uniform in [0, 1): a function of seed, sample, path and draw alone, the one that a random value at that path of a
   * scene begins with.
   */
  static double Uniform(long long seed, long long sample, const std::string& path, int draw);

protected:
  dgtkSceneSampler();
  ~dgtkSceneSampler() override;

private:
  dgtkSceneSampler(const dgtkSceneSampler&) = delete;
  void operator=(const dgtkSceneSampler&) = delete;

  long long Seed = -1;
  struct Internal;
  std::unique_ptr<Internal> Self;
};

#endif
