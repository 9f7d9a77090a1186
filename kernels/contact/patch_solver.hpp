#pragma once
// Pressure and friction of all points of the patch together, such that they belong to the motion that they
// themselves cause. [theory.md, Contact]

#include <array>
#include <cstdint>
#include <vector>

#include "core/body_frame.hpp"
#include "core/mesh/node_field.hpp"
#include "kernels/contact/contact_point.hpp"
#include "kernels/contact/friction.hpp"
#include "kernels/lanes/patch_sum.hpp"

namespace tread {

struct TileForces;

/// Nodal fields after a step without contact, components in the nodes' local bases.
struct NodeMotion {
  NodeField displacement;      ///< at the end of the step [m]
  NodeField velocity;          ///< mean of the step, relative to the frame [m/s]
  const double* inverse_mass;  ///< by slot [1/kg]
};

class PatchSolver {
 public:
  PatchSolver();
  /// Makes room for fields of `slots` nodes, of which `points` points carry `nodes` at once.
  void reserve(std::int64_t slots, std::size_t points, std::size_t nodes);

  /// Sets pressure, shear, closing and slip speed of the points for a step of length dt [s] from their gap,
  /// motion and shear before it, and adds the impulses to the motion. `penalty`: normal stiffness [Pa/m].
  void solve(std::vector<ContactPoint>& points, double penalty, const CoulombFriction& friction,
             const BodyFrame& wheel, const NodeMotion& motion, double dt);

  std::int64_t bytes() const;

 private:
  struct Node {
    std::int64_t slot;
    bool of_wheel;
    double cosine, sine;  ///< of the space angle of its basis (wheel)
    double mobility;      ///< square root of the inverse mass [kg^-1/2]
  };
  struct Link {
    PatchLink nodes;    ///< into nodes_; weights of the wheel's against the rail's, times mobility [kg^-1/2]
    PatchVector free;   ///< velocity of the wheel against the rail without contact [m/s]
    Vec3 before;        ///< the same of the step before: closing, along, across [m/s]
    double compliance;  ///< half of dt^2 A sum(w^2 / m) [m/Pa]
  };
  struct Law {
    double penalty;  ///< [Pa/m]
    CoulombFriction friction;
    double dt;  ///< [s]
  };
  /// Of all points. [Pa]
  struct Sweep {
    double change = 0;   ///< largest of a traction
    double largest = 0;  ///< pressure
  };
  void link(const std::vector<ContactPoint>& points, const BodyFrame& wheel, const NodeMotion& motion,
            double dt);
  /// Adds an impulse on the rail, and its opposite on the wheel. [N s]
  void push(const Link& link, const Vec3& impulse);
  /// Of the wheel against the rail: closing, along, across. [m/s]
  Vec3 relative_velocity(const ContactPoint& point, const Link& link) const;
  template <bool rubs>
  Sweep sweep(std::vector<ContactPoint>& points, const Law& law);
  /// Slip of points without friction, which no sweep needs.
  void slip_freely(std::vector<ContactPoint>& points) const;
  void write_back(const NodeMotion& motion, double spin, double dt);

  const TileForces* lanes_;   ///< the widest instruction set's loops
  std::vector<int> node_of_;  ///< by slot, -1: none
  std::vector<Node> nodes_;
  std::vector<PatchVector> change_;  ///< of the nodes' velocities by contact, over their mobility
  std::vector<Link> links_;
};

}  // namespace tread
