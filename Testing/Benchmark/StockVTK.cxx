// SPDX-License-Identifier: BSD-3-Clause
#include "StockVTK.h"

#include "dgtkError.h"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkHardwareSelector.h>
#include <vtkImageData.h>
#include <vtkLight.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkOpenGLRenderWindow.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkTexture.h>
#include <vtkWindowToImageFilter.h>
#include <vtk_glew.h>

#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <algorithm>
#include <cmath>
#include <map>

#include <vtkAutoInit.h>
VTK_MODULE_INIT(vtkRenderingOpenGL2);

namespace dgtk::bench
{

namespace
{
class EglWindow : public vtkGenericOpenGLRenderWindow
{
public:
  static EglWindow* New();
  vtkTypeMacro(EglWindow, vtkGenericOpenGLRenderWindow);
  void MakeCurrent() override {} // the context stays current
  bool IsCurrent() override { return true; }
  int SupportsOpenGL() override { return 1; }
  int GetColorBufferSizes(int* rgba) override
  {
    std::fill_n(rgba, 4, 8);
    return 32;
  }
  void OpenGLInitContext() override
  {
    this->ContextCreationTime.Modified();
    if (!this->Initialized)
    {
      constexpr unsigned int noGlxDisplay = 4;
      glewExperimental = GL_TRUE;
      const unsigned int result = glewInit();
      this->GlewInitValid = (result == GLEW_OK || result == noGlxDisplay) && GLEW_VERSION_3_2;
      this->Initialized = this->GlewInitValid;
    }
  }
  void WaitForCompletion() override { glFinish(); }
};
vtkStandardNewMacro(EglWindow);

void makeEglContextCurrent()
{
  EGLDisplay display = eglGetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
  const EGLint wanted[] = { EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_NONE };
  const EGLint version[] = { EGL_CONTEXT_MAJOR_VERSION, 3, EGL_CONTEXT_MINOR_VERSION, 2,
    EGL_CONTEXT_OPENGL_PROFILE_MASK, EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE };
  EGLConfig config = nullptr;
  EGLint count = 0;
  if (!eglInitialize(display, nullptr, nullptr) || !eglBindAPI(EGL_OPENGL_API) ||
      !eglChooseConfig(display, wanted, &config, 1, &count) || count == 0 ||
      !eglMakeCurrent(
        display, EGL_NO_SURFACE, EGL_NO_SURFACE, eglCreateContext(display, config, EGL_NO_CONTEXT, version)))
  {
    throw MachineError("no EGL context for the reference");
  }
}

vtkSmartPointer<vtkPolyData> polyDataOf(const Model& model, const Part& part)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToFloat();
  vtkNew<vtkFloatArray> normals;
  normals->SetNumberOfComponents(3);
  vtkNew<vtkFloatArray> uvs;
  uvs->SetNumberOfComponents(2);
  for (std::size_t i = 0; i < model.rest->positions.size(); ++i)
  {
    points->InsertNextPoint(model.rest->positions[i].data());
    normals->InsertNextTuple(model.rest->normals[i].data());
    if (!model.uvs.empty())
    {
      uvs->InsertNextTuple(model.uvs[i].data());
    }
  }
  vtkNew<vtkCellArray> cells;
  for (std::uint32_t t = part.firstTriangle; t < part.firstTriangle + part.triangles; ++t)
  {
    const vtkIdType ids[3] = { model.triangles[t][0], model.triangles[t][1], model.triangles[t][2] };
    cells->InsertNextCell(3, ids);
  }
  auto poly = vtkSmartPointer<vtkPolyData>::New();
  poly->SetPoints(points);
  poly->SetPolys(cells);
  poly->GetPointData()->SetNormals(normals);
  if (!model.uvs.empty())
  {
    poly->GetPointData()->SetTCoords(uvs);
  }
  return poly;
}

vtkSmartPointer<vtkTexture> textureOf(const Image& image)
{
  vtkNew<vtkImageData> data;
  data->SetDimensions(image.width, image.height, 1);
  data->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  auto* to = static_cast<unsigned char*>(data->GetScalarPointer());
  for (int y = 0; y < image.height; ++y)
  {
    for (int x = 0; x < image.width; ++x)
    {
      const std::uint8_t* from = &image.rgba[4 * (std::size_t(image.height - 1 - y) * image.width + x)];
      *to++ = from[0];
      *to++ = from[1];
      *to++ = from[2];
    }
  }
  auto texture = vtkSmartPointer<vtkTexture>::New();
  texture->SetInputData(data);
  texture->InterpolateOn();
  texture->MipmapOn();
  texture->RepeatOn();
  return texture;
}
} // namespace

struct StockVTK::Impl
{
  vtkSmartPointer<EglWindow> window;
  vtkNew<vtkRenderer> renderer;
  std::map<vtkProp*, unsigned int> ids;
  int width = 0;
  int height = 0;
};

StockVTK::StockVTK(const SceneState& state, int width, int height)
  : Self(new Impl)
{
  makeEglContextCurrent();
  this->Self->width = width;
  this->Self->height = height;
  this->Self->window = vtkSmartPointer<EglWindow>::New();
  this->Self->window->SetReadyForRendering(true);
  this->Self->window->SetOffScreenRendering(true);
  this->Self->window->SetMultiSamples(0);
  this->Self->window->SetSize(width, height);
  this->Self->window->OpenGLInit();
  this->Self->window->AddRenderer(this->Self->renderer);
  std::map<const Part*, vtkSmartPointer<vtkPolyDataMapper>> mappers;
  std::map<const Image*, vtkSmartPointer<vtkTexture>> textures;
  for (std::size_t i = 0; i < state.instances.size(); ++i)
  {
    const Instance& instance = state.instances[i];
    vtkNew<vtkMatrix4x4> matrix;
    for (int r = 0; r < 3; ++r)
    {
      for (int c = 0; c < 3; ++c)
      {
        matrix->SetElement(r, c, instance.world_from_object.linear(r, c));
      }
      matrix->SetElement(r, 3, instance.world_from_object.translation(r));
    }
    for (const Part& part : instance.model->parts)
    {
      vtkSmartPointer<vtkPolyDataMapper>& mapper = mappers[&part];
      if (!mapper)
      {
        mapper = vtkSmartPointer<vtkPolyDataMapper>::New();
        mapper->SetInputData(polyDataOf(*instance.model, part));
      }
      vtkNew<vtkActor> actor;
      actor->SetMapper(mapper);
      actor->SetUserMatrix(matrix);
      const Material& material = (*instance.materials)[part.material];
      actor->GetProperty()->SetDiffuseColor(material.diffuse.data());
      actor->GetProperty()->SetAmbientColor(material.ambient.data());
      actor->GetProperty()->SetSpecularColor(material.specular.data());
      if (material.texture >= 0 && instance.model->textures[material.texture].image)
      {
        const Image* image = instance.model->textures[material.texture].image.get();
        vtkSmartPointer<vtkTexture>& texture = textures[image];
        texture = texture ? texture : textureOf(*image);
        actor->SetTexture(texture);
      }
      this->Self->renderer->AddActor(actor);
      this->Self->ids[actor] = static_cast<unsigned int>(i + 1);
    }
  }
  this->Self->renderer->SetAutomaticLightCreation(false);
  for (const LightState& state_ : state.lights)
  {
    vtkNew<vtkLight> light;
    light->SetDiffuseColor(state_.diffuse.data());
    light->SetPositional(state_.kind != LightKind::Directional && state_.kind != LightKind::Head);
    light->SetPosition(state_.position.data());
    light->SetFocalPoint(state_.target.data());
    if (state_.kind == LightKind::Head)
    {
      light->SetLightTypeToHeadlight();
    }
    this->Self->renderer->AddLight(light);
  }
}

StockVTK::~StockVTK() = default;

void StockVTK::render(const View& view)
{
  vtkCamera* camera = this->Self->renderer->GetActiveCamera();
  const Rigid3 world_from_camera = view.camera_from_world.inverse();
  const Eigen::Vector3d eye = world_from_camera.translation;
  const Eigen::Vector3d at = world_from_camera * Eigen::Vector3d(0, 0, 1);
  const Eigen::Vector3d up = world_from_camera.rotation * Eigen::Vector3d(0, -1, 0);
  camera->SetPosition(eye.data());
  camera->SetFocalPoint(at.data());
  camera->SetViewUp(up.data());
  const double fy = view.model->linear()->K(1, 1);
  camera->SetViewAngle(2 * std::atan(this->Self->height / (2 * fy)) * 180 / 3.14159265358979323846);
  camera->SetClippingRange(view.near, view.far);
  this->Self->window->Render();
  this->Self->window->WaitForCompletion();
}

void StockVTK::capture(const View& view, Truth& truth)
{
  const int width = this->Self->width;
  const int height = this->Self->height;
  vtkNew<vtkWindowToImageFilter> filter;
  filter->SetInput(this->Self->window);
  filter->ReadFrontBufferOff();
  filter->ShouldRerenderOff();
  filter->Update();
  const auto* rgb = static_cast<unsigned char*>(filter->GetOutput()->GetScalarPointer());
  truth.rgb.assign(rgb, rgb + std::size_t(width) * height * 3);
  vtkNew<vtkFloatArray> z;
  this->Self->window->GetZbufferData(0, 0, width - 1, height - 1, z);
  truth.depth.resize(std::size_t(width) * height);
  for (std::size_t i = 0; i < truth.depth.size(); ++i)
  {
    const double n = view.near;
    const double f = view.far;
    const double ndc = 2.0 * z->GetValue(static_cast<vtkIdType>(i)) - 1;
    truth.depth[i] = ndc >= 1 ? INFINITY : 2 * n * f / (f + n - ndc * (f - n));
  }
  vtkNew<vtkHardwareSelector> selector;
  selector->SetRenderer(this->Self->renderer);
  selector->SetArea(0, 0, static_cast<unsigned int>(width - 1), static_cast<unsigned int>(height - 1));
  selector->SetFieldAssociation(vtkDataObject::FIELD_ASSOCIATION_CELLS);
  selector->CaptureBuffers();
  truth.object.assign(std::size_t(width) * height, 0);
  truth.triangle.assign(std::size_t(width) * height, 0);
  for (int y = 0; y < height; ++y)
  {
    for (int x = 0; x < width; ++x)
    {
      const unsigned int at[2] = { static_cast<unsigned int>(x), static_cast<unsigned int>(y) };
      const vtkHardwareSelector::PixelInformation info = selector->GetPixelInformation(at);
      if (info.Valid)
      {
        truth.object[std::size_t(y) * width + x] = this->Self->ids[info.Prop];
        truth.triangle[std::size_t(y) * width + x] = static_cast<unsigned int>(info.AttributeID);
      }
    }
  }
}

} // namespace dgtk::bench
