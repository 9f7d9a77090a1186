#include "drivers/engine/energy_sums.hpp"

#include <algorithm>

namespace tread {

namespace {

/// Sums weight[slot] times `term` of the values of a tile's slots, for the components [first_component, 3).
template <class Term>
double weighted_sum(const SweptBlock& block, int tile, int first_component, const double* weight,
                    ConstNodeField field, const Term& term) {
  const std::int64_t nodes = block.section.nodes();
  const std::int64_t first = block.base / kLanes + tile * nodes;
  double lanes[kLanes] = {};
  for (std::int64_t group = first; group < first + nodes; ++group) {
    const NodeLanes values = field.lanes(group * kLanes);
    for (int c = first_component; c < 3; ++c)
      for (int l = 0; l < kLanes; ++l) lanes[l] += weight[group * kLanes + l] * term(values[c][l]);
  }
  double sum = 0;
  for (const double lane : lanes) sum += lane;
  return sum;
}

double square(double value) {
  return value * value;
}

}  // namespace

double EnergySums::fixed_kinetic_energy(ConstNodeField v, const TileShare* share) const {
  return 0.5 * sum_tiles<double>(model_->mesh, fixed_, share, [&](int block, int tile) {
           return weighted_sum(swept(block), tile, 0, model_->mass.data(), v, square);
         });
}

double EnergySums::fixed_gravity_potential(ConstNodeField u, const TileShare* share) const {
  return model_->scene.gravity * sum_tiles<double>(model_->mesh, fixed_, share, [&](int block, int tile) {
           return weighted_sum(swept(block), tile, 2, model_->mass.data(), u,
                               [](double value) { return value; });
         });
}

double EnergySums::half_step_excess(ConstNodeField force, double dt, const TileShare* share) const {
  const double* const inverse_mass = model_->inverse_mass.data();
  return 0.25 * dt * dt * sum_tiles<double>(model_->mesh, all_, share, [&](int number, int tile) {
           const SweptBlock& block = swept(number);
           double sum = weighted_sum(block, tile, block.vertical_only ? 2 : 0, inverse_mass, force, square);
           const std::int64_t first = block.base + std::int64_t{tile} * block.section.nodes() * kLanes;
           const std::int64_t end = first + std::int64_t{block.section.nodes()} * kLanes;
           for (auto at = std::lower_bound(unforced_.begin(), unforced_.end(), 3 * first);
                at != unforced_.end() && *at < 3 * end; ++at)
             sum -= inverse_mass[*at / (3 * kLanes) * kLanes + *at % kLanes] * square(force[*at]);
           return sum;
         });
}

}  // namespace tread
