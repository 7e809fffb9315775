// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkIdPrograms_h
#define dgtkIdPrograms_h

#include "dgtkRasterShaders.h"

#include <array>

namespace dgtk
{

/// The programs that draw ids alone. The context must be current.
class IdPrograms
{
public:
  IdPrograms() = default;
  ~IdPrograms();
  IdPrograms(const IdPrograms&) = delete;
  IdPrograms& operator=(const IdPrograms&) = delete;

  struct Program
  {
    unsigned int name = 0;
    int matrix = -1;  ///< MCDCMatrix
    int draw = -1;    ///< dgtkDraw
    int picture = -1; ///< actortexture
    int layer = -1;   ///< dgtkLayer
    int first = -1;   ///< dgtkFirstTriangle
  };
  /// Of `variant`, cutOut, pieces, peel and the wraps of the base picture count. Throws MachineError with the
  /// compiler's words.
  const Program& program(const ShaderVariant& variant);
  /// A vertex array of our own.
  unsigned int vertexArray();

private:
  std::array<Program, 72> All;
  unsigned int VertexArray = 0;
};

} // namespace dgtk

#endif
