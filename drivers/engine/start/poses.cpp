#include "drivers/engine/start/poses.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>

#include "kernels/contact/contact_surface.hpp"

namespace tread {

double wheel_tilt(const Model& model, ConstNodeField displacement, double angle) {
  if (model.index.tread < 0) return 0;
  // The tread's lateral displacement varies as the depth below the axle. Masses stand for the areas of nodes,
  // whatever the mesh.
  const SweptBlock& block = model.mesh.blocks[static_cast<std::size_t>(model.index.tread)];
  const SurfaceProfile profile(block.section);
  double mass = 0, first = 0, second = 0, sideways = 0, moment = 0;
  for (int ordinal = 0; ordinal <= profile.edges(); ++ordinal) {
    const int node = profile.node(ordinal);
    for (int station = 0; station < block.station_count(); ++station) {
      const std::int64_t slot = block.base + block.slot(node, station);
      const double m = model.mass[static_cast<std::size_t>(slot)];
      const double down = block.section.q[static_cast<std::size_t>(node)] *
                          std::cos(block.stations[static_cast<std::size_t>(station)] + angle);
      const double across = displacement[dof(slot, 1)];
      mass += m;
      first += m * down;
      second += m * down * down;
      sideways += m * across;
      moment += m * down * across;
    }
  }
  return (mass * moment - first * sideways) / (mass * second - first * first);
}

SectionPose head_pose(const Model& model, ConstNodeField displacement, double x) {
  const SweptBlock& head = model.mesh.blocks[static_cast<std::size_t>(model.index.rail_cap)];
  const auto at = std::lower_bound(head.stations.begin(), std::prev(head.stations.end()), x);
  const auto station = static_cast<int>(at - head.stations.begin());
  const Section& section = head.section;
  const SurfaceProfile profile(section);
  const std::array sides = {profile.node(0), profile.node(profile.edges())};
  std::array<Vec3, 2> place, moved;
  for (const std::size_t i : {0, 1}) {
    const auto node = static_cast<std::size_t>(sides[i]);
    place[i] = {0, section.p[node], section.q[node]};
    moved[i] = displacement.at(head.base + head.slot(sides[i], station));
  }
  const double roll = (moved[1].z - moved[0].z) / (place[1].y - place[0].y);
  return {roll, 0.5 * (moved[0].y + moved[1].y) + roll * 0.5 * (place[0].z + place[1].z)};
}

}  // namespace tread
