#pragma once
// Stresses, slip and work at the nodes of the rail's surface, from the integration points.
// [theory.md, Fields of the surface]

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/inline.hpp"
#include "kernels/contact/contact_point.hpp"
#include "kernels/contact/contact_surface.hpp"

namespace tread {

/// The nodes of a rail's surface that contact can reach, stations along the rail times rows across it, and
/// the cells between them.
struct SurfaceGrid {
  int first_edge = 0;          ///< surface edge between the first two rows
  std::vector<double> x;       ///< by station [m]
  std::vector<double> y;       ///< by row [m]
  std::vector<double> length;  ///< of the rail that a station stands for [m]
  std::vector<double> width;   ///< of the profile that a row stands for, beyond the grid, too [m]
  std::vector<int> quad;       ///< of the rail's section, under the cells between a row and the next

  int stations() const { return static_cast<int>(x.size()); }
  int rows() const { return static_cast<int>(y.size()); }
  std::size_t nodes() const { return x.size() * y.size(); }
  /// Place of a node in arrays [station][row].
  std::size_t node(int station, int row) const {
    return static_cast<std::size_t>(station) * y.size() + static_cast<std::size_t>(row);
  }
  /// Place of the cell that starts at a node in arrays [station][row] with a row and a station less.
  std::size_t cell(int station, int row) const {
    return static_cast<std::size_t>(station) * quad.size() + static_cast<std::size_t>(row);
  }
  /// Area that a node stands for [m2].
  double area(int station, int row) const {
    return length[static_cast<std::size_t>(station)] * width[static_cast<std::size_t>(row)];
  }
};

/// The nodes on the edges [first_edge, last_edge) of an extruded block's surface.
SurfaceGrid make_surface_grid(const SweptBlock& rail, const SurfaceProfile& profile, SurfaceKind kind,
                              std::array<int, 2> edges);

/// Lumped averages at a node that the record of a passage takes; tractions are those of the middle of a step,
/// zero outside of contact.
struct NodalStress {
  double pressure = 0;         ///< [Pa]
  Traction shear;              ///< on the rail [Pa]
  double frictional_work = 0;  ///< of the step [J/m2]

  /// Adds a point's share, of the node's area.
  template <class Point>
  TREAD_BODY void add(const Point& point, double share) {
    frictional_work += share * point.frictional_work;
    if (point.pressure <= 0) return;
    pressure += share * point.pressure;
    shear.along += share * point.shear.along;
    shear.across += share * point.shear.across;
  }

  TREAD_BODY double shear_size() const {
    return std::sqrt(shear.along * shear.along + shear.across * shear.across);
  }  ///< [Pa]
};

/// All averages at a node.
struct NodalContact : NodalStress {
  Traction slip_speed;          ///< of the wheel against the rail, mean over what touches [m/s]
  double frictional_power = 0;  ///< shear stress times slip speed [W/m2]
  double touching = 0;          ///< share of the node's area [-]
  double slipping = 0;          ///< share of the node's area [-]

  /// Adds a point's share, of the node's area.
  void add(const ContactPoint& point, double share) {
    NodalStress::add(point, share);
    if (point.pressure <= 0) return;
    slip_speed.along += share * point.slip_speed.along;
    slip_speed.across += share * point.slip_speed.across;
    frictional_power += share * point.frictional_power();
    touching += share;
    if (point.slips) slipping += share;
  }
};

enum class PatchState : std::uint8_t { out, stick, slip };

/// A node slips where most of what touches about it slips.
inline PatchState state_of(const NodalContact& node) {
  if (node.touching <= 0) return PatchState::out;
  return node.slipping > 0.5 * node.touching ? PatchState::slip : PatchState::stick;
}

/// The nodes about the patch at one instant: rows of a SurfaceGrid at a run of its stations.
class PatchNodes {
 public:
  PatchNodes() = default;
  /// Room for `stations` stations.
  PatchNodes(SurfaceGrid grid, int stations);

  /// Averages over the faces from station `first` to station `last`, both included; all points lie between.
  /// Points without pressure count for their frictional work only.
  void average(int first, int last, const std::vector<ContactPoint>& points);

  const SurfaceGrid& grid() const { return grid_; }
  int capacity() const { return static_cast<int>(nodes_.size()) / grid_.rows(); }  ///< stations
  int first() const { return first_; }                                             ///< station
  int last() const { return last_; }                                               ///< station
  const NodalContact& at(int station, int row) const { return nodes_[grid_.node(station - first_, row)]; }

  /// Calls visit(station, row) for all cells with pressure at one of their nodes.
  template <class Visit>
  void for_each_pressed_cell(const Visit& visit) const {
    const auto pressed = [this](int station, int row) { return at(station, row).pressure > 0; };
    for (int station = first_; station < last_; ++station)
      for (int row = 0; row + 1 < grid_.rows(); ++row)
        if (pressed(station, row) || pressed(station, row + 1) || pressed(station + 1, row) ||
            pressed(station + 1, row + 1))
          visit(station, row);
  }

  double max_pressure() const;  ///< [Pa]
  double max_shear() const;     ///< [Pa]
  std::int64_t bytes() const;

 private:
  void add(const ContactPoint& point);

  SurfaceGrid grid_;
  std::vector<NodalContact> nodes_;  ///< [station - first][row]
  int first_ = 0, last_ = 0;
};

}  // namespace tread
