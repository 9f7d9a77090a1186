#include "drivers/engine/start/step_limit.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "core/error.hpp"
#include "core/parallel/chunks.hpp"
#include "drivers/engine/start/static_system.hpp"
#include "kernels/solver/stable_step.hpp"
#include "kernels/update/inverse_mass.hpp"

namespace tread {

namespace {

/// Damping may shorten the step to this share; a classical beta of ordinary size in structural dynamics would
/// shorten it a thousand times.
constexpr double kLeastShare = 0.5;

/// Tolerance of the stable step [-].
constexpr double kStepTolerance = 1e-3;
constexpr int kMostIterations = 50;

/// Factor by which damping stiffens bodies at the limit of the step dt: 1 + g + 2 beta / dt.
/// [theory.md, eqs. 12, 12f]
struct Stiffening {
  double branch = 1;  ///< 1 + g [-]
  double beta = 0;    ///< [s]

  bool operator==(const Stiffening&) const = default;
  double at(double dt) const { return branch + 2 * beta / dt; }
  /// Stable step of bodies of the frequency omega [s].
  double stable_step(double omega) const {
    return tread::stable_step(omega * std::sqrt(branch), beta / branch);
  }
};

/// By part.
std::vector<Stiffening> stiffenings(const Model& model) {
  std::vector<Stiffening> list;
  for (int part = 0; part < model.mesh.parts(); ++part) {
    const BodyForce* body = model.body_force_of(part);
    const auto b = static_cast<std::size_t>(part);
    const std::optional<MaxwellBranch>& branch = body ? body->branch() : model.branches[b];
    list.push_back({branch ? 1 + branch->strength : 1, body ? body->beta() : model.beta[b]});
  }
  return list;
}

/// As much as any part has of each kind of damping.
Stiffening largest_of(const std::vector<Stiffening>& parts) {
  Stiffening largest;
  for (const Stiffening& part : parts) {
    largest.branch = std::max(largest.branch, part.branch);
    largest.beta = std::max(largest.beta, part.beta);
  }
  return largest;
}

/// Damping of the materials: that of all parts, or of each part its own.
struct MaterialDamping {
  Stiffening all;                      ///< none where the parts have their own
  std::vector<Stiffening> parts = {};  ///< empty: `all`

  /// Factors of the parts' stiffnesses at the limit of the step dt [-].
  std::vector<double> factors(double dt) const {
    std::vector<double> list;
    for (const Stiffening& part : parts) list.push_back(part.at(dt));
    return list;
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

  /// From above, without damping [rad/s]. NumericalError if it is not finite.
  double frequency() const { return frequency_with(springs_, {}); }
  /// The same of parts as stiff as their own damping makes them at the limit of the step dt.
  double frequency(const MaterialDamping& material, double dt) const {
    return frequency_with(springs_, material.factors(dt));
  }
  /// The same with dampers as the springs (k + 2 c / dt) / stiffening of all parts that they are there.
  double frequency_with_dampers(const MaterialDamping& material, double dt) const {
    std::vector<Spring> springs = springs_;
    for (std::size_t i = 0; i < springs.size(); ++i)
      springs[i].stiffness = (springs[i].stiffness + 2 * damping_[i] / dt) / material.all.at(dt);
    return frequency_with(springs, material.factors(dt));
  }

 private:
  double frequency_with(const std::vector<Spring>& springs, const std::vector<double>& factors) const {
    const Operator elastic = [&](double* x, double* y) {
      system_.apply(x, y, factors);
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

/// Damping of the materials that `step.material` is made with. All parts as damped as any of them are on the
/// safe side. Where that takes much and they differ, the answer comes up from there: in a longer step each
/// part's own damping stiffens it less.
MaterialDamping find_material_step(const std::vector<Stiffening>& parts, const AssembledBodies& bodies,
                                   AssembledStep& step) {
  const MaterialDamping own{{}, parts};
  MaterialDamping damping{largest_of(parts)};
  step.material = damping.all.stable_step(step.omega);
  const bool alike = std::ranges::count(parts, damping.all) == std::ssize(parts);
  if (alike || step.material >= (1 - kStepTolerance) * stable_step(step.omega, 0)) return damping;
  for (int i = 0; i < kMostIterations; ++i) {
    const double next = stable_step(bodies.frequency(own, step.material), 0);
    if (next <= (1 + kStepTolerance) * step.material) break;
    step.material = next;
    damping = own;
  }
  return damping;
}

/// `omega`: AssembledBodies::frequency() [rad/s]
AssembledStep assembled_step(const Model& model, const AssembledBodies& bodies, double omega) {
  AssembledStep step;
  step.omega = omega;
  const MaterialDamping material = find_material_step(stiffenings(model), bodies, step);
  step.stable = step.material;
  // A shorter step makes the dampers stiffer: comes down on the answer from above and takes a little less.
  double last = step.material;
  for (int i = 0; bodies.damped() && i < kMostIterations; ++i) {
    const double next = material.all.stable_step(bodies.frequency_with_dampers(material, last));
    const bool settled = next >= (1 - kStepTolerance) * last;
    if (settled && i == 0) break;  // the dampers do not matter
    step.stable = (1 - 2 * kStepTolerance) * next;
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

const Material& material_of(const Model& model, std::size_t part) {
  const HexBody* body = model.mesh.body_of(static_cast<int>(part));
  return body ? body->materials.front() : model.mesh.blocks[part].materials.front();
}

/// beta w / 2 that leaves kLeastShare of the step [-].
constexpr double kMostFraction = 0.5 * (1 / kLeastShare - kLeastShare);

/// Part whose beta leaves the shortest step by its stiffest element.
std::size_t heaviest_damped(const std::vector<Stiffening>& parts,
                            const std::vector<StiffestElement>& elements) {
  const auto step = [&](std::size_t part) { return stable_step(2 / elements[part].step, parts[part].beta); };
  std::size_t heaviest = 0;
  for (std::size_t part = 0; part < parts.size(); ++part)
    if (parts[part].beta > 0 && (parts[heaviest].beta == 0 || step(part) < step(heaviest))) heaviest = part;
  return heaviest;
}

/// Betas of the parts; a branch takes a bounded part of the step.
std::vector<Stiffening> betas(const Model& model) {
  std::vector<Stiffening> parts = stiffenings(model);
  for (Stiffening& part : parts) part.branch = 1;
  return parts;
}

/// Returns true if a material states a beta that may take too much.
bool is_suspect(const Model& model) {
  const std::vector<Stiffening> parts = betas(model);
  for (std::size_t part = 0; part < parts.size(); ++part) {
    const double fraction = material_of(model, part).high_frequency_fraction;
    if (parts[part].beta > 0 && (fraction == 0 || fraction > kMostFraction)) return true;
  }
  return false;
}

std::size_t shortest_of(const std::vector<StiffestElement>& elements) {
  const auto shortest = std::ranges::min_element(elements, {}, &StiffestElement::step);
  return static_cast<std::size_t>(shortest - elements.begin());
}

/// Returns true if all elements have enough of their step; no assembled body is stiffer than its stiffest
/// one.
bool is_harmless(const Model& model, const std::vector<StiffestElement>& elements) {
  return largest_of(betas(model)).beta <= kMostFraction * elements[shortest_of(elements)].step;
}

/// refuse_heavy_damping() by the assembled bodies; `omega_free`: their frequency [rad/s].
void judge_damping(const Model& model, const std::vector<StiffestElement>& elements,
                   const AssembledBodies& bodies, double omega_free) {
  const std::vector<Stiffening> parts = betas(model);
  AssembledStep step;
  step.omega = omega_free;
  find_material_step(parts, bodies, step);
  const double free_step = stable_step(step.omega, 0);
  const double least = kLeastShare * free_step;
  if (step.material >= (1 - kStepTolerance) * least) return;

  const std::size_t part = heaviest_damped(parts, elements);
  const double beta = parts[part].beta;
  const double omega = 2 / elements[part].step;
  // Accepted for sure: by this element alone, or where all parts have it. Printed, it is still less.
  const double largest =
      0.995 * std::max(0.5 * (4 / (omega * omega * least) - least), kMostFraction * free_step);
  throw InputError(fmt::format(
      "material damping: a stiffness-proportional beta of {:.3g} s of material.{} needs a time step of 2/w "
      "(sqrt(1 + xi^2) - xi) = {:.2e} s in the stiffest element of {} (w = {:.3e} rad/s, xi = beta w/2 = "
      "{:.3g}) and {:.2e} s in the assembled bodies, {:.2g} % of their {:.2e} s without damping; at least "
      "{:g} % must be left: state rayleigh_beta of at most {:.3g} s, or {{ kind = "
      "\"high_frequency_fraction\", value = xi }} with xi of at most {:g} (LS-DYNA's positive COEF), or with "
      "this beta damping_up_to = \"3 kHz\" or another frequency that is enough",
      beta, material_of(model, part).name, stable_step(omega, beta), elements[part].name, omega,
      0.5 * beta * omega, step.material, 100 * step.material / free_step, free_step, 100 * kLeastShare,
      largest, kMostFraction));
}

}  // namespace

void refuse_heavy_damping(const Model& model) {
  if (!is_suspect(model)) return;
  const std::vector<StiffestElement> elements = stiffest_elements(model);
  if (is_harmless(model, elements)) return;
  const AssembledBodies bodies(model);
  judge_damping(model, elements, bodies, bodies.frequency());
}

double stable_step_of(const Model& model) {
  const AssembledBodies bodies(model);
  return assembled_step(model, bodies, bodies.frequency()).stable;
}

std::size_t StepLimit::stiffest_block() const {
  return shortest_of(stiffest);
}

StepLimit step_limit(const Model& model) {
  StepLimit limit;
  limit.stiffest = stiffest_elements(model);
  const AssembledBodies bodies(model);
  const double omega = bodies.frequency();
  if (is_suspect(model) && !is_harmless(model, limit.stiffest))
    judge_damping(model, limit.stiffest, bodies, omega);
  const AssembledStep step = assembled_step(model, bodies, omega);
  const Stiffening material = largest_of(stiffenings(model));
  limit.stable_step = step.stable;
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
