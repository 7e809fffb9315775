// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkIdPrograms.h"

#include "dgtkError.h"

#include <vtk_glew.h>

namespace dgtk
{
namespace
{

unsigned int compile(GLenum kind, const std::string& source)
{
  const unsigned int shader = glCreateShader(kind);
  const char* text = source.c_str();
  glShaderSource(shader, 1, &text, nullptr);
  glCompileShader(shader);
  return shader;
}

} // namespace

IdPrograms::~IdPrograms()
{
  for (const Program& each : this->All)
  {
    if (each.name)
    {
      glDeleteProgram(each.name);
    }
  }
  if (this->VertexArray)
  {
    glDeleteVertexArrays(1, &this->VertexArray);
  }
}

unsigned int IdPrograms::vertexArray()
{
  if (!this->VertexArray)
  {
    glGenVertexArrays(1, &this->VertexArray);
  }
  return this->VertexArray;
}

const IdPrograms::Program& IdPrograms::program(const ShaderVariant& variant)
{
  const auto& wraps = variant.wraps[ShaderVariant::Base];
  Program& wanted = this->All[(variant.cutOut ? 1u : 0u) + (variant.pieces ? 2u : 0u) + (variant.peel ? 4u : 0u) +
                              8u * (unsigned(wraps[0]) + 3u * unsigned(wraps[1]))];
  if (wanted.name)
  {
    return wanted;
  }
  const unsigned int vertex = compile(GL_VERTEX_SHADER, idVertexShader(variant));
  const unsigned int fragment = compile(GL_FRAGMENT_SHADER, idFragmentShader(variant));
  const unsigned int name = glCreateProgram();
  glAttachShader(name, vertex);
  glAttachShader(name, fragment);
  glBindAttribLocation(name, 0, "vertexMC");
  glBindAttribLocation(name, 1, "tcoord");
  glBindAttribLocation(name, 2, "dgtkTriangle");
  glBindFragDataLocation(name, 1, "dgtkOutput");
  glLinkProgram(name);
  glDeleteShader(vertex);
  glDeleteShader(fragment);
  GLint linked = 0;
  glGetProgramiv(name, GL_LINK_STATUS, &linked);
  if (!linked)
  {
    char log[400] = "";
    glGetProgramInfoLog(name, sizeof(log), nullptr, log);
    glDeleteProgram(name);
    throw MachineError("OpenGL cannot build the program for object ids: " + quoted(log));
  }
  wanted.name = name;
  wanted.matrix = glGetUniformLocation(name, "MCDCMatrix");
  wanted.draw = glGetUniformLocation(name, "dgtkDraw");
  wanted.picture = glGetUniformLocation(name, "actortexture");
  wanted.first = glGetUniformLocation(name, "dgtkFirstTriangle");
  wanted.layer = glGetUniformLocation(name, "dgtkLayer");
  return wanted;
}

} // namespace dgtk
