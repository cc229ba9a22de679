#pragma once
// The network of contact forces: its directions, its strong chains.

#include "sim/frame/frame.h"

#include <vector>

namespace sandglass::analysis {

/// Fabric tensor F = <n n> over contacts between grains; trace 1, I/3 where directions are random (Satake
/// 1982). `weighted`: each contact by its normal force.
Eigen::Matrix3d fabric(const Frame& frame, bool weighted);

/// sqrt(3/2) times the norm of F - I/3: 0 for random directions, 1 for a single one.
double anisotropy(const Eigen::Matrix3d& fabric);

struct ForceChain {
  std::vector<std::size_t> grains; ///< in order along the chain
};

/// Quasi-linear chains (Peters, Muthuswamy, Wibowo & Tordesillas, Phys. Rev. E 72, 041307, 2005): grains
/// whose largest principal stress (of their own contacts) is above the mean of all; two belong to one chain
/// when they touch and the line between them lies within `angle` [rad] of the principal directions of both.
/// Chains of three or more, longest first.
std::vector<ForceChain> forceChains(const Frame& frame, double angle);

} // namespace sandglass::analysis
