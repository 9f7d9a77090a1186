#pragma once
// Penalty contact of a revolved wheel surface on an extruded rail surface, with Coulomb friction.
// [theory.md, Contact]

#include <array>
#include <cstdint>
#include <vector>

#include "core/aligned.hpp"
#include "core/body_frame.hpp"
#include "core/corrugation.hpp"
#include "core/mesh/node_field.hpp"
#include "core/mesh/swept_block.hpp"
#include "core/state_list.hpp"
#include "kernels/contact/contact_point.hpp"
#include "kernels/contact/contact_surface.hpp"
#include "kernels/contact/friction.hpp"
#include "kernels/contact/patch_nodes.hpp"
#include "kernels/contact/patch_solver.hpp"
#include "kernels/solver/linear_operator.hpp"

namespace tread {

struct ContactOptions {
  int rail_block = -1;
  int wheel_block = -1;
  SurfaceKind surface = SurfaceKind::exact;
  int points = 3;           ///< integration points per face and direction
  double penalty = 0;       ///< normal penalty stiffness per area [Pa/m]
  double friction = 0;      ///< coefficient of friction f [-]
  double wheel_radius = 0;  ///< of the nominal rolling circle [m]
  double depth_room = 0;    ///< deepest corrugation that is searched for, if deeper than the present one [m]
  double reach_gap = 4e-4;  ///< gap of the undeformed surfaces up to which points are searched [m]
};

/// Sums over the patch at one instant.
struct ContactTotals {
  Vec3 force_on_rail;          ///< [N]
  double area = 0;             ///< [m2]
  double slip_area = 0;        ///< [m2]
  double max_pressure = 0;     ///< at integration points [Pa]
  double max_shear = 0;        ///< at integration points [Pa]
  double max_penetration = 0;  ///< [m]
  double penalty_energy = 0;   ///< stored in the normal and tangential penalties [J]
  Vec3 centre;                 ///< of pressure [m]
  Vec3 pressure_peak;          ///< position of the largest pressure [m]
};

/// Where the bodies are: displacement and velocity fields in local components, and the wheel's frame.
struct ContactState {
  ConstNodeField displacement;  ///< [m]
  ConstNodeField velocity;      ///< relative to the frame [m/s]; none in statics
  const BodyFrame* wheel;
};

class Contact {
 public:
  Contact(const Mesh& mesh, const ContactOptions& options, Corrugation corrugation);

  /// Finds the points in contact, without friction (preload).
  void find_static(const ContactState& state);

  /// Before the first step: it starts from the pressures found last.
  void begin();

  /// Finds the points that touch or may touch before the step of length dt [s] that starts at `time` [s]
  /// ends.
  void search(const ContactState& state, double time, double dt);

  /// Pressure and friction of the points found last, in the middle of the step; their impulses are added to
  /// the motion that the step has without contact.
  void resolve(const NodeMotion& motion, const BodyFrame& wheel, double dt);

  /// A point of the patch found last that lies at the end of the surface that is searched, beyond which
  /// points would be missed; or null.
  const ContactPoint* point_at_the_end(const BodyFrame& wheel) const;
  /// NumericalError where there is one.
  void require_room(const BodyFrame& wheel) const;

  /// Pressure-weighted mean velocity of the wheel's surface against the rail's over the points found last
  /// [m/s].
  Vec3 mean_slip_velocity(const ContactState& state) const;

  /// Subtracts the contact forces from `force` (internal minus external).
  void add_forces(NodeField force) const;

  /// The normal penalties of the points found last, one spring each.
  std::vector<Spring> springs() const;

  /// Height of the wheel's axis at which its undeformed surface touches the smooth rail [m].
  double touching_height() const { return touching_height_; }

  const std::vector<ContactPoint>& points() const { return points_; }
  const ContactTotals& totals() const { return totals_; }
  const Corrugation& corrugation() const { return corrugation_; }
  const ContactOptions& options() const { return options_; }

  double frictional_work() const { return frictional_work_; }  ///< dissipated by friction since the start [J]
  /// Dissipated because the forces lead the motion by half a step, so that the penalty's oscillations die out
  /// [J].
  double damping_work() const { return damping_work_; }

  /// Half length of the stretch about the wheel's axis that is searched [m].
  double reach() const;

  /// Bytes of the integration points' histories and of the nodes about the patch.
  std::int64_t bytes() const;

  /// At the rail's surface nodes about the patch. Of a step: its tractions, slip and frictional work, that of
  /// points that left contact in it included.
  const PatchNodes& nodes() const { return nodes_; }

  /// What search() and resolve() do not find anew.
  void list_state(StateList& list) {
    list.add_records("history", std::span(history_));
    list.add("wake_time", wake_time_);
    list.add("frictional_work", frictional_work_);
    list.add("damping_work", damping_work_);
  }

 private:
  struct Candidate {
    int station;
    int edge;
    int point;
  };
  void update_window(const BodyFrame& wheel);
  void visit_column(const ContactState& state, int station, double time);
  void gather_columns();
  void sum_up();
  double area_by_rows() const;
  double probe(const ContactState& state, const Candidate& where, ContactPoint& point) const;
  Vec3 rail_velocity(const ContactState& state, const ContactPoint& point) const;
  Vec3 wheel_velocity(const ContactState& state, const ContactPoint& point) const;
  double stored_energy(double pressure, const Traction& shear) const;  // per area [J/m2]
  /// Of a rail face among all.
  std::int64_t face_index(int station, int edge) const {
    return static_cast<std::int64_t>(station) * rail_profile_.edges() + edge;
  }

  const SweptBlock* rail_;
  const SweptBlock* wheel_;
  ContactOptions options_;
  Corrugation corrugation_;
  SurfaceProfile rail_profile_;
  SurfaceProfile wheel_profile_;
  StationFinder rail_stations_;
  StationFinder wheel_stations_;
  CoulombFriction friction_;
  int points_per_face_;
  std::vector<std::array<double, 2>> gauss_;       ///< points and weights on [0, 1]
  std::vector<std::array<double, 3>> quadrature_;  ///< along, across, weight on the unit face
  std::vector<double> across_;  ///< arc length across the rail up to each integration point of a row [m]
  double deepest_ = 0;          ///< corrugation that the searched surface has room for [m]
  double width_ = 0;            ///< of the rail's surface along its arc [m]
  int first_edge_ = 0, last_edge_ = 0;  ///< edges that the wheel's profile can reach, [first, last)

  struct History {
    Traction shear;       ///< [Pa]
    double pressure = 0;  ///< [Pa]
  };
  std::vector<History> history_;   ///< by integration point of the whole rail
  std::vector<double> wake_time_;  ///< by face: contact cannot start before [s]
  double touching_height_ = 0;
  double closing_speed_ = 0;  ///< bound used for wake_time_ [m/s]
  double margin_ = 0;         ///< gap up to which points are kept [m]
  int window_first_ = 0, window_last_ = 0;

  std::vector<std::vector<ContactPoint>> columns_;  ///< points found, by rail station of the window
  std::vector<ContactPoint> points_;
  PatchSolver solver_;
  PatchNodes nodes_;
  ContactTotals totals_;
  double frictional_work_ = 0;
  double damping_work_ = 0;
};

}  // namespace tread
