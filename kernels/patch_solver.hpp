#pragma once
// Pressure and friction of all points of the patch together, such that they belong to the motion that they
// themselves cause. [theory.md, Contact]

#include <array>
#include <cstdint>
#include <vector>

#include "core/body_frame.hpp"
#include "core/mesh/node_field.hpp"
#include "kernels/contact_point.hpp"
#include "kernels/friction.hpp"

namespace tread {

/// Nodal fields after a step without contact, components in the nodes' local bases.
struct NodeMotion {
  NodeField displacement;      ///< at the end of the step [m]
  NodeField velocity;          ///< mean of the step, relative to the frame [m/s]
  const double* inverse_mass;  ///< by slot [1/kg]
};

class PatchSolver {
 public:
  /// Makes room for fields of `slots` nodes, of which `points` points carry `nodes` at once.
  void reserve(std::int64_t slots, std::size_t points, std::size_t nodes);

  /// Sets pressure, shear, closing and slip speed of the points for a step of length dt [s] from their gap,
  /// motion and shear before it, and adds the impulses to the motion. `penalty`: normal stiffness [Pa/m].
  void solve(std::vector<ContactPoint>& points, double penalty, const CoulombFriction& friction,
             const BodyFrame& wheel, const NodeMotion& motion, double dt);

  std::int64_t bytes() const;

 private:
  /// A vector and a zero, in two registers of every processor.
  struct Padded {
    typedef double Half __attribute__((vector_size(2 * sizeof(double))));
    Half xy, z0;

    Padded() : xy{}, z0{} {}
    explicit Padded(const Vec3& v) : xy{v.x, v.y}, z0{v.z, 0} {}
    operator Vec3() const { return {xy[0], xy[1], z0[0]}; }
    void add(double weight, const Padded& other) {
      xy += weight * other.xy;
      z0 += weight * other.z0;
    }
  };
  struct Node {
    std::int64_t slot;
    bool of_wheel;
    Padded free;  ///< velocity without contact, in the node's basis [m/s]
  };
  struct Link {
    std::array<int, kSupport> rail, wheel;  ///< into nodes_
    Padded frame_velocity;                  ///< of the wheel's frame at the point [m/s]
    double compliance;                      ///< half of dt^2 A sum(w^2 / m) [m/Pa]
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
  void push(const ContactPoint& point, const Link& link, const Vec3& impulse);
  Vec3 relative_velocity(const ContactPoint& point, const Link& link) const;
  template <bool rubs>
  Sweep sweep(std::vector<ContactPoint>& points, const Law& law);
  /// Slip of points without friction, which no sweep needs.
  void slip_freely(std::vector<ContactPoint>& points) const;
  void write_back(const NodeMotion& motion, double spin, double dt);

  std::vector<int> node_of_;  ///< by slot, -1: none
  std::vector<Node> nodes_;
  std::vector<Padded> velocity_;      ///< of the nodes with contact, in their bases [m/s]
  std::vector<double> inverse_mass_;  ///< of the nodes [1/kg]
  std::vector<Link> links_;
};

}  // namespace tread
