#include "sim/contact/law_registry.h"

#include "sim/contact/laws/laws.h"

namespace sandglass {

const std::vector<LawKind>& lawKinds() {
  static const std::vector<LawKind> kinds{
      linearNormalLaw(),
      waltonBraunNormalLaw(),
      hertzNormalLaw(),
      dmtNormalLaw(),
      jkrNormalLaw(),
      riceNormalLaw(),
      noTangentialLaw(),
      viscousTangentialLaw(),
      springTangentialLaw(),
      mindlinTangentialLaw(),
      waltonTangentialLaw(),
      riceTangentialLaw(),
      noRollingLaw(),
      constantTorqueRollingLaw(),
      elasticPlasticRollingLaw(),
      noTorsionLaw(),
      constantTorqueTorsionLaw(),
      elasticPlasticTorsionLaw(),
      vanDerWaalsLaw(),
      coulombLaw(),
  };
  return kinds;
}

const LawKind* findLaw(LawRole role, const std::string& name) {
  for (const LawKind& kind : lawKinds())
    if (kind.role == role && kind.name == name) return &kind;
  return nullptr;
}

} // namespace sandglass
