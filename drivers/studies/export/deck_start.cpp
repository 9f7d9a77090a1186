#include "drivers/studies/export/deck_start.hpp"

#include <algorithm>
#include <array>
#include <functional>
#include <map>

#include "core/body_frame.hpp"
#include "drivers/studies/export/deck_units.hpp"
#include "kernels/element/element.hpp"

namespace tread {

namespace {

using Tensor = std::array<std::array<double, 3>, 3>;

/// A stress (xx, yy, zz, yz, zx, xy) of a block's bases as a tensor in the deck's axes.
Tensor turned(const std::array<double, 6>& s, const std::array<Vec3, 3>& bases) {
  const Tensor own = {{{s[0], s[5], s[4]}, {s[5], s[1], s[3]}, {s[4], s[3], s[2]}}};
  Tensor result = {};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      for (std::size_t a = 0; a < 3; ++a)
        for (std::size_t b = 0; b < 3; ++b)
          result[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)] +=
              bases[a][i] * own[a][b] * bases[b][j];
  return result;
}

/// Directions of the components of a stress in the middle between a station and the next.
std::array<Vec3, 3> bases_of(const SweptBlock& block, int station) {
  const double middle = block.stations[static_cast<std::size_t>(station)] + 0.5 * block.pitch(station);
  std::array<Vec3, 3> bases = {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};
  if (block.sweep == Sweep::revolved)
    for (Vec3& base : bases) base = cylindrical_to_cartesian(middle, base);
  return bases;
}

/// Stress of an element in the deck's axes [Pa].
Tensor stress_of(const DeckModel& deck, const VtkGrid::Cell& cell) {
  const SweptBlock& block = deck.model().mesh.blocks[static_cast<std::size_t>(cell.block)];
  return turned(deck.model().internal->stress(cell.block, cell.quad, cell.station, deck.displacement()),
                bases_of(block, cell.station));
}

using CornerForces = std::array<Vec3, 8>;

/// The part of a displacement of an element's corners beyond the linear field of its mean gradients.
std::array<Vec3, 8> beyond_linear(const HexNodes& places, const std::array<Vec3, 8>& displacement) {
  const ElementGeometry geometry = element_geometry(places);
  std::array<Vec3, 3> gradient;  // of each component
  for (std::size_t mode = 0; mode < kGradientModes; ++mode)
    for (int node = 0; node < 8; ++node)
      for (int i = 0; i < 3; ++i)
        gradient[static_cast<std::size_t>(i)] += mode_value(static_cast<Mode>(mode), node) *
                                                 displacement[static_cast<std::size_t>(node)][i] *
                                                 geometry.gradient[mode];
  std::array<Vec3, 8> beyond;
  for (std::size_t node = 0; node < 8; ++node)
    for (int i = 0; i < 3; ++i)
      beyond[node][i] = displacement[node][i] - displacement[0][i] -
                        dot(gradient[static_cast<std::size_t>(i)], places[node] - places[0]);
  return beyond;
}

/// Forces of an element's hourglass stiffness on its corners, in the deck's axes [N]. They balance.
CornerForces hourglass_of(const DeckModel& deck, const VtkGrid::Cell& cell, const std::int64_t* corner) {
  const SweptBlock& block = deck.model().mesh.blocks[static_cast<std::size_t>(cell.block)];
  HexNodes places;
  std::array<Vec3, 8> displacement;
  std::array<int, 8> station = {};
  for (std::size_t node = 0; node < 8; ++node) {
    const VtkGrid::Point& point = deck.grid().points[static_cast<std::size_t>(corner[node])];
    station[node] = point.station;
    places[node] = deck.undeformed_place(point);
    displacement[node] = deck.place(point) - places[node];
  }
  const std::array<Vec3, 8> beyond = beyond_linear(places, displacement);
  std::array<double, 24> u = {};
  for (std::size_t node = 0; node < 8; ++node) {
    const Vec3 own = to_local(block, station[node], 0, beyond[node]);
    for (std::size_t i = 0; i < 3; ++i) u[3 * node + i] = own[static_cast<int>(i)];
  }
  const ElementStiffness stiffness =
      deck.model().internal->element_stiffness(cell.block, cell.quad, cell.station);
  CornerForces forces;
  for (std::size_t node = 0; node < 8; ++node) {
    Vec3 own;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t k = 0; k < 24; ++k) own[static_cast<int>(i)] += stiffness[3 * node + i][k] * u[k];
    forces[node] = to_cartesian(block, station[node], 0, own);
  }
  return forces;
}

double largest_of(const CornerForces& forces) {
  double largest = 0;
  for (const Vec3& force : forces) largest = std::max(largest, norm(force));
  return largest;
}

}  // namespace

std::vector<std::pair<std::int64_t, Vec3>> hourglass_forces(const DeckModel& deck,
                                                            const KeptHourglass& keep) {
  std::vector<CornerForces> elements;
  std::vector<double> sizes;
  const std::int64_t* corner = deck.grid().connectivity.data();
  for (const VtkGrid::Cell& cell : deck.grid().cells) {
    elements.push_back(hourglass_of(deck, cell, corner));
    sizes.push_back(largest_of(elements.back()));
    corner += deck.grid().corners();
  }
  std::vector<double> descending = sizes;
  std::sort(descending.begin(), descending.end(), std::greater<>());
  double bound = keep.smallest * descending.front();
  if (descending.size() > keep.elements) bound = std::max(bound, descending[keep.elements]);
  // Whole elements are kept or left out, so that what is kept balances.
  std::map<std::int64_t, Vec3> kept;
  for (std::size_t i = 0; i < elements.size(); ++i)
    for (std::size_t node = 0; node < 8; ++node)
      if (sizes[i] > bound) kept[deck.grid().connectivity[8 * i + node] + 1] -= elements[i][node];
  return {kept.begin(), kept.end()};
}

std::vector<RadiossReference> references(const DeckModel& deck) {
  std::vector<RadiossReference> all;
  for (const auto& [part, block] : deck.parts) {
    RadiossReference reference{part, {}};
    std::int64_t node = 0;
    for (const VtkGrid::Point& point : deck.grid().points) {
      ++node;
      if (point.block == block)
        reference.nodes.emplace_back(node, deck_unit::kLength * deck.undeformed_place(point));
    }
    all.push_back(std::move(reference));
  }
  return all;
}

void write_stresses(const DeckModel& deck, KeywordDeck& out) {
  static constexpr std::array<int, 5> kLargeCard = {16, 16, 16, 16, 16};
  out.remark("Stresses of the static state, in the middle of each element.");
  out.keyword("*INITIAL_STRESS_SOLID");
  out.names({"eid", "nint", "nhisv", "large"});
  out.names(kLargeCard, {"sigxx", "sigyy", "sigzz", "sigxy", "sigyz"});
  out.names(kLargeCard, {"sigzx", "eps"});
  std::int64_t element = 0;
  for (const VtkGrid::Cell& cell : deck.grid().cells) {
    const Tensor stress = stress_of(deck, cell);
    const auto at = [&](std::size_t i, std::size_t j) { return deck_unit::kStress * stress[i][j]; };
    out.card({++element, 1, 0, 1});
    out.card(kLargeCard, {at(0, 0), at(1, 1), at(2, 2), at(0, 1), at(1, 2)});
    out.card(kLargeCard, {at(2, 0), 0.0});
  }
}

std::vector<std::pair<std::int64_t, Vec3>> node_velocities(const DeckModel& deck) {
  std::vector<std::pair<std::int64_t, Vec3>> velocities;
  std::int64_t node = 0;
  for (const VtkGrid::Point& point : deck.grid().points)
    velocities.emplace_back(++node, deck.velocity(point));
  velocities.insert(velocities.end(), deck.moving.begin(), deck.moving.end());
  return velocities;
}

void write_node_velocities(const DeckModel& deck, KeywordDeck& out) {
  out.remark("Velocities at t = 0.");
  out.keyword("*INITIAL_VELOCITY_NODE");
  out.names({"nid", "vx", "vy", "vz"});
  for (const auto& [node, velocity] : node_velocities(deck))
    out.card({node, velocity.x, velocity.y, velocity.z});
}

}  // namespace tread
