#pragma once
// One function per law, each in its own file; law_registry.cpp lists them.

#include "sim/contact/law.h"

namespace sandglass {

LawKind linearNormalLaw();
LawKind waltonBraunNormalLaw();
LawKind hertzNormalLaw();
LawKind noTangentialLaw();
LawKind springTangentialLaw();
LawKind mindlinTangentialLaw();
LawKind noRollingLaw();
LawKind elasticPlasticRollingLaw();

} // namespace sandglass
