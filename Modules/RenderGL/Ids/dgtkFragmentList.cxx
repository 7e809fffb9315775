// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkFragmentList.h"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <tuple>
#include <vtk_glew.h>

namespace dgtk
{

namespace
{
/// Before the fragments in the buffer, as the shader declares it.
struct Header
{
  std::uint32_t count;
  std::uint32_t capacity;
  std::uint32_t width;
  std::uint32_t unused;
};
static_assert(sizeof(Header) == 16 && sizeof(Fragment) == 32, "std430 layout");
} // namespace

FragmentList::~FragmentList()
{
  if (this->Buffer)
  {
    glDeleteBuffers(1, &this->Buffer);
  }
}

bool FragmentList::supported()
{
  GLint64 most = 0;
  GLint blocks = 0;
  if (GLEW_ARB_shader_storage_buffer_object)
  {
    glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &most);
    glGetIntegerv(GL_MAX_FRAGMENT_SHADER_STORAGE_BLOCKS, &blocks);
  }
  return blocks > 0 && std::uint64_t(most) >= sizeof(Header) + capacity * sizeof(Fragment);
}

void FragmentList::begin(int width)
{
  const Header header{ 0, std::uint32_t(capacity), std::uint32_t(width), 0 };
  if (!this->Buffer)
  {
    glGenBuffers(1, &this->Buffer);
    glBindBuffer(GL_SHADER_STORAGE_BUFFER, this->Buffer);
    glBufferData(
      GL_SHADER_STORAGE_BUFFER, GLsizeiptr(sizeof(Header) + capacity * sizeof(Fragment)), nullptr, GL_DYNAMIC_READ);
  }
  glBindBuffer(GL_SHADER_STORAGE_BUFFER, this->Buffer);
  glBufferSubData(GL_SHADER_STORAGE_BUFFER, 0, sizeof header, &header);
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, this->Buffer);
}

std::size_t FragmentList::end(std::vector<Fragment>& fragments)
{
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  Header header{};
  glBindBuffer(GL_SHADER_STORAGE_BUFFER, this->Buffer);
  glGetBufferSubData(GL_SHADER_STORAGE_BUFFER, 0, sizeof header, &header);
  fragments.resize(std::min<std::size_t>(header.count, capacity));
  if (!fragments.empty())
  {
    glGetBufferSubData(
      GL_SHADER_STORAGE_BUFFER, sizeof header, GLsizeiptr(fragments.size() * sizeof(Fragment)), fragments.data());
  }
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, 0);
  glBindBuffer(GL_SHADER_STORAGE_BUFFER, 0);
  return header.count;
}

void sortFragments(std::vector<Fragment>& fragments, std::size_t pixels)
{
  const auto key = [](const Fragment& f) { return std::make_tuple(-f.depth, f.number, f.triangle); };
  std::vector<std::uint32_t> begin(pixels + 1, 0);
  for (const Fragment& f : fragments)
  {
    ++begin[std::size_t(f.pixel) + 1];
  }
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  std::vector<Fragment> sorted(fragments.size());
  std::vector<std::uint32_t> next(begin.begin(), begin.end() - 1);
  for (const Fragment& f : fragments)
  {
    sorted[next[std::size_t(f.pixel)]++] = f;
  }
  fragments.clear();
  for (std::size_t pixel = 0; pixel < pixels; ++pixel)
  {
    const auto first = sorted.begin() + begin[pixel];
    const auto last = sorted.begin() + begin[pixel + 1];
    std::sort(first, last, [&](const Fragment& a, const Fragment& b) { return key(a) < key(b); });
    for (auto it = first; it != last; ++it)
    {
      if (it->depth > 0 && (it == first || key(*it) != key(*(it - 1))))
      {
        fragments.push_back(*it);
      }
    }
  }
}

} // namespace dgtk
