// The half-space reference of `tread verify` against theory and against CONTACT, the field's reference
// program (Vollebregt and Kalker, open source, r2707 of 2025-07), at equal grids. CONTACT's numbers: E 205.9
// GPa, nu 0.3, f 0.5, F_N 8926 kg * 9.81 m/s2, radii 430 mm along and 300 mm across.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "core/math/hertz.hpp"
#include "core/math/vec.hpp"
#include "kernels/half_space/half_space_steady.hpp"
#include "kernels/half_space/half_space_stress.hpp"
#include "tests/measured.hpp"

namespace tread::half_space {
namespace {

constexpr Material kSteel{205.9e9, 0.3};
constexpr double kModulus = 205.9e9 / (2 * 0.91);  ///< contact modulus of two steel bodies
constexpr double kLoad = 8926 * 9.81;              ///< [N]
constexpr double kFriction = 0.5;
constexpr double kRadiusX = 0.43;
constexpr double kRadiusY = 0.3;
constexpr double kElement = 1.1e-3;  ///< side of the paper's surface elements [m]

class Clock {
 public:
  double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// Wheel and rail, pressed together.
struct Pressed {
  Influence influence;
  NormalContact contact;

  explicit Pressed(double cell, bool node = false, double radius_y = kRadiusY)
      : influence(centred_grid(7e-3 + 2 * cell, 6.5e-3 + 2 * cell, cell, node), kSteel),
        contact(press(influence, quadratic_gap(kRadiusX, radius_y), kLoad)) {}
};

void compare(const std::string& what, double value, double reference, double tolerance) {
  measured(what, value);
  measured(what + " / reference - 1", value / reference - 1);
  EXPECT_NEAR(value / reference, 1, tolerance) << what;
}

// ---- Normal contact

TEST(HalfSpaceNormal, EllipseNearsHertz) {
  const HertzPatch hertz = tread::hertz(kRadiusX, kRadiusY, kModulus, kLoad);
  const Pressed fine(0.25e-3);
  const double a = hertz.semi_axis_x;
  const double b = hertz.semi_axis_y;
  compare("largest pressure", fine.contact.max_pressure, hertz.max_pressure, 2e-4);
  compare("approach", fine.contact.approach, hertz.approach, 2e-4);
  compare("area", fine.contact.area, std::numbers::pi * a * b, 0.015);
  const Grid& grid = fine.influence.grid;
  double worst = 0;
  for (int j = 0; j < grid.ny; ++j)
    for (int i = 0; i < grid.nx; ++i) {
      const double inside = 1 - std::pow(grid.x(i) / a, 2) - std::pow(grid.y(j) / b, 2);
      if (inside < 0.2) continue;
      const double theory = hertz.max_pressure * std::sqrt(inside);
      worst = std::max(worst, std::abs(fine.contact.pressure[grid.index(i, j)] - theory));
    }
  measured("worst pressure error 10 % inside of the edge / p0", worst / hertz.max_pressure);
  EXPECT_LT(worst / hertz.max_pressure, 2e-3);
}

TEST(HalfSpaceNormal, SphereNearsHertz) {
  const HertzPatch hertz = tread::hertz(0.43, 0.43, kModulus, kLoad);
  const Pressed fine(0.25e-3, false, 0.43);
  compare("largest pressure", fine.contact.max_pressure, hertz.max_pressure, 2e-4);
  compare("approach", fine.contact.approach, hertz.approach, 2e-4);
  compare("area", fine.contact.area, std::numbers::pi * hertz.semi_axis_x * hertz.semi_axis_x, 0.015);
}

TEST(HalfSpaceNormal, CellsAndPressuresAreThoseOfContact) {
  // Cell, corner of cells at the origin, CONTACT's cells under pressure, largest pressure, approach.
  struct Row {
    double cell;
    bool node;
    int cells;
    double max_pressure, approach;
  };
  for (const Row& row :
       {Row{1.1e-3, false, 93, 1196.04e6, 0.09765e-3}, Row{1.1e-3, true, 92, 1184.44e6, 0.09756e-3},
        Row{0.55e-3, false, 371, 1193.69e6, 0.09768e-3}, Row{0.5e-3, false, 451, 1193.68e6, 0.09769e-3},
        Row{0.25e-3, false, 1779, 1193.46e6, 0.09772e-3}}) {
    const Pressed at(row.cell, row.node);
    EXPECT_EQ(at.contact.cells, row.cells);
    EXPECT_NEAR(at.contact.max_pressure, row.max_pressure, 0.006e6);
    EXPECT_NEAR(at.contact.approach, row.approach, 0.0051e-6);
    EXPECT_NEAR(at.contact.load, kLoad, 1e-6);
  }
}

TEST(HalfSpaceNormal, BetweenCentresFieldsAreBilinear) {
  const Grid grid = centred_grid(3e-3, 2e-3, 1e-3);
  std::vector<double> field(static_cast<std::size_t>(grid.size()));
  const auto f = [](double x, double y) { return 2 + 3e3 * x - 5e3 * y + 7e6 * x * y; };
  for (int j = 0; j < grid.ny; ++j)
    for (int i = 0; i < grid.nx; ++i)
      field[static_cast<std::size_t>(grid.index(i, j))] = f(grid.x(i), grid.y(j));
  EXPECT_NEAR(interpolated(grid, field, 0.3e-3, -1.2e-3), f(0.3e-3, -1.2e-3), 1e-12);
  EXPECT_NEAR(interpolated(grid, field, grid.x(2), grid.y(1)), f(grid.x(2), grid.y(1)), 1e-12);
  EXPECT_EQ(interpolated(grid, field, 3.6e-3, 0), 0);
}

TEST(HalfSpaceNormal, ContactThatLeavesTheGridIsRefused) {
  const Influence small(centred_grid(5e-3, 5e-3, 0.5e-3), kSteel);
  EXPECT_THROW(press(small, quadratic_gap(kRadiusX, kRadiusY), kLoad), NumericalError);
}

/// Height [m] that the wheel loses on the paper's corrugation, with the wheel at `wheel` [m] from the crest.
double sinks(const Influence& influence, double wavelength, double wheel, double& max_pressure) {
  constexpr double depth = 0.14e-3;
  constexpr double half_width = 30e-3;
  const Gap smooth = quadratic_gap(kRadiusX, kRadiusY);
  const NormalContact contact = press(
      influence,
      [&](double x, double y) {
        const double wave = 1 - std::cos(2 * std::numbers::pi * (x + wheel) / wavelength);
        return smooth(x, y) + 0.5 * depth * wave * (1 - std::pow(y / half_width, 2));
      },
      kLoad);
  max_pressure = contact.max_pressure;
  return contact.approach;
}

TEST(HalfSpaceNormal, ContactFilterOfACorrugatedRail) {
  // Wavelength, CONTACT's filtered height between crest and trough, largest pressure there; cells of 0.5 mm.
  struct Row {
    double wavelength, filtered, crest, trough;
  };
  const Influence influence(centred_grid(14e-3, 9e-3, 0.5e-3), kSteel);
  for (const Row& row : {Row{0.040, 0.112036e-3, 1427e6, 833.6e6}, Row{0.065, 0.128984e-3, 1291e6, 1044e6},
                         Row{0.080, 0.132258e-3, 1260e6, 1083e6}, Row{0.095, 0.134094e-3, 1241e6, 1104e6},
                         Row{0.125, 0.13594e-3, 1222e6, 1125e6}}) {
    double crest = 0;
    double trough = 0;
    const double filtered = sinks(influence, row.wavelength, row.wavelength / 2, trough) -
                            sinks(influence, row.wavelength, 0, crest);
    const std::string name = "filter gain at " + std::to_string(std::lround(row.wavelength * 1e3)) + " mm";
    measured(name, filtered / 0.14e-3);
    EXPECT_NEAR(filtered / row.filtered, 1, 1e-4) << name;
    EXPECT_NEAR(crest / row.crest, 1, 5e-4) << name;
    EXPECT_NEAR(trough / row.trough, 1, 5e-4) << name;
  }
}

// ---- Steady rolling

TEST(HalfSpaceRolling, SteadyStateIsThatOfContact) {
  // Cell, corner of cells at the origin, mu, then CONTACT's creepage, slip fraction, largest shear [Pa], work
  // per metre [J], work per passage of the element [J].
  struct Row {
    double cell;
    bool node;
    double mu, creepage, slip, shear, work, element;
  };
  for (const Row& row : {Row{1.1e-3, false, 0.1, 0.0006925, 0.09677419, 300.8704e6, 6.063814, 0.001028276},
                         Row{1.1e-3, false, 0.3, 0.002509, 0.3655914, 520.453e6, 65.90946, 0.01124792},
                         Row{1.1e-3, true, 0.1, 0.0007064, 0.1086957, 241.9566e6, 6.185537, 0.0009957769},
                         Row{1.1e-3, true, 0.3, 0.002517, 0.3695652, 511.5178e6, 66.11962, 0.01078088},
                         Row{0.55e-3, false, 0.1, 0.0007143, 0.09703504, 310.7055e6, 6.254729, 0.001034119},
                         Row{0.55e-3, false, 0.3, 0.00256, 0.3854447, 541.433e6, 67.24922, 0.01112639},
                         Row{0.5e-3, false, 0.1, 0.0007144, 0.1108647, 314.3721e6, 6.255575, 0.001019636},
                         Row{0.5e-3, false, 0.3, 0.002585, 0.3858093, 533.2e6, 67.90588, 0.0111932}}) {
    const std::string at = " mu " + std::to_string(row.mu).substr(0, 3) + ", " +
                           std::to_string(std::lround(row.cell * 1e5)) + "e-5 m" +
                           (row.node ? ", corner" : "");
    const Clock clock;
    const Pressed pressed(row.cell, row.node);
    const RollingContact rolling(pressed.influence, pressed.contact, kFriction);
    const FrictionState state = rolling.steady(row.mu * kLoad);
    measured("seconds" + at, clock.seconds(), "s");
    compare("creepage" + at, state.creepage, row.creepage, 4e-4);  // four digits there
    compare("slip fraction" + at, state.slip_fraction, row.slip, 1e-6);
    compare("largest shear" + at, state.max_shear, row.shear, 2e-5);
    compare("work" + at, state.work, row.work, 4e-4);
    compare("element work" + at, centre_element_work(pressed.influence.grid, state, kElement), row.element,
            5e-4);
    measured("work / (creepage F_L) - 1" + at, state.work / (state.creepage * state.force) - 1);
    EXPECT_NEAR(state.work / (state.creepage * state.force), 1, 1e-7);
    EXPECT_NEAR(state.force, row.mu * kLoad, 1e-3);
    EXPECT_NEAR(state.lateral_force, 0, 1e-3);
  }
}

TEST(HalfSpaceRolling, TractionsAlongTheCentreLineAreThoseOfContact) {
  // mu 0.3, 1.1 mm, from -6.6 mm on [MPa].
  constexpr std::array<double, 13> contact = {88.7025, 348.094, 451.065, 520.453, 428.641, 309.939, 260.091,
                                              222.728, 192.185, 164.838, 138.366, 110.444, 75.435};
  const Pressed pressed(kElement);
  const FrictionState state =
      RollingContact(pressed.influence, pressed.contact, kFriction).steady(0.3 * kLoad);
  const Grid& grid = pressed.influence.grid;
  const int row = grid.ny / 2;
  for (int k = 0; k < 13; ++k)
    EXPECT_NEAR(state.tractions.x[grid.index(grid.nx / 2 - 6 + k, row)], contact[k] * 1e6, 0.05e6) << k;
}

TEST(HalfSpaceRolling, AnOppositeForceHasTheOppositeCreepage) {
  const Pressed pressed(kElement);
  const RollingContact rolling(pressed.influence, pressed.contact, kFriction);
  for (const double share : {0.001, 0.2, 0.6, 0.9, 0.99, 0.999}) {
    const double force = share * kFriction * kLoad;
    const FrictionState driven = rolling.steady(force);
    EXPECT_NEAR(rolling.steady(-force).creepage / driven.creepage, -1, 1e-7) << share;
  }
  EXPECT_THROW(rolling.steady(kFriction * kLoad), NumericalError);
}

TEST(HalfSpaceRolling, AMeanOfGridsLeavesOutThoseThatDoNotConverge) {
  std::vector<std::optional<double>> grids(12);
  for (std::size_t i = 0; i < kLeastGrids; ++i) grids[2 * i] = 0.002 + 1e-4 * (i % 2 == 0 ? 1 : -1);
  const SteadyCreepage mean = mean_of_grids(grids);
  EXPECT_NEAR(mean.mean, 0.002, 1e-12);
  EXPECT_NEAR(mean.error, 0.05 / std::sqrt(kLeastGrids - 1.0), 1e-9);
  grids[0].reset();
  EXPECT_THROW(mean_of_grids(grids), NumericalError);
  EXPECT_THROW(steady_creepage({kSteel, kRadiusX, kRadiusY, kLoad, kFriction, 1.01 * kFriction * kLoad}),
               NumericalError);
}

/// CONTACT's creepages, extrapolated from 1.1 to 0.125 mm, and near the limit of friction. Means of
/// other grids, from 25 and 28 cells along a semi-axis on, differ by 0.2 % at mu 0.3, by 0.6 % at 0.45.
TEST(HalfSpaceRolling, MeanOfGridsIsTheLimitOfFineGrids) {
  struct Row {
    double mu, creepage, tolerance;
  };
  for (const Row& row : {Row{0.1, 0.000736151, 0.005}, Row{0.3, 0.002649654, 0.005},
                         Row{0.4, 0.004102, 0.008}, Row{0.45, 0.005205, 0.01}}) {
    const std::string at = " at mu " + std::to_string(row.mu).substr(0, 4);
    const Clock clock;
    const SteadyCreepage steady =
        steady_creepage({kSteel, kRadiusX, kRadiusY, kLoad, kFriction, row.mu * kLoad});
    measured("seconds" + at, clock.seconds(), "s");
    measured("standard error" + at, steady.error);
    compare("creepage" + at, steady.mean, row.creepage, row.tolerance);
    EXPECT_LT(steady.error, 2e-3);
  }
}

// ---- Histories

TEST(HalfSpaceRolling, SphereUnderATangentialLoop) {
  // [Mindlin and Deresiewicz, J. Appl. Mech. 20 (1953) 327]; CONTACT's shifts at 0.25 mm beside. The work of
  // steps is the area of a polygon inscribed in the loop, so the loop has many.
  const Pressed pressed(0.5e-3, false, kRadiusX);
  const HertzPatch hertz = tread::hertz(kRadiusX, kRadiusX, kModulus, kLoad);
  const RollingContact rolling(pressed.influence, pressed.contact, kFriction);
  const double largest = kFriction * kLoad;
  const double limit = 3 * largest * 1.7 / (8 * hertz.semi_axis_x * kSteel.shear_modulus());  // shift limit
  const auto stick_radius = [&](const FrictionState& state) {
    return std::sqrt((1 - state.slip_fraction) * pressed.contact.area / std::numbers::pi);
  };

  const Clock clock;
  FrictionState state = rolling.free_state();
  double shift = 0;
  double work = 0;
  const auto go = [&](double to, int steps) {
    const double from = state.force / largest;
    for (int k = 1; k <= steps; ++k) {
      state = rolling.shift(state, (from + (to - from) * k / steps) * largest);
      shift += state.shift;
      work += state.work;
    }
  };
  go(0.5, 2);
  compare("stick radius at half of the largest force", stick_radius(state),
          hertz.semi_axis_x * std::cbrt(0.5), 0.02);
  compare("shift at half of the largest force", shift, limit * (1 - std::pow(0.5, 2.0 / 3)), 2e-3);
  EXPECT_NEAR(shift / 0.020704e-3, 1, 2e-3);
  go(0.875, 2);
  compare("stick radius at 7/8", stick_radius(state), hertz.semi_axis_x * 0.5, 0.04);  // by cells
  compare("shift at 7/8", shift, limit * 0.75, 3e-3);
  EXPECT_NEAR(shift / 0.041948e-3, 1, 3e-3);

  work = 0;
  go(0, 8);
  compare("shift left when the force is gone", shift, 0.006316371e-3, 0.02);
  EXPECT_NEAR(shift / 0.006294e-3, 1, 0.02);
  go(-0.875, 8);
  EXPECT_NEAR(shift / -0.041947e-3, 1, 3e-3);
  go(0.875, 16);
  EXPECT_NEAR(shift / 0.041948e-3, 1, 3e-3);
  compare("work of the loop", work, 0.6740, 0.015);
  measured("seconds", clock.seconds(), "s");
}

TEST(HalfSpaceRolling, FromShiftToSteadyRolling) {
  // CONTACT, 0.5 mm: creepage after 0.5, 2.5, 5, 7.5, 10, 12.5, 15, 17.5, 20 mm.
  constexpr std::array<double, 9> contact = {0.001491, 0.001769, 0.002206, 0.002894, 0.002606,
                                             0.00255,  0.002576, 0.002594, 0.002585};
  const Clock clock;
  const Pressed pressed(0.5e-3);
  const RollingContact rolling(pressed.influence, pressed.contact, kFriction);
  const double force = 0.3 * kLoad;
  const double steady = rolling.steady(force).creepage;
  FrictionState state = rolling.shift(rolling.free_state(), force);
  EXPECT_NEAR(state.slip_fraction, 0.4656319, 0.003);
  EXPECT_NEAR(state.max_shear, 395.587e6, 0.01e6);
  double largest = 0;
  double largest_at = 0;
  double settled = 0;
  for (int step = 1; step <= 40; ++step) {
    state = rolling.roll(state, force);
    const double rolled = step * 0.5e-3;
    if (state.creepage > largest) {
      largest = state.creepage;
      largest_at = rolled;
    }
    if (std::abs(state.creepage / steady - 1) > 0.014) settled = rolled;
    if (step % 5 == 0 || step == 1) {
      const double reference = contact[step / 5];
      measured("creepage at " + std::to_string(step * 5) + "e-4 m / reference - 1",
               state.creepage / reference - 1);
      EXPECT_NEAR(state.creepage / reference, 1, 2e-3) << step;
    }
  }
  measured("largest creepage", largest);
  measured("largest creepage at", largest_at * 1e3, "mm");
  measured("within 1.4 % of steady after", settled * 1e3, "mm");
  measured("seconds", clock.seconds(), "s");
  EXPECT_NEAR(largest, 0.002894, 3e-6);
  EXPECT_NEAR(largest_at, 7.5e-3, 1e-9);
  EXPECT_LT(settled, 13e-3);
}

// ---- Stress in the rail

TEST(HalfSpaceStress, UnderTheMiddleOfAHertzPatch) {
  // [Johnson, eqs. 3.45]
  const Pressed pressed(0.25e-3, false, kRadiusX);
  const HertzPatch hertz = tread::hertz(kRadiusX, kRadiusX, kModulus, kLoad);
  const FrictionState none = RollingContact(pressed.influence, pressed.contact, kFriction).free_state();
  const SurfaceLoad load{pressed.influence.grid, pressed.contact.pressure, none.tractions, 0.3};
  const double p0 = hertz.max_pressure;
  for (const double depth : {0.1, 0.48, 1.0, 2.0}) {
    const Stress s = rail_stress(load, 0, 0, depth * hertz.semi_axis_x);
    const double fall = 1 / (1 + depth * depth);
    EXPECT_NEAR(s.zz / p0, -fall, 2e-3);
    EXPECT_NEAR(s.xx / p0, -1.3 * (1 - depth * std::atan(1 / depth)) + 0.5 * fall, 2e-3);
    EXPECT_NEAR(s.xx, s.yy, 1e-3 * p0);
    EXPECT_NEAR(s.xz / p0, 0, 1e-9);
  }
}

/// Stress under unit point forces along z and x at the surface's origin. [Johnson, sect. 3.4 and 3.6]
Stress point_force(double x, double y, double z, double nu, double normal, double along) {
  const double r2 = x * x + y * y + z * z;
  const double r = std::sqrt(r2);
  const double n = normal / (2 * std::numbers::pi);
  const double t = along / (2 * std::numbers::pi);
  // The (1 - 2 nu) terms of the normal force come from second derivatives of ln(r + z).
  const auto twice = [&](double u) {
    return 1 / (r * (r + z)) - u * u / (r2 * r * (r + z)) - u * u / (r2 * std::pow(r + z, 2));
  };
  const double mixed = -x * y / (r2 * r * (r + z)) - x * y / (r2 * std::pow(r + z, 2));
  const double r5 = r2 * r2 * r;
  Stress s;
  s.xx = n * (-(1 - 2 * nu) * twice(x) - z * (3 * x * x / r5 - 1 / (r2 * r)) - 2 * nu * z / (r2 * r));
  s.yy = n * (-(1 - 2 * nu) * twice(y) - z * (3 * y * y / r5 - 1 / (r2 * r)) - 2 * nu * z / (r2 * r));
  s.zz = n * -3 * z * z * z / r5;
  s.xy = n * (-(1 - 2 * nu) * mixed - 3 * x * y * z / r5);
  s.yz = n * -3 * y * z * z / r5;
  s.xz = n * -3 * x * z * z / r5;
  const double rz = r + z;
  s.xx += t * x / (r2 * r) * (-3 * x * x / r2 + (1 - 2 * nu) / (rz * rz) * (r2 - y * y - 2 * r * y * y / rz));
  s.yy +=
      t * x / (r2 * r) * (-3 * y * y / r2 + (1 - 2 * nu) / (rz * rz) * (3 * r2 - x * x - 2 * r * x * x / rz));
  s.zz += t * -3 * x * z * z / r5;
  s.xy +=
      t * y / (r2 * r) * (-3 * x * x / r2 + (1 - 2 * nu) / (rz * rz) * (-r2 + x * x + 2 * r * x * x / rz));
  s.yz += t * -3 * x * y * z / r5;
  s.xz += t * -3 * x * x * z / r5;
  return s;
}

std::array<double, 6> components(const Stress& s) {
  return {s.xx, s.yy, s.zz, s.xy, s.yz, s.xz};
}

TEST(HalfSpaceStress, OfACellIsTheSumOfItsPointForces) {
  const Grid grid = centred_grid(1e-3, 1e-3, 1e-3);  // 3 x 3
  const std::vector<double> zero(9, 0.0);
  std::vector<double> one = zero;
  one[grid.index(2, 0)] = 1;
  const Tractions none{zero, zero};
  const Tractions along{one, zero};
  const Tractions across{zero, one};
  constexpr int n = 200;
  double worst = 0;
  for (const Vec3& at : {Vec3{0.3e-3, 0.2e-3, 0.5e-3}, Vec3{1.2e-3, -0.8e-3, 0.3e-3},
                         Vec3{1e-3, -1e-3, 0.9e-3}, Vec3{-2e-3, 1e-3, 0.4e-3}}) {
    Stress normal, x_force, y_force;
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) {
        const double px = at.x - (0.5e-3 + (i + 0.5) * 1e-3 / n);
        const double py = at.y - (-1.5e-3 + (j + 0.5) * 1e-3 / n);
        const double area = 1e-6 / (n * n);
        const auto sum = [&](Stress& to, const Stress& s) {
          to.xx += area * s.xx, to.yy += area * s.yy, to.zz += area * s.zz;
          to.xy += area * s.xy, to.yz += area * s.yz, to.xz += area * s.xz;
        };
        sum(normal, point_force(px, py, at.z, 0.3, 1, 0));
        sum(x_force, point_force(px, py, at.z, 0.3, 0, 1));
        const Stress s = point_force(py, px, at.z, 0.3, 0, 1);  // axes swapped
        sum(y_force, {s.yy, s.xx, s.zz, s.xy, s.xz, s.yz});
      }
    const auto close = [&](const SurfaceLoad& load, double sign, const Stress& points) {
      const auto closed = components(rail_stress(load, at.x, at.y, at.z));
      const auto summed = components(points);
      for (int k = 0; k < 6; ++k) worst = std::max(worst, std::abs(closed[k] - sign * summed[k]));
    };
    close({grid, one, none, 0.3}, 1, normal);
    close({grid, zero, along, 0.3}, -1, x_force);
    close({grid, zero, across, 0.3}, -1, y_force);
  }
  measured("worst difference to 40000 point forces / load", worst);
  EXPECT_LT(worst, 1e-5);
}

/// Largest Von Mises stress at a depth below y = 0 [Pa].
double largest_von_mises(const SurfaceLoad& load, double depth, double& at) {
  double largest = 0;
  for (int i = 0; i < load.grid.nx; ++i) {
    const double stress = von_mises(rail_stress(load, load.grid.x(i), 0, depth));
    if (stress > largest) {
      largest = stress;
      at = load.grid.x(i);
    }
  }
  return largest;
}

TEST(HalfSpaceStress, VonMisesBelowTheCentreLine) {
  // CONTACT, 0.25 mm; 0.55 mm is the depth of the middle of a 1.1 mm surface element. The wheel's tractions
  // point forward, the rail's backward, and their sum over the patch lies behind its middle: the bodies
  // differ.
  const Pressed pressed(0.25e-3);
  const RollingContact rolling(pressed.influence, pressed.contact, kFriction);
  const FrictionState none = rolling.free_state();
  const FrictionState driven = rolling.steady(0.3 * kLoad);
  Tractions reverse = driven.tractions;
  for (double& v : reverse.x) v = -v;
  for (double& v : reverse.y) v = -v;
  struct Row {
    std::string what;
    const Tractions& tractions;
    double depth, stress, x;
  };
  for (const Row& row : {Row{"mu 0", none.tractions, 0.55e-3, 438.339e6, 0},
                         Row{"mu 0.3, rail", driven.tractions, 0.275e-3, 809.449e6, -3e-3},
                         Row{"mu 0.3, rail", driven.tractions, 0.825e-3, 740.105e6, -3.75e-3},
                         Row{"mu 0.3, rail", driven.tractions, 1.65e-3, 768.572e6, -4.25e-3},
                         Row{"mu 0.3, rail", driven.tractions, 4.4e-3, 662.908e6, -1.75e-3},
                         Row{"mu 0.3, wheel", reverse, 0.275e-3, 819.285e6, -4.25e-3},
                         Row{"mu 0.3, wheel", reverse, 0.55e-3, 704.547e6, -4e-3},
                         Row{"mu 0.3, wheel", reverse, 2.75e-3, 786.629e6, 0.75e-3}}) {
    double at = 0;
    const double stress = largest_von_mises(
        {pressed.influence.grid, pressed.contact.pressure, row.tractions, 0.3}, row.depth, at);
    compare("Von Mises, " + row.what + ", depth " + std::to_string(std::lround(row.depth * 1e6)) + " um",
            stress, row.stress, 1e-4);
    EXPECT_NEAR(at, row.x, 1e-6);
  }
  double at = 0;
  const double stress = largest_von_mises(
      {pressed.influence.grid, pressed.contact.pressure, driven.tractions, 0.3}, 0.55e-3, at);
  measured("Von Mises, mu 0.3, rail, depth 550 um", stress / 1e6, "MPa");
  measured("at x", at * 1e3, "mm");
}

TEST(HalfSpaceStress, MeanOverASurfaceElement) {
  const Pressed pressed(0.5e-3);
  const RollingContact rolling(pressed.influence, pressed.contact, kFriction);
  const FrictionState state = rolling.steady(0.3 * kLoad);
  const SurfaceLoad load{pressed.influence.grid, pressed.contact.pressure, state.tractions, 0.3};
  const Box box{-3.3e-3, 0, 0, kElement, kElement, kElement};
  const Clock clock;
  const Stress mean = mean_rail_stress(load, box);
  measured("seconds", clock.seconds(), "s");
  Stress sum;
  constexpr int n = 12;
  for (int k = 0; k < n * n * n; ++k) {
    const auto at = [&](int i) { return ((i % n + 0.5) / n - 0.5) * kElement; };
    const Stress s = rail_stress(load, box.x + at(k), box.y + at(k / n), 0.5 * kElement + at(k / n / n));
    sum.xx += s.xx, sum.yy += s.yy, sum.zz += s.zz;
    sum.xy += s.xy, sum.yz += s.yz, sum.xz += s.xz;
  }
  const auto a = components(mean);
  const auto b = components(sum);
  for (int k = 0; k < 6; ++k) EXPECT_NEAR(a[k], b[k] / (n * n * n), 3e6) << k;
  measured("Von Mises of the mean", von_mises(mean) / 1e6, "MPa");
  measured("Von Mises in the middle", von_mises(rail_stress(load, box.x, box.y, 0.5 * kElement)) / 1e6,
           "MPa");
}

}  // namespace
}  // namespace tread::half_space
