#pragma once
// Coulomb friction between two half-spaces pressed together: tangential shift, steady and transient rolling.
// No spin; the lateral shift or creepage is zero, so the lateral force is zero if the contact is symmetric
// about y = const. [Kalker, Three-Dimensional Elastic Bodies in Rolling Contact, ch. 4]
//
// Signs: tractions act on the wheel, positive forward: positive under traction; the rail feels the opposite.
// Creepage (w R - v) / v is positive under traction. A shift moves the wheel's body backward against the
// rail, which drives the tractions forward. Slip is that of the wheel's surface backward against the rail.

#include <optional>
#include <vector>

#include "kernels/half_space/half_space.hpp"

namespace tread::half_space {

/// Tractions on the wheel; nx * ny values each [Pa].
struct Tractions {
  std::vector<double> x, y;
};

/// Tractions at the end of a step, or in the steady state, with slip, creepage and work of the step.
struct FrictionState {
  Tractions tractions;
  std::vector<int> slipping;   ///< nx * ny: 1 for cells in contact that slip
  double force = 0;            ///< F_L on the wheel [N]
  double lateral_force = 0;    ///< lateral force on the wheel [N]
  double shift = 0;            ///< shift of the bodies in the step [m]
  double creepage = 0;         ///< shift / cell rolled; 0 for a shift without rolling
  double slip_fraction = 0;    ///< slipping cells / cells in contact
  double max_shear = 0;        ///< [Pa]
  double work = 0;             ///< work of friction; rolling: [J] per metre rolled; shift: [J]
  std::vector<double> strips;  ///< ny works per passage of a surface point of row j [J/m2]; rolling only
};

/// Slip of steady rolling: its mean over the cell that a particle rolls in a step, as in CONTACT, or at the
/// cell's centre by backward differences of second order, whose work is not exactly creepage * force.
enum class SteadySlip { over_a_cell, at_the_centre };

/// Rolling contact; a step rolls by one cell. Work is the mean of the tractions before and after the step
/// times its slip. The step in which a particle leaves the contact counts too: in the steady state work =
/// creepage * force.
class RollingContact {
 public:
  /// `influence` and `contact` belong together and must outlive this object. The contact must leave a free
  /// column of cells before and behind it.
  RollingContact(const Influence& influence, const NormalContact& contact, double friction_coefficient,
                 SteadySlip slip = SteadySlip::over_a_cell);

  /// State without tractions: the start of a history.
  FrictionState free_state() const;

  /// State after a shift that brings the longitudinal force to `force` [N]. shift(), roll() and steady()
  /// throw unless |force| < f F_N.
  FrictionState shift(const FrictionState& before, double force) const;
  /// State after the patch has rolled on by one cell under `force` [N].
  FrictionState roll(const FrictionState& before, double force) const;
  /// State of steady rolling under `force` [N].
  FrictionState steady(double force) const;

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
  FrictionState solve(const Problem& problem, double force, const FrictionState& start) const;
  double expected_creepage(double force) const;
  void add_work(const Problem& problem, FrictionState& state) const;

  const Influence& influence_;
  const NormalContact& contact_;
  double friction_;
  std::vector<int> cells_;                   ///< cells in contact
  std::vector<Run> runs_;                    ///< runs that hold the cells in contact
  OffsetTable rate_xx_, rate_xy_, rate_yy_;  ///< of steady rolling: displacement lost in a cell's way [m/Pa]
};

}  // namespace tread::half_space
