// The counting shield: a wind from below reaches a grain weakened by alpha for each grain in its way, so its
// drag is alpha^N of what it were alone (ShieldCounts says who is in the way). A stack of four feels 1,
// alpha, alpha^2, alpha^3 from bottom to top.

#include "sim/fields/field.h"
#include "sim/fields/field_kinds.h"
#include "sim/fields/shield_counts.h"

#include <cmath>

namespace sandglass {

namespace {

class Shield final : public Field {
public:
  explicit Shield(const Parameters& p) : ratio_(p.number("ratio")) {}

  bool looks() const override { return true; }
  void list(const GrainStore& grains, const PairList&, Parallel& parallel) override {
    counts_.list(grains, parallel);
  }
  void look(const GrainStore& grains, const PairList&, Parallel& parallel) override {
    counts_.count(grains, parallel);
    for (std::size_t n = powers_.size(); n <= grains.size(); ++n)
      powers_.push_back(n == 0 ? 1.0 : powers_.back() * ratio_);
  }

  /// The factor multiplies what the shield keeps off, 1 - alpha^N.
  void apply(FieldBlock& b, double factor) const override {
    for (int i = 0; i < b.size; ++i) {
      const double share = powers_[counts_.of(b.first + i)];
      b.exposure[i] *= factor == 1.0 ? share : 1.0 - factor * (1.0 - share);
    }
  }

private:
  double ratio_;
  ShieldCounts counts_;
  std::vector<double> powers_; ///< of the ratio
};

} // namespace

FieldKind shieldField() {
  ParameterSpec ratio{.name = "ratio",
                      .type = ParameterType::number,
                      .unit = "1",
                      .description = "share of the drag that each grain below leaves",
                      .minimum = 0,
                      .maximum = 1};
  ParameterSpec of{.name = "of",
                   .type = ParameterType::texts,
                   .unit = "1",
                   .description = "names of the drags that it lessens; all, when left out",
                   .optional = true};
  return {"shield",
          FieldRole::shield,
          "grains below another shield it from the fluid that rises",
          "8 bytes a grain, a look at the few pairs in doubt a step, columns searched with each new list",
          {ratio, of},
          [](const Parameters& p) { return std::make_unique<Shield>(p); }};
}

} // namespace sandglass
