#include "drivers/static_system.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

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

StepLimit step_limit(const Model& model) {
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
  StepLimit limit;
  limit.element = model.internal->max_frequency();
  const auto bodies = highest_frequency(elastic, inverse_mass);
  limit.without_contact = stable_step(bodies.omega, 0);
  limit.omega = bodies.omega;

  if (model.contact) {
    AlignedVector<double> grounded(static_cast<std::size_t>(model.mesh.slots), 0.0);
    model.contact->add_grounded_stiffness(model.mass.data(), grounded.data());
    const Operator with_contact = [&](const double* x, double* y) {
      elastic(x, y);
      for (std::int64_t slot = 0; slot < model.mesh.slots; ++slot)
        if (grounded[static_cast<std::size_t>(slot)] > 0)
          for (int c = 0; c < 3; ++c)
            if (inverse_mass[static_cast<std::size_t>(dof(slot, c))] > 0)
              y[dof(slot, c)] += grounded[static_cast<std::size_t>(slot)] * x[dof(slot, c)];
    };
    limit.omega = highest_frequency(with_contact, inverse_mass).omega;
  }
  double beta = 0;
  for (const double b : model.beta) beta = std::max(beta, b);
  limit.stable_step = stable_step(limit.omega, beta);
  // Contact damping lags by half a step too; its fraction of critical counts as if every mode had it.
  const double ratio = model.contact ? model.scene.contact->damping_ratio : 0;
  limit.stable_step *= std::sqrt(1 + ratio * ratio) - ratio;
  const SweptBlock& block = model.mesh.blocks[static_cast<std::size_t>(limit.element.block)];
  const int node = block.section.quads[static_cast<std::size_t>(limit.element.quad)][0];
  const Vec3 at = position(block, node, limit.element.station);
  limit.reason = fmt::format(
      "stiffest element: {} at ({:.4f}, {:.4f}, {:.4f}) m alone {:.3e} s; assembled bodies {:.3e} s",
      block.name, at.x, at.y, at.z, 2 / limit.element.omega, limit.without_contact);
  if (model.contact)
    limit.reason += fmt::format("; the contact penalty takes {:.0f} % of that",
                                100 * (1 - stable_step(limit.omega, 0) / limit.without_contact));
  if (beta > 0 || ratio > 0)
    limit.reason += fmt::format("; damping takes {:.1f} % of the rest",
                                100 * (1 - limit.stable_step / stable_step(limit.omega, 0)));
  return limit;
}

}  // namespace tread
