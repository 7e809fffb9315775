// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkEnvironmentMap.h"

#include "dgtkError.h"
#include "dgtkPortableMath.h"
#include "dgtkSurfaceMaterial.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <string>
#include <vtk_glew.h>

namespace dgtk
{
namespace
{

constexpr const char* backgroundVertex = R"(#version 150
void main()
{
  gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.5, 1.0);
}
)";

/// After the functions of transferShader().
constexpr const char* backgroundFragment = R"(
uniform sampler2D dgtkPicture;
uniform mat3 dgtkRay; // direction in the picture's axes of window coordinates (x, y, 1)
uniform float dgtkLevel;
uniform float dgtkIntensity;
out vec4 dgtkColor;
out vec4 dgtkId;
void main()
{
  vec3 d = normalize(dgtkRay * vec3(gl_FragCoord.xy, 1.0));
  vec2 uv = vec2(0.5 + atan(d.x, -d.z) * 0.15915494309189535, acos(clamp(d.y, -1.0, 1.0)) * 0.3183098861837907);
  vec3 c = textureLod(dgtkPicture, uv, dgtkLevel).rgb * dgtkIntensity;
  dgtkColor = vec4(dgtkToDisplay(c), 1.0);
  dgtkId = vec4(0.0);
}
)";

unsigned int compiled(GLenum kind, const char* source)
{
  const unsigned int shader = glCreateShader(kind);
  glShaderSource(shader, 1, &source, nullptr);
  glCompileShader(shader);
  return shader;
}

void wrapAround(bool mipmaps)
{
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, mipmaps ? GL_LINEAR_MIPMAP_LINEAR : GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_REPEAT);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
}

void storeMatrix(const Eigen::Matrix3d& from, std::array<float, 9>& to)
{
  std::transform(from.data(), from.data() + 9, to.begin(), [](double v) { return float(v); });
}

Eigen::Matrix3d imageFromViewOf(const EnvironmentState& state, const Eigen::Matrix4d& view_from_world)
{
  return state.image_from_world * view_from_world.topLeftCorner<3, 3>().transpose();
}

} // namespace

EnvironmentMap::~EnvironmentMap()
{
  this->release();
  glDeleteProgram(this->Program);
  glDeleteVertexArrays(1, &this->VertexArray);
  glDeleteTextures(1, &this->Reflectance);
}

void EnvironmentMap::release()
{
  glDeleteTextures(1, &this->Radiance);
  glDeleteTextures(1, &this->Picture);
  this->Radiance = this->Picture = 0;
}

void EnvironmentMap::set(const std::shared_ptr<const EnvironmentState>& environment)
{
  if (environment == this->State)
  {
    return;
  }
  this->release();
  this->State = environment;
  if (!environment)
  {
    return;
  }
  const std::shared_ptr<const EnvironmentLight> known = environmentLight(environment);
  const EnvironmentLight& light = *known;
  for (std::size_t i = 0; i < 27; ++i)
  {
    this->Irradiance[i] = float(light.irradiance[i / 3][Eigen::Index(i % 3)]);
  }
  glActiveTexture(GL_TEXTURE0);
  glGenTextures(1, &this->Radiance);
  glBindTexture(GL_TEXTURE_2D, this->Radiance);
  for (int level = 0; level < EnvironmentLight::levels; ++level)
  {
    glTexImage2D(GL_TEXTURE_2D, level, GL_RGB32F, EnvironmentLight::width >> level,
      EnvironmentLight::width / 2 >> level, 0, GL_RGB, GL_FLOAT, light.radiance[std::size_t(level)].data());
  }
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, EnvironmentLight::levels - 1);
  wrapAround(true);
  if (!this->Reflectance)
  {
    const std::vector<float> table = reflectanceTable();
    glGenTextures(1, &this->Reflectance);
    glBindTexture(GL_TEXTURE_2D, this->Reflectance);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RG32F, EnvironmentLight::reflectanceSize, EnvironmentLight::reflectanceSize, 0,
      GL_RG, GL_FLOAT, table.data());
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
    wrapAround(false);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  }
  glBindTexture(GL_TEXTURE_2D, 0);
}

void EnvironmentMap::makePicture()
{
  const RadianceImage& image = *this->State->image;
  GLint largest = 0;
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &largest);
  if (image.width > largest || image.height > largest)
  {
    throw MachineError(
      "OpenGL cannot hold an environment of " + std::to_string(image.width) + " x " + std::to_string(image.height));
  }
  glGenTextures(1, &this->Picture);
  glBindTexture(GL_TEXTURE_2D, this->Picture);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB32F, image.width, image.height, 0, GL_RGB, GL_FLOAT, image.rgb.data());
  glGenerateMipmap(GL_TEXTURE_2D);
  wrapAround(true);
}

void EnvironmentMap::makeProgram()
{
  const unsigned int vertex = compiled(GL_VERTEX_SHADER, backgroundVertex);
  const unsigned int fragment =
    compiled(GL_FRAGMENT_SHADER, (std::string("#version 150\n") + transferShader() + backgroundFragment).c_str());
  this->Program = glCreateProgram();
  glAttachShader(this->Program, vertex);
  glAttachShader(this->Program, fragment);
  glBindFragDataLocation(this->Program, 0, "dgtkColor");
  glBindFragDataLocation(this->Program, 1, "dgtkId");
  glLinkProgram(this->Program);
  glDeleteShader(vertex);
  glDeleteShader(fragment);
  GLint linked = 0;
  glGetProgramiv(this->Program, GL_LINK_STATUS, &linked);
  if (!linked)
  {
    char log[400] = "";
    glGetProgramInfoLog(this->Program, sizeof(log), nullptr, log);
    throw MachineError("OpenGL cannot build the program for the background: " + quoted(log));
  }
  glGenVertexArrays(1, &this->VertexArray);
}

void EnvironmentMap::aim(const Eigen::Matrix4d& view_from_world)
{
  if (this->State)
  {
    storeMatrix(imageFromViewOf(*this->State, view_from_world), this->ImageFromView);
  }
}

void EnvironmentMap::bind(int radianceUnit, int reflectanceUnit) const
{
  glActiveTexture(GLenum(GL_TEXTURE0 + radianceUnit));
  glBindTexture(GL_TEXTURE_2D, this->Radiance);
  glActiveTexture(GLenum(GL_TEXTURE0 + reflectanceUnit));
  glBindTexture(GL_TEXTURE_2D, this->Reflectance);
}

void EnvironmentMap::drawBackground(const RasterCamera& camera, int width, int height, int unit)
{
  glActiveTexture(GLenum(GL_TEXTURE0 + unit));
  if (!this->Picture)
  {
    this->makePicture();
  }
  if (!this->Program)
  {
    this->makeProgram();
  }
  glBindTexture(GL_TEXTURE_2D, this->Picture);
  Eigen::Matrix3d ray = Eigen::Matrix3d::Zero();
  ray(2, 2) = -1; // a parallel projection looks along one direction
  double pixel = 0;
  if (camera.perspective)
  {
    Eigen::Matrix3d clip; // x, y and w of clip coordinates from a direction
    clip.row(0) = camera.clip_from_view.block<1, 3>(0, 0);
    clip.row(1) = camera.clip_from_view.block<1, 3>(1, 0);
    clip.row(2) = camera.clip_from_view.block<1, 3>(3, 0);
    Eigen::Matrix3d device;
    device << 2.0 / width, 0, -1, 0, 2.0 / height, -1, 0, 0, 1;
    ray = clip.inverse() * device;
    pixel = 1 / camera.focal;
  }
  std::array<float, 9> values;
  storeMatrix(imageFromViewOf(*this->State, camera.view_from_world) * ray, values);
  const double texel = pi / this->State->image->height;
  glUseProgram(this->Program);
  glUniformMatrix3fv(glGetUniformLocation(this->Program, "dgtkRay"), 1, GL_FALSE, values.data());
  glUniform1f(
    glGetUniformLocation(this->Program, "dgtkLevel"), float(std::max(0.0, std::log2(std::max(pixel / texel, 1e-9)))));
  glUniform1f(glGetUniformLocation(this->Program, "dgtkIntensity"), float(this->State->intensity));
  glUniform1i(glGetUniformLocation(this->Program, "dgtkPicture"), unit);
  glBindVertexArray(this->VertexArray);
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glBindVertexArray(0);
  glUseProgram(0);
}

} // namespace dgtk
