#pragma once
// The fixed tables of a scene file: which keys each has, and the way between those keys and the structs of
// scene.h. Reading and writing share the lists, so that what is written reads back.

#include "sim/scene/scene.h"

#include <vector>

namespace sandglass {

using Keys = std::vector<ParameterSpec>;

const Keys& sceneKeys(); ///< the root: title, seed, gravity, ...
const Keys& domainKeys();
const Keys& wedgeKeys();
const Keys& materialKeys();
const Keys& contactKeys(); ///< beside the laws
const Keys& speciesKeys(); ///< beside `size`
const Keys& wallKeys();    ///< beside kind and its parameters
const Keys& fieldKeys();   ///< beside kind and its parameters
const Keys& outletKeys();  ///< beside `recycle`
const Keys& recycleKeys();
const Keys& fillKeys();  ///< beside kind, mixture and the kind's parameters
const Keys& shareKeys(); ///< one entry of a mixture
const Keys& stageKeys(); ///< beside `until`
const Keys& untilKeys();
const Keys& eventKeys();
const Keys& probeKeys(); ///< beside kind and its parameters
const Keys& outputKeys();
const Keys& accuracyKeys();

// From checked values; keys that are absent leave the target as it is.
void load(const Parameters& values, Scene& scene);
void load(const Parameters& values, Domain& domain);
void load(const Parameters& values, WedgeSpec& wedge);
void load(const Parameters& values, Material& material);
void load(const Parameters& values, ContactSpec& contact);
void load(const Parameters& values, Species& species);
void load(const Parameters& values, WallSpec& wall);
void load(const Parameters& values, FieldSpec& field);
void load(const Parameters& values, OutletSpec& outlet);
void load(const Parameters& values, RecycleSpec& recycle);
void load(const Parameters& values, FillSpec& fill);
void load(const Parameters& values, Share& share);
void load(const Parameters& values, StageSpec& stage); ///< of stageKeys and of untilKeys
void load(const Parameters& values, EventSpec& event);
void load(const Parameters& values, ProbeSpec& probe);
void load(const Parameters& values, OutputSpec& output);
void load(const Parameters& values, AccuracySpec& accuracy);

// To values, for writing.
Parameters store(const Scene& scene);
Parameters store(const Domain& domain);
Parameters store(const WedgeSpec& wedge);
Parameters store(const Material& material);
Parameters store(const ContactSpec& contact);
Parameters store(const Species& species);
Parameters store(const WallSpec& wall);
Parameters store(const FieldSpec& field);
Parameters store(const OutletSpec& outlet);
Parameters store(const RecycleSpec& recycle);
Parameters store(const FillSpec& fill);
Parameters store(const Share& share);
Parameters store(const StageSpec& stage);
Parameters storeUntil(const StageSpec& stage);
Parameters store(const EventSpec& event);
Parameters store(const ProbeSpec& probe);
Parameters store(const OutputSpec& output);
Parameters store(const AccuracySpec& accuracy);

} // namespace sandglass
