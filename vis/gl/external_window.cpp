#include "vis/gl/external_window.h"

namespace sandglass::vis {

ExternalWindow* ExternalWindow::New() {
  auto* window = new ExternalWindow;
  window->InitializeObjectBase();
  return window;
}

ExternalWindow::ExternalWindow() {
  SetReadyForRendering(true);
  SetFrameBlitModeToNoBlit(); // pictures are read from VTK's own framebuffer
  SetOwnContext(0);
}

ExternalWindow::~ExternalWindow() {
  MakeCurrent();
  Finalize();
  SetReadyForRendering(false);
}

void ExternalWindow::MakeCurrent() {
  if (context_) context_->makeCurrent();
}

void ExternalWindow::OpenGLInitContext() {
  ContextCreationTime.Modified();
  if (Initialized) return;
  MakeCurrent(); // vtkGenericOpenGLRenderWindow::Render() initialises before it makes current
  // Debian's GLEW is the GLX flavour: it loads every entry point first and only then asks for a GLX display,
  // so that GLEW_ERROR_NO_GLX_DISPLAY means success here.
  const GLenum result = glewInit();
  GlewInitValid = result == GLEW_OK || result == GLEW_ERROR_NO_GLX_DISPLAY;
  if (!GlewInitValid || !GLEW_VERSION_3_2) {
    fault_ = "the context offers no OpenGL 3.2";
    return;
  }
  Initialized = true;
  MaximumHardwareLineWidth = 1; // wide lines by geometry shader, the same on every back end
}

} // namespace sandglass::vis
