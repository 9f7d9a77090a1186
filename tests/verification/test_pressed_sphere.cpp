// A rigid sphere pressed into an elastic, perfectly plastic block far beyond first yield and lifted again:
// force over depth and the dent that stays, beside fits of others to axisymmetric finite elements.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "kernels/blocks/internal_force.hpp"
#include "kernels/material/law_state.hpp"
#include "tests/measured.hpp"
#include "tests/swept_samples.hpp"

namespace tread {
namespace {

constexpr double kRadius = 1.0;  ///< of the sphere [m]
constexpr double kDeepest = 10;  ///< depth over that of first yield [-]

Material perfectly_plastic() {
  Material material = samples::steel();
  material.law = "j2";
  material.yield_stress =
      material.youngs_modulus / (1 - material.poissons_ratio * material.poissons_ratio) / 500;
  return material;
}

/// Sphere and block at first yield, and what follows it. [Jackson and Green 2005, eqs. 4 to 20; Etsion,
/// Kligerman and Kadin 2005, eq. 8]
struct SphereTheory {
  double modulus = 0;  ///< E / (1 - nu^2) [Pa]
  double yield = 0;    ///< [Pa]
  double factor = 0;   ///< C [-]

  explicit SphereTheory(const Material& block)
      : modulus(block.youngs_modulus / (1 - block.poissons_ratio * block.poissons_ratio)),
        yield(block.yield_stress),
        factor(1.295 * std::exp(0.736 * block.poissons_ratio)) {}

  double first_depth() const {  ///< [m]
    const double root = std::acos(-1.0) * factor * yield / (2 * modulus);
    return root * root * kRadius;
  }
  double first_force() const {  ///< [N]
    return 4.0 / 3 * modulus * std::sqrt(kRadius) * std::pow(first_depth(), 1.5);
  }
  /// Force over that of first yield at a depth over that of first yield.
  double force(double depth) const {
    if (depth < 1.9) return std::pow(depth, 1.5);
    const double e = yield / modulus;
    const double b = 0.14 * std::exp(23 * e);
    const double slope = std::acos(-1.0) * factor * e / 2 * std::sqrt(depth) * std::pow(depth / 1.9, 0.5 * b);
    const double hardness = 2.84 * (1 - std::exp(-0.82 * std::pow(slope, -0.7)));
    return std::exp(-0.25 * std::pow(depth, 5.0 / 12)) * std::pow(depth, 1.5) +
           4 * hardness / factor * (1 - std::exp(-0.04 * std::pow(depth, 5.0 / 9))) * depth;
  }
  /// Depth of the dent that stays over the largest depth.
  static double dent(double deepest) {
    return (1 - std::pow(deepest, -0.28)) * (1 - std::pow(deepest, -0.69));
  }
};

/// A quarter of a block, elements of `element` near the sphere and growing away from it to `size`.
class PressedBlock {
 public:
  PressedBlock(double element, double fine, double size) {
    // Stations come in tiles of one pitch.
    std::vector<Segment> segments;
    double reach = 0;
    for (double pitch = element; reach < size; pitch *= reach < fine ? 1 : 1.7) {
      segments.push_back({kLanes / 2, pitch, 0});
      reach += kLanes / 2 * pitch;
    }
    std::vector<double> lines = {0};
    for (double pitch = element; lines.back() < size; pitch *= lines.back() < fine ? 1 : 1.15)
      lines.push_back(lines.back() + pitch);
    Section section;
    rows_ = static_cast<int>(lines.size());
    for (int row = 0; row < rows_; ++row)
      for (int column = 0; column < rows_; ++column) {
        section.p.push_back(lines[static_cast<std::size_t>(column)]);
        section.q.push_back(-lines[static_cast<std::size_t>(rows_ - 1 - row)]);
      }
    for (int row = 0; row + 1 < rows_; ++row)
      for (int column = 0; column + 1 < rows_; ++column) {
        const int node = row * rows_ + column;
        section.quads.push_back({node, node + 1, node + rows_ + 1, node + rows_});
        section.quad_material.push_back(0);
      }
    mesh_.add(make_swept_block("block", Sweep::extruded, section, {perfectly_plastic()}, 0, segments));
    force_.emplace(mesh_);
    laws_.emplace(mesh_);
    const auto values = static_cast<std::size_t>(3 * mesh_.slots);
    u_.assign(values, 0);
    v_.assign(values, 0);
    f_.assign(values, 0);
    mass_.assign(static_cast<std::size_t>(mesh_.slots), 0);
    force_->lumped_mass(mass_.data());
    step_ = 0.9 * 2 / force_->max_frequency(0).omega;
    const Material& steel = mesh_.blocks[0].materials[0];
    // Critical for the slowest wave between surface and ground.
    drag_ = std::acos(-1.0) * std::sqrt(steel.youngs_modulus / steel.density) / lines.back();
  }

  /// Moves the sphere to `depth` below the surface over `steps` steps; returns the mean force on it over the
  /// last twentieth, by all four quarters. [m], [N]
  double move_to(double depth, int steps) {
    const double from = depth_;
    double sum = 0;
    const int last = steps / 20;
    for (int i = 1; i <= steps; ++i) {
      depth_ = from + (depth - from) * i / steps;
      const double force = advance();
      if (i > steps - last) sum += force;
    }
    return 4 * sum / last;
  }

  /// Height of the surface over the undisturbed one below the sphere's middle [m].
  double middle() const { return u_[static_cast<std::size_t>(dof(top(0, 0), 2))]; }
  double dissipated() const { return 4 * force_->energy(0, u_.data(), &*laws_).dissipated; }

 private:
  std::int64_t top(int column, int station) const {
    return mesh_.blocks[0].slot((rows_ - 1) * rows_ + column, station);
  }

  /// One step of central differences; nodes that would come into the sphere move with it. Returns the force
  /// that this takes. [N]
  double advance() {
    force_->internal_force({u_.data(), nullptr, f_.data(), nullptr, &*laws_});
    const SweptBlock& block = mesh_.blocks[0];
    const double keep = (1 - 0.5 * drag_ * step_) / (1 + 0.5 * drag_ * step_);
    const double take = step_ / (1 + 0.5 * drag_ * step_);
    double pushed = 0;
    for (int station = 0; station < block.station_count(); ++station)
      for (int node = 0; node < block.section.nodes(); ++node) {
        const std::int64_t slot = block.slot(node, station);
        const int row = node / rows_;
        const int column = node % rows_;
        const bool far = row == 0 || column == rows_ - 1 || station + 1 == block.station_count();
        for (int c = 0; c < 3; ++c) {
          const auto i = static_cast<std::size_t>(dof(slot, c));
          const bool symmetric = (c == 0 && station == 0) || (c == 1 && column == 0);
          if (far || symmetric) continue;
          v_[i] = keep * v_[i] - take * f_[i] / mass_[static_cast<std::size_t>(slot)];
          if (c == 2 && row == rows_ - 1) {
            const double x = block.stations[static_cast<std::size_t>(station)];
            const double y = block.section.p[static_cast<std::size_t>(node)];
            const double surface = kRadius - std::sqrt(kRadius * kRadius - x * x - y * y) - depth_;
            const double allowed = (surface - u_[i]) / step_;
            if (x * x + y * y < 0.01 * kRadius * kRadius && v_[i] > allowed) {
              pushed += mass_[static_cast<std::size_t>(slot)] * (v_[i] - allowed) / take;
              v_[i] = allowed;
            }
          }
          u_[i] += step_ * v_[i];
        }
      }
    return pushed;
  }

  Mesh mesh_;
  std::optional<InternalForce> force_;
  std::optional<LawState<double>> laws_;
  AlignedVector<double> u_, v_, f_, mass_;
  int rows_ = 0;
  double step_ = 0, drag_ = 0, depth_ = 0;
};

// The fits hold within a few per cent of the finite elements that they were made of; the dent's within ten.
TEST(PressedSphere, ForceAndDentFollowTheFitsOfOthers) {
  const SphereTheory theory(perfectly_plastic());
  const double first = theory.first_depth();
  const double radius = std::sqrt(kDeepest * first * kRadius);  // of the patch at the largest depth, nearly
  PressedBlock block(radius / 8, 1.4 * radius, 14 * radius);
  double before = 0;
  for (const double depth : {1.0, 2.0, 5.0, kDeepest}) {
    const double ratio = block.move_to(depth * first, 900) / theory.first_force() / theory.force(depth);
    measured(fmt::format("force over theory at {} times the depth of first yield", depth), ratio);
    EXPECT_NEAR(ratio, 1, 0.03) << depth;
    EXPECT_EQ(block.dissipated() > 0, depth > 1) << depth;
    EXPECT_GE(block.dissipated(), before);
    before = block.dissipated();
  }
  block.move_to(-0.5 * kDeepest * first, 3000);
  const double dent = -block.middle() / (kDeepest * first);
  measured("dent over largest depth", dent);
  measured("dent over theory", dent / SphereTheory::dent(kDeepest));
  measured("plastic work while the sphere is lifted over that before", block.dissipated() / before - 1);
  EXPECT_NEAR(dent / SphereTheory::dent(kDeepest), 1, 0.12);
  // The block springs back elastically, but for a little at the patch's rim.
  EXPECT_NEAR(block.dissipated() / before, 1, 0.03);
}

}  // namespace
}  // namespace tread
