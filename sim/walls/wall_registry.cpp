#include "sim/walls/wall_registry.h"

#include "sim/walls/wall_kinds.h"

namespace sandglass {

const std::vector<WallKind>& wallKinds() {
  static const std::vector<WallKind> kinds{
      planeWallKind(), rectangleWallKind(),   boxWallKind(),   cylinderWallKind(),
      coneWallKind(),  frustumWallKind(),     wedgeWallKind(), coneHopperWallKind(),
      discWallKind(),  obliqueConeWallKind(), meshWallKind(),
  };
  return kinds;
}

} // namespace sandglass
