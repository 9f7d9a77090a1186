#include "kernels/time_update.hpp"

#include <array>
#include <cmath>

#include "core/parallel.hpp"

namespace tread {

void update_fixed_block(const SweptBlock& block, const UpdateFields& fields, double gravity, double dt,
                        bool vertical_only) {
  const std::int64_t groups = block.slots() / kLanes;
  const std::int64_t first_group = block.base / kLanes;
  parallel_ranges(groups, [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t g = first_group + first; g < first_group + last; ++g) {
      const double* inverse = fields.inverse_mass + g * kLanes;
      for (int c = vertical_only ? 2 : 0; c < 3; ++c) {
        double* u = fields.displacement + (g * 3 + c) * kLanes;
        double* v = fields.velocity + (g * 3 + c) * kLanes;
        const double* f = fields.force + (g * 3 + c) * kLanes;
        const double weight = c == 2 ? gravity : 0.0;
        for (int l = 0; l < kLanes; ++l) {
          const double moves = inverse[l] > 0 ? 1.0 : 0.0;
          v[l] -= dt * (inverse[l] * f[l] + moves * weight);
          u[l] += dt * v[l];
        }
      }
    }
  });
}

void update_spinning_block(const SweptBlock& block, const UpdateFields& fields, const BodyFrame& frame,
                           double gravity, double dt) {
  const int section_nodes = block.section.nodes();
  const double turn_c = std::cos(2 * frame.spin * dt);
  const double turn_s = std::sin(2 * frame.spin * dt);
  const double spin2 = frame.spin * frame.spin;
  const double half = 0.5 * dt;
  parallel_ranges(static_cast<std::int64_t>(block.tiles.size()), [&](std::int64_t first, std::int64_t last) {
    for (std::int64_t t = first; t < last; ++t) {
      const Tile& tile = block.tiles[static_cast<std::size_t>(t)];
      std::array<double, kLanes> weight_t{};
      std::array<double, kLanes> weight_r{};
      for (int l = 0; l < tile.stations; ++l) {
        const double phi = block.stations[static_cast<std::size_t>(tile.first_station + l)] + frame.angle;
        weight_t[static_cast<std::size_t>(l)] = -gravity * std::sin(phi);
        weight_r[static_cast<std::size_t>(l)] = gravity * std::cos(phi);
      }
      for (int node = 0; node < section_nodes; ++node) {
        const std::int64_t group = block.base / kLanes + t * section_nodes + node;
        const double radius = block.section.q[static_cast<std::size_t>(node)];
        const double* inverse = fields.inverse_mass + group * kLanes;
        double* u = fields.displacement + group * 3 * kLanes;
        double* w = fields.velocity + group * 3 * kLanes;
        const double* f = fields.force + group * 3 * kLanes;
        for (int l = 0; l < kLanes; ++l) {
          const double moves = inverse[l] > 0 ? 1.0 : 0.0;
          const int y = kLanes + l;
          const int r = 2 * kLanes + l;
          const double a_t =
              moves * (weight_t[static_cast<std::size_t>(l)] + spin2 * u[l]) - inverse[l] * f[l];
          const double a_r =
              moves * (weight_r[static_cast<std::size_t>(l)] + spin2 * (radius + u[r])) - inverse[l] * f[r];
          const double w_t = w[l] + half * a_t;
          const double w_r = w[r] + half * a_r;
          w[l] = turn_c * w_t - turn_s * w_r + half * a_t;
          w[r] = turn_s * w_t + turn_c * w_r + half * a_r;
          w[y] -= dt * inverse[l] * f[y];
          u[l] += dt * w[l];
          u[y] += dt * w[y];
          u[r] += dt * w[r];
        }
      }
    }
  });
}

}  // namespace tread
