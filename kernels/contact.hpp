#pragma once
// Penalty contact of a revolved wheel surface on an extruded rail surface, with Coulomb friction.
// [theory.md, Contact]

#include <array>
#include <cstdint>
#include <limits>
#include <map>
#include <utility>
#include <vector>

#include "core/aligned.hpp"
#include "core/body_frame.hpp"
#include "core/corrugation.hpp"
#include "core/mesh/swept_block.hpp"
#include "kernels/contact_surface.hpp"
#include "kernels/friction.hpp"
#include "kernels/solver/linear_operator.hpp"

namespace tread {

struct ContactOptions {
  int rail_block = -1;
  int wheel_block = -1;
  SurfaceKind surface = SurfaceKind::exact;
  int points = 3;           ///< integration points per face and direction
  double penalty = 0;       ///< normal penalty stiffness per area [Pa/m]
  double damping = 0;       ///< normal damping per area [Pa s/m]
  double friction = 0;      ///< coefficient of friction f [-]
  double wheel_radius = 0;  ///< of the nominal rolling circle [m]
  double reach_gap = 4e-4;  ///< gap of the undeformed surfaces up to which points are searched [m]
};

/// Nodes that carry a point of a surface: 4 stations x 4 nodes across.
inline constexpr std::size_t kSupport = 16;

/// One integration point of the rail's faces in contact.
struct ContactPoint {
  std::array<std::int64_t, kSupport> rail_slot;   ///< nodes about the point, station by station
  std::array<std::int64_t, kSupport> wheel_slot;  ///< nodes about the opposite point of the wheel
  std::array<double, kSupport> rail_weight;
  std::array<double, kSupport> wheel_weight;
  std::array<double, 4> wheel_cosine, wheel_sine;  ///< of the space angle of the four wheel stations
  std::array<double, 4> face_weight;  ///< bilinear, of the rail face's corners (for nodal averages)
  std::array<int, 2> face;            ///< rail station and surface edge
  Vec3 normal;                        ///< out of the wheel, into the rail; Cartesian
  Vec3 along, across;                 ///< tangents: along the rolling direction; across, to the field side
  Vec3 position;                      ///< on the rail surface [m]
  double area;                        ///< that the point stands for [m2]
  double gap;                         ///< < 0: penetration [m]
  double pressure;                    ///< [Pa]
  Traction shear;                     ///< on the rail [Pa]
  Traction slip_speed;                ///< of the wheel against the rail [m/s]
  bool slips;
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
  const double* displacement;  ///< [m]
  const double* velocity;      ///< relative to the frame [m/s]; null in statics
  const BodyFrame* wheel;
};

class Contact {
 public:
  Contact(const Mesh& mesh, const ContactOptions& options, Corrugation corrugation);

  /// Finds the points in contact, without friction (preload).
  void find_static(const ContactState& state);

  /// One step of length dt [s] that ends at `time` [s]: search, gap, penalty, friction, frictional work.
  void advance(const ContactState& state, double time, double dt);

  /// Pressure-weighted mean velocity of the wheel's surface against the rail's over the points found last
  /// [m/s].
  Vec3 mean_slip_velocity(const ContactState& state) const;

  /// Subtracts the contact forces from `force` (internal minus external).
  void add_forces(double* force) const;

  /// The normal penalties of the points found last, one spring each.
  std::vector<Spring> springs() const;

  /// Height of the wheel's axis at which its undeformed surface touches the smooth rail [m].
  double touching_height() const { return touching_height_; }

  /// Springs to ground that bound the effect of the penalty at every surface node that contact can reach,
  /// whatever node it meets: k (1 + m / m_other) per area, with the lightest surface of the other body [N/m].
  /// Both fields are scalar node fields; `mass` is lumped.
  void add_grounded_stiffness(const double* mass, double* stiffness) const;

  const std::vector<ContactPoint>& points() const { return points_; }
  const ContactTotals& totals() const { return totals_; }
  const Corrugation& corrugation() const { return corrugation_; }
  const ContactOptions& options() const { return options_; }

  double frictional_work() const { return frictional_work_; }  ///< dissipated by friction since the start [J]
  double damping_work() const { return damping_work_; }        ///< dissipated by contact damping [J]

  /// Bytes of the integration points' histories.
  std::int64_t bytes() const;

  /// Largest lumped nodal averages of pressure and shear over the rail's surface nodes [Pa].
  std::array<double, 2> max_nodal_tractions() const;

 private:
  struct Candidate {
    int station;
    int edge;
    int point;
  };
  /// Penalty times the area that each reachable surface node stands for [N/m].
  std::map<std::int64_t, double> surface_stiffness(const SweptBlock& block, const SurfaceProfile& profile,
                                                   int first, int last) const;
  void update_window(double wheel_x);
  void visit_column(const ContactState& state, int station, double time, double dt);
  void collect();
  double probe(const ContactState& state, const Candidate& where, ContactPoint& point) const;
  Vec3 rail_velocity(const ContactState& state, const ContactPoint& point) const;
  Vec3 wheel_velocity(const ContactState& state, const ContactPoint& point) const;
  void load_point(const ContactState& state, double dt, Traction& history, ContactPoint& point,
                  double* work) const;
  std::int64_t history_index(int station, int edge, int point) const {
    return (static_cast<std::int64_t>(station) * rail_profile_.edges() + edge) * points_per_face_ + point;
  }

  const Mesh* mesh_;
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
  std::vector<std::array<double, 3>> quadrature_;  ///< along, across, weight on the unit face
  int first_edge_ = 0, last_edge_ = 0;  ///< edges that the wheel's profile can reach, [first, last)

  std::vector<Traction> history_;  ///< by integration point of the whole rail [Pa]
  std::vector<double> wake_time_;  ///< by face: contact cannot start before [s]
  double touching_height_ = 0;
  double closing_speed_ = 0;  ///< bound used for wake_time_ [m/s]
  int window_first_ = 0, window_last_ = 0;

  struct Column {
    std::vector<ContactPoint> points;
    double friction_work = 0;
    double damping_work = 0;
  };
  std::vector<Column> columns_;
  std::vector<ContactPoint> points_;
  ContactTotals totals_;
  double frictional_work_ = 0;
  double damping_work_ = 0;
};

}  // namespace tread
