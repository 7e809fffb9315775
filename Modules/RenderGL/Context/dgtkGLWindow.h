// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkGLWindow_h
#define dgtkGLWindow_h

#include "dgtkGLContext.h"

#include <memory>
#include <string>
#include <utility>
#include <vtkSmartPointer.h>

class vtkOpenGLRenderWindow;

namespace dgtk
{

/// An OpenGL context as the operating system gives it.
class NativeContext
{
public:
  virtual ~NativeContext() = default;
  virtual void makeCurrent() = 0;
  /// Leaves the context to other threads.
  virtual void release() = 0;
  virtual bool isCurrent() const = 0;
  virtual void* lookUp(const char* function) const = 0;
};

/// They throw MachineError with a few words: what failed, without naming the backend.
std::unique_ptr<NativeContext> makeEglContext();
std::unique_ptr<NativeContext> makeOsmesaContext(bool preloadNeeded);
vtkSmartPointer<vtkOpenGLRenderWindow> makeGlxWindow();

/// GL_RENDERER; the context must be current.
std::string rendererName(const NativeContext& context);

/// The process's render window, made by chooseGL(). Its context is current after the call.
vtkOpenGLRenderWindow* currentGLWindow(GLBackend backend, GLChoice& choice);

/// Errors that VTK reported since the last call, as one line; "" when there were none.
std::string takeVTKErrors();

/// Path of the preload library beside this one; "" when there is none.
std::string preloadLibrary();
bool osmesaPreloaded();
/// Why earlier backends were passed over before the process was started anew.
std::string inheritedReason();

} // namespace dgtk

#endif
