#include "drivers/static_system.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "kernels/solver/chunks.hpp"
#include "kernels/stable_step.hpp"

namespace tread {

StaticSystem::StaticSystem(const Model& model)
    : model_(&model),
      diagonal_(static_cast<std::size_t>(3 * model.mesh.slots), 0.0),
      full_(static_cast<std::size_t>(3 * model.mesh.slots), 0.0) {
  model.internal->diagonal(diagonal_.data());
  if (model.ties) model.ties->gather_diagonal(diagonal_.data());
  for (const std::int64_t unknown : model.restrained) diagonal_[static_cast<std::size_t>(unknown)] = 0;
}

void StaticSystem::apply(const double* x, double* y) const {
  for_chunks(static_cast<std::int64_t>(full_.size()), [&](std::int64_t first, std::int64_t last) {
    std::copy(x + first, x + last, full_.data() + first);
  });
  expand(full_.data());
  model_->internal->apply(full_.data(), y);
  reduce(y);
}

void StaticSystem::reduce(double* force) const {
  if (model_->ties) model_->ties->gather(force);
  for (const std::int64_t unknown : model_->restrained) force[unknown] = 0;
}

void StaticSystem::expand(double* field) const {
  if (model_->ties) model_->ties->follow({field});
}

namespace {

/// Damping may shorten the step to this share; a classical beta of ordinary size in structural dynamics would
/// shorten it a thousand times.
constexpr double kLeastShare = 0.5;

void refuse_heavy_damping(double beta, double damped_step, double omega) {
  const double free_step = stable_step(omega, 0);
  if (damped_step >= kLeastShare * free_step) return;
  const double largest = (1 / kLeastShare - kLeastShare) / omega;
  throw InputError(fmt::format(
      "material damping: a stiffness-proportional beta of {:.3g} s needs a time step of 2/w (sqrt(1 + xi^2) "
      "- "
      "xi) = {:.2e} s, {:.2g} % of the 2/w = {:.2e} s without damping (w = {:.3e} rad/s, xi = beta w/2 = "
      "{:.3g}); at least {:g} % must be left: state rayleigh_beta of at most {:.2g} s, or {{ kind = "
      "\"high_frequency_fraction\", value = xi }} with xi of at most {:.2g} (LS-DYNA's positive COEF, which "
      "the "
      "paper's 1e-4 is)",
      beta, damped_step, 100 * damped_step / free_step, free_step, omega, 0.5 * beta * omega,
      100 * kLeastShare, largest, 0.5 * largest * omega));
}

double largest_beta(const Model& model) {
  return model.beta.empty() ? 0 : *std::max_element(model.beta.begin(), model.beta.end());
}

/// Of the assembled bodies without damping, from above [rad/s].
double assembled_frequency(const Model& model) {
  const StaticSystem system(model);
  const auto n = static_cast<std::size_t>(3 * model.mesh.slots);
  AlignedVector<double> inverse_mass(n, 0.0);
  for (std::int64_t slot = 0; slot < model.mesh.slots; ++slot)
    for (int c = 0; c < 3; ++c)
      if (system.diagonal()[static_cast<std::size_t>(dof(slot, c))] > 0)
        inverse_mass[static_cast<std::size_t>(dof(slot, c))] =
            model.inverse_mass[static_cast<std::size_t>(slot)];

  std::vector<Spring> springs;
  if (model.fastenings) springs = model.fastenings->springs();
  const Operator elastic = [&](const double* x, double* y) {
    system.apply(x, y);
    add_springs(springs, x, y);
  };
  return highest_frequency(elastic, inverse_mass).omega;
}

}  // namespace

double stable_step_of(const Model& model) {
  return stable_step(assembled_frequency(model), largest_beta(model));
}

StepLimit step_limit(const Model& model) {
  StepLimit limit;
  limit.element = model.internal->max_frequency();
  const double omega = assembled_frequency(model);
  const double beta = largest_beta(model);
  limit.stable_step = stable_step(omega, beta);
  refuse_heavy_damping(beta, limit.stable_step, omega);
  const SweptBlock& block = model.mesh.blocks[static_cast<std::size_t>(limit.element.block)];
  const int node = block.section.quads[static_cast<std::size_t>(limit.element.quad)][0];
  const Vec3 at = position(block, node, limit.element.station);
  limit.reason = fmt::format(
      "stiffest element: {} at ({:.4f}, {:.4f}, {:.4f}) m alone {:.3e} s; assembled bodies {:.3e} s",
      block.name, at.x, at.y, at.z, 2 / limit.element.omega, stable_step(omega, 0));
  if (beta > 0)
    limit.reason += fmt::format("; damping takes {:.1f} % of that",
                                100 * (1 - limit.stable_step / stable_step(omega, 0)));
  return limit;
}

}  // namespace tread
