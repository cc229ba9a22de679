#pragma once
// Mass per time through a plane, from the sides on which grains were at two samples.

#include "sim/run/probe.h"

namespace sandglass {

/// A grain counts when it changed sides since the last sample, negative when it came back. A grain that left
/// the run in between counts when it was last seen before the plane and an outlet lies on the plane or beyond
/// it; one that was put back meanwhile has left once for each life, and has entered again where its outlet
/// puts grains. A jump of more than half the domain along a periodic direction is a grain that came round,
/// not one that crossed.
class FlowRateProbe final : public Probe {
public:
  FlowRateProbe(const Parameters& parameters, const Scene& scene);
  std::vector<std::string> values() const override { return {"rate", "mass"}; }
  std::vector<double> sample(const Solver& solver) override;
  std::vector<std::byte> save() const override;
  void load(const std::vector<std::byte>& bytes) override;

private:
  struct Seen {
    std::int64_t id;
    double distance, mass; ///< signed distance from the plane [m], [kg]
    std::int64_t life;
  };

  const Scene& scene_;
  Vec3 point_, normal_;
  double halfPeriod_; ///< [m] along the normal; infinite when nothing is periodic there
  bool outletBeyond_, entersBefore_ = false; ///< the latter: where grains are put back
  std::vector<Seen> last_;                   ///< ascending id
  double lastTime_ = -1, total_ = 0;
};

} // namespace sandglass
