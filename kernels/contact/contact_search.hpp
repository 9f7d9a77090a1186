#pragma once
// Search for the rail's integration points that touch the wheel. [theory.md, Contact]

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/body_frame.hpp"
#include "core/mesh/swept_block.hpp"
#include "core/page_vector.hpp"
#include "kernels/contact/contact_point.hpp"
#include "kernels/contact/contact_state.hpp"
#include "kernels/contact/face_quadrature.hpp"
#include "kernels/contact/search_body.hpp"
#include "kernels/contact/surface_pair.hpp"

namespace tread {

/// A part of a running surface: stations [first, first + count), which may pass the end of a full turn, and
/// nodes across it, [first_node, last_node), by their ordinals.
struct SurfacePart {
  int first = 0, count = 0;
  int first_node = 0, last_node = 0;
};

/// The tiles that hold a part of the surface of a block.
TileSpan tiles_of(const SweptBlock& block, const SurfacePart& part);

/// Window of rail faces about the wheel and the integration points on them that may touch.
class ContactSearch {
 public:
  struct Options {
    SurfaceKind surface;
    SurfaceKind across;         ///< SurfacePairBody::kind_across
    int points;                 ///< integration points per face and direction
    double penalty;             ///< normal penalty stiffness per area [Pa/m]
    double wheel_radius;        ///< of the nominal rolling circle [m]
    double depth_room;          ///< corrugation depth that there is room for at least [m]
    double reach_gap;           ///< gap of the undeformed surfaces up to which points are searched [m]
    RunningSurface rail_depth;  ///< besides the corrugation
    RunningSurface wheel_depth;
  };

  /// InputError if the wheel's profile does not lie over the rail's.
  ContactSearch(const SweptBlock& rail, const SweptBlock& wheel, const Options& options,
                Corrugation corrugation);

  /// Lowers the rail's surface, makes room for its depth and forgets all wake times. Those of faces are zeros
  /// that take no memory until wake_all(): a search from time 0 on finds the same with them.
  void set_corrugation(Corrugation corrugation);

  /// Sets `points` to those in contact, with the pressures of statics.
  void find_static(const ContactState& state, std::vector<ContactPoint>& points);

  /// Where and how a step searches.
  struct Aim {
    int first_station = 0, last_station = 0;  ///< of the window, [first, last)
    double closing_speed = 0;                 ///< bound used for wake times [m/s]
    double margin = 0;                        ///< gap up to which points are kept [m]
  };
  /// Window and bounds of a search in a step of length dt [s]; none where the wheel leaves the meshed
  /// surfaces.
  std::optional<Aim> aim_at(const BodyFrame& wheel, double dt) const;
  /// Sets them. NumericalError where the wheel leaves the meshed surfaces.
  void aim(const BodyFrame& wheel, double dt);
  /// Sets `points` to those that touch or may touch before the step ends that starts at `time` [s], after
  /// aim(), with the tractions and velocities before the step. A point that carried pressure stays.
  void find(const ContactState& state, std::span<const PointHistory> history, double time,
            std::vector<ContactPoint>& points);
  /// Columns of faces that a search visits, after aim().
  int columns() const { return aim_.last_station - aim_.first_station; }
  /// find() in parts: visits of all columns, by several threads, then gather().
  void visit_columns(const ContactState& state, std::span<const PointHistory> history, double time, int first,
                     int last);
  void gather(std::vector<ContactPoint>& points) const;
  SearchBounds bounds(const Aim& aim, double time) const;
  SearchEnd end() const;

  /// Parts of the rail's and the wheel's surface that hold all nodes whose motion find() reads, and those
  /// that carry what it finds, with the wheel's frame anywhere between now and a step of dt [s] later.
  std::array<SurfacePart, 2> near(const BodyFrame& wheel, double dt) const;

  /// Forgets when faces may close.
  void wake_all();

  /// Returns a point at the end of the searched surface, beyond which points would be missed; or null.
  const ContactPoint* point_at_the_end(const BodyFrame& wheel, const std::vector<ContactPoint>& points) const;

  /// Half length of the stretch about the wheel's axis that is searched [m].
  double reach() const { return reach_within(deepest_); }
  /// The same with a corrugation of that depth [m].
  double reach_over(double corrugation) const { return reach_within(depth_over(corrugation)); }
  /// Height of the wheel's axis at which the undeformed wheel touches the smooth rail [m].
  double touching_height() const { return touching_height_; }
  /// Depth by which the undeformed wheel touches lower over `wheel_x` [m], its start, for the depths of both
  /// surfaces but the corrugation [m].
  double touching_depth(double wheel_x) const;

  const SurfacePair& surfaces() const { return surfaces_; }
  const FaceQuadrature& quadrature() const { return quadrature_; }
  /// Edges of the rail's surface that the wheel's profile can reach, [first, last).
  std::array<int, 2> edges() const { return {first_edge_, last_edge_}; }
  const Aim& aimed() const { return aim_; }
  std::size_t window_capacity() const { return columns_.size(); }                         ///< stations
  std::size_t capacity() const { return columns_.size() * columns_.front().capacity(); }  ///< points
  std::size_t rail_points() const { return wake_time_.size() * points_per_face(); }  ///< of the whole rail
  PageVector<double>& wake_time() { return wake_time_; }                             ///< by face [s]
  /// Bytes of the wake times.
  std::int64_t bytes() const { return static_cast<std::int64_t>(wake_time_.size() * sizeof(double)); }

 private:
  struct Visit {
    const ContactState* state;
    std::span<const PointHistory> history;
    SearchBounds bounds;
  };
  void choose_edges();
  void make_room();
  [[noreturn]] void refuse(const BodyFrame& wheel, bool at_rest) const;
  void visit_column(const Visit& visit, int station);
  double depth_over(double corrugation) const;
  double reach_within(double deepest) const;
  std::size_t points_per_face() const { return static_cast<std::size_t>(quadrature_.size()); }
  /// Number of a rail face among all.
  std::int64_t face_index(int station, int edge) const {
    return static_cast<std::int64_t>(station) * surfaces_.rail_profile().edges() + edge;
  }

  SurfacePair surfaces_;
  Options options_;
  FaceQuadrature quadrature_;
  double deepest_ = 0;               ///< depth that the searched surface has room for [m]
  std::vector<double> lateral_gap_;  ///< by edge: of the smooth surfaces where they touch elsewhere [m]
  int first_edge_ = 0, last_edge_ = 0;
  double touching_height_ = 0;
  double least_radius_ = 0;  ///< of the wheel's surface [m]
  Aim aim_;
  PageVector<double> wake_time_;                    ///< by face: contact cannot start before [s]
  std::vector<std::vector<ContactPoint>> columns_;  ///< points found, by rail station of the window
};

}  // namespace tread
