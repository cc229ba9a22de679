#pragma once
// One function per kind of wall, each in its own file; wall_registry.cpp lists them.

#include "sim/walls/wall_registry.h"

namespace sandglass {

WallKind planeWallKind();
WallKind rectangleWallKind();
WallKind boxWallKind();
WallKind cylinderWallKind();
WallKind coneWallKind();
WallKind frustumWallKind();
WallKind wedgeWallKind();
WallKind coneHopperWallKind();
WallKind discWallKind();
WallKind obliqueConeWallKind();
WallKind meshWallKind();

} // namespace sandglass
