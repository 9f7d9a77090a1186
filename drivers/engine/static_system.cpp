#include "drivers/engine/static_system.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "core/error.hpp"
#include "core/parallel/chunks.hpp"
#include "kernels/solver/stable_step.hpp"
#include "kernels/update/inverse_mass.hpp"

namespace tread {

AlignedVector<double> StaticSystem::diagonal() const {
  AlignedVector<double> diagonal(static_cast<std::size_t>(3 * model_->mesh.slots), 0.0);
  model_->internal->diagonal(diagonal.data());
  for (const auto& body : model_->body_forces) body->add_diagonal(diagonal.data());
  if (model_->ties) model_->ties->gather_diagonal(diagonal.data());
  for (const std::int64_t unknown : model_->restrained) diagonal[static_cast<std::size_t>(unknown)] = 0;
  if (model_->guide)
    for (const std::int64_t unknown : model_->guide->unknowns())
      diagonal[static_cast<std::size_t>(unknown)] = 0;
  return diagonal;
}

void StaticSystem::apply(double* x, double* y) const {
  const double rise = model_->guide ? x[model_->guide->unknown()] : 0;
  expand(x);
  model_->apply_stiffness(x, y);
  if (model_->ties) model_->ties->clear(x);
  if (model_->guide) {
    for (const std::int64_t unknown : model_->guide->unknowns()) x[unknown] = 0;
    x[model_->guide->unknown()] = rise;
  }
  reduce(y);
}

void StaticSystem::reduce(double* force) const {
  if (model_->ties) model_->ties->gather(force);
  if (model_->guide) model_->guide->reduce(force);
  for (const std::int64_t unknown : model_->restrained) force[unknown] = 0;
}

void StaticSystem::expand(double* field) const {
  if (model_->guide) model_->guide->expand(field);
  if (model_->ties) model_->ties->follow({field});
}

namespace {

/// Damping may shorten the step to this share; a classical beta of ordinary size in structural dynamics would
/// shorten it a thousand times.
constexpr double kLeastShare = 0.5;

void refuse_heavy_damping(double beta, double omega) {
  const double free_step = stable_step(omega, 0);
  const double damped_step = stable_step(omega, beta);
  if (damped_step >= kLeastShare * free_step) return;
  const double largest = (1 / kLeastShare - kLeastShare) / omega;
  throw InputError(fmt::format(
      "material damping: a stiffness-proportional beta of {:.3g} s needs a time step of 2/w (sqrt(1 + xi^2) "
      "- "
      "xi) = {:.2e} s, {:.2g} % of the 2/w = {:.2e} s without damping (w = {:.3e} rad/s, xi = beta w/2 = "
      "{:.3g}); at least {:g} % must be left: state rayleigh_beta of at most {:.2g} s, or {{ kind = "
      "\"high_frequency_fraction\", value = xi }} with xi of at most {:.2g} (LS-DYNA's positive COEF), "
      "or with this beta damping_up_to = \"3 kHz\" or another frequency that is enough",
      beta, damped_step, 100 * damped_step / free_step, free_step, omega, 0.5 * beta * omega,
      100 * kLeastShare, largest, 0.5 * largest * omega));
}

/// Factor by which damping stiffens the bodies at the limit of the step dt: 1 + g + 2 beta / dt, with the
/// largest of all blocks. [theory.md, eqs. 12, 12f]
struct Stiffening {
  double branch = 1;  ///< 1 + g [-]
  double beta = 0;    ///< [s]

  explicit Stiffening(const Model& model) {
    for (const double of_block : model.beta) beta = std::max(beta, of_block);
    for (const std::optional<MaxwellBranch>& of_block : model.branches)
      if (of_block) branch = std::max(branch, 1 + of_block->strength);
    for (const auto& body : model.body_forces) {
      beta = std::max(beta, body->beta());
      if (body->branch()) branch = std::max(branch, 1 + body->branch()->strength);
    }
  }
  double at(double dt) const { return branch + 2 * beta / dt; }
  /// Stable step of bodies of the frequency omega [s].
  double stable_step(double omega) const {
    return tread::stable_step(omega * std::sqrt(branch), beta / branch);
  }
};

/// The free unknowns' inverse masses, and the elastic operator with the fastenings' springs.
class AssembledBodies {
 public:
  explicit AssembledBodies(const Model& model) : system_(model), inverse_mass_(system_.diagonal()) {
    for_chunks(model.mesh.slots, [&](std::int64_t first, std::int64_t last) {
      for (std::int64_t slot = first; slot < last; ++slot)
        for (int c = 0; c < 3; ++c) {
          double& value = inverse_mass_[static_cast<std::size_t>(dof(slot, c))];
          if (value > 0) value = inverse_mass(model.mass[static_cast<std::size_t>(slot)]);
        }
    });
    if (model.guide)
      inverse_mass_[static_cast<std::size_t>(model.guide->unknown())] = 1 / model.guide->static_mass();
    if (!model.fastenings) return;
    springs_ = model.fastenings->springs();
    for (const SpringDampers::Element& element : model.fastenings->elements())
      damping_.push_back(element.damping);
  }

  bool damped() const {
    return std::any_of(damping_.begin(), damping_.end(), [](double c) { return c > 0; });
  }

  /// From above, material damping aside; with dampers as the springs (k + 2 c / dt) / stiffening that
  /// they are at the limit of the step dt, or without them [rad/s]. NumericalError if it is not finite.
  double frequency() const { return frequency_with(springs_); }
  double frequency(const Stiffening& material, double dt) const {
    std::vector<Spring> springs = springs_;
    for (std::size_t i = 0; i < springs.size(); ++i)
      springs[i].stiffness = (springs[i].stiffness + 2 * damping_[i] / dt) / material.at(dt);
    return frequency_with(springs);
  }

 private:
  double frequency_with(const std::vector<Spring>& springs) const {
    const Operator elastic = [&](double* x, double* y) {
      system_.apply(x, y);
      add_springs(springs, x, y);
    };
    const double omega = highest_frequency(elastic, inverse_mass_).omega;
    if (!std::isfinite(omega))
      throw NumericalError(fmt::format(
          "time step: the highest frequency of the assembled bodies is {} rad/s: a stiffness or mass is no "
          "finite number, or an element has no shape; check the constants of the materials and the meshes of "
          "bodies from files",
          omega));
    return omega;
  }

  StaticSystem system_;
  AlignedVector<double> inverse_mass_;
  std::vector<Spring> springs_;
  std::vector<double> damping_;  ///< of each spring [N s/m]
};

/// Stable step of the sprung mass on the journal [s].
double suspension_step(const Model& model) {
  if (!model.scene.vehicle) return std::numeric_limits<double>::infinity();
  const VehicleSpec& vehicle = *model.scene.vehicle;
  const double mass = 1 / (1 / vehicle.sprung_mass + 1 / (model.journal.mass() + vehicle.unsprung_mass));
  const double omega = std::sqrt(vehicle.suspension_stiffness / mass);
  return stable_step(omega, vehicle.suspension_damping / vehicle.suspension_stiffness);
}

struct AssembledStep {
  double omega = 0;     ///< of the bodies without damping, from above [rad/s]
  double material = 0;  ///< stable step with the materials' damping [s]
  double stable = 0;    ///< with all dampers [s]
};

AssembledStep assembled_step(const Model& model) {
  const AssembledBodies bodies(model);
  const Stiffening material(model);
  AssembledStep step;
  step.omega = bodies.frequency();
  step.material = step.stable = material.stable_step(step.omega);
  // A shorter step makes the dampers stiffer: comes down on the answer from above and takes a little less.
  constexpr double kTolerance = 1e-3;
  constexpr int kMaxIterations = 50;
  double last = step.material;
  for (int i = 0; bodies.damped() && i < kMaxIterations; ++i) {
    const double next = material.stable_step(bodies.frequency(material, last));
    const bool settled = next >= (1 - kTolerance) * last;
    if (settled && i == 0) break;  // the dampers do not matter
    step.stable = (1 - 2 * kTolerance) * next;
    if (settled) break;
    last = next;
  }
  step.stable = std::min(step.stable, suspension_step(model));
  return step;
}

std::vector<StiffestElement> stiffest_elements(const Model& model) {
  std::vector<StiffestElement> list;
  for (int b = 0; b < static_cast<int>(model.mesh.blocks.size()); ++b) {
    const SweptBlock& block = model.mesh.blocks[static_cast<std::size_t>(b)];
    const ElementFrequency highest = model.internal->max_frequency(b);
    const int corner = block.section.quads[static_cast<std::size_t>(highest.quad)][0];
    list.push_back({stable_step(highest.omega, 0), position(block, corner, highest.station), block.name});
  }
  for (const auto& force : model.body_forces) {
    const HexFrequency highest = force->elements().max_frequency();
    const HexMesh& mesh = force->body().mesh;
    list.push_back({stable_step(highest.omega, 0), mesh.corners(highest.element)[0],
                    fmt::format("{} (element {} of the file)", force->body().name,
                                mesh.element_number[highest.element])});
  }
  return list;
}

}  // namespace

double stable_step_of(const Model& model) {
  return assembled_step(model).stable;
}

std::size_t StepLimit::stiffest_block() const {
  const auto shortest = std::min_element(stiffest.begin(), stiffest.end(),
                                         [](const auto& a, const auto& b) { return a.step < b.step; });
  return static_cast<std::size_t>(shortest - stiffest.begin());
}

StepLimit step_limit(const Model& model) {
  StepLimit limit;
  const AssembledStep step = assembled_step(model);
  const double omega = step.omega;
  const Stiffening material(model);
  limit.stable_step = step.stable;
  refuse_heavy_damping(material.beta, omega);
  limit.stiffest = stiffest_elements(model);
  const StiffestElement& stiffest = limit.stiffest[limit.stiffest_block()];
  limit.reason = fmt::format(
      "stiffest element: {} at ({:.4f}, {:.4f}, {:.4f}) m alone {:.3e} s; assembled bodies {:.3e} s",
      stiffest.name, stiffest.at.x, stiffest.at.y, stiffest.at.z, stiffest.step, stable_step(omega, 0));
  if (material.beta > 0 || material.branch > 1)
    limit.reason +=
        fmt::format("; damping takes {:.1f} % of that", 100 * (1 - step.material / stable_step(omega, 0)));
  if (step.stable < step.material)
    limit.reason += fmt::format("; fastenings' dampers and suspension take {:.1f} % of that",
                                100 * (1 - step.stable / step.material));
  return limit;
}

}  // namespace tread
