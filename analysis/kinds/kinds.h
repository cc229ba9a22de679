#pragma once
// One function per analysis, each in its own file; registry.cpp lists them.

#include "analysis/registry.h"

namespace sandglass::analysis {

AnalysisKind pairCorrelationKind();
AnalysisKind bondAngleKind();
AnalysisKind voidsKind();
AnalysisKind voronoiKind();
AnalysisKind orderKind();
AnalysisKind coordinationKind();
AnalysisKind stateKind();
AnalysisKind fieldsKind();
AnalysisKind motionKind();
AnalysisKind mixingKind();
AnalysisKind clumpsKind();
AnalysisKind forcesKind();
AnalysisKind surfaceAngleKind();
AnalysisKind vortexKind();

} // namespace sandglass::analysis
