// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkPartMapper_h
#define dgtkPartMapper_h

#include "dgtkMaterialMaps.h"
#include "dgtkRasterLights.h"
#include "dgtkRasterShaders.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <unordered_map>
#include <vector>
#include <vtkOpenGLActor.h>
#include <vtkOpenGLPolyDataMapper.h>
#include <vtk_glew.h>

namespace dgtk
{

/// Texture units; VTK hands out those from 0.
struct RasterUnits
{
  static constexpr int maps = 4; ///< and the four after it
  static constexpr int radiance = 9;
  static constexpr int reflectance = 10;
  static constexpr int shadowMaps = 11;
  static constexpr int shadowData = 12;
  static constexpr int background = 13;
  static constexpr int layer = 14;
  static constexpr int lights = 15;
};

/// Keeps the vertex stage of software OpenGL from running away from its fragment stage: it keeps some 250 bytes for
/// each triangle between them, half a gigabyte for a picture of two million.
class DrawPacer
{
public:
  /// After a draw of so many triangles. Waits until not too many are on the way.
  void drew(std::size_t triangles);

private:
  std::size_t Since = 0; ///< triangles since the last fence
  std::deque<GLsync> Fences;
};

/// What all draws of a frame share.
struct RasterFrame
{
  DrawPacer pacer;
  RasterLights lights;
  std::uint64_t lightsVersion = 1; ///< changes with `lights`
  bool parallel = false;
  bool peel = false;
  bool collect = false;
  // Light beyond VTK's model; matrices by columns.
  bool shadows = false;
  bool environment = false;
  bool fog = false;
  std::array<float, 3> fogColor{};
  std::array<float, 2> fogDensity{}; ///< density and start
  std::array<float, 9> worldFromView{};
  std::array<float, 9> imageFromView{};
  std::array<float, 27> irradiance{};
  int lightsUnit = 0; ///< texture unit of the buffer texture with the lights
  int layerUnit = 0;  ///< texture unit of the layer before, when peeling
  int maxUniformLights = uniformLights;
  std::unordered_map<vtkShaderProgram*, std::uint64_t> uploaded; ///< version of the lights that a program has
};

/// An instance's part, with the matrices of the current frame as OpenGL takes them (by columns).
class PartActor : public vtkOpenGLActor
{
public:
  static PartActor* New();
  vtkTypeMacro(PartActor, vtkOpenGLActor);

  std::array<float, 16> clip_from_object{};
  std::array<float, 16> view_from_object{};
  std::array<float, 9> normal_view_from_object{};
  std::array<float, 3> emission{};
  const SurfaceParameters* surface = nullptr;
  /// The triangles to draw: first and count; everything when empty and not `nothing`.
  std::vector<std::pair<std::uint32_t, std::uint32_t>> runs;
  bool nothing = false;
  float number = 0; ///< of the draw, from 1
  bool mirrored = false;

protected:
  PartActor() = default;
};

/// VTK's mapper for triangles of one material. Differences to VTK's: triangles without area keep their place, lights
/// and ids are ours, and the shader is rebuilt only when it must be.
class PartMapper : public vtkOpenGLPolyDataMapper
{
public:
  static PartMapper* New();
  vtkTypeMacro(PartMapper, vtkOpenGLPolyDataMapper);

  /// `indices`: three per triangle, into the points of the input. A triangle's number is that of its last vertex, from
  /// `firstTriangle`.
  void configure(
    RasterFrame* frame, const ShaderVariant& material, int firstTriangle, std::vector<unsigned int> indices);
  int firstTriangle() const { return this->FirstTriangle; }
  /// Other indices, for pieces.
  void setIndices(std::vector<unsigned int> indices);
  const ShaderVariant& material() const { return this->Material; }

  /// Uploads what is not in OpenGL's memory yet.
  void prepare(vtkRenderer* renderer, vtkActor* actor);
  /// Binds vertices (attribute 0, and texture coordinates as attribute 1 for cut-outs, the triangle's number as
  /// attribute 2 for pieces) and indices to the bound vertex array, and draws. prepare() comes before.
  void drawBare(const PartActor& actor);

protected:
  PartMapper();
  void RenderPieceDraw(vtkRenderer* renderer, vtkActor* actor) override;
  void BuildIBO(vtkRenderer* renderer, vtkActor* actor, vtkPolyData* poly) override;
  bool GetNeedToRebuildShaders(vtkOpenGLHelper& cell, vtkRenderer* renderer, vtkActor* actor) override;
  void ReplaceShaderValues(
    std::map<vtkShader::Type, vtkShader*> shaders, vtkRenderer* renderer, vtkActor* actor) override;
  void SetCameraShaderParameters(vtkOpenGLHelper& cell, vtkRenderer* renderer, vtkActor* actor) override;
  void SetPropertyShaderParameters(vtkOpenGLHelper& cell, vtkRenderer* renderer, vtkActor* actor) override;
  void SetLightingShaderParameters(vtkOpenGLHelper& cell, vtkRenderer* renderer, vtkActor* actor) override;

private:
  void drawElements(const PartActor& actor);
  void bindAttribute(const char* name, unsigned int location);
  ShaderVariant currentVariant() const;
  void setSurface(vtkShaderProgram& program, const SurfaceParameters& surface) const;
  void setEnvironment(vtkShaderProgram& program) const;

  RasterFrame* Frame = nullptr;
  bool Preparing = false;
  int FirstTriangle = 0;
  ShaderVariant Material;
  ShaderVariant Built;
  std::vector<unsigned int> Indices; // until they are uploaded
};

} // namespace dgtk

#endif
