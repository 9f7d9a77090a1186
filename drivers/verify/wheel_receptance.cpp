// Receptance of the free half wheelset at the contact patch, against harmonics in the frequency domain.

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <map>
#include <numbers>

#include "core/error.hpp"
#include "core/math/raised_cosine.hpp"
#include "drivers/engine/simulation.hpp"
#include "drivers/engine/start/step_limit.hpp"
#include "drivers/verify/cases.hpp"
#include "drivers/verify/free_wheelset.hpp"
#include "kernels/harmonics/harmonic_solid.hpp"
#include "kernels/update/inverse_mass.hpp"

namespace tread {

namespace {

using Complex = std::complex<double>;
using ReceptanceCurve = std::vector<Complex>;  ///< receptance by frequency [m/N]

constexpr double kLowestFrequency = 100, kHighestFrequency = 3000;  // [Hz]
constexpr int kFrequencies = 600;
constexpr double kHalfAcross = 20e-3;  ///< half the width of the loaded region [m]
constexpr double kHalfAround = 25e-3;  ///< half its length around the tread [m]
constexpr double kDepth = 20e-3;       ///< its depth under the rolling circle [m]

/// Direction of force and motion at the bottom of the tread: components of SweptBlock.
struct Direction3 {
  const char* name;
  int component;
};
constexpr std::array<Direction3, 3> kDirections = {
    {{"along the rail", 0}, {"across the rail", 1}, {"vertical", 2}}};

/// Laplace variables: the motion fades by e^-(decay t), so that an undamped body needs no more than a finite
/// time.
std::vector<Complex> variables(double decay) {
  std::vector<Complex> s;
  for (int i = 0; i <= kFrequencies; ++i)
    s.emplace_back(decay, 2 * std::numbers::pi * kLowestFrequency *
                              std::pow(kHighestFrequency / kLowestFrequency, 1.0 * i / kFrequencies));
  return s;
}

/// The loaded region under the model's tread: nodal shares of a unit force.
struct LoadedRegion {
  struct Node {
    std::int64_t slot;
    Vec3 place;  ///< components (t, y, r) [m]
    double angle;
    double weight;
  };
  std::vector<Node> nodes;
};

/// Density of the load over the section, largest at the surface.
double section_density(const Model& model, double p, double q) {
  return raised_cosine(p, kHalfAcross) * raised_cosine(model.wheel_radius() - q, kDepth);
}

LoadedRegion loaded_region(const Model& model) {
  const SweptBlock& tread = model.mesh.blocks[static_cast<std::size_t>(model.index.tread)];
  LoadedRegion region;
  double sum = 0;
  const double half = kHalfAround / model.wheel_radius();
  for (int station = 0; station < tread.station_count(); ++station) {
    const double angle =
        std::remainder(tread.stations[static_cast<std::size_t>(station)], 2 * std::numbers::pi);
    const double around = raised_cosine(angle, half);
    for (int node = 0; around > 0 && node < tread.section.nodes(); ++node) {
      const double p = tread.section.p[static_cast<std::size_t>(node)];
      const double q = tread.section.q[static_cast<std::size_t>(node)];
      const std::int64_t slot = tread.base + tread.slot(node, station);
      const double weight =
          around * section_density(model, p, q) * model.mass[static_cast<std::size_t>(slot)];
      if (weight == 0) continue;
      sum += weight;
      region.nodes.push_back({slot, {0, p, q}, angle, weight});
    }
  }
  for (LoadedRegion::Node& node : region.nodes) node.weight /= sum;
  return region;
}

/// Mean displacement of the region in a direction of its nodes' undeformed places [m].
double displacement(const LoadedRegion& region, int component, const Simulation& simulation) {
  const BodyFrame& frame = simulation.wheel();
  double sum = 0;
  for (const LoadedRegion::Node& node : region.nodes) {
    Vec3 u;
    for (int c = 0; c < 3; ++c) u[c] = simulation.displacement()[dof(node.slot, c)];
    const Vec3 moved =
        turn(node.place + u, frame.angle) - node.place + cartesian_to_cylindrical(node.angle, frame.origin);
    sum += node.weight * moved[component];
  }
  return sum;
}

/// Receptance from the step: an impulse on the region, and the transform of the region's velocity, which ends
/// with less of a step than its drifting displacement.
ReceptanceCurve receptance_of_step(const Model& model, const LoadedRegion& region, int component,
                                   const std::vector<Complex>& s, const ProgressText& progress) {
  constexpr double kImpulse = 1;      // [N s]
  constexpr double kInterval = 5e-6;  // most between samples [s]
  Preload rest;
  rest.displacement.assign(static_cast<std::size_t>(3 * model.mesh.slots), 0.0);
  const double stable = model.scene.motion->step_safety * step_limit(model).stable_step;
  const auto every = std::max<std::int64_t>(1, static_cast<std::int64_t>(kInterval / stable));
  Simulation simulation(model, rest, stable);
  simulation.set_sampling_interval(1 << 20);
  const StateList state = simulation.state();
  for (const StateList::Field& field : state.fields()) {
    if (field.name != "velocity") continue;
    const auto velocity = std::get<std::span<double>>(field.values);
    for (const LoadedRegion::Node& node : region.nodes)
      velocity[static_cast<std::size_t>(dof(node.slot, component))] =
          kImpulse * node.weight * inverse_mass(model.mass[static_cast<std::size_t>(node.slot)]);
  }
  const auto steps = static_cast<std::int64_t>(std::ceil(model.scene.motion->duration / stable));
  progress(fmt::format("{} elements, {} steps of {:.3e} s", model.elements(), steps, stable));
  ReceptanceCurve out(s.size());
  const double interval = static_cast<double>(every) * stable;
  double before = 0;
  while (simulation.steps() < steps) {
    for (std::int64_t i = 0; i < every; ++i) simulation.step();
    const double u = displacement(region, component, simulation);
    const double middle = simulation.time() - 0.5 * interval;
    for (std::size_t i = 0; i < s.size(); ++i)
      out[i] += (u - before) / kImpulse / s[i] * std::exp(-s[i] * middle);
    before = u;
  }
  return out;
}

/// Receptances in all directions by harmonics.
std::array<ReceptanceCurve, 3> receptance_of_harmonics(const Model& model, const std::vector<Complex>& s,
                                                       const ProgressText& progress) {
  const auto part = [&](int block) {
    const SweptBlock& b = model.mesh.blocks[static_cast<std::size_t>(block)];
    return SolidPart{b.section, b.materials.front()};
  };
  constexpr std::size_t kTread = 0, kDisc = 1, kAxle = 2;
  HarmonicSolid solid({part(model.index.tread), part(model.index.disc), part(model.index.axle)},
                      {{kTread, "tie", kDisc, "tie_outer"}, {kDisc, "tie_inner", kAxle, "tie"}});
  solid.hold(kAxle, "symmetry_end", 1);
  std::vector<std::vector<double>> loads;
  for (const Direction3& direction : kDirections)
    loads.push_back(solid.body_load(kTread, direction.component,
                                    [&](double p, double q) { return section_density(model, p, q); }));
  const double half = kHalfAround / model.wheel_radius();
  const int most = static_cast<int>(3 * std::numbers::pi / half);
  progress(fmt::format("{} harmonics of {} unknowns", most + 1, solid.unknowns()));
  std::array<ReceptanceCurve, 3> out;
  out.fill(ReceptanceCurve(s.size()));
  for (int waves = 0; waves <= most; ++waves) {
    constexpr int kSlow = 12;  // waves up to which a harmonic resonates in the band
    const double share = std::pow(raised_cosine_coefficient(waves, half), 2);
    const auto receptances = solid.receptances(waves, loads, waves <= kSlow ? 40 : 12);
    for (std::size_t d = 0; d < 3; ++d)
      for (std::size_t i = 0; i < s.size(); ++i) out[d][i] += share * receptances[d].at(s[i]);
  }
  return out;
}

/// Norm of the difference over the reference's.
double difference(const ReceptanceCurve& ours, const ReceptanceCurve& reference) {
  double apart = 0, whole = 0;
  for (std::size_t i = 0; i < ours.size(); ++i) {
    apart += std::norm(ours[i] - reference[i]);
    whole += std::norm(reference[i]);
  }
  return std::sqrt(apart / whole);
}

/// Frequencies of the maxima that exceed the valleys beside them by `prominence` [Hz].
std::vector<double> peaks(const ReceptanceCurve& curve, const std::vector<Complex>& s, double prominence) {
  std::vector<double> out;
  double valley = std::abs(curve.front());
  std::size_t top = 0;  // of the rise since the last valley; 0: none
  for (std::size_t i = 1; i + 1 < curve.size(); ++i) {
    const double here = std::abs(curve[i]);
    if (here > prominence * valley && (top == 0 || here > std::abs(curve[top]))) top = i;
    if (top == 0) valley = std::min(valley, here);
    if (top == 0 || here * prominence > std::abs(curve[top])) continue;
    // The parabola through the logarithms of three points.
    const auto level = [&](std::size_t k) { return std::log(std::abs(curve[k])); };
    const double bend = level(top - 1) - 2 * level(top) + level(top + 1);
    const double shift = 0.5 * (level(top - 1) - level(top + 1)) / bend;
    const double pitch = std::log(s[1].imag() / s[0].imag());
    out.push_back(s[top].imag() / (2 * std::numbers::pi) * std::exp(shift * pitch));
    top = 0;
    valley = here;
  }
  return out;
}

Figure receptance_figure(const std::vector<Complex>& s, const std::array<ReceptanceCurve, 3>& ours,
                         const std::array<ReceptanceCurve, 3>& reference) {
  Figure figure;
  figure.title = "Receptance of the free half wheelset at the contact patch";
  figure.x_label = "Frequency [Hz]";
  for (std::size_t d = 0; d < 3; ++d) {
    Series step{fmt::format("step, {}", kDirections[d].name), {}, {}, Stroke::solid};
    Series harmonics{fmt::format("harmonics, {}", kDirections[d].name), {}, {}, Stroke::dashed};
    for (std::size_t i = 0; i < s.size(); ++i) {
      for (Series* series : {&step, &harmonics}) series->x.push_back(s[i].imag() / (2 * std::numbers::pi));
      step.y.push_back(std::log10(std::abs(ours[d][i])));
      harmonics.y.push_back(std::log10(std::abs(reference[d][i])));
    }
    figure.panels.push_back({"log10 of [m/N]", {step, harmonics}, {}, 220, std::nullopt});
  }
  return figure;
}

CaseResult wheel_receptance(const VerifyInputs& inputs, const ProgressText& progress) {
  constexpr double kLeft = 1e-4;                 // of the motion's weight at the end of the observed time
  constexpr double kFaint = 1.05, kClear = 1.3;  // prominence of peaks
  const double decay = inputs["decay"];
  const Model model(free_wheelset(inputs["element_size"], std::log(1 / kLeft) / decay));
  const std::vector<Complex> s = variables(decay);
  const std::array<ReceptanceCurve, 3> reference = receptance_of_harmonics(model, s, progress);
  const LoadedRegion region = loaded_region(model);
  std::array<ReceptanceCurve, 3> ours;
  CaseResult result;
  for (std::size_t d = 0; d < 3; ++d) {
    const std::string name = kDirections[d].name;
    ours[d] = receptance_of_step(model, region, kDirections[d].component, s, progress);
    result.findings.push_back({name + ", at 100 Hz", "nm/N", 1e9 * std::abs(ours[d].front()),
                               1e9 * std::abs(reference[d].front()), 0.02});
    result.findings.push_back(
        {name + ", difference over 0.1 to 3 kHz", "-", difference(ours[d], reference[d]), 0, 0.1, true});
    // The reference's peaks, beside the nearest of ours.
    const std::vector<double> ours_at = peaks(ours[d], s, kFaint);
    for (const double peak : peaks(reference[d], s, kClear)) {
      const auto nearest = std::min_element(ours_at.begin(), ours_at.end(), [&](double a, double b) {
        return std::abs(a - peak) < std::abs(b - peak);
      });
      result.findings.push_back({fmt::format("{}, peak at {:.0f} Hz", name, peak), "Hz",
                                 nearest == ours_at.end() ? 0 : *nearest, peak, 0.02});
    }
  }
  result.figures = {receptance_figure(s, ours, reference)};
  return result;
}

}  // namespace

VerifyCase wheel_receptance_case() {
  return {"wheel_receptance",
          "receptance of the free half wheelset at the contact patch, 0.1 to 3 kHz, against harmonics",
          {{"element_size", &kLength, "mm", 6e-3, {1e-3, 0.02}, "the elements' size at the tread"},
           {"decay", nullptr, "", 120, {20, 1000}, "rate at which the motion is faded [1/s]"}},
          wheel_receptance};
}

}  // namespace tread
