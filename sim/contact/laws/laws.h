#pragma once
// One function per law, each in its own file; law_registry.cpp lists them.

#include "sim/contact/law.h"

namespace sandglass {

LawKind linearNormalLaw();
LawKind waltonBraunNormalLaw();
LawKind hertzNormalLaw();
LawKind dmtNormalLaw();
LawKind jkrNormalLaw();
LawKind riceNormalLaw();
LawKind noTangentialLaw();
LawKind viscousTangentialLaw();
LawKind springTangentialLaw();
LawKind mindlinTangentialLaw();
LawKind waltonTangentialLaw();
LawKind riceTangentialLaw();
LawKind noRollingLaw();
LawKind constantTorqueRollingLaw();
LawKind elasticPlasticRollingLaw();
LawKind noTorsionLaw();
LawKind constantTorqueTorsionLaw();
LawKind elasticPlasticTorsionLaw();
LawKind vanDerWaalsLaw();
LawKind coulombLaw();

} // namespace sandglass
