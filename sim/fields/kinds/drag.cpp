// Drag of a fluid on a grain of diameter D and velocity u relative to the fluid,
//   F = -g(|u|) u,   g = c1 + c2 |u|,   c1 = 3 pi eta D (Stokes),  c2 = c_d rho pi D^2 / 8,
// or by Schiller and Naumann (Z. Ver. Dtsch. Ing. 77, 318 (1933)),
//   g = 3 pi eta D (1 + 0.15 Re^0.687),  Re = rho |u| D / eta,  from Re = 1000 on with c_d = 0.44.
// Only the part of u along or across an axis may count. The force may fall off with height and be lessened by
// a shield.
//
// The step does not fear light grains in thick fluids: with k = g dt / m and the acceleration a of all other
// forces, the exact change of velocity for fixed g and a is  (a dt - k u) (1 - e^-k) / k. Here
//   e^-k ~ 1 / (1 + k + k^2 / 2),  so  (1 - e^-k) / k ~ (1 + k/2) / (1 + k + k^2/2),
// right to second order for small k, and for large k the velocity goes to that at which forces balance.

#include "sim/base/error.h"
#include "sim/base/math.h"
#include "sim/fields/field.h"
#include "sim/fields/field_kinds.h"
#include "sim/math/exponential.h"

#include <cmath>
#include <numbers>

namespace sandglass {

namespace {

class Drag final : public Field {
  using Column = FieldBlock::Column;

public:
  explicit Drag(const Parameters& p)
      : strength_(p.number("strength")), decay_(p.number("decay")), reference_(p.number("reference")) {
    const std::string& law = p.text("law");
    schillerNaumann_ = law == "schiller_naumann";
    const bool linear = law == "linear" || law == "both", quadratic = law == "quadratic" || law == "both";
    const bool fluid = p.has("viscosity") || p.has("density");
    const auto need = [&](const char* key) {
      if (!p.has(key)) throw InputError(std::string("a drag with law '") + law + "' needs the key " + key);
      return p.number(key);
    };
    if (schillerNaumann_) {
      viscosity_ = need("viscosity");
      density_ = need("density");
    }
    if (linear) {
      const int given = p.has("linear_coefficient") + p.has("area_coefficient") + p.has("viscosity");
      if (given != 1)
        throw InputError(
            "a linear drag needs exactly one of viscosity, linear_coefficient and area_coefficient");
      linear_ = p.has("viscosity") ? 3.0 * std::numbers::pi * p.number("viscosity")
                                   : p.number("linear_coefficient", 0.0);
      area_ = 0.25 * std::numbers::pi * p.number("area_coefficient", 0.0);
    }
    if (quadratic) {
      if (p.has("density") == p.has("quadratic_coefficient"))
        throw InputError("a quadratic drag needs either density or quadratic_coefficient");
      quadratic_ = p.has("density")
                       ? 0.125 * std::numbers::pi * p.number("drag_coefficient") * p.number("density")
                       : p.number("quadratic_coefficient");
    }
    if (!fluid && schillerNaumann_) throw InputError("needs viscosity and density of the fluid");
    const std::string& acts = p.text("acts");
    acts_ = acts == "all" ? Acts::all : acts == "across" ? Acts::across : Acts::along;
    axis_ = unitAxis(p);
    componentwise_ = p.text("speed") == "componentwise";
  }

  void apply(FieldBlock& b, double factor) const override {
    FieldBlock::Column scale;
    const double strength = factor * strength_;
    if (decay_ > 0.0) {
      const FieldBlock::Column& share = b.falloff(decay_, reference_, axis_);
      SANDGLASS_GRAINS(i) scale[i] = strength * b.exposure[i] * share[i];
    } else {
      SANDGLASS_GRAINS(i) scale[i] = strength * b.exposure[i];
    }
    if (componentwise_)
      act<true>(b, scale);
    else
      act<false>(b, scale);
  }

private:
  enum class Acts { all, across, along };

  template <bool componentwise> void act(FieldBlock& b, const FieldBlock::Column& scale) const {
    switch (acts_) {
    case Acts::all:
      return act<componentwise, Acts::all>(b, scale);
    case Acts::across:
      return act<componentwise, Acts::across>(b, scale);
    case Acts::along:
      return act<componentwise, Acts::along>(b, scale);
    }
  }

  template <bool componentwise, Acts acts> void act(FieldBlock& b, const FieldBlock::Column& scale) const {
    const double nx = axis_.x(), ny = axis_.y(), nz = axis_.z();
    if constexpr (acts != Acts::all)
      if (nx == 0.0 && ny == 0.0) return upright<componentwise, acts>(b, scale);
    FieldBlock::Column ux, uy, uz, qx, qy, qz; // relative velocity and acceleration, the parts that count
    SANDGLASS_GRAINS(i) {
      ux[i] = b.vx[i] - b.flowX[i];
      uy[i] = b.vy[i] - b.flowY[i];
      uz[i] = b.vz[i] - b.flowZ[i];
      qx[i] = b.ax[i];
      qy[i] = b.ay[i];
      qz[i] = b.az[i];
      if constexpr (acts != Acts::all) {
        const double u = nx * ux[i] + ny * uy[i] + nz * uz[i], q = nx * qx[i] + ny * qy[i] + nz * qz[i];
        ux[i] = acts == Acts::along ? u * nx : ux[i] - u * nx;
        uy[i] = acts == Acts::along ? u * ny : uy[i] - u * ny;
        uz[i] = acts == Acts::along ? u * nz : uz[i] - u * nz;
        qx[i] = acts == Acts::along ? q * nx : qx[i] - q * nx;
        qy[i] = acts == Acts::along ? q * ny : qy[i] - q * ny;
        qz[i] = acts == Acts::along ? q * nz : qz[i] - q * nz;
      }
    }
    Column speed, rest, pull;
    const auto slow = [&](Column& a, const Column& q, const Column& u) {
      if constexpr (componentwise) {
        SANDGLASS_GRAINS(i) speed[i] = std::abs(u[i]);
        weigh(speed, b, scale, rest, pull);
      }
      SANDGLASS_GRAINS(i) a[i] -= rest[i] * q[i] + pull[i] * u[i];
    };
    if constexpr (!componentwise) {
      SANDGLASS_GRAINS(i) speed[i] = std::sqrt(ux[i] * ux[i] + uy[i] * uy[i] + uz[i] * uz[i]);
      weigh(speed, b, scale, rest, pull);
    }
    slow(b.ax, qx, ux);
    slow(b.ay, qy, uy);
    slow(b.az, qz, uz);
  }

  /// Along or across an upright axis components count or do not, as they are.
  template <bool componentwise, Acts acts> void upright(FieldBlock& b, const Column& scale) const {
    Column speed, rest, pull;
    const auto slow = [&](Column& a, const Column& v, const Column& flow) {
      SANDGLASS_GRAINS(i) a[i] -= rest[i] * a[i] + pull[i] * (v[i] - flow[i]);
    };
    if constexpr (acts == Acts::along) {
      SANDGLASS_GRAINS(i) speed[i] = std::abs(b.vz[i] - b.flowZ[i]);
      weigh(speed, b, scale, rest, pull);
      slow(b.az, b.vz, b.flowZ);
    } else if constexpr (componentwise) {
      SANDGLASS_GRAINS(i) speed[i] = std::abs(b.vx[i] - b.flowX[i]);
      weigh(speed, b, scale, rest, pull);
      slow(b.ax, b.vx, b.flowX);
      SANDGLASS_GRAINS(i) speed[i] = std::abs(b.vy[i] - b.flowY[i]);
      weigh(speed, b, scale, rest, pull);
      slow(b.ay, b.vy, b.flowY);
    } else {
      SANDGLASS_GRAINS(i) {
        const double x = b.vx[i] - b.flowX[i], y = b.vy[i] - b.flowY[i];
        speed[i] = std::sqrt(x * x + y * y);
      }
      weigh(speed, b, scale, rest, pull);
      slow(b.ax, b.vx, b.flowX);
      slow(b.ay, b.vy, b.flowY);
    }
  }

  /// The change of acceleration is -(rest a + pull u).
  void weigh(const Column& speed, const FieldBlock& b, const Column& scale, Column& rest,
             Column& pull) const {
    const double dt = b.dt;
    Column g;
    if (schillerNaumann_) {
      const double stokes = 3.0 * std::numbers::pi * viscosity_, perSpeed = density_ / viscosity_,
                   newton = 0.44 * 0.125 * std::numbers::pi * density_;
      SANDGLASS_GRAINS(i) {
        const double D = 2.0 * b.radius[i], re = perSpeed * speed[i] * D;
        const double power = powerOfTwo(0.687 * binaryLogarithm(re > 1e-300 ? re : 1e-300));
        const double thick = stokes * D * (1.0 + 0.15 * power), thin = newton * D * D * speed[i];
        g[i] = scale[i] * (re < 1000.0 ? thick : thin);
      }
    } else {
      const double c1 = linear_, c1area = area_, c2 = quadratic_;
      SANDGLASS_GRAINS(i) {
        const double D = 2.0 * b.radius[i];
        g[i] = scale[i] * (c1 * D + (c1area + c2 * speed[i]) * (D * D));
      }
    }
    SANDGLASS_GRAINS(i) {
      const double rate = g[i] * b.inverseMass[i], k = rate * dt;
      const double inverse = 1.0 / (1.0 + k + 0.5 * k * k);
      rest[i] = 0.5 * k * (1.0 + k) * inverse; // 1 - (1 - e^-k) / k
      pull[i] = (1.0 + 0.5 * k) * inverse * rate;
    }
  }

  double strength_, decay_, reference_;
  double linear_ = 0, area_ = 0, quadratic_ = 0; ///< g = linear D + (area + quadratic |u|) D^2
  double viscosity_ = 0, density_ = 0;           ///< [Pa s], [kg/m^3]
  bool schillerNaumann_ = false, componentwise_ = false;
  Acts acts_ = Acts::all;
  Vec3 axis_;
};

} // namespace

FieldKind dragField() {
  const auto choice = [](const char* name, const char* description, const char* fallback,
                         std::vector<std::string> choices) {
    ParameterSpec spec{.name = name,
                       .type = ParameterType::text,
                       .unit = "1",
                       .description = description,
                       .choices = std::move(choices)};
    if (fallback) spec.fallback = std::string(fallback);
    return spec;
  };
  ParameterSpec axis = vortexAxis();
  axis.description = "direction for 'acts' and 'decay'";
  ParameterSpec flows{.name = "flows",
                      .type = ParameterType::texts,
                      .unit = "1",
                      .description = "names of the flows that it feels; all, when left out",
                      .optional = true};
  return {
      "drag",
      FieldRole::drag,
      "a force that draws the velocity of a grain to that of the fluid; still air without flows",
      "some ten operations a grain and step",
      {choice("law", "how it grows with speed", nullptr, {"linear", "quadratic", "both", "schiller_naumann"}),
       flows, optionalNumber("viscosity", "Pa*s", "of the fluid", 0, true),
       optionalNumber("density", "kg/m^3", "of the fluid", 0, true),
       fieldNumber("drag_coefficient", "1", "of the quadratic part, with 'density'", 0, false, 0.47),
       optionalNumber("linear_coefficient", "kg/(m*s)", "force over speed and diameter", 0),
       optionalNumber("area_coefficient", "kg/(m^2*s)", "force over speed and cross-section", 0),
       optionalNumber("quadratic_coefficient", "kg/m^3", "force over speed and diameter, both squared", 0),
       choice("acts", "which part of the velocity counts and is changed", "all", {"all", "across", "along"}),
       axis, fieldNumber("strength", "1", "factor of the force", 0, false, 1.0),
       heightDecay("rate at which the force falls off along the axis"), heightReference(),
       choice("speed",
              "speed in the quadratic part: the magnitude, or each component by itself, which is not the "
              "same in all directions",
              "magnitude", {"magnitude", "componentwise"})},
      [](const Parameters& p) { return std::make_unique<Drag>(p); }};
}

} // namespace sandglass
