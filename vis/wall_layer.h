#pragma once
// Walls: translucent faces, feature edges as lines, the outline of the periodic box, all cut by the clip
// planes.

#include "sim/frame/frame.h"
#include "vis/clip.h"
#include "vis/view.h"

#include <Eigen/Geometry>

#include <vtkActor.h>
#include <vtkNew.h>

#include <memory>
#include <vector>

namespace sandglass::vis {

class WallLayer {
public:
  WallLayer();
  std::vector<vtkActor*> actors() const { return {faces_, edges_, box_}; }

  /// `camera`: the picture's, presets resolved. `lineScale`: width of lines relative to a picture of usual
  /// size.
  void show(const Frame& frame, const View& view, const Camera& camera, const Eigen::AlignedBox3d& box,
            float lineScale);

private:
  void rebuild(const Eigen::AlignedBox3d& box);

  vtkNew<vtkActor> faces_, edges_, box_;
  std::vector<std::shared_ptr<const WallShape>> shown_; ///< held, so that an address means one shape
  std::vector<Vec3> shifts_;                            ///< periodic images, built
  Eigen::AlignedBox3d builtBox_;
  FragmentClip clipFaces_{faces_}, clipEdges_{edges_};
};

} // namespace sandglass::vis
