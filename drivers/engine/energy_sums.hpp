#pragma once
// Sums over all nodes in the energy balance, at the speed of memory.

#include <cstdint>
#include <vector>

#include "core/mesh/node_field.hpp"
#include "drivers/engine/model.hpp"

namespace tread {

/// Kinetic energy of the bodies that do not travel: v^T M v / 2. `v`: vector field [m/s]; result [J].
double fixed_kinetic_energy(const Model& model, ConstNodeField v);

/// Gravity potential of the bodies that do not travel: g sum(m u_z). `u`: vector field [m]; result [J].
double fixed_gravity_potential(const Model& model, ConstNodeField u);

/// The mean of both half steps' kinetic energies exceeds v- . M v+ / 2, which central difference conserves
/// together with the strain energy, by dt^2 / 4 F . M^-1 F [J]. `force`: vector field [N]; `unforced`:
/// unknowns that forces do not move, but for those that a vertical-only block lacks.
double half_step_excess(const Model& model, const std::vector<std::int64_t>& unforced, ConstNodeField force,
                        double dt);

}  // namespace tread
