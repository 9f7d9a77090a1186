#include "drivers/verify/natural_modes.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>

#include "drivers/engine/start/static_system.hpp"
#include "kernels/solver/lowest_modes.hpp"
#include "kernels/solver/two_level_preconditioner.hpp"

namespace tread {

namespace {

constexpr int kMostWaves = 8;
constexpr double kShift = 200;  ///< frequency whose square keeps the preconditioner regular [rad/s]

/// Fourier coefficients around the axle of one section node's motion, 0 to kMostWaves waves.
using Harmonics = std::array<std::array<std::complex<double>, 3>, kMostWaves + 1>;

Harmonics harmonics(const SweptBlock& block, int node, const double* shape) {
  Harmonics sum{};
  for (int station = 0; station < block.station_count(); ++station) {
    const double angle = block.stations[static_cast<std::size_t>(station)];
    // Arc of the station in turns: pitches may differ around a tread.
    const int before = station == 0 ? block.station_count() - 1 : station - 1;
    const double arc = 0.5 * (block.pitch(station) + block.pitch(before)) / (2 * std::numbers::pi);
    const std::int64_t slot = block.base + block.slot(node, station);
    for (int n = 0; n <= kMostWaves; ++n)
      for (int c = 0; c < 3; ++c)
        sum[static_cast<std::size_t>(n)][static_cast<std::size_t>(c)] +=
            arc * shape[dof(slot, c)] * std::polar(1.0, -n * angle);
  }
  return sum;
}

NaturalMode mode_of(const Model& model, double omega, const double* shape) {
  NaturalMode mode;
  mode.frequency = omega / (2 * std::numbers::pi);
  std::array<std::array<double, 3>, kMostWaves + 1> motion{};
  std::vector<Harmonics> nodes;
  for (const int b : model.index.wheel()) {
    const SweptBlock& block = model.mesh.blocks[static_cast<std::size_t>(b)];
    for (int node = 0; node < block.section.nodes(); ++node) {
      nodes.push_back(harmonics(block, node, shape));
      double mass = 0;
      for (int station = 0; station < block.station_count(); ++station)
        mass += model.mass[static_cast<std::size_t>(block.base + block.slot(node, station))];
      for (std::size_t n = 0; n <= kMostWaves; ++n)
        for (std::size_t c = 0; c < 3; ++c)
          motion[n][c] += mass * (n == 0 ? 1 : 2) * std::norm(nodes.back()[n][c]);
    }
  }
  double all = 0;
  double most = 0;
  std::size_t waves = 0;
  for (std::size_t n = 0; n <= kMostWaves; ++n) {
    const double sum = motion[n][0] + motion[n][1] + motion[n][2];
    all += sum;
    if (sum <= most) continue;
    most = sum;
    waves = n;
  }
  const auto largest = std::max_element(motion[waves].begin(), motion[waves].end());
  mode.waves = static_cast<int>(waves);
  mode.direction = static_cast<Direction>(largest - motion[waves].begin());
  mode.share = most / all;
  const std::size_t plane = waves == 0 && mode.direction == Direction::around ? 0 : 2;
  double peak = 0;
  for (const Harmonics& h : nodes) peak = std::max({peak, std::abs(h[waves][1]), std::abs(h[waves][plane])});
  // Amplitudes are taken in phase with the largest: an undamped mode is a standing wave.
  std::complex<double> phase = 1;
  for (const Harmonics& h : nodes)
    for (const std::size_t c : {std::size_t{1}, plane})
      if (std::abs(h[waves][c]) == peak) phase = h[waves][c] / peak;
  for (const Harmonics& h : nodes) {
    mode.along_axis.push_back((h[waves][1] / phase).real() / peak);
    mode.in_plane.push_back((h[waves][plane] / phase).real() / peak);
  }
  return mode;
}

}  // namespace

std::string NaturalMode::name() const {
  if (waves == 0)
    return direction == Direction::around       ? "torsion"
           : direction == Direction::along_axis ? "umbrella"
                                                : "breathing";
  const std::string count = fmt::format("{} {}", waves, waves == 1 ? "wave" : "waves");
  return count + (direction == Direction::along_axis ? ", out of plane" : ", in plane");
}

std::vector<NaturalMode> natural_modes(const Model& model, int count, const ProgressText& progress) {
  const StaticSystem system(model);
  AlignedVector<double> diagonal = system.diagonal();
  AlignedVector<double> mass(diagonal.size(), 0.0);
  for (std::int64_t slot = 0; slot < model.mesh.slots; ++slot)
    for (int c = 0; c < 3; ++c) {
      const auto unknown = static_cast<std::size_t>(dof(slot, c));
      if (diagonal[unknown] <= 0) continue;
      mass[unknown] = model.mass[static_cast<std::size_t>(slot)];
      diagonal[unknown] += kShift * kShift * mass[unknown];
    }
  const Operator elastic = [&](double* x, double* y) { system.apply(x, y); };
  const Operator shifted = [&](double* x, double* y) {
    system.apply(x, y);
    for (std::size_t i = 0; i < mass.size(); ++i) y[i] += kShift * kShift * mass[i] * x[i];
  };
  TwoLevelPreconditioner preconditioner(model.mesh, shifted, diagonal,
                                        model.ties ? model.ties->tied_slots() : std::vector<TiedSlot>{}, {});
  preconditioner.update(shifted, {});
  LowestModesOptions options;
  options.count = count;
  options.shift = kShift * kShift;
  LowestModes lowest = lowest_modes(elastic, mass, preconditioner, options);
  progress(fmt::format("{} modes of {} elements, {} iterations", count, model.elements(), lowest.iterations));
  std::vector<NaturalMode> modes;
  for (std::size_t k = 0; k < lowest.omega.size(); ++k) {
    system.expand(lowest.shapes[k].data());
    NaturalMode mode = mode_of(model, lowest.omega[k], lowest.shapes[k].data());
    // Both modes of a pair have one frequency up to the mesh's unequal pitches.
    const bool second = !modes.empty() && mode.waves > 0 && modes.back().waves == mode.waves &&
                        modes.back().direction == mode.direction &&
                        std::abs(mode.frequency - modes.back().frequency) < 1e-3 * mode.frequency;
    progress(fmt::format("{:.3f} Hz: {}, {:.1f} %{}", mode.frequency, mode.name(), 100 * mode.share,
                         second ? ", second of a pair" : ""));
    if (!second) modes.push_back(std::move(mode));
  }
  return modes;
}

}  // namespace tread
