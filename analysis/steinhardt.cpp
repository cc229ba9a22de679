#include "analysis/steinhardt.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace sandglass::analysis {

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr int greatest = 12;

double factorial(int n) {
  double f = 1;
  for (int k = 2; k <= n; ++k)
    f *= k;
  return f;
}

/// Y_lm(v) for m = 0 .. l as (x + i y)^m times a polynomial in z: no angles, no trigonometric functions.
/// The associated Legendre function divided by sin^m obeys, for fixed m,
///   P_m = (2m - 1)!! (with the sign (-1)^m),  P_(m+1) = (2m + 1) z P_m,
///   (n - m) P_n = (2n - 1) z P_(n-1) - (n + m - 1) P_(n-2).
class Harmonics {
public:
  explicit Harmonics(int l) : l_(l) {
    for (int m = 0; m <= l; ++m)
      scale_[m] = std::sqrt((2 * l + 1) / (4 * std::numbers::pi) * factorial(l - m) / factorial(l + m));
    for (int m = 0; m <= l; ++m) {
      for (auto& c : coefficient_[m])
        c = 0;
      // Coefficients of z^k in P_l of this m.
      std::array<double, greatest + 1> before{}, now{};
      now[0] = m % 2 ? -1 : 1;
      for (int k = 1; k < 2 * m; k += 2)
        now[0] *= k;
      for (int n = m + 1; n <= l; ++n) {
        std::array<double, greatest + 1> next{};
        for (int k = 0; k < n - m; ++k)
          next[k + 1] += (2 * n - 1) * now[k] / (n - m);
        for (int k = 0; k + 1 < n - m; ++k)
          next[k] -= (n + m - 1) * before[k] / (n - m);
        before = now;
        now = next;
      }
      for (int k = 0; k <= l - m; ++k)
        coefficient_[m][k] = scale_[m] * now[k];
    }
  }

  void add(const Vec3& unit, double weight, std::complex<double>* q) const {
    const double z = unit.z(), z2 = z * z;
    double re = weight, im = 0;
    for (int m = 0; m <= l_; ++m) {
      // Only powers of one parity occur: Horner in z^2.
      const auto& c = coefficient_[m];
      double p = 0;
      int k = l_ - m;
      for (; k >= 0; k -= 2)
        p = p * z2 + c[k];
      if ((l_ - m) % 2) p *= z;
      q[m] += std::complex<double>(re * p, im * p);
      const double r = re * unit.x() - im * unit.y();
      im = re * unit.y() + im * unit.x();
      re = r;
    }
  }

private:
  int l_;
  std::array<double, greatest + 1> scale_{};
  std::array<std::array<double, greatest + 1>, greatest + 1> coefficient_{};
};

double squared(std::span<const std::complex<double>> q) {
  double sum = std::norm(q[0]);
  for (std::size_t m = 1; m < q.size(); ++m)
    sum += 2 * std::norm(q[m]);
  return sum;
}

template <class Work> void eachGrain(std::size_t n, Work&& work) {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, n, 512), [&](const auto& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i)
      work(i);
  });
}

} // namespace

BondOrder bondOrder(const Bonds& bonds, int l) {
  const Harmonics harmonics(l);
  const auto width = static_cast<std::size_t>(l + 1);
  BondOrder order{l, std::vector<std::complex<double>>(bonds.size() * width)};
  eachGrain(bonds.size(), [&](std::size_t i) {
    std::complex<double>* q = order.q.data() + i * width;
    double sum = 0;
    for (std::size_t k = bonds.start[i]; k < bonds.start[i + 1]; ++k) {
      const double w = bonds.weight.empty() ? 1 : bonds.weight[k];
      if (!(w > 0)) continue;
      harmonics.add(bonds.vector[k].normalized(), w, q);
      sum += w;
    }
    for (std::size_t m = 0; m < width; ++m)
      q[m] = sum > 0 ? q[m] / sum : std::complex<double>(nan, nan);
  });
  return order;
}

BondOrder averaged(const BondOrder& order, const Bonds& bonds) {
  const auto width = static_cast<std::size_t>(order.l + 1);
  BondOrder mean{order.l, std::vector<std::complex<double>>(order.q.size())};
  eachGrain(bonds.size(), [&](std::size_t i) {
    std::complex<double>* q = mean.q.data() + i * width;
    double count = 1;
    for (std::size_t m = 0; m < width; ++m)
      q[m] = order.of(i)[m];
    for (std::size_t k = bonds.start[i]; k < bonds.start[i + 1]; ++k) {
      const auto other = order.of(bonds.index[k]);
      if (std::isnan(other[0].real())) continue;
      for (std::size_t m = 0; m < width; ++m)
        q[m] += other[m];
      count += 1;
    }
    for (std::size_t m = 0; m < width; ++m)
      q[m] /= count;
  });
  return mean;
}

std::vector<double> magnitudes(const BondOrder& order) {
  std::vector<double> values(order.size());
  eachGrain(order.size(), [&](std::size_t i) {
    values[i] = std::sqrt(4 * std::numbers::pi / (2 * order.l + 1) * squared(order.of(i)));
  });
  return values;
}

double wigner3j(int l, int m1, int m2) {
  const int m3 = -m1 - m2;
  if (std::abs(m1) > l || std::abs(m2) > l || std::abs(m3) > l) return 0;
  const double delta = std::pow(factorial(l), 3) / factorial(3 * l + 1);
  const double product = factorial(l + m1) * factorial(l - m1) * factorial(l + m2) * factorial(l - m2) *
                         factorial(l + m3) * factorial(l - m3);
  double sum = 0;
  for (int k = 0; k <= l; ++k) {
    if (l - k - m1 < 0 || l - k + m2 < 0 || k + m1 < 0 || k - m2 < 0) continue;
    sum += (k % 2 ? -1 : 1) / (factorial(k) * factorial(l - k) * factorial(l - k - m1) *
                               factorial(l - k + m2) * factorial(k + m1) * factorial(k - m2));
  }
  return (m3 % 2 ? -1 : 1) * std::sqrt(delta * product) * sum;
}

std::vector<double> thirdOrder(const BondOrder& order) {
  const int l = order.l;
  struct Term {
    int m1, m2;
    double factor;
  };
  std::vector<Term> terms;
  for (int m1 = -l; m1 <= l; ++m1)
    for (int m2 = -l; m2 <= l; ++m2)
      if (std::abs(m1 + m2) <= l) terms.push_back({m1, m2, wigner3j(l, m1, m2)});
  std::vector<double> values(order.size());
  eachGrain(order.size(), [&](std::size_t i) {
    const auto positive = order.of(i);
    std::array<std::complex<double>, 2 * greatest + 1> q;
    for (int m = 0; m <= l; ++m) {
      q[static_cast<std::size_t>(l + m)] = positive[static_cast<std::size_t>(m)];
      q[static_cast<std::size_t>(l - m)] =
          (m % 2 ? -1.0 : 1.0) * std::conj(positive[static_cast<std::size_t>(m)]);
    }
    double sum = 0;
    for (const auto& t : terms)
      sum += t.factor * (q[static_cast<std::size_t>(l + t.m1)] * q[static_cast<std::size_t>(l + t.m2)] *
                         q[static_cast<std::size_t>(l - t.m1 - t.m2)])
                            .real();
    values[i] = sum / std::pow(squared(positive), 1.5);
  });
  return values;
}

std::vector<double> alignment(const BondOrder& order, const Bonds& bonds) {
  std::vector<double> norm(order.size());
  eachGrain(order.size(), [&](std::size_t i) { norm[i] = std::sqrt(squared(order.of(i))); });
  std::vector<double> s(bonds.index.size());
  eachGrain(bonds.size(), [&](std::size_t i) {
    const auto a = order.of(i);
    for (std::size_t k = bonds.start[i]; k < bonds.start[i + 1]; ++k) {
      const auto b = order.of(bonds.index[k]);
      double sum = (a[0] * std::conj(b[0])).real();
      for (std::size_t m = 1; m < a.size(); ++m)
        sum += 2 * (a[m] * std::conj(b[m])).real();
      s[k] = sum / (norm[i] * norm[bonds.index[k]]);
    }
  });
  return s;
}

} // namespace sandglass::analysis
