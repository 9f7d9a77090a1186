#include "drivers/engine/energy_sums.hpp"

#include "core/parallel/chunks.hpp"

namespace tread {

namespace {

/// Sums weight[slot] times `term` of the values of a group of slots, for the components [first, 3) of a
/// block.
template <class Term>
double weighted_sum(const SweptBlock& block, int first_component, const double* weight, ConstNodeField field,
                    const Term& term) {
  const std::int64_t base = block.base / kLanes;
  return sum_chunks(block.slots() / kLanes, [&](std::int64_t first, std::int64_t last) {
    double lanes[kLanes] = {};
    for (std::int64_t group = base + first; group < base + last; ++group) {
      const NodeLanes values = field.lanes(group * kLanes);
      for (int c = first_component; c < 3; ++c)
        for (int l = 0; l < kLanes; ++l) lanes[l] += weight[group * kLanes + l] * term(values[c][l]);
    }
    double sum = 0;
    for (const double lane : lanes) sum += lane;
    return sum;
  });
}

}  // namespace

double fixed_kinetic_energy(const Model& model, ConstNodeField v) {
  double sum = 0;
  for (const SweptBlock& block : model.mesh.blocks)
    if (block.sweep == Sweep::extruded)
      sum += 0.5 * weighted_sum(block, 0, model.mass.data(), v, [](double value) { return value * value; });
  return sum;
}

double fixed_gravity_potential(const Model& model, ConstNodeField u) {
  double sum = 0;
  for (const SweptBlock& block : model.mesh.blocks)
    if (block.sweep == Sweep::extruded)
      sum += weighted_sum(block, 2, model.mass.data(), u, [](double value) { return value; });
  return model.scene.gravity * sum;
}

double half_step_excess(const Model& model, const std::vector<std::int64_t>& unforced, ConstNodeField force,
                        double dt) {
  const double* inverse_mass = model.inverse_mass.data();
  double sum = 0;
  for (const SweptBlock& block : model.mesh.blocks)
    sum += weighted_sum(block, block.vertical_only ? 2 : 0, inverse_mass, force,
                        [](double value) { return value * value; });
  for (const std::int64_t unknown : unforced)
    sum -= inverse_mass[unknown / (3 * kLanes) * kLanes + unknown % kLanes] * force[unknown] * force[unknown];
  return 0.25 * dt * dt * sum;
}

}  // namespace tread
