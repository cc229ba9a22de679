#pragma once
// The one rule of what is cut away: grains by their centres (whole grains, no cut spheres), contacts by their
// points, walls and slices pixel by pixel. Drawing and picking ask the same function.

#include "vis/camera.h"
#include "vis/view.h"

class vtkActor;

namespace sandglass::vis {

bool isClipped(const View& view, const Vec3& point);

/// Makes an actor's fragments obey the clips of the view. The actor must be lit (ambient alone will do):
/// VTK hands the place of a fragment to lit surfaces only. Call before each picture, with its camera.
class FragmentClip {
public:
  explicit FragmentClip(vtkActor* actor) : actor_(actor) {}
  void show(const View& view, const Camera& camera);

private:
  void setCode(const View& view);

  vtkActor* actor_;
  std::array<std::size_t, 3> counts_{0, 0, 0}; ///< of planes, boxes, cylinders in the shader
};

} // namespace sandglass::vis
