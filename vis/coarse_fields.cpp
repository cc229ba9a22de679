#include "vis/coarse_fields.h"

#include "analysis/grain_sizes.h"
#include "analysis/registry.h"
#include "vis/readers/vti_field.h"

#include <Eigen/Geometry>

#include <algorithm>

namespace sandglass::vis {

FramePtr withFields(const FramePtr& frame) {
  if (!frame->fields.empty() || frame->size() == 0) return frame;
  constexpr double most = 48; ///< nodes along the longest side: what a picture of usual size can show
  const auto& kind = analysis::analysisKind("fields");
  Parameters knobs = analysis::defaultKnobs(kind);
  Eigen::AlignedBox3d box;
  for (const Vec3& x : frame->position)
    box.extend(x);
  const double across = box.sizes().maxCoeff() / analysis::meanDiameter(*frame);
  knobs.set("spacing", std::max(1.0, across / most));
  const auto results = analysis::analyze(kind, knobs, {}, {frame});
  auto with = std::make_shared<Frame>(*frame);
  with->fields.push_back(frameField(results.fields.front()));
  return with;
}

const std::vector<std::string>& fieldQuantities() {
  static const std::vector<std::string> names{
      "packing_fraction", "velocity",  "velocity.x",           "velocity.y", "velocity.z",
      "density",          "vorticity", "granular_temperature", "shear_rate"};
  return names;
}

} // namespace sandglass::vis
