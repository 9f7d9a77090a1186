#pragma once
// Pressure and friction of all points of the patch, solved together with the motion that they cause.
// [theory.md, Contact]

#include <cstdint>
#include <vector>

#include "core/body_frame.hpp"
#include "core/mesh/node_field.hpp"
#include "kernels/contact/contact_point.hpp"
#include "kernels/contact/friction/friction_law.hpp"
#include "kernels/contact/friction/point_response.hpp"
#include "kernels/lanes/patch_loop.hpp"

namespace tread {

struct TileForces;

/// Nodal fields after a step without contact, components in the nodes' local bases.
struct NodeMotion {
  NodeField displacement;      ///< at the end of the step [m]
  NodeField velocity;          ///< mean of the step, relative to the frame [m/s]
  const double* inverse_mass;  ///< by slot [1/kg]
};

/// Jacobi's method with momentum: all points of an iteration respond to the motion that the iteration before
/// leaves, then all nodes sum up the impulses of their points. Points and nodes are shared by the threads of
/// a large patch; the bits do not depend on them.
class PatchSolver {
 public:
  PatchSolver();
  /// Makes room for fields of `slots` nodes and for `points` points that carry `nodes` nodes at once.
  void reserve(std::int64_t slots, std::size_t points, std::size_t nodes);

  /// Sets pressure, shear, closing and slip speed of the points for a step of length dt [s] from their gap,
  /// motion and tractions before it, and adds the impulses to the motion. Moves the states of the friction
  /// law on; a point without pressure forgets its state. Removes points that were apart and stay so.
  void solve(std::vector<ContactPoint>& points, const PointSprings& springs, Friction& friction,
             const BodyFrame& wheel, const NodeMotion& motion, double dt);

  /// Iterations of the last solution.
  int iterations() const { return iterations_; }

  std::int64_t bytes() const;

 private:
  struct Node {
    std::int64_t slot;
    bool of_wheel;
    double cosine, sine;  ///< of the space angle of its basis (wheel)
    double mobility;      ///< square root of the inverse mass [kg^-1/2]
  };
  /// Largest values over all points. [Pa]
  struct Progress {
    double change;   ///< of a traction
    double largest;  ///< pressure
  };

  void link(const std::vector<ContactPoint>& points, const BodyFrame& wheel, const NodeMotion& motion);
  void list_points_of_nodes();
  void fill_tiles(const std::vector<ContactPoint>& points, double dt);
  template <class Law>
  void advance(const std::vector<ContactPoint>& points, FrictionOf<Law>& friction, double dt);
  void set_compliances(const std::vector<ContactPoint>& points, double dt);
  void guess(const std::vector<ContactPoint>& points, const PointSprings& springs, double dt);
  void iterate(const std::vector<ContactPoint>& points, const PointSprings& springs, double dt);
  Progress respond(std::size_t points, const PointIteration& iteration);
  /// Sets the nodes' change of velocity from the impulses of their points.
  void sum_impulses();
  PatchTerms nodes_of(std::size_t point) const;
  /// Sets the tractions of the points, and the impulses to them alone.
  void settle(std::vector<ContactPoint>& points, double dt);
  void set_speeds(std::vector<ContactPoint>& points) const;
  void write_back(const NodeMotion& motion, double spin, double dt);

  const TileForces* lanes_;   ///< the widest instruction set's loops
  std::vector<int> node_of_;  ///< by slot, -1: none
  std::vector<Node> nodes_;
  std::vector<PointTile> tiles_;
  std::vector<PatchVector> free_;     ///< velocity of the points, wheel against rail, without contact [m/s]
  std::vector<PatchVector> impulse_;  ///< of the points on the wheel [N s]
  std::vector<PatchVector> change_;   ///< of the nodes' velocities by contact, over their mobility
  /// Nodes of the points, kLinkedNodes each, and the wheel's weights against the rail's, times mobility
  /// [kg^-1/2].
  std::vector<int> node_;
  std::vector<double> node_weight_;
  /// The same by node: terms first_point_[n] to first_point_[n + 1].
  std::vector<int> first_point_, point_;
  std::vector<double> point_weight_;
  int iterations_ = 0;
};

}  // namespace tread
