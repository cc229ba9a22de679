#pragma once
// A VTK render window on a context that somebody else made: what lets the packaged, GLX-only VTK draw without
// an X server.

#include <vtk_glew.h> // before any other OpenGL header

#include "vis/gl/gl_context.h"

#include <vtkGenericOpenGLRenderWindow.h>

#include <memory>
#include <string>

namespace sandglass::vis {

class ExternalWindow : public vtkGenericOpenGLRenderWindow {
public:
  static ExternalWindow* New();
  vtkTypeMacro(ExternalWindow, vtkGenericOpenGLRenderWindow);

  /// Takes the context over. Call once, before anything else.
  void setContext(std::unique_ptr<GlContext> context) { context_ = std::move(context); }
  GlContext& context() { return *context_; }
  const std::string& fault() const { return fault_; } ///< why OpenGL could not be loaded, or ""

  void Initialize() override { MakeCurrent(); }
  void MakeCurrent() override;
  bool IsCurrent() override { return context_ && context_->isCurrent(); }
  int SupportsOpenGL() override { return 1; }
  vtkTypeBool IsDirect() override { return 0; }
  void OpenGLInitContext() override;

protected:
  ExternalWindow();
  ~ExternalWindow() override;

private:
  std::unique_ptr<GlContext> context_;
  std::string fault_;
};

} // namespace sandglass::vis
