// OSMesa is no vendor of glvnd, so a context of its own would leave the dispatch table that VTK calls through
// empty. We register it as one: libGLdispatch exports what is needed but installs no header, hence the
// declarations (glvnd's GLdispatch.h is their reference).

#include "vis/gl/gl_context.h"

#include <array>
#include <dlfcn.h>

extern "C" {
struct GLDispatchThreadState {
  int tag; ///< who owns the state: 0 is GLX, 1 is EGL, and both act on states that carry their mark
  void (*threadDestroyed)(GLDispatchThreadState*);
  void* priv;
};
using GLDispatchProc = void* (*)(const char* name, void* data);
void __glDispatchInit(void);
int __glDispatchNewVendorID(void);
void* __glDispatchCreateTable(GLDispatchProc getProcAddress, void* data);
unsigned char __glDispatchMakeCurrent(GLDispatchThreadState*, void* table, int vendor, const void* patch);
void __glDispatchLoseCurrent(void);
}

namespace sandglass::vis {

namespace {

constexpr int tagOfOurOwn = 2;

/// The library and its registration: once per process, never unloaded (LLVM keeps threads of its own).
struct OsmesaLibrary {
  void* (*create)(const int* attributes, void* share) = nullptr;
  unsigned char (*makeCurrent)(void* context, void* buffer, unsigned type, int width, int height) = nullptr;
  void* (*current)() = nullptr;
  void (*destroy)(void* context) = nullptr;
  void* (*procAddress)(const char* name) = nullptr;
  void* table = nullptr;
  int vendor = 0;
  std::string fault;

  OsmesaLibrary() {
    // RTLD_LOCAL: its gl* symbols must not win over those of the dispatch library.
    void* library = dlopen("libOSMesa.so.8", RTLD_NOW | RTLD_LOCAL);
    if (library == nullptr) {
      fault = "libOSMesa.so.8 cannot be loaded (package libosmesa6)";
      return;
    }
    const auto find = [&](auto& function, const char* name) {
      function = reinterpret_cast<std::remove_reference_t<decltype(function)>>(dlsym(library, name));
      if (function == nullptr) fault = std::string("libOSMesa.so.8 has no ") + name;
    };
    find(create, "OSMesaCreateContextAttribs");
    find(makeCurrent, "OSMesaMakeCurrent");
    find(current, "OSMesaGetCurrentContext");
    find(destroy, "OSMesaDestroyContext");
    find(procAddress, "OSMesaGetProcAddress");
    if (!fault.empty()) return;
    __glDispatchInit();
    vendor = __glDispatchNewVendorID();
    table = __glDispatchCreateTable(
        [](const char* name, void* self) { return static_cast<OsmesaLibrary*>(self)->procAddress(name); },
        this);
    if (table == nullptr) fault = "libGLdispatch refused another vendor";
  }
};

OsmesaLibrary& library() {
  static OsmesaLibrary theLibrary;
  return theLibrary;
}

class OsmesaContext final : public GlContext {
public:
  explicit OsmesaContext(void* context) : context_(context) {}
  ~OsmesaContext() override {
    release();
    library().destroy(context_);
  }

  void makeCurrent() override {
    if (isCurrent()) return;
    library().makeCurrent(context_, buffer_.data(), unsignedByte, side, side);
    current_ = __glDispatchMakeCurrent(&state_, library().table, library().vendor, nullptr) != 0;
  }
  bool isCurrent() const override { return current_; }
  void release() override {
    if (!current_) return;
    __glDispatchLoseCurrent();
    library().makeCurrent(nullptr, nullptr, 0, 0, 0);
    current_ = false;
  }
  const char* name() const override { return "osmesa"; }

private:
  static constexpr unsigned unsignedByte = 0x1401;
  static constexpr int side = 16; // VTK draws into a framebuffer object of its own, of any size
  void* context_;
  std::array<unsigned char, static_cast<std::size_t>(side) * side * 4> buffer_{};
  GLDispatchThreadState state_{tagOfOurOwn, nullptr, nullptr};
  bool current_ = false;
};

} // namespace

std::unique_ptr<GlContext> makeOsmesaContext(std::string& reason) {
  if (!library().fault.empty()) {
    reason = library().fault;
    return nullptr;
  }
  // OSMESA_FORMAT RGBA, DEPTH_BITS 24, STENCIL_BITS 8, PROFILE core, version 3.2 (GL/osmesa.h)
  const int attributes[] = {0x22, 0x1908, 0x30, 24, 0x31, 8, 0x33, 0x34, 0x36, 3, 0x37, 2, 0};
  void* context = library().create(attributes, nullptr);
  if (context == nullptr) {
    reason = "OSMesa offers no OpenGL 3.2 core context";
    return nullptr;
  }
  return std::make_unique<OsmesaContext>(context);
}

} // namespace sandglass::vis
