#pragma once
// An OpenGL 3.2 core context without window or display, the two ways that Mesa offers. Both reach the
// packaged VTK through glvnd's dispatch table, so that one executable holds both. A context belongs to the
// thread that made it. It is current between makeCurrent() and release() only, so that any number of them,
// and contexts of a toolkit, can take turns on one thread.

#include <memory>
#include <string>

namespace sandglass::vis {

class GlContext {
public:
  virtual ~GlContext() = default;
  virtual void makeCurrent() = 0;
  virtual bool isCurrent() const = 0;
  virtual void release() = 0;
  virtual const char* name() const = 0; ///< "osmesa" or "egl"
};

/// Each returns null and a reason (a phrase) when this machine cannot make one.
std::unique_ptr<GlContext> makeOsmesaContext(std::string& reason);
std::unique_ptr<GlContext> makeEglContext(std::string& reason);

} // namespace sandglass::vis
