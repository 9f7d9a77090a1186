#include "drivers/engine/fields/energy_sums.hpp"

#include <algorithm>

#include "core/index.hpp"
#include "kernels/update/inverse_mass.hpp"

namespace tread {

namespace {

/// Sums weight(slot) times `term` of the values of a tile's slots, for the components [first_component, 3).
template <class Weight, class Term>
double weighted_sum(const SweptBlock& block, int tile, int first_component, const Weight& weight,
                    ConstNodeField field, const Term& term) {
  const std::int64_t nodes = block.section.nodes();
  const std::int64_t first = block.base / kLanes + tile * nodes;
  double lanes[kLanes] = {};
  for (std::int64_t group = first; group < first + nodes; ++group) {
    const NodeLanes values = field.lanes(group * kLanes);
    double weights[kLanes];
    for (int l = 0; l < kLanes; ++l) weights[l] = weight(group * kLanes + l);
    for (int c = first_component; c < 3; ++c)
      for (int l = 0; l < kLanes; ++l) lanes[l] += weights[l] * term(values[c][l]);
  }
  double sum = 0;
  for (const double lane : lanes) sum += lane;
  return sum;
}

constexpr auto square = [](double value) { return value * value; };
constexpr auto itself = [](double value) { return value; };

/// The same of a body's slots.
template <class Weight, class Term>
double weighted_sum(const HexBody& body, int first_component, const Weight& weight, ConstNodeField field,
                    const Term& term) {
  double sum = 0;
  for (std::int64_t node = 0; node < body.nodes(); ++node) {
    const Vec3 value = field.at(body.slot(node));
    for (int c = first_component; c < 3; ++c) sum += weight(body.slot(node)) * term(value[c]);
  }
  return sum;
}

}  // namespace

template <class Term>
double EnergySums::sum_of_fixed(int first_component, ConstNodeField field, const TileShare* share,
                                const Term& term) const {
  const auto mass = [&](std::int64_t slot) { return model_->mass[index(slot)]; };
  auto sum = sum_tiles<double>(model_->mesh, fixed_, share, [&](int block, int tile) {
    return weighted_sum(swept(block), tile, first_component, mass, field, term);
  });
  for (const HexBody& body : model_->mesh.bodies)
    if (!body.spins) sum += weighted_sum(body, first_component, mass, field, term);
  return sum;
}

double EnergySums::fixed_kinetic_energy(ConstNodeField v, const TileShare* share) const {
  return 0.5 * sum_of_fixed(0, v, share, square);
}

double EnergySums::fixed_gravity_potential(ConstNodeField u, const TileShare* share) const {
  return model_->scene.gravity * sum_of_fixed(2, u, share, itself);
}

double EnergySums::half_step_excess(ConstNodeField force, double dt, const TileShare* share) const {
  const auto mobility = [&](std::int64_t slot) { return inverse_mass(model_->mass[index(slot)]); };
  // Unknowns that forces do not move have no part in it.
  const auto unforced = [&](std::int64_t first_slot, std::int64_t end_slot) {
    double sum = 0;
    for (auto at = std::lower_bound(unforced_.begin(), unforced_.end(), 3 * first_slot);
         at != unforced_.end() && *at < 3 * end_slot; ++at)
      sum += mobility(slot_of(*at)) * square(force[*at]);
    return sum;
  };
  auto sum = sum_tiles<double>(model_->mesh, all_, share, [&](int number, int tile) {
    const SweptBlock& block = swept(number);
    const std::int64_t first = block.base + std::int64_t{tile} * block.section.nodes() * kLanes;
    return weighted_sum(block, tile, block.vertical_only ? 2 : 0, mobility, force, square) -
           unforced(first, first + std::int64_t{block.section.nodes()} * kLanes);
  });
  for (const HexBody& body : model_->mesh.bodies)
    sum += weighted_sum(body, 0, mobility, force, square) - unforced(body.base, body.base + body.slots());
  return 0.25 * dt * dt * sum;
}

}  // namespace tread
