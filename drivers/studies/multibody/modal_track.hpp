#pragma once
// The modal rail on its supports. [theory.md, Multi-body approach]

#include <vector>

#include "drivers/engine/beam/track_beam.hpp"
#include "drivers/studies/multibody/modal_beam.hpp"

namespace tread {

/// A spring-damper that a weighted sum of the foot's motions along x stretches.
struct FootSpring {
  struct Place {
    double x = 0;       ///< [m]
    double weight = 0;  ///< [-]
  };
  std::vector<Place> places;
  double stiffness = 0;  ///< [N/m]
  double damping = 0;    ///< [N s/m]
};

/// The modal rail on its supports.
class ModalTrack {
 public:
  /// `foot`: only under a beam whose foot moves. A sleeper's
  /// deflection times the root of its mass is one more coordinate after those of the modes.
  ModalTrack(ModalBeam beam, const std::vector<BeamSupport>& supports,
             const std::vector<FootSpring>& foot = {}, const std::vector<SleeperSupport>& sleepers = {});

  /// The same track by its own modes below `top` [Hz], tabulated along the rail. Springs are part of the
  /// modes; the others yield at once, as much as they do at each place.
  ModalTrack diagonal(double top) const;

  int modes() const { return beam_.modes(); }  ///< of the rail
  double left() const { return beam_.left(); }
  std::size_t coordinates() const { return omega_.size(); }

  /// Computes the values of all coordinates for a force on the head and for the deflection that a wheel on it
  /// sees [1/sqrt(kg)]; `values` holds coordinates() of them.
  void head_shapes(double x, std::vector<double>& values) const;
  /// Flexibility that the coordinates lack in the head's deflection [m/N].
  double flexibility(double x) const;

  /// Angular frequencies by coordinate, without the supports; 0 of sleepers [rad/s].
  const std::vector<double>& omega() const { return omega_; }

  /// Coordinates at rest under a force on the head at x, downwards [m sqrt(kg)].
  std::vector<double> static_state(double x, double force) const;

  /// Adds the modal forces of springs and dampers. `scratch` holds a value for each support.
  void support_forces(const std::vector<double>& state, const std::vector<double>& rate,
                      std::vector<double>& forces, std::vector<double>& scratch) const;
  std::size_t supports() const { return stiffness_.size(); }

  /// Estimates of the supports' largest contribution to the squares of the modes' frequencies [rad2/s2], and
  /// of their largest rate of decay [1/s].
  double support_stiffness() const;
  double support_damping() const;

 private:
  double largest(const std::vector<double>& weight) const;
  std::vector<double> stiffness_matrix() const;

  /// Values at even places along the rail.
  struct Table {
    double pitch = 0;                 ///< [m]
    std::vector<double> shapes;       ///< of all coordinates, place by place [1/sqrt(kg)]
    std::vector<double> flexibility;  ///< by place [m/N]
  };
  struct Stencil;
  Stencil stencil(double x) const;

  ModalBeam beam_;
  std::vector<double> omega_;
  std::vector<double> stiffness_, damping_;  ///< values by support
  Table table_;                              ///< empty unless diagonal
  std::vector<double> by_support_;           ///< what a coordinate stretches, support by support [1/sqrt(kg)]
};

}  // namespace tread
