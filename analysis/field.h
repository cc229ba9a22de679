#pragma once
// Quantities on a regular grid, and their file: VTK image data, which ParaView opens.

#include "sim/base/vec.h"

#include <array>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace sandglass::analysis {

/// Values at the nodes origin + (i, j, k) spacing; the x index runs fastest. NaN: no grains near.
struct Field {
  std::string name, title, definition;
  Vec3 origin = Vec3::Zero(), spacing = Vec3::Ones(); ///< [m]
  std::array<int, 3> count{1, 1, 1};
  std::map<std::string, std::vector<double>> scalars;
  std::map<std::string, std::vector<Vec3>> vectors;
  std::map<std::string, std::vector<Eigen::Matrix3d>> tensors;
  std::map<std::string, std::string> units; ///< SI symbol by name of the array
  std::size_t frames = 0;                   ///< averaged
  std::map<std::string, std::string> provenance;

  std::size_t size() const { return static_cast<std::size_t>(count[0]) * count[1] * count[2]; }
  std::size_t at(int i, int j, int k) const {
    return (static_cast<std::size_t>(k) * count[1] + j) * count[0] + i;
  }
  Vec3 node(int i, int j, int k) const { return origin + spacing.cwiseProduct(Vec3(i, j, k)); }
};

/// XML text of VTK image data (.vti), values as base64 of little-endian doubles; definition, units and
/// provenance as field data.
std::string toVti(const Field& field);

} // namespace sandglass::analysis
