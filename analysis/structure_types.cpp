#include "analysis/structure_types.h"

namespace sandglass::analysis {

StructureType structureType(double q4, double q6, double w4, double w6, bool atWall,
                            const StructureThresholds& limits) {
  if (q4 > limits.q4) return StructureType::simpleCubic;
  if (!(q6 > limits.q6)) return atWall ? StructureType::wallLayer : StructureType::amorphous;
  if (w6 > 0) return StructureType::bodyCentred;
  return w4 < 0 ? StructureType::faceCentred : StructureType::hexagonal;
}

const std::map<int, std::string>& structureNames() {
  static const std::map<int, std::string> names{{0, "amorphous"}, {1, "wall layer"}, {2, "fcc-like"},
                                                {3, "hcp-like"},  {4, "bcc-like"},   {5, "sc-like"}};
  return names;
}

} // namespace sandglass::analysis
