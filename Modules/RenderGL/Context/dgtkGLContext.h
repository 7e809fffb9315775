// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkGLContext_h
#define dgtkGLContext_h

#include "dgtkRenderGLModule.h"

#include <string>
#include <vector>

namespace dgtk
{

/// A way to an OpenGL context that needs no window on a desktop.
enum class GLBackend
{
  Auto,   ///< the first of the others, in their order, that works
  Egl,    ///< a GPU without a display, else Mesa's surfaceless platform
  Osmesa, ///< Mesa in main memory; the process must have been prepared, see prepareProcess()
  Glx     ///< an X server (DISPLAY)
};

/// "auto", "egl", "osmesa", "glx": the names of the ways to OpenGL.
DGTKRENDERGL_EXPORT const char* nameOf(GLBackend backend);
/// Throws UsageError for a name that is none of them.
DGTKRENDERGL_EXPORT GLBackend glBackendFromName(const std::string& name);

/// What was chosen. `description` is one line: backend, renderer and, when a backend was passed over, why; for instance
/// "EGL, llvmpipe (LLVM 15.0.6, 256 bits)".
struct GLChoice
{
  GLBackend backend = GLBackend::Auto;
  std::string description;
};

/// To be called once at the start of main, before threads are started and OpenGL is used. Starts the program anew
/// (same process, same arguments) with the preload library that OSMesa needs, when `backend` asks for OSMesa or, with
/// Auto, when EGL does not work. Does nothing when there is nothing to do or no preload library.
/// `threads` > 0 limits the threads of Mesa's software renderer (LP_NUM_THREADS, unless the environment sets it).
DGTKRENDERGL_EXPORT void prepareProcess(GLBackend backend, char** argv, int threads = 0);

/// Makes the process's OpenGL context, or returns the one made before. The context belongs to the process and to the
/// thread that draws, see GLTurn. A process that was forked from one with a context makes its own, which is possible
/// once, for software rendering through EGL: the threads of the one before are not in the copy. Throws MachineError,
/// one line with what each backend said, when none works, and UsageError when another backend than the one in use is
/// asked for.
DGTKRENDERGL_EXPORT GLChoice chooseGL(GLBackend backend);

/// A thread's turn with the process's OpenGL: waits until no other thread has one, and leaves the context to whichever
/// thread draws next. Only threads that draw in turns need it, all of them; everything that draws (RasterSource) must
/// be made, used and destroyed within turns then.
class DGTKRENDERGL_EXPORT GLTurn
{
public:
  GLTurn();
  ~GLTurn();
  GLTurn(const GLTurn&) = delete;
  GLTurn& operator=(const GLTurn&) = delete;
};

/// One row of `dgtk list gl`.
struct GLBackendInfo
{
  GLBackend backend = GLBackend::Auto;
  bool available = false;
  std::string description; ///< renderer, or why it is not available; one line
};
/// Tries every backend, each in a child process of its own, so that a driver that crashes is an unavailable backend.
DGTKRENDERGL_EXPORT std::vector<GLBackendInfo> glBackends();

} // namespace dgtk

#endif
