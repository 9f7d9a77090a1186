#pragma once
// Pressure and friction of all points of the patch, solved together with the motion that they cause.
// [theory.md, Contact]

#include <array>
#include <cstdint>
#include <vector>

#include "core/body_frame.hpp"
#include "core/mesh/node_field.hpp"
#include "kernels/contact/contact_point.hpp"
#include "kernels/contact/friction/friction_law.hpp"
#include "kernels/lanes/patch_sum.hpp"

namespace tread {

struct TileForces;

/// Nodal fields after a step without contact, components in the nodes' local bases.
struct NodeMotion {
  NodeField displacement;      ///< at the end of the step [m]
  NodeField velocity;          ///< mean of the step, relative to the frame [m/s]
  const double* inverse_mass;  ///< by slot [1/kg]
};

/// Springs of a point: the normal penalty and the elastic stick.
struct PointSprings {
  double penalty;  ///< normal stiffness per area [Pa/m]
  ElasticStick stick;

  /// Energy stored per area [J/m2].
  double stored(double pressure, const Traction& shear) const {
    return 0.5 * pressure * pressure / penalty + stick.stored(shear);
  }
};

/// Gauss and Seidel's method over the points, in a fixed order.
class PatchSolver {
 public:
  PatchSolver();
  /// Makes room for fields of `slots` nodes and for `points` points that carry `nodes` nodes at once.
  void reserve(std::int64_t slots, std::size_t points, std::size_t nodes);

  /// Sets pressure, shear, closing and slip speed of the points for a step of length dt [s] from their gap,
  /// motion and tractions before it, and adds the impulses to the motion. Moves the states of the friction
  /// law on; a point that carries no pressure forgets its state.
  void solve(std::vector<ContactPoint>& points, const PointSprings& springs, Friction& friction,
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
  /// Coefficient of friction of each point.
  template <class Law>
  struct Coefficients {
    double uniform;
    const double* by_point;

    double operator[](std::size_t i) const {
      if constexpr (Law::kUniform)
        return uniform;
      else
        return by_point[i];
    }
  };
  /// Largest values over all points. [Pa]
  struct Sweep {
    double change = 0;   ///< of a traction
    double largest = 0;  ///< pressure
  };
  struct Step {
    PointSprings springs;
    double dt;  ///< [s]
  };
  void link(const std::vector<ContactPoint>& points, const BodyFrame& wheel, const NodeMotion& motion,
            double dt);
  /// Adds an impulse on the rail, and its opposite on the wheel. [N s]
  void push(const Link& link, const Vec3& impulse);
  /// Velocity of the wheel against the rail: closing, along, across. [m/s]
  Vec3 relative_velocity(const ContactPoint& point, const Link& link) const;
  template <class Law>
  Coefficients<Law> advance(const std::vector<ContactPoint>& points, FrictionOf<Law>& friction, double dt);
  template <class Law>
  void solve_with(std::vector<ContactPoint>& points, const Coefficients<Law>& friction, bool rubs,
                  const Step& step);
  template <bool rubs, class Law>
  Sweep sweep(std::vector<ContactPoint>& points, const Coefficients<Law>& friction, const Step& step);
  /// Sets the slip speed of points without friction, which no sweep needs.
  void slip_freely(std::vector<ContactPoint>& points) const;
  void write_back(const NodeMotion& motion, double spin, double dt);

  const TileForces* lanes_;   ///< the widest instruction set's loops
  std::vector<int> node_of_;  ///< by slot, -1: none
  std::vector<Node> nodes_;
  std::vector<PatchVector> change_;  ///< of the nodes' velocities by contact, over their mobility
  std::vector<Link> links_;
  std::vector<double> coefficient_;  ///< of friction, by point; empty for a uniform law
};

}  // namespace tread
