#pragma once
// Penalty contact with friction of a revolved wheel surface on an extruded rail surface.
// [theory.md, Contact]

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/body_frame.hpp"
#include "core/corrugation.hpp"
#include "core/mesh/node_field.hpp"
#include "core/mesh/swept_block.hpp"
#include "core/page_vector.hpp"
#include "core/running_surface.hpp"
#include "core/state_list.hpp"
#include "kernels/contact/contact_point.hpp"
#include "kernels/contact/contact_search.hpp"
#include "kernels/contact/contact_state.hpp"
#include "kernels/contact/contact_surface.hpp"
#include "kernels/contact/contact_totals.hpp"
#include "kernels/contact/friction/friction_law.hpp"
#include "kernels/contact/patch_nodes.hpp"
#include "kernels/contact/patch_point_body.hpp"
#include "kernels/contact/patch_solver.hpp"
#include "kernels/solver/linear_operator.hpp"

namespace tread {

struct ContactOptions {
  int rail_block = -1;
  int wheel_block = -1;
  SurfaceKind surface = SurfaceKind::exact;
  /// Displacements across follow the nodes by straight lines: where all rows move alike, cubics would give
  /// rows near an edge other loads.
  bool straight_across = false;
  int points = 3;                             ///< integration points per face and direction
  double penalty = 0;                         ///< normal penalty stiffness per area [Pa/m]
  FrictionLaw friction = CoulombFriction{0};  ///< law of the coefficient of friction
  double wheel_radius = 0;                    ///< of the nominal rolling circle [m]
  double depth_room = 0;    ///< deepest corrugation that is searched for, if deeper than the present one [m]
  double reach_gap = 4e-4;  ///< gap of the undeformed surfaces up to which points are searched [m]
  RunningSurface rail_depth;   ///< of the rail's surface besides the corrugation
  RunningSurface wheel_depth;  ///< of the wheel's surface
  double static_force = 0;     ///< vertical force that the search expects [N]
  bool yields = false;         ///< a surface's material is not linear
};

class SurfaceFields;

/// Search and tractions of a contact elsewhere, on a device.
class ContactSteps {
 public:
  /// Contact::search() and resolve(), of the fields that live there. The contact's search is aimed.
  virtual void search(const BodyFrame& wheel, double time, double dt) = 0;
  virtual void resolve() = 0;

 protected:
  ContactSteps() = default;
  ContactSteps(const ContactSteps&) = default;
  ContactSteps& operator=(const ContactSteps&) = default;
  ~ContactSteps() = default;
};

/// Outcome of a step elsewhere.
struct ContactOutcome {
  Vec3 force_on_rail;          ///< [N]
  double frictional_work = 0;  ///< of the step [J]
  double contact_loss = 0;     ///< of the step [J]
  double unsettled = 0;        ///< PatchSolver::unsettled()
};

/// Owner of search, histories, solver and sums of the patch.
class Contact {
 public:
  Contact(const Mesh& mesh, const ContactOptions& options, Corrugation corrugation);
  Contact(const Contact&) = delete;
  Contact& operator=(const Contact&) = delete;

  /// Lowers the rail's surface by another corrugation; the contact is that of a construction with it.
  void set_corrugation(Corrugation corrugation);

  /// Finds the points in contact (preload). The wheel drives the rail backwards by a shear stress of
  /// `traction` times the pressure.
  void find_static(const ContactState& state, double traction = 0);

  /// Starts the first step from the tractions found last.
  void begin();

  /// Finds the points that touch or may touch before the step of length dt [s] that starts at `time` [s]
  /// ends.
  void search(const ContactState& state, double time, double dt);

  /// search() in parts, where no one else carries it out: aim(), then search_columns() of all columns(), by
  /// several threads, then gather_points().
  void aim(const BodyFrame& wheel, double dt) { search_.aim(wheel, dt); }
  int columns() const { return search_.columns(); }
  void search_columns(const ContactState& state, double time, int first, int last) {
    search_.visit_columns(state, history_, time, first, last);
  }
  void gather_points() { search_.gather(points_); }

  /// Sets pressure and friction of the points found last, in the middle of the step, and adds their impulses
  /// to the motion that the step has without contact.
  void resolve(const NodeMotion& motion, const BodyFrame& wheel, double dt);

  /// From now on `steps` carries out search() and resolve(), or, null, this object. It must outlive them.
  void run_on(ContactSteps* steps) { steps_ = steps; }
  const ContactSteps* steps() const { return steps_; }
  /// Takes over the outcome of a step elsewhere; no points until take_points().
  void take(const ContactOutcome& outcome);
  /// Takes over the points that were solved elsewhere in the last step.
  void take_points(std::span<const ContactPoint> points);
  /// The same, with the works since the start [J].
  void take_points(std::span<const ContactPoint> points, double frictional_work, double contact_loss);
  /// The record that the tractions of each step go to; whoever solves elsewhere keeps it.
  void record_in(SurfaceFields* record) { record_ = record; }
  SurfaceFields* record() const { return record_; }
  /// State and parts, for whoever solves elsewhere. Histories and states: by integration point of the whole
  /// rail.
  PageVector<PointHistory>& history() { return history_; }
  Friction& friction() { return friction_; }
  /// Coefficient of friction of a point at x that has not slid [-].
  double friction_at_rest(double x) const;
  ContactSearch& searching() { return search_; }
  const ContactSearch& searching() const { return search_; }
  const PointSprings& springs_of_points() const { return springs_; }

  /// Returns a point of the patch found last that lies at the end of the searched surface, beyond which
  /// points would be missed; or null.
  const ContactPoint* point_at_the_end(const BodyFrame& wheel) const {
    return search_.point_at_the_end(wheel, points_);
  }
  /// NumericalError where there is such a point.
  void require_room(const BodyFrame& wheel) const;
  /// False where the iterations of the last resolve() ended far from a solution.
  bool settled() const { return unsettled_ <= kUnsettled; }
  /// NumericalError where settled() is false.
  void require_settled() const;

  /// Pressure-weighted mean velocity of the wheel's surface against the rail's over the points found last
  /// [m/s].
  Vec3 mean_slip_velocity(const ContactState& state) const;

  /// Subtracts the contact forces from `force` (internal minus external).
  void add_forces(NodeField force) const;

  /// The normal penalties of the points found last, one spring each.
  std::vector<Spring> springs() const;

  /// Height of the wheel's axis at which its undeformed surface touches the smooth rail [m].
  double touching_height() const { return search_.touching_height(); }
  /// Depth by which it touches lower over its start x [m] for the depths of both surfaces but the corrugation
  /// [m].
  double touching_depth(double x) const { return search_.touching_depth(x); }

  const std::vector<ContactPoint>& points() const { return points_; }
  /// True if resolve() uses all threads for the points found last.
  bool shares_patch() const { return worth_sharing(points_.size()); }
  const ContactTotals& totals() const { return totals_; }
  const Corrugation& corrugation() const { return search_.surfaces().corrugation(); }
  const SurfacePair& surfaces() const { return search_.surfaces(); }
  const ContactOptions& options() const { return options_; }

  double frictional_work() const { return frictional_work_; }  ///< dissipated by friction since the start [J]
  /// Dissipated because the forces lead the motion by half a step, so that the penalty's oscillations die out
  /// [J].
  double contact_loss() const { return contact_loss_; }

  /// Parts of both surfaces that hold all nodes whose motion a search reads or the tractions change, with the
  /// wheel's frame anywhere between now and a step of dt [s] later.
  std::array<SurfacePart, 2> near(const BodyFrame& wheel, double dt) const { return search_.near(wheel, dt); }
  /// Nodes whose motion the last resolve() read and changed.
  const std::vector<PatchCells::Node>& patch() const { return solver_.nodes(); }

  /// Half length of the stretch about the wheel's axis that is searched [m].
  double reach() const { return search_.reach(); }
  /// The same with a corrugation of that depth [m].
  double reach_over(double corrugation) const { return search_.reach_over(corrugation); }

  /// Bytes of the integration points' histories and of the nodes about the patch.
  std::int64_t bytes() const;

  /// Averages of the last step at the rail's surface nodes about the patch: tractions, slip and frictional
  /// work, with the work of points that left contact in the step.
  const PatchNodes& nodes() const { return nodes_; }

  /// Lists the state that search() and resolve() do not find anew.
  void list_state(StateList& list);
  /// The part of it by points and faces of the whole rail, for search() and resolve() here alone.
  void list_searched(StateList& list);

 private:
  /// Likely reason for a patch at the end of the searched surface.
  std::string why_no_room() const;
  void make_room();
  void close_step();

  ContactOptions options_;
  std::int64_t slots_;  ///< of the mesh
  PointSprings springs_;
  Friction friction_;
  ContactSearch search_;
  PatchArea area_;
  PageVector<PointHistory> history_;  ///< by integration point of the whole rail
  std::vector<ContactPoint> points_;
  PatchSolver solver_;
  PatchNodes nodes_;
  ContactTotals totals_;
  ContactSteps* steps_ = nullptr;
  SurfaceFields* record_ = nullptr;
  double frictional_work_ = 0;
  double contact_loss_ = 0;
  double unsettled_ = 0;  ///< PatchSolver::unsettled() of the last step
};

}  // namespace tread
