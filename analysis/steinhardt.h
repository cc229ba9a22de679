#pragma once
// Bond order of Steinhardt, Nelson & Ronchetti, Phys. Rev. B 28, 784 (1983).
//
//   q_lm(i) = sum_j w_ij Y_lm(r_ij) / sum_j w_ij over the neighbours j, w = 1 or the area of the Voronoi face
//             (Minkowski structure metrics: Mickel et al., J. Chem. Phys. 138, 044501, 2013)
//   q_l(i)  = sqrt(4 pi / (2 l + 1) sum_m |q_lm|^2)
//   w_l(i)  = sum over m1 + m2 + m3 = 0 of the Wigner 3j symbol (l l l, m1 m2 m3) q_lm1 q_lm2 q_lm3
//             / (sum_m |q_lm|^2)^(3/2)
// averaged (Lechner & Dellago, J. Chem. Phys. 129, 114707, 2008): q_lm replaced by its mean over i and its
// neighbours. A grain without neighbours has NaN, not 0.

#include <complex>
#include <cstdint>
#include <span>
#include <vector>

#include "sim/base/vec.h"

namespace sandglass::analysis {

/// Bonds of all grains: those of grain i are entries start[i] .. start[i + 1] - 1.
struct Bonds {
  std::span<const std::size_t> start;
  std::span<const std::uint32_t> index; ///< the neighbour
  std::span<const Vec3> vector;         ///< towards it, any length > 0
  std::span<const double> weight;       ///< >= 0; empty: all 1
  std::size_t size() const { return start.empty() ? 0 : start.size() - 1; }
};

/// q_lm for m = 0 .. l of each grain, l + 1 numbers in turn; q_l,-m = (-1)^m conj(q_lm).
struct BondOrder {
  int l = 6;
  std::vector<std::complex<double>> q; ///< NaN without neighbours
  std::size_t size() const { return q.size() / static_cast<std::size_t>(l + 1); }
  std::span<const std::complex<double>> of(std::size_t i) const {
    const auto n = static_cast<std::size_t>(l + 1);
    return {q.data() + i * n, n};
  }
};

/// l from 0 to 12. Uses the calling thread's TBB arena.
BondOrder bondOrder(const Bonds& bonds, int l);

/// Mean of q_lm over each grain and its neighbours (those that have one).
BondOrder averaged(const BondOrder& order, const Bonds& bonds);

/// q_l and w_l of each grain.
std::vector<double> magnitudes(const BondOrder& order);
std::vector<double> thirdOrder(const BondOrder& order);

/// s_ij = Re sum_m q_lm(i) conj(q_lm(j)) / (|q_l(i)| |q_l(j)|) for each bond, in the order of the bonds.
std::vector<double> alignment(const BondOrder& order, const Bonds& bonds);

/// The Wigner 3j symbol (l l l; m1 m2 -m1-m2), by Racah's formula.
double wigner3j(int l, int m1, int m2);

} // namespace sandglass::analysis
