#include <gtest/gtest.h>

#include <cmath>

#include "core/error.hpp"
#include "core/parallel/chunks.hpp"
#include "kernels/solver/lowest_modes.hpp"

namespace tread {
namespace {

/// A chain of unit springs between equal masses, both ends free, on every eighth unknown of a longer field.
struct Chain {
  static constexpr std::size_t kMasses = 200, kStride = 8;
  static constexpr double kMass = 0.25;

  AlignedVector<double> mass = AlignedVector<double>(kMasses * kStride, 0.0);
  Chain() {
    for (std::size_t i = 0; i < kMasses; ++i) mass[i * kStride] = kMass;
  }
  static void apply(const double* x, double* y) {
    std::fill(y, y + kMasses * kStride, 0.0);
    for (std::size_t i = 0; i + 1 < kMasses; ++i) {
      const double pull = x[(i + 1) * kStride] - x[i * kStride];
      y[i * kStride] -= pull;
      y[(i + 1) * kStride] += pull;
    }
  }
  static double omega(int mode) {
    return 2 / std::sqrt(kMass) * std::sin(0.5 * M_PI * mode / static_cast<double>(kMasses));
  }
};

/// Solves (K + shift M) z = r of the chain exactly except for a part: z / 2 + (K + shift M)^-1 r.
class NearlyExact : public Preconditioner {
 public:
  explicit NearlyExact(double shift) : shift_(shift) {}
  void apply(const double* r, double* z) const override {
    // Thomas' algorithm.
    constexpr std::size_t n = Chain::kMasses;
    std::vector<double> above(n, 0.0), value(n, 0.0);
    for (std::size_t i = 0; i < n; ++i) {
      const double ends = i == 0 || i + 1 == n ? 1 : 2;
      const double pivot = ends + shift_ * Chain::kMass + (i > 0 ? above[i - 1] : 0.0);
      above[i] = -1 / pivot;
      value[i] = (r[i * Chain::kStride] + (i > 0 ? value[i - 1] : 0.0)) / pivot;
    }
    std::fill(z, z + n * Chain::kStride, 0.0);
    for (std::size_t i = n; i-- > 0;)
      z[i * Chain::kStride] = value[i] - (i + 1 < n ? above[i] * z[(i + 1) * Chain::kStride] : 0.0);
    for (std::size_t i = 0; i < n; ++i) z[i * Chain::kStride] += 0.5 * r[i * Chain::kStride];
  }

 private:
  double shift_;
};

TEST(LowestModes, OfAFreeChain) {
  const Chain chain;
  constexpr double shift = 1e-3;
  LowestModesOptions options;
  options.count = 6;
  options.shift = shift;
  const LowestModes modes = lowest_modes(Chain::apply, chain.mass, NearlyExact(shift), options);
  ASSERT_EQ(modes.omega.size(), 6u);
  EXPECT_LT(modes.omega[0], 1e-5);  // the rigid motion
  for (int k = 1; k < 6; ++k)
    EXPECT_NEAR(modes.omega[static_cast<std::size_t>(k)] / Chain::omega(k), 1, 1e-3) << k;
  AlignedVector<double> weighted = modes.shapes[3];
  for (std::size_t i = 0; i < weighted.size(); ++i) weighted[i] *= chain.mass[i];
  const auto n = static_cast<std::int64_t>(weighted.size());
  EXPECT_NEAR(dot(n, weighted.data(), modes.shapes[3].data()), 1, 1e-9);
  EXPECT_NEAR(dot(n, weighted.data(), modes.shapes[2].data()), 0, 1e-9);
}

TEST(LowestModes, SayWhenTheyDoNotConverge) {
  const Chain chain;
  LowestModesOptions options;
  options.count = 4;
  options.shift = 1e-3;
  options.max_iterations = 2;
  EXPECT_THROW(lowest_modes(Chain::apply, chain.mass, JacobiPreconditioner(chain.mass), options),
               NumericalError);
}

}  // namespace
}  // namespace tread
