// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkGLWindow.h"

#include "dgtkError.h"

#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkLogger.h>
#include <vtkObjectFactory.h>
#include <vtkOpenGLState.h>
#include <vtkOutputWindow.h>
#include <vtk_glew.h>

#include <atomic>
#include <mutex>
#include <unistd.h>

namespace dgtk
{
namespace
{

/// Keeps what VTK would print, for our own message.
class CollectingOutput : public vtkOutputWindow
{
public:
  static CollectingOutput* New();
  vtkTypeMacro(CollectingOutput, vtkOutputWindow);
  void DisplayText(const char* text) override { this->collect(text); }
  void DisplayErrorText(const char* text) override
  {
    this->collect(text);
    throwIfRefused(text);
  }
  void DisplayWarningText(const char* text) override { this->collect(text); }
  void DisplayGenericWarningText(const char* text) override { this->collect(text); }
  void DisplayDebugText(const char*) override {}

  std::string take()
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    return std::exchange(this->Collected, {});
  }

private:
  /// A shader that OpenGL refuses is told in two texts, its lines with numbers and then why. VTK would go on without it
  /// and end in its null pointer.
  static void throwIfRefused(const std::string& text)
  {
    const std::size_t said = text.find("): ");
    if (text.find("vtkShaderProgram") != std::string::npos && said != std::string::npos &&
        text.compare(said + 3, 3, "1: ") != 0)
    {
      const std::size_t end = text.find('\n', said + 3);
      throw MachineError("OpenGL refuses a shader: " + text.substr(said + 3, end - said - 3));
    }
  }
  void collect(const char* text)
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    for (const char* c = text; c && *c && this->Collected.size() < 500; ++c)
    {
      const bool space = *c == '\n' || *c == '\t' || *c == ' ';
      if (!space || (!this->Collected.empty() && this->Collected.back() != ' '))
      {
        this->Collected += space ? ' ' : *c;
      }
    }
  }
  std::mutex Mutex;
  std::string Collected;
};
vtkStandardNewMacro(CollectingOutput);

CollectingOutput* output()
{
  static vtkSmartPointer<CollectingOutput> instance;
  if (!instance)
  {
    instance = vtkSmartPointer<CollectingOutput>::New();
    vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
  }
  if (vtkOutputWindow::GetInstance() != instance)
  {
    vtkOutputWindow::SetInstance(instance);
  }
  return instance;
}

constexpr unsigned int glewNoGlxDisplay = 4; // GLEW_ERROR_NO_GLX_DISPLAY; everything else is initialised then

/// A render window on a context that was made elsewhere. It never has a framebuffer of its own.
class SurfacelessWindow : public vtkGenericOpenGLRenderWindow
{
public:
  static SurfacelessWindow* New();
  vtkTypeMacro(SurfacelessWindow, vtkGenericOpenGLRenderWindow);

  void adopt(std::unique_ptr<NativeContext> context)
  {
    this->Native = std::move(context);
    this->SetOffScreenRendering(1);
    this->SetMultiSamples(0);
    this->SetSize(16, 16);
    this->OpenGLInit();
  }
  bool initialised() const { return this->Initialized; }

  void MakeCurrent() override
  {
    if (this->Native && !this->Native->isCurrent())
    {
      this->Native->makeCurrent();
    }
  }
  void ReleaseCurrent() override
  {
    if (this->Native && this->Native->isCurrent())
    {
      this->Native->release();
    }
  }
  bool IsCurrent() override { return this->Native && this->Native->isCurrent(); }
  int SupportsOpenGL() override { return 1; }
  void* GetGenericContext() override { return this->Native.get(); }

  void OpenGLInitContext() override
  {
    this->ContextCreationTime.Modified();
    if (this->Initialized)
    {
      return;
    }
    const unsigned int result = glewInit();
    this->GlewInitValid = (result == GLEW_OK || result == glewNoGlxDisplay) && GLEW_VERSION_3_2;
    this->Initialized = this->GlewInitValid;
    this->MaximumHardwareLineWidth = 1.0;
  }

protected:
  SurfacelessWindow() = default;
  ~SurfacelessWindow() override
  {
    this->MakeCurrent();
    this->Finalize();
  }

private:
  std::unique_ptr<NativeContext> Native;
};
vtkStandardNewMacro(SurfacelessWindow);

struct Process
{
  pid_t id = ::getpid();
  vtkSmartPointer<vtkOpenGLRenderWindow> window;
  GLChoice choice;
  GLChoice before; ///< of the process that this one was forked from; without a description when it had none
  std::mutex turn;
};

Process& process()
{
  // Never destroyed: drivers take themselves down at exit in an order that is not ours. What a forked process finds is
  // left alone: it may wait for threads that are not there.
  static std::atomic<Process*> current{ new Process };
  Process* one = current;
  if (one->id != ::getpid())
  {
    auto* own = new Process;
    own->before = one->window ? one->choice : one->before;
    one = current.compare_exchange_strong(one, own) ? own : (delete own, one);
  }
  return *one;
}

const char* titleOf(GLBackend backend)
{
  switch (backend)
  {
    case GLBackend::Egl:
      return "EGL";
    case GLBackend::Osmesa:
      return "OSMesa";
    case GLBackend::Glx:
      return "GLX";
    case GLBackend::Auto:
      break;
  }
  return "auto";
}

void make(GLBackend backend, Process& made)
{
  output();
  if (backend == GLBackend::Glx)
  {
    made.window = makeGlxWindow();
    if (!GLEW_VERSION_3_2)
    {
      made.window = nullptr;
      throw MachineError("no OpenGL 3.2; " + takeVTKErrors());
    }
  }
  else
  {
    if (backend == GLBackend::Egl && osmesaPreloaded())
    {
      throw MachineError("the process was started for OSMesa");
    }
    auto window = vtkSmartPointer<SurfacelessWindow>::New();
    window->adopt(backend == GLBackend::Egl ? makeEglContext() : makeOsmesaContext(true));
    if (!window->initialised())
    {
      throw MachineError("no OpenGL 3.2 core context");
    }
    made.window = window;
  }
  made.window->MakeCurrent();
  const GLubyte* name = glGetString(GL_RENDERER);
  made.choice.backend = backend;
  made.choice.description = std::string(titleOf(backend)) + ", " + (name ? reinterpret_cast<const char*>(name) : "?");
  if (!GLEW_ARB_clip_control)
  {
    made.choice.description += ", without clip control (less exact order of far surfaces)";
  }
}

} // namespace

std::string takeVTKErrors() { return output()->take(); }

std::string rendererName(const NativeContext& context)
{
  using GetString = const GLubyte* (*)(GLenum);
  const auto get = reinterpret_cast<GetString>(context.lookUp("glGetString"));
  const GLubyte* name = get ? get(GL_RENDERER) : nullptr;
  return name ? reinterpret_cast<const char*>(name) : "";
}

namespace
{
/// The first of the backends that works.
void makeFirst(GLBackend backend, Process& one)
{
  std::string said = inheritedReason();
  const std::vector<GLBackend> wanted = backend == GLBackend::Auto
                                          ? std::vector<GLBackend>{ GLBackend::Egl, GLBackend::Osmesa, GLBackend::Glx }
                                          : std::vector<GLBackend>{ backend };
  for (const GLBackend each : wanted)
  {
    if (backend == GLBackend::Auto && each == GLBackend::Egl && !said.empty())
    {
      continue; // tried before the process was started anew
    }
    try
    {
      make(each, one);
      break;
    }
    catch (const MachineError& error)
    {
      said += (said.empty() ? "" : "; ") + std::string(titleOf(each)) + ": " + error.what();
    }
  }
  if (!one.window)
  {
    throw MachineError("no OpenGL: " + said);
  }
  if (!said.empty())
  {
    one.choice.description += " (" + said + ")";
  }
}

[[noreturn]] void throwForked()
{
  throw MachineError(
    "OpenGL was used before this process was forked and cannot be used in the copy (start processes by "
    "spawn or forkserver, or draw the first picture after the fork)");
}

/// A context in place of the one of the process that this one was forked from: the same renderer, or none.
void makeAfterFork(Process& one)
{
  try
  {
    if (one.before.backend != GLBackend::Egl)
    {
      throwForked();
    }
    glewInit(); // at its first call libGLX notices the fork and drops what is current, which is nothing yet
    make(GLBackend::Egl, one);
  }
  catch (const MachineError&)
  {
    throwForked();
  }
  if (one.choice.description != one.before.description)
  {
    one.window = nullptr;
    throwForked();
  }
}

void checkBackend(GLBackend wanted, GLBackend inUse)
{
  if (wanted != GLBackend::Auto && wanted != inUse)
  {
    throw UsageError(
      std::string("OpenGL is in use through ") + titleOf(inUse) + " and cannot change to " + titleOf(wanted));
  }
}
} // namespace

GLTurn::GLTurn() { process().turn.lock(); }

GLTurn::~GLTurn()
{
  Process& one = process();
  if (one.window)
  {
    one.window->ReleaseCurrent();
  }
  one.turn.unlock();
}

vtkOpenGLRenderWindow* currentGLWindow(GLBackend backend, GLChoice& choice)
{
  Process& one = process();
  const bool forked = !one.before.description.empty();
  checkBackend(backend, one.window ? one.choice.backend : forked ? one.before.backend : backend);
  if (!one.window)
  {
    forked ? makeAfterFork(one) : makeFirst(backend, one);
  }
  one.window->MakeCurrent();
  choice = one.choice;
  return one.window;
}

} // namespace dgtk
