// SPDX-License-Identifier: BSD-3-Clause
// What tests of views ask of VTK's renderers.
#ifndef dgtkViewChecks_h
#define dgtkViewChecks_h

#include <Eigen/Core>
#include <gtest/gtest.h>

#include <vtkActor.h>
#include <vtkActorCollection.h>
#include <vtkRenderer.h>

#include <vector>

namespace dgtk::test
{

/// Colours and places that VTK has in double precision.
constexpr double viewTolerance = 1e-12;

inline std::vector<vtkActor*> actorsOf(vtkRenderer* renderer)
{
  std::vector<vtkActor*> actors;
  vtkActorCollection* const all = renderer->GetActors();
  all->InitTraversal();
  while (vtkActor* const actor = all->GetNextActor())
  {
    actors.push_back(actor);
  }
  return actors;
}

inline void expectVector(const double* found, const Eigen::Vector3d& expected, const char* what = "")
{
  EXPECT_LT((Eigen::Vector3d(found[0], found[1], found[2]) - expected).norm(), viewTolerance)
    << what << ": " << found[0] << ' ' << found[1] << ' ' << found[2];
}

} // namespace dgtk::test

#endif
