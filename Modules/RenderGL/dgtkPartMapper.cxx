// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkPartMapper.h"

#include <vtkObjectFactory.h>
#include <vtkOpenGLHelper.h>
#include <vtkOpenGLIndexBufferObject.h>
#include <vtkOpenGLRenderWindow.h>
#include <vtkOpenGLState.h>
#include <vtkOpenGLVertexBufferObject.h>
#include <vtkOpenGLVertexBufferObjectGroup.h>
#include <vtkPolyData.h>
#include <vtkRenderer.h>
#include <vtkShader.h>
#include <vtkShaderProgram.h>
#include <vtk_glew.h>

namespace dgtk
{

namespace
{
constexpr std::size_t trianglesBetweenFences = 100'000;
constexpr std::size_t mostFences = 2;
constexpr GLuint64 longestWait = 1'000'000'000; // nanoseconds; it costs memory alone when that was not enough
} // namespace

vtkStandardNewMacro(PartActor);
vtkStandardNewMacro(PartMapper);

void DrawPacer::drew(std::size_t triangles)
{
  this->Since += triangles;
  if (this->Since < trianglesBetweenFences)
  {
    return;
  }
  this->Since = 0;
  this->Fences.push_back(glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0));
  if (this->Fences.size() > mostFences)
  {
    glClientWaitSync(this->Fences.front(), GL_SYNC_FLUSH_COMMANDS_BIT, longestWait);
    glDeleteSync(this->Fences.front());
    this->Fences.pop_front();
  }
}

PartMapper::PartMapper()
{
  this->SetStatic(1); // the input is data, not a pipeline
  this->ScalarVisibilityOff();
  this->SetVBOShiftScaleMethod(vtkOpenGLVertexBufferObject::DISABLE_SHIFT_SCALE);
}

void PartMapper::configure(
  RasterFrame* frame, const ShaderVariant& material, int firstTriangle, std::vector<unsigned int> indices)
{
  this->FirstTriangle = firstTriangle;
  this->Frame = frame;
  this->Material = material;
  this->SetScalarVisibility(material.colored);
  this->Indices = std::move(indices);
}

void PartMapper::setIndices(std::vector<unsigned int> indices) { this->Indices = std::move(indices); }

void PartMapper::prepare(vtkRenderer* renderer, vtkActor* actor)
{
  this->Preparing = true;
  this->RenderPiece(renderer, actor);
  this->Preparing = false;
}

void PartMapper::RenderPieceDraw(vtkRenderer* renderer, vtkActor* actor)
{
  vtkOpenGLHelper& triangles = this->Primitives[PrimitiveTris];
  if (this->Preparing || triangles.IBO->IndexCount == 0)
  {
    return;
  }
  this->DrawingVertices = false;
  this->DrawingSelection = false;
  this->UpdateShaders(triangles, renderer, actor);
  triangles.IBO->Bind();
  this->drawElements(*static_cast<PartActor*>(actor));
  triangles.IBO->Release();
}

void PartMapper::BuildIBO(vtkRenderer*, vtkActor*, vtkPolyData*)
{
  if (this->Indices.empty())
  {
    return;
  }
  vtkOpenGLIndexBufferObject* buffer = this->Primitives[PrimitiveTris].IBO;
  buffer->Upload(this->Indices, vtkOpenGLBufferObject::ElementArrayBuffer);
  buffer->IndexCount = this->Indices.size();
  std::vector<unsigned int>().swap(this->Indices);
}

void PartMapper::bindAttribute(const char* name, unsigned int location)
{
  vtkOpenGLVertexBufferObject* buffer = this->VBOs->GetVBO(name);
  glBindBuffer(GL_ARRAY_BUFFER, GLuint(buffer->GetHandle()));
  glEnableVertexAttribArray(location);
  const GLint components = this->VBOs->GetNumberOfComponents(name);
  glVertexAttribPointer(
    location, components, GL_FLOAT, GL_FALSE, GLsizei(std::size_t(components) * sizeof(float)), nullptr);
}

void PartMapper::drawBare(const PartActor& actor)
{
  vtkOpenGLIndexBufferObject* indices = this->Primitives[PrimitiveTris].IBO;
  this->bindAttribute("vertexMC", 0);
  if (this->Material.cutOut)
  {
    this->bindAttribute("tcoord", 1);
  }
  if (this->Material.pieces)
  {
    this->bindAttribute("dgtkTriangle", 2);
  }
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, GLuint(indices->GetHandle()));
  this->drawElements(actor);
}

void PartMapper::drawElements(const PartActor& actor)
{
  const auto last = GLuint(this->VBOs->GetNumberOfTuples("vertexMC") - 1);
  if (actor.runs.empty())
  {
    glDrawRangeElements(
      GL_TRIANGLES, 0, last, GLsizei(this->Primitives[PrimitiveTris].IBO->IndexCount), GL_UNSIGNED_INT, nullptr);
    this->Frame->pacer.drew(this->Primitives[PrimitiveTris].IBO->IndexCount / 3);
  }
  for (const auto& run : actor.runs)
  {
    const std::uintptr_t offset = std::uintptr_t(run.first) * 3 * sizeof(unsigned int);
    const void* const place = reinterpret_cast<const void*>(offset); // NOLINT(performance-no-int-to-ptr): OpenGL's way
    glDrawRangeElements(GL_TRIANGLES, 0, last, GLsizei(run.second * 3), GL_UNSIGNED_INT, place);
    this->Frame->pacer.drew(run.second);
  }
}

ShaderVariant PartMapper::currentVariant() const
{
  ShaderVariant variant = this->Material;
  variant.lights = this->Frame->lights.counts;
  variant.headOnly = this->Frame->lights.headOnly;
  variant.lightTexture = this->Frame->lights.count() > this->Frame->maxUniformLights;
  variant.peel = this->Frame->peel;
  variant.collect = this->Frame->collect;
  variant.shadows = this->Frame->shadows;
  variant.fog = this->Frame->fog;
  variant.environment = this->Frame->environment;
  variant.physical = this->Material.physical || this->Frame->environment;
  variant.metallicRoughnessMap = variant.physical && variant.metallicRoughnessMap;
  variant.occlusionMap = variant.physical && variant.occlusionMap;
  return variant;
}

bool PartMapper::GetNeedToRebuildShaders(vtkOpenGLHelper& cell, vtkRenderer* renderer, vtkActor* actor)
{
  const ShaderVariant wanted = this->currentVariant();
  const bool changed = !(wanted == this->Built);
  this->Built = wanted;
  return this->Superclass::GetNeedToRebuildShaders(cell, renderer, actor) || changed;
}

void PartMapper::ReplaceShaderValues(
  std::map<vtkShader::Type, vtkShader*> shaders, vtkRenderer* renderer, vtkActor* actor)
{
  std::string vertex = shaders[vtkShader::Vertex]->GetSource();
  std::string fragment = shaders[vtkShader::Fragment]->GetSource();
  substituteColor(this->Built, vertex, fragment);
  shaders[vtkShader::Vertex]->SetSource(vertex);
  shaders[vtkShader::Fragment]->SetSource(fragment);
  this->Superclass::ReplaceShaderValues(shaders, renderer, actor);
}

void PartMapper::SetCameraShaderParameters(vtkOpenGLHelper& cell, vtkRenderer*, vtkActor* actor)
{
  auto* part = static_cast<PartActor*>(actor);
  cell.Program->SetUniformMatrix4x4("MCDCMatrix", part->clip_from_object.data());
  cell.Program->SetUniformMatrix4x4("MCVCMatrix", part->view_from_object.data());
  cell.Program->SetUniformMatrix3x3("normalMatrix", part->normal_view_from_object.data());
  cell.Program->SetUniformi("cameraParallel", this->Frame->parallel ? 1 : 0);
  const float draw[2] = { part->number, part->mirrored ? 1.0f : 0.0f };
  cell.Program->SetUniform2f("dgtkDraw", draw);
  if (!this->Built.pieces)
  {
    cell.Program->SetUniformi("dgtkFirstTriangle", this->FirstTriangle);
  }
  if (this->Built.peel)
  {
    cell.Program->SetUniformi("dgtkLayer", this->Frame->layerUnit);
  }
}

void PartMapper::SetPropertyShaderParameters(vtkOpenGLHelper& cell, vtkRenderer* renderer, vtkActor* actor)
{
  this->Superclass::SetPropertyShaderParameters(cell, renderer, actor);
  const auto* part = static_cast<PartActor*>(actor);
  cell.Program->SetUniform3f("dgtkEmission", part->emission.data());
  if (part->surface && (this->Built.physical || part->surface->hasMaps()))
  {
    this->setSurface(*cell.Program, *part->surface);
    static_cast<vtkOpenGLRenderWindow*>(renderer->GetRenderWindow())->GetState()->ResetGLActiveTexture();
  }
}

/// Textures that the program does not read are bound without harm.
void PartMapper::setSurface(vtkShaderProgram& program, const SurfaceParameters& surface) const
{
  const auto bind = [&program](bool used, const char* name, unsigned int texture, int unit)
  {
    if (used)
    {
      glActiveTexture(GLenum(GL_TEXTURE0 + unit));
      glBindTexture(GL_TEXTURE_2D, texture);
      program.SetUniformi(name, unit);
    }
  };
  bind(this->Built.normalMap, "dgtkNormalMap", surface.normalMap, RasterUnits::maps);
  bind(this->Built.bumpMap, "dgtkBumpMap", surface.bumpMap, RasterUnits::maps + 1);
  bind(this->Built.metallicRoughnessMap, "dgtkMetalRoughMap", surface.metallicRoughnessMap, RasterUnits::maps + 2);
  bind(this->Built.emissionMap, "dgtkEmissionMap", surface.emissionMap, RasterUnits::maps + 3);
  bind(this->Built.occlusionMap, "dgtkOcclusionMap", surface.occlusionMap, RasterUnits::maps + 4);
  if (this->Built.normalMap)
  {
    program.SetUniformf("dgtkNormalScale", surface.normalScale);
  }
  if (this->Built.bumpMap)
  {
    program.SetUniformf("dgtkBumpScale", surface.bumpScale);
  }
  if (this->Built.occlusionMap)
  {
    program.SetUniformf("dgtkOcclusionStrength", surface.occlusionStrength);
  }
  if (this->Built.physical)
  {
    program.SetUniform2f("dgtkMetalRough", surface.metalRough.data());
    program.SetUniform3f("dgtkF0", surface.f0.data());
  }
}

void PartMapper::setEnvironment(vtkShaderProgram& program) const
{
  RasterFrame& frame = *this->Frame;
  if (this->Built.shadows)
  {
    program.SetUniformi("dgtkShadowMaps", RasterUnits::shadowMaps);
    program.SetUniformi("dgtkShadowData", RasterUnits::shadowData);
    program.SetUniformMatrix3x3("dgtkWorldFromView", frame.worldFromView.data());
  }
  if (this->Built.environment)
  {
    program.SetUniformi("dgtkEnvironment", RasterUnits::radiance);
    program.SetUniformi("dgtkReflectance", RasterUnits::reflectance);
    program.SetUniformMatrix3x3("dgtkImageFromView", frame.imageFromView.data());
    program.SetUniform3fv("dgtkIrradiance", 9, reinterpret_cast<const float(*)[3]>(frame.irradiance.data()));
  }
  if (this->Built.fog)
  {
    program.SetUniform3f("dgtkFog", frame.fogColor.data());
    program.SetUniform2f("dgtkFogDensity", frame.fogDensity.data());
  }
}

void PartMapper::SetLightingShaderParameters(vtkOpenGLHelper& cell, vtkRenderer*, vtkActor*)
{
  std::uint64_t& has = this->Frame->uploaded[cell.Program];
  if (has == this->Frame->lightsVersion)
  {
    return;
  }
  has = this->Frame->lightsVersion;
  this->setEnvironment(*cell.Program);
  if (this->Frame->lights.count() == 0)
  {
    return;
  }
  if (this->Built.lightTexture)
  {
    cell.Program->SetUniformi("dgtkLights", this->Frame->lightsUnit);
    return;
  }
  const auto& values = this->Frame->lights.values;
  cell.Program->SetUniform4fv("dgtkLights", int(values.size()), reinterpret_cast<const float(*)[4]>(values.data()));
}

} // namespace dgtk
