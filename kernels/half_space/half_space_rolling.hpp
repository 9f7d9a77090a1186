#pragma once
// Coulomb friction between two half-spaces pressed together: tangential shift, steady and transient rolling.
// No spin; the lateral shift or creepage is zero, so the lateral force is zero where the contact is symmetric
// about y = const. [Kalker, Three-Dimensional Elastic Bodies in Rolling Contact, ch. 4]
//
// Signs: tractions act on the wheel, positive forward: positive under traction; the rail feels the opposite.
// Creepage (w R - v) / v is positive under traction. A shift moves the wheel's body backward against the
// rail, which drives the tractions forward. Slip is that of the wheel's surface backward against the rail.

#include <optional>
#include <vector>

#include "kernels/half_space/half_space.hpp"

namespace tread::half_space {

/// On the wheel; nx * ny values each [Pa].
struct Tractions {
  std::vector<double> x, y;
};

/// Tractions at the end of a step, or in the steady state, and what happened in the step.
struct FrictionState {
  Tractions tractions;
  std::vector<int> slipping;   ///< nx * ny: 1 for cells in contact that slip
  double force = 0;            ///< F_L on the wheel [N]
  double lateral_force = 0;    ///< on the wheel [N]
  double shift = 0;            ///< of the bodies in the step [m]
  double creepage = 0;         ///< shift / cell rolled; 0 for a shift without rolling
  double slip_fraction = 0;    ///< slipping cells / cells in contact
  double max_shear = 0;        ///< [Pa]
  double work = 0;             ///< of friction; rolling: [J] per metre rolled; shift: [J]
  std::vector<double> strips;  ///< ny: work per passage of a surface point of row j [J/m2]; rolling only
};

/// A step rolls by one cell. Work is the mean of the tractions before and after the step times its slip, that
/// of the step in which a particle leaves the contact included: in the steady state work = creepage * force.
class RollingContact {
 public:
  /// `influence` and `contact` belong together and outlive this; there is a free column of cells before and
  /// behind the contact.
  RollingContact(const Influence& influence, const NormalContact& contact, double friction_coefficient);

  /// No tractions: the start of a history.
  FrictionState free_state() const;

  /// The state after a shift that brings the longitudinal force to `force` [N]. This and the others throw
  /// unless |force| < f F_N.
  FrictionState shift(const FrictionState& before, double force) const;
  /// The state after the patch has rolled on by one cell under `force` [N].
  FrictionState roll(const FrictionState& before, double force) const;
  /// Steady rolling under `force` [N].
  FrictionState steady(double force) const;
  FrictionState steady_at_creepage(double creepage) const;

 private:
  struct Drive;
  struct Problem;
  /// Cells of one row from the first in contact to the last.
  struct Run {
    int j, first, cells;
  };
  Problem step_problem(const FrictionState& before, bool rolling) const;
  Problem steady_problem() const;
  std::optional<FrictionState> newton(const Problem& problem, const Drive& drive,
                                      const FrictionState& start) const;
  FrictionState solve(const Problem& problem, const Drive& drive, const FrictionState& start) const;
  double expected_creepage(double force) const;
  void add_work(const Problem& problem, FrictionState& state) const;

  const Influence& influence_;
  const NormalContact& contact_;
  double friction_;
  std::vector<int> cells_;                   ///< in contact
  std::vector<Run> runs_;                    ///< that hold them
  OffsetTable rate_xx_, rate_xy_, rate_yy_;  ///< displacement at a cell minus that one cell ahead [m/Pa]
};

/// Work per passage [J] of a square surface element of side `element` [m] centred on y = 0.
double centre_element_work(const Grid& grid, const FrictionState& state, double element);

/// Elliptic contact that rolls steadily.
struct SteadyCase {
  Material material;
  double radius_x = 0, radius_y = 0;  ///< of the gap, positive [m]
  double load = 0;                    ///< F_N [N]
  double friction_coefficient = 0;
  double force = 0;    ///< F_L [N]
  double element = 0;  ///< side of the surface element of `element_work` [m]
};

struct SteadySummary {
  double creepage = 0;
  double slip_fraction = 0;
  double max_shear = 0;     ///< [Pa]
  double work = 0;          ///< [J] per metre rolled
  double element_work = 0;  ///< [J] per passage
};

/// On square cells of side `cell` [m].
SteadySummary steady_summary(const SteadyCase& steady, double cell);
/// From cells of `cell` and `cell` / 2 to the limit of fine grids, by first order. Slip fraction and largest
/// shear are those of single cells and scatter: by 12 % and 3 % from cells of a sixth of the patch.
SteadySummary extrapolated_summary(const SteadyCase& steady, double cell);

}  // namespace tread::half_space
