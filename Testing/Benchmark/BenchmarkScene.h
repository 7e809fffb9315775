// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkBenchmarkScene_h
#define dgtkBenchmarkScene_h

#include <string>

namespace dgtk::bench
{

struct SceneOptions
{
  int triangles = 200000; ///< in all objects together, about
  int objects = 50;       ///< instances of five textured bumpy spheres
  int frames = 20;        ///< camera "c" turns around the objects
  bool stereo = false;    ///< with a camera "r", at the right of "c" and rectified with it
  bool shadows = false;   ///< of the light
  bool distorted = false; ///< the cameras have radial and tangential distortion
};

/// Writes models, a texture and the scene into `folder`; returns the scene's path.
std::string writeBenchmarkScene(const std::string& folder, const SceneOptions& options);

} // namespace dgtk::bench

#endif
