#include "drivers/studies/multibody/modal_track.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/math/band_matrix.hpp"
#include "kernels/solver/symmetric_modes.hpp"

namespace tread {

ModalTrack::ModalTrack(ModalBeam beam, const std::vector<BeamSupport>& supports,
                       const std::vector<FootSpring>& foot, const std::vector<SleeperSupport>& sleepers)
    : beam_(std::move(beam)), omega_(beam_.omega()) {
  const std::size_t modes = omega_.size();
  omega_.resize(modes + sleepers.size(), 0.0);
  std::vector<double> values(coordinates(), 0.0);
  const auto add = [&](double stiffness, double damping) {
    stiffness_.push_back(stiffness);
    damping_.push_back(damping);
    by_support_.insert(by_support_.end(), values.begin(), values.end());
  };
  for (const BeamSupport& s : supports) {
    beam_.shapes(s.x, values);
    add(s.stiffness, s.damping);
  }
  std::vector<double> there(modes);
  for (const FootSpring& s : foot) {
    std::fill(values.begin(), values.end(), 0.0);
    for (const auto& [x, weight] : s.places) {
      beam_.foot_shapes(x, there);
      for (std::size_t i = 0; i < modes; ++i) values[i] += weight * there[i];
    }
    add(s.stiffness, s.damping);
  }
  std::fill(values.begin(), values.end(), 0.0);
  for (std::size_t i = 0; i < sleepers.size(); ++i) {
    const SleeperSupport& s = sleepers[i];
    const auto columns = static_cast<double>(s.columns.size());
    for (const double offset : s.columns) {
      beam_.shapes(s.x + offset, values);
      values[modes + i] = -1 / std::sqrt(s.sleeper.mass);
      add(s.stiffness / columns, s.damping / columns);
    }
    std::fill(values.begin(), values.end(), 0.0);
    values[modes + i] = 1 / std::sqrt(s.sleeper.mass);
    add(s.sleeper.stiffness, s.sleeper.damping);
    values[modes + i] = 0;
  }
}

/// Four places about x and the weights of cubic interpolation.
struct ModalTrack::Stencil {
  std::size_t first = 0;
  std::array<double, 4> weight{};
};

ModalTrack::Stencil ModalTrack::stencil(double x) const {
  const double place = (x - left()) / table_.pitch;
  const double last = static_cast<double>(table_.flexibility.size()) - 4;
  const double first = std::clamp(std::floor(place) - 1, 0.0, last);
  const double t = place - first;
  return {static_cast<std::size_t>(first),
          {-(t - 1) * (t - 2) * (t - 3) / 6, t * (t - 2) * (t - 3) / 2, -t * (t - 1) * (t - 3) / 2,
           t * (t - 1) * (t - 2) / 6}};
}

void ModalTrack::head_shapes(double x, std::vector<double>& values) const {
  if (table_.pitch == 0) {
    beam_.head_shapes(x, values);
    return;
  }
  const Stencil at = stencil(x);
  const std::size_t n = coordinates();
  const double* shapes = table_.shapes.data() + at.first * n;
  for (std::size_t i = 0; i < n; ++i)
    values[i] = at.weight[0] * shapes[i] + at.weight[1] * shapes[n + i] + at.weight[2] * shapes[2 * n + i] +
                at.weight[3] * shapes[3 * n + i];
}

double ModalTrack::flexibility(double x) const {
  double sum = beam_.residual_flexibility();
  if (table_.pitch == 0) return sum;
  const Stencil at = stencil(x);
  for (std::size_t k = 0; k < 4; ++k) sum += at.weight[k] * table_.flexibility[at.first + k];
  return sum;
}

ModalTrack ModalTrack::diagonal(double top) const {
  constexpr double kPitch = 0.01;  // [m]: a quarter of the shortest wave that bends the head
  const std::size_t n = coordinates();
  const SymmetricModes modes = symmetric_modes(stiffness_matrix(), n);
  const double highest = std::pow(2 * std::numbers::pi * top, 2);
  std::size_t kept = 0;
  while (kept < n && modes.values[kept] < highest) ++kept;

  ModalTrack out = *this;
  out.omega_.clear();
  for (std::size_t i = 0; i < kept; ++i) out.omega_.push_back(std::sqrt(std::max(0.0, modes.values[i])));
  // Springs are in the modes.
  out.stiffness_.clear();
  out.damping_.clear();
  out.by_support_.clear();
  const std::vector<double> stretched = modes.components(by_support_);
  for (std::size_t s = 0; s < supports(); ++s) {
    if (damping_[s] == 0) continue;
    out.stiffness_.push_back(0);
    out.damping_.push_back(damping_[s]);
    const auto row = stretched.begin() + static_cast<std::ptrdiff_t>(s * n);
    out.by_support_.insert(out.by_support_.end(), row, row + static_cast<std::ptrdiff_t>(kept));
  }
  const auto places = static_cast<std::size_t>(std::ceil(beam_.length() / kPitch)) + 1;
  out.table_.pitch = beam_.length() / static_cast<double>(places - 1);
  std::vector<double> shapes(places * n), one(n);
  for (std::size_t p = 0; p < places; ++p) {
    beam_.head_shapes(left() + static_cast<double>(p) * out.table_.pitch, one);
    std::copy(one.begin(), one.end(), shapes.begin() + static_cast<std::ptrdiff_t>(p * n));
  }
  shapes = modes.components(shapes);
  for (std::size_t p = 0; p < places; ++p) {
    const double* row = shapes.data() + p * n;
    out.table_.shapes.insert(out.table_.shapes.end(), row, row + kept);
    double rest = 0;
    for (std::size_t i = kept; i < n; ++i) rest += row[i] * row[i] / modes.values[i];
    out.table_.flexibility.push_back(rest);
  }
  return out;
}

/// Squares of the frequencies and the supports' springs, by coordinates.
std::vector<double> ModalTrack::stiffness_matrix() const {
  const std::size_t n = coordinates();
  std::vector<double> matrix(n * n);
  for (std::size_t i = 0; i < n; ++i) matrix[i * n + i] = omega_[i] * omega_[i];
  for (std::size_t s = 0; s < supports(); ++s) {
    const double* mode = by_support_.data() + s * n;
    for (std::size_t i = 0; i < n; ++i) {
      const double pull = stiffness_[s] * mode[i];
      if (pull == 0) continue;
      for (std::size_t j = 0; j < n; ++j) matrix[i * n + j] += pull * mode[j];
    }
  }
  return matrix;
}

std::vector<double> ModalTrack::static_state(double x, double force) const {
  const std::size_t n = coordinates();
  if (table_.pitch > 0) {
    std::vector<double> state(n);
    head_shapes(x, state);
    for (std::size_t i = 0; i < n; ++i) state[i] *= force / (omega_[i] * omega_[i]);
    return state;
  }
  const auto rows = static_cast<int>(n);
  BandMatrix<double> system(rows, rows - 1);
  for (std::size_t i = 0; i < n; ++i) {
    const int row = static_cast<int>(i);
    system.at(row, row) = omega_[i] * omega_[i];
    for (std::size_t s = 0; s < supports(); ++s) {
      const double* mode = by_support_.data() + s * n;
      for (std::size_t j = 0; j <= i; ++j)
        system.at(row, static_cast<int>(j)) += stiffness_[s] * mode[i] * mode[j];
    }
  }
  system.factorise();
  std::vector<double> load(n);
  beam_.head_shapes(x, load);
  for (double& value : load) value *= force;
  return system.solve(std::move(load));
}

void ModalTrack::support_forces(const std::vector<double>& state, const std::vector<double>& rate,
                                std::vector<double>& forces, std::vector<double>& scratch) const {
  const std::size_t n = state.size();
  for (std::size_t s = 0; s < supports(); ++s) {
    const double* mode = by_support_.data() + s * n;
    // Four sums run side by side: one alone would wait for every addition.
    double sum[4] = {0, 0, 0, 0};
    std::size_t i = 0;
    for (; i + 4 <= n; i += 4)
      for (std::size_t k = 0; k < 4; ++k)
        sum[k] += mode[i + k] * (stiffness_[s] * state[i + k] + damping_[s] * rate[i + k]);
    for (; i < n; ++i) sum[0] += mode[i] * (stiffness_[s] * state[i] + damping_[s] * rate[i]);
    scratch[s] = (sum[0] + sum[1]) + (sum[2] + sum[3]);
  }
  for (std::size_t s = 0; s < supports(); ++s) {
    const double* mode = by_support_.data() + s * n;
    const double force = scratch[s];
    for (std::size_t i = 0; i < n; ++i) forces[i] -= force * mode[i];
  }
}

/// Largest eigenvalue of the weighted sum of the supports' dyads, by power iteration.
double ModalTrack::largest(const std::vector<double>& weight) const {
  const std::size_t n = coordinates();
  // All modes start alike at the first support, so that the high ones take part.
  std::vector<double> vector(by_support_.begin(), by_support_.begin() + static_cast<std::ptrdiff_t>(n));
  double value = 0;
  for (int iteration = 0; iteration < 30; ++iteration) {
    std::vector<double> next(n);
    for (std::size_t s = 0; s < supports(); ++s) {
      const double* mode = by_support_.data() + s * n;
      double sum = 0;
      for (std::size_t i = 0; i < n; ++i) sum += mode[i] * vector[i];
      for (std::size_t i = 0; i < n; ++i) next[i] += weight[s] * sum * mode[i];
    }
    double norm = 0;
    for (const double v : next) norm += v * v;
    norm = std::sqrt(norm);
    if (norm == 0) return 0;
    value = norm;
    for (std::size_t i = 0; i < n; ++i) vector[i] = next[i] / norm;
  }
  return value;
}

double ModalTrack::support_stiffness() const {
  return supports() == 0 ? 0 : largest(stiffness_);
}

double ModalTrack::support_damping() const {
  return supports() == 0 ? 0 : largest(damping_);
}

}  // namespace tread
