// An even wind that may fall off along its own direction:  u = w exp(-beta (s - s_0)),  s = x . w / |w|.

#include "sim/fields/field.h"
#include "sim/fields/field_kinds.h"
#include "sim/math/exponential.h"

namespace sandglass {

namespace {

class Wind final : public Field {
public:
  explicit Wind(const Parameters& p)
      : velocity_(p.vector("velocity")), decay_(p.number("decay")), reference_(p.number("reference")) {
    if (velocity_.norm() > 0.0) direction_ = velocity_.normalized();
  }

  void apply(FieldBlock& b, double factor) const override {
    const double ux = factor * velocity_.x(), uy = factor * velocity_.y(), uz = factor * velocity_.z();
    if (decay_ == 0.0) {
      SANDGLASS_GRAINS(i) {
        b.flowX[i] += ux;
        b.flowY[i] += uy;
        b.flowZ[i] += uz;
      }
      return;
    }
    const double nx = direction_.x(), ny = direction_.y(), nz = direction_.z();
    const double decay = decay_, reference = reference_;
    SANDGLASS_GRAINS(i) {
      const double s = nx * b.x[i] + ny * b.y[i] + nz * b.z[i];
      const double share = exponential(-decay * (s - reference));
      b.flowX[i] += ux * share;
      b.flowY[i] += uy * share;
      b.flowZ[i] += uz * share;
    }
  }

  double topSpeed(const Domain&) const override { return velocity_.norm(); }

private:
  Vec3 velocity_, direction_ = Vec3::UnitZ();
  double decay_, reference_;
};

} // namespace

FieldKind windField() {
  ParameterSpec velocity{.name = "velocity",
                         .type = ParameterType::vector,
                         .unit = "m/s",
                         .description = "of the fluid",
                         .minimum = -1e6,
                         .maximum = 1e6};
  ParameterSpec reference = heightReference();
  reference.description = "way along the wind, from the origin, at which it has that velocity";
  return {"wind",
          FieldRole::flow,
          "an even wind, which may fall off exponentially along its own direction",
          "a few operations a grain and step",
          {velocity, heightDecay("rate at which the velocity falls off along the wind"), reference},
          [](const Parameters& p) { return std::make_unique<Wind>(p); }};
}

} // namespace sandglass
