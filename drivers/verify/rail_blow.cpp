#include "drivers/verify/rail_blow.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "drivers/engine/start/step_limit.hpp"

namespace tread {

RailAxis::RailAxis(const Model& model) : model_(&model) {
  for (const int b : model.index.rail()) {
    const SweptBlock& block = model.mesh.blocks[static_cast<std::size_t>(b)];
    const double* first = model.mass.data() + block.base;
    const double mass = std::accumulate(first, first + block.slots(), 0.0);
    parts_.push_back({&block, mass / (block.stations.back() - block.stations.front())});
  }
}

/// Mean of a block's nodes at a station.
double RailAxis::deflection(const Part& part, int station, ConstNodeField u) const {
  double sum = 0;
  double mass = 0;
  for (int node = 0; node < part.block->section.nodes(); ++node) {
    const std::int64_t slot = part.block->base + part.block->slot(node, station);
    const double m = model_->mass[static_cast<std::size_t>(slot)];
    sum -= m * u[dof(slot, 2)];
    mass += m;
  }
  return sum / mass;
}

double RailAxis::deflection(double x, ConstNodeField u) const {
  double sum = 0;
  double mass = 0;
  for (const Part& part : parts_) {
    const std::vector<double>& places = part.block->stations;
    const auto above = std::upper_bound(places.begin() + 1, places.end() - 1, x);
    const auto i = static_cast<int>(above - places.begin()) - 1;
    const double share = (x - *(above - 1)) / (*above - *(above - 1));
    sum += part.mass * ((1 - share) * deflection(part, i, u) + share * deflection(part, i + 1, u));
    mass += part.mass;
  }
  return sum / mass;
}

EnergyLedger run_blow(Model& model, double interval, const BlowSample& sample, const ProgressText& progress) {
  const MotionSpec& motion = *model.scene.motion;
  const Preload preload = solve_preload(model, {}, progress);
  // The sampling interval is a whole number of steps.
  const double stable = motion.step_safety * step_limit(model).stable_step;
  const auto every = static_cast<std::int64_t>(std::ceil(interval / stable));
  const double dt = interval / static_cast<double>(every);
  const auto samples = static_cast<std::int64_t>(std::ceil(motion.duration / interval));
  Simulation simulation(model, preload, dt);
  simulation.set_sampling_interval(every);
  progress(fmt::format("{} elements, {} steps of {:.3e} s", model.elements(), samples * every, dt));
  for (std::int64_t i = 0; i <= samples * every; ++i) {
    if (i % every == 0) sample(simulation.time(), simulation.displacement());
    simulation.step();
  }
  return simulation.sample().energy;
}

namespace {

/// Share of the values' squares that a harmonic of this frequency explains.
double explained(const std::vector<double>& values, double step_angle) {
  double ss = 0, cc = 0, sc = 0, vs = 0, vc = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double s = std::sin(step_angle * static_cast<double>(i));
    const double c = std::cos(step_angle * static_cast<double>(i));
    ss += s * s;
    cc += c * c;
    sc += s * c;
    vs += values[i] * s;
    vc += values[i] * c;
  }
  const double det = ss * cc - sc * sc;
  return (vs * vs * cc - 2 * vs * vc * sc + vc * vc * ss) / det;
}

}  // namespace

double harmonic_frequency(const std::vector<double>& values, double interval, double low, double high) {
  const double turn = 2 * std::numbers::pi * interval;
  // The search starts with a quarter of the resolution 1 / T and refines about the best frequency.
  double pitch = 0.25 / (interval * static_cast<double>(values.size()));
  double best = low;
  double most = -1;
  for (double f = low; f <= high; f += pitch) {
    const double share = explained(values, turn * f);
    if (share <= most) continue;
    most = share;
    best = f;
  }
  for (int i = 0; i < 24; ++i) {
    pitch *= 0.5;
    for (const double f : {best - pitch, best + pitch}) {
      const double share = explained(values, turn * f);
      if (share <= most) continue;
      most = share;
      best = f;
      break;
    }
  }
  return best;
}

}  // namespace tread
