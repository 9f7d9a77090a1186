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
#include "kernels/contact/patch_cells.hpp"
#include "kernels/lanes/patch_loop.hpp"

namespace tread {

/// Nodal fields after a step without contact, components in the nodes' local bases.
struct NodeMotion {
  NodeField displacement;  ///< at the end of the step [m]
  NodeField velocity;      ///< mean of the step, relative to the frame [m/s]
  const double* mass;      ///< by slot [kg]
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

  /// Nodes that carry the points of the last solution.
  const std::vector<PatchCells::Node>& nodes() const { return cells_.nodes(); }
  /// Iterations of the last solution.
  int iterations() const { return iterations_; }
  /// Last change of a traction over the largest pressure, if the iterations of the last solution ended beyond
  /// kTractionTolerance; or 0.
  double unsettled() const { return unsettled_; }

  std::int64_t bytes() const;

 private:
  /// Largest values over all points. [Pa]
  struct Progress {
    double change;   ///< of a traction
    double largest;  ///< pressure
  };

  /// Sets the points' velocities without contact.
  void set_free(const std::vector<ContactPoint>& points, const BodyFrame& wheel, const NodeMotion& motion);
  void fill_tiles(const std::vector<ContactPoint>& points, double dt);
  template <class Law>
  void advance(const std::vector<ContactPoint>& points, FrictionOf<Law>& friction, double dt);
  void set_compliances(const std::vector<ContactPoint>& points, double dt);
  void guess(const std::vector<ContactPoint>& points, const PointSprings& springs, double dt);
  void iterate(const std::vector<ContactPoint>& points, const PointSprings& springs, double dt);
  Progress respond(std::size_t points, const PointIteration& iteration);
  /// Sets the change of velocity of nodes and points from the impulses of the points.
  void sum_impulses();
  /// Sets the tractions of the points, and the impulses to them alone.
  void settle(std::vector<ContactPoint>& points);
  void set_speeds(std::vector<ContactPoint>& points) const;
  void write_back(const NodeMotion& motion, double spin, double dt);

  PatchRespond respond_;  ///< the widest instruction set's
  PatchCells cells_;
  std::vector<PointTile> tiles_;
  std::vector<PatchVector> free_;     ///< velocity of the points, wheel against rail, without contact [m/s]
  std::vector<PatchVector> impulse_;  ///< of the points on the wheel [N s]
  /// By node: change of the velocity by contact, on the rail turned round, so that both close the gap [m/s].
  std::vector<PatchVector> change_;
  std::vector<double> mobility_;  ///< of the points: PatchCells::own_mobility
  int iterations_ = 0;
  double unsettled_ = 0;
};

}  // namespace tread
