// EGL on Mesa's surfaceless platform. VTK wants a complete default framebuffer, hence the small pbuffer.

#include "vis/gl/gl_context.h"

#define EGL_NO_X11
#include <EGL/egl.h>
#include <EGL/eglext.h>

namespace sandglass::vis {

namespace {

class EglContext final : public GlContext {
public:
  EglContext(EGLDisplay display, EGLSurface surface, EGLContext context)
      : display_(display), surface_(surface), context_(context) {}
  ~EglContext() override {
    release();
    eglDestroySurface(display_, surface_);
    eglDestroyContext(display_, context_); // the display stays: another renderer may use it
  }

  void makeCurrent() override {
    if (isCurrent()) return;
    eglBindAPI(EGL_OPENGL_API);
    eglMakeCurrent(display_, surface_, surface_, context_);
  }
  bool isCurrent() const override { return eglGetCurrentContext() == context_; }
  void release() override {
    if (isCurrent()) eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  }
  const char* name() const override { return "egl"; }

private:
  EGLDisplay display_;
  EGLSurface surface_;
  EGLContext context_;
};

} // namespace

std::unique_ptr<GlContext> makeEglContext(std::string& reason) {
  const auto platformDisplay =
      reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(eglGetProcAddress("eglGetPlatformDisplayEXT"));
  EGLDisplay display = platformDisplay
                           ? platformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr)
                           : nullptr;
  if (display == nullptr || !eglInitialize(display, nullptr, nullptr)) {
    reason = "EGL has no surfaceless display (package libegl-mesa0)";
    return nullptr;
  }
  const EGLint wanted[] = {EGL_SURFACE_TYPE,
                           EGL_PBUFFER_BIT,
                           EGL_RENDERABLE_TYPE,
                           EGL_OPENGL_BIT,
                           EGL_RED_SIZE,
                           8,
                           EGL_GREEN_SIZE,
                           8,
                           EGL_BLUE_SIZE,
                           8,
                           EGL_ALPHA_SIZE,
                           8,
                           EGL_DEPTH_SIZE,
                           24,
                           EGL_NONE};
  EGLConfig config{};
  EGLint count = 0;
  if (!eglBindAPI(EGL_OPENGL_API) || !eglChooseConfig(display, wanted, &config, 1, &count) || count < 1) {
    reason = "EGL offers no OpenGL configuration with depth";
    return nullptr;
  }
  const EGLint version[] = {EGL_CONTEXT_MAJOR_VERSION,
                            3,
                            EGL_CONTEXT_MINOR_VERSION,
                            2,
                            EGL_CONTEXT_OPENGL_PROFILE_MASK,
                            EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                            EGL_NONE};
  EGLContext context = eglCreateContext(display, config, EGL_NO_CONTEXT, version);
  if (context == EGL_NO_CONTEXT) {
    reason = "EGL offers no OpenGL 3.2 core context";
    return nullptr;
  }
  const EGLint size[] = {EGL_WIDTH, 16, EGL_HEIGHT, 16, EGL_NONE};
  EGLSurface surface = eglCreatePbufferSurface(display, config, size);
  if (surface == EGL_NO_SURFACE) {
    eglDestroyContext(display, context);
    reason = "EGL offers no off-screen surface";
    return nullptr;
  }
  return std::make_unique<EglContext>(display, surface, context);
}

} // namespace sandglass::vis
