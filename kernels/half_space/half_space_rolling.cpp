#include "kernels/half_space/half_space_rolling.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>

#include "core/error.hpp"
#include "core/math/hertz.hpp"
#include "kernels/half_space/gmres.hpp"

namespace tread::half_space {

namespace {

/// Values one cell ahead; zeros come from beyond the grid.
std::vector<double> ahead(const Grid& grid, const std::vector<double>& v) {
  std::vector<double> shifted(v.size(), 0.0);
  for (int j = 0; j < grid.ny; ++j)
    for (int i = 0; i + 1 < grid.nx; ++i) shifted[grid.index(i, j)] = v[grid.index(i + 1, j)];
  return shifted;
}

}  // namespace

/// Prescribed quantity: the force (the shift is then unknown) or the shift.
struct RollingContact::Drive {
  bool by_force;
  double value;  ///< force [N] or shift [m]
};

namespace {

/// Displacement differences of the surfaces along x and y under tractions [m].
std::array<std::vector<double>, 2> displacements(const OffsetTable& xx, const OffsetTable& xy,
                                                 const OffsetTable& yy, const Grid& grid,
                                                 const Tractions& p) {
  std::array<std::vector<double>, 2> u;
  for (std::vector<double>& component : u) component.assign(static_cast<std::size_t>(grid.size()), 0.0);
  apply(xx, grid, p.x, u[0]);
  apply(xy, grid, p.y, u[0]);
  apply(xy, grid, p.x, u[1]);
  apply(yy, grid, p.y, u[1]);
  return u;
}

}  // namespace

/// Equations of one step or of the steady state. Slip = shift + before - displacement by the tractions.
/// Vectors of the solver hold the tractions of the n cells in contact over f p_max: x of all, then y of all.
/// They also hold the shift over `length` = f p_max times the table's diagonal.
struct RollingContact::Problem {
  const Grid& grid;
  const std::vector<int>& cells;
  const std::vector<Run>& runs;
  const OffsetTable& xx;
  const OffsetTable& xy;
  const OffsetTable& yy;
  bool rolling = true;
  bool steady = false;
  std::vector<double> before_x, before_y;  ///< displacement difference of the particles before the step [m]
  Tractions arriving;                      ///< tractions of the particles before the step; none when steady

  int count() const { return static_cast<int>(cells.size()); }
  std::vector<double> displace(const std::vector<double>& p) const;
};

/// Scaled displacements of the n cells, x, then y, under scaled tractions.
std::vector<double> RollingContact::Problem::displace(const std::vector<double>& p) const {
  const int n = count();
  std::vector<double> field_x(grid.size(), 0.0);
  std::vector<double> field_y(grid.size(), 0.0);
  for (int c = 0; c < n; ++c) {
    const double px = p[c];
    const double py = p[n + c];
    const int is = cells[c] % grid.nx;
    const int js = cells[c] / grid.nx;
    for (const Run& run : runs) {
      const double* __restrict cxx = xx.row(run.j - js) + (run.first - is);
      const double* __restrict cxy = xy.row(run.j - js) + (run.first - is);
      const double* __restrict cyy = yy.row(run.j - js) + (run.first - is);
      double* __restrict vx = field_x.data() + grid.index(run.first, run.j);
      double* __restrict vy = field_y.data() + grid.index(run.first, run.j);
      for (int i = 0; i < run.cells; ++i) {
        vx[i] += px * cxx[i] + py * cxy[i];
        vy[i] += px * cxy[i] + py * cyy[i];
      }
    }
  }
  std::vector<double> v(2 * n);
  const double scale = 1 / xx.at(0, 0);
  for (int c = 0; c < n; ++c) {
    v[c] = scale * field_x[cells[c]];
    v[n + c] = scale * field_y[cells[c]];
  }
  return v;
}

RollingContact::RollingContact(const Influence& influence, const NormalContact& contact,
                               double friction_coefficient, SteadySlip slip)
    : influence_(influence), contact_(contact), friction_(friction_coefficient) {
  const Grid& grid = influence.grid;
  for (int j = 0; j < grid.ny; ++j) {
    Run run{j, grid.nx, 0};
    for (int i = 0; i < grid.nx; ++i)
      if (contact.pressure[grid.index(i, j)] > 0) {
        cells_.push_back(grid.index(i, j));
        run.first = std::min(run.first, i);
        run.cells = i - run.first + 1;
      }
    if (run.cells == 0) continue;
    runs_.push_back(run);
    if (run.first < 1 || run.first + run.cells >= grid.nx)
      throw NumericalError(
          "half-space reference: rolling needs a free cell before and behind the contact; take a larger "
          "grid");
  }
  const double second_order = slip == SteadySlip::at_the_centre ? 0.5 : 0;
  const auto rate = [&](const OffsetTable& table) {
    const int reach = grid.nx - 2;  // the outermost columns are free
    OffsetTable r(reach, grid.ny - 1);
    for (int dj = 1 - grid.ny; dj < grid.ny; ++dj)
      for (int di = -reach; di <= reach; ++di) {
        const double ahead_of = table.at(di + 1, dj);
        const double lost = table.at(di, dj) - ahead_of;
        r.at(di, dj) = lost + second_order * (lost - (ahead_of - table.at(di + 2, dj)));
      }
    return r;
  };
  rate_xx_ = rate(influence.xx);
  rate_xy_ = rate(influence.xy);
  rate_yy_ = rate(influence.yy);
}

FrictionState RollingContact::free_state() const {
  const std::size_t n = influence_.grid.size();
  FrictionState state;
  state.tractions = {std::vector<double>(n, 0.0), std::vector<double>(n, 0.0)};
  state.slipping.assign(n, 0);
  return state;
}

RollingContact::Problem RollingContact::steady_problem() const {
  const std::vector<double> zero(influence_.grid.size(), 0.0);
  return {influence_.grid, cells_, runs_, rate_xx_, rate_xy_, rate_yy_, true, true, zero, zero, {}};
}

RollingContact::Problem RollingContact::step_problem(const FrictionState& before, bool rolling) const {
  const Grid& grid = influence_.grid;
  Tractions p = before.tractions;
  auto [ux, uy] = displacements(influence_.xx, influence_.xy, influence_.yy, grid, p);
  if (rolling) {
    ux = ahead(grid, ux);
    uy = ahead(grid, uy);
    p = {ahead(grid, p.x), ahead(grid, p.y)};
  }
  return {grid, cells_, runs_, influence_.xx, influence_.xy, influence_.yy, rolling, false, ux, uy, p};
}

/// Semi-smooth Newton on P(p + slip / D) - p = 0. P is the projection on the disk of radius f pressure, D the
/// table's diagonal; the last equation is the force or the shift. Returns nullopt without convergence. [Alart
/// and Curnier, Comput. Methods Appl. Mech. Eng. 92 (1991) 353]
std::optional<FrictionState> RollingContact::newton(const Problem& problem, const Drive& drive,
                                                    const FrictionState& start) const {
  constexpr double kTolerance = 1e-9;  ///< norm of the scaled residuals
  constexpr double kLinear = 1e-3;     ///< relative residual of the linear solution in a Newton step
  constexpr int kProducts = 400;       ///< most products in a Newton step
  constexpr double kSmallest = 0.01;   ///< smallest fraction of a Newton step
  const int iterations = drive.by_force ? 15 : 60;
  const int n = problem.count();
  const double scale = friction_ * contact_.max_pressure;
  const double length = scale * problem.xx.at(0, 0);
  const double area = influence_.grid.dx * influence_.grid.dy;
  const double share = 1.0 / n;

  std::vector<double> x(2 * n + 1), bound(n), before(2 * n);
  for (int c = 0; c < n; ++c) {
    const int k = problem.cells[c];
    bound[c] = contact_.pressure[k] / contact_.max_pressure;
    before[c] = problem.before_x[k] / length;
    before[n + c] = problem.before_y[k] / length;
    x[c] = start.tractions.x[k] / scale;
    x[n + c] = start.tractions.y[k] / scale;
  }
  x[2 * n] = (drive.by_force ? start.shift : drive.value) / length;

  std::vector<double> zx(n), zy(n), z(n);  ///< p + slip / D and its length
  const auto residual = [&](const std::vector<double>& at) {
    const std::vector<double> v = problem.displace(at);
    std::vector<double> r(2 * n + 1);
    double sum = 0;
    for (int c = 0; c < n; ++c) {
      zx[c] = at[c] + at[2 * n] + before[c] - v[c];
      zy[c] = at[n + c] + before[n + c] - v[n + c];
      z[c] = std::hypot(zx[c], zy[c]);
      const double factor = z[c] > bound[c] ? bound[c] / z[c] : 1;
      r[c] = factor * zx[c] - at[c];
      r[n + c] = factor * zy[c] - at[n + c];
      sum += at[c];
    }
    r[2 * n] = drive.by_force ? share * (drive.value / (area * scale) - sum) : 0;
    return r;
  };
  const auto minus_derivative = [&](const std::vector<double>& d) {
    const std::vector<double> v = problem.displace(d);
    std::vector<double> r(2 * n + 1);
    double sum = 0;
    for (int c = 0; c < n; ++c) {
      sum += d[c];
      if (z[c] > bound[c]) {
        const double ex = zx[c] / z[c];
        const double ey = zy[c] / z[c];
        const double dx = d[c] + d[2 * n] - v[c];
        const double dy = d[n + c] - v[n + c];
        const double turn = (ex * dy - ey * dx) * bound[c] / z[c];
        r[c] = d[c] + ey * turn;
        r[n + c] = d[n + c] - ex * turn;
      } else {
        r[c] = v[c] - d[2 * n];
        r[n + c] = v[n + c];
      }
    }
    r[2 * n] = drive.by_force ? share * sum : d[2 * n];
    return r;
  };

  std::vector<double> r = residual(x);
  double norm = std::sqrt(dot(r, r));
  for (int iteration = 0; norm > kTolerance; ++iteration) {
    const bool loose = std::equal(z.begin(), z.end(), bound.begin(), std::greater<>());
    if (iteration == iterations || (loose && drive.by_force)) return std::nullopt;
    const std::vector<double> step = gmres(minus_derivative, r, kLinear, kProducts);
    const std::vector<double> from = x;
    const double last = norm;
    double damping = 2;
    do {
      damping *= 0.5;
      if (damping < kSmallest) return std::nullopt;
      x = from;
      add(damping, step, x);
      r = residual(x);
      norm = std::sqrt(dot(r, r));
    } while (norm > (1 - 0.1 * damping) * last);
  }

  FrictionState state = free_state();
  for (int c = 0; c < n; ++c) {
    const int k = problem.cells[c];
    state.tractions.x[k] = x[c] * scale;
    state.tractions.y[k] = x[n + c] * scale;
    state.force += state.tractions.x[k] * area;
    state.lateral_force += state.tractions.y[k] * area;
    state.max_shear = std::max(state.max_shear, scale * std::hypot(x[c], x[n + c]));
    state.slipping[k] = z[c] > bound[c] ? 1 : 0;
    state.slip_fraction += share * state.slipping[k];
  }
  state.shift = x[2 * n] * length;
  state.creepage = problem.rolling ? state.shift / influence_.grid.dx : 0;
  add_work(problem, state);
  return state;
}

/// Newton's method with the shift unknown. Newton fails if at some iterate no cell sticks: the force then
/// depends on no shift. In that case the shift is bisected until Newton succeeds.
FrictionState RollingContact::solve(const Problem& problem, double force, const FrictionState& start) const {
  constexpr int kTrials = 80;
  constexpr double kForce = 1e-9;  ///< tolerance as a fraction of the largest possible force
  const double largest = friction_ * contact_.load;
  if (!(std::abs(force) < largest))
    throw NumericalError(fmt::format(
        "half-space reference: friction carries less than {:.1f} N, asked for {:.1f} N; lower the "
        "traction coefficient",
        largest, force));
  const Drive drive{true, force};
  if (std::optional<FrictionState> state = newton(problem, drive, start)) return *std::move(state);

  FrictionState near = start;
  double low = -HUGE_VAL, high = HUGE_VAL;  ///< shifts of too small and too large forces
  double stride = std::max(std::abs(start.shift), 1e-6 * contact_.approach);
  double shift = start.shift;
  for (int trial = 0; trial < kTrials; ++trial) {
    std::optional<FrictionState> state = newton(problem, {false, shift}, near);
    if (!state) break;
    near = *std::move(state);
    const double miss = near.force - force;
    if (std::abs(miss) < kForce * largest) return near;
    (miss > 0 ? high : low) = shift;
    if (std::isinf(high) || std::isinf(low)) {
      shift += miss > 0 ? -stride : stride;
      stride *= 2;
    } else {
      shift = 0.5 * (low + high);
    }
    if (near.slip_fraction == 1) continue;
    std::optional<FrictionState> balanced = newton(problem, drive, near);
    if (balanced) return *std::move(balanced);
  }
  throw NumericalError("half-space reference: friction does not converge; try other cells");
}

void RollingContact::add_work(const Problem& problem, FrictionState& state) const {
  const Grid& grid = influence_.grid;
  const Tractions& p = state.tractions;
  const Tractions before = problem.steady ? Tractions{ahead(grid, p.x), ahead(grid, p.y)} : problem.arriving;
  const auto [vx, vy] = displacements(problem.xx, problem.xy, problem.yy, grid, p);
  double sum = 0;
  std::vector<double> strips(grid.ny, 0.0);
  for (int j = 0; j < grid.ny; ++j) {
    for (int i = 0; i < grid.nx; ++i) {
      const int k = grid.index(i, j);
      const double slip_x = state.shift + problem.before_x[k] - vx[k];
      const double slip_y = problem.before_y[k] - vy[k];
      strips[j] += 0.5 * ((p.x[k] + before.x[k]) * slip_x + (p.y[k] + before.y[k]) * slip_y);
    }
    sum += strips[j];
  }
  state.work = sum * grid.dy * (problem.rolling ? 1 : grid.dx);
  if (problem.rolling) state.strips = std::move(strips);
}

FrictionState RollingContact::shift(const FrictionState& before, double force) const {
  FrictionState start = before;  // as if all cells stuck [Johnson, sect. 7.2]
  const double radius = std::sqrt(contact_.area / std::numbers::pi);
  start.shift = (force - before.force) * (2 - influence_.material.poissons_ratio) /
                (4 * radius * influence_.material.shear_modulus());
  return solve(step_problem(before, false), force, start);
}

FrictionState RollingContact::roll(const FrictionState& before, double force) const {
  return solve(step_problem(before, true), force, before);
}

FrictionState RollingContact::steady(double force) const {
  FrictionState start = free_state();
  start.shift = expected_creepage(force) * influence_.grid.dx;
  return solve(steady_problem(), force, start);
}

/// Creepage of a circular patch, with which the solver starts; Kalker's C11 = 4.3. [Vermeulen and Johnson, J.
/// Appl. Mech. 31 (1964) 338]
double RollingContact::expected_creepage(double force) const {
  const double largest = friction_ * contact_.load;
  const double ab = contact_.area / std::numbers::pi;
  const double share = std::min(1.0, std::abs(force) / largest);
  const double creepage = 3 * largest / (4.3 * influence_.material.shear_modulus() * ab);
  return std::copysign(creepage * (1 - std::cbrt(1 - share)), force);
}

}  // namespace tread::half_space
