#include "kernels/half_space/half_space_steady.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/math/hertz.hpp"
#include "core/math/statistics.hpp"
#include "core/parallel/each_item.hpp"

namespace tread::half_space {

double centre_element_work(const Grid& grid, const FrictionState& state, double element) {
  double sum = 0;
  for (int j = 0; j < grid.ny; ++j) {
    const double from = std::max(grid.y(j) - 0.5 * grid.dy, -0.5 * element);
    const double to = std::min(grid.y(j) + 0.5 * grid.dy, 0.5 * element);
    if (to > from) sum += state.strips[j] * (to - from);
  }
  return sum * element;
}

namespace {

/// Creepage on cells of semi-axis / `cells` along x, and of eight times that share of the semi-axis across.
double creepage_on_grid(const SteadyCase& steady, double cells) {
  const Material& m = steady.material;
  const HertzPatch patch = hertz(steady.radius_x, steady.radius_y,
                                 contact_modulus(m.youngs_modulus, m.poissons_ratio), steady.load);
  const double dx = patch.semi_axis_x / cells;
  const double dy = 8 * patch.semi_axis_y / cells;
  const auto count = [](double half, double cell) { return 2 * static_cast<int>(half / cell + 2) + 1; };
  const int nx = count(patch.semi_axis_x, dx);
  const int ny = count(patch.semi_axis_y, dy);
  const Influence influence({nx, ny, dx, dy, -0.5 * (nx - 1) * dx, -0.5 * (ny - 1) * dy}, m);
  const NormalContact contact =
      press(influence, quadratic_gap(steady.radius_x, steady.radius_y), steady.load);
  return RollingContact(influence, contact, steady.friction_coefficient, SteadySlip::at_the_centre)
      .steady(steady.force)
      .creepage;
}

}  // namespace

SteadyCreepage mean_of_grids(const std::vector<std::optional<double>>& grids) {
  std::vector<double> found;
  for (const std::optional<double>& creepage : grids)
    if (creepage) found.push_back(*creepage);
  if (found.size() < kLeastGrids)
    throw NumericalError(fmt::format(
        "half-space reference: the creepage of steady rolling converges on {} of {} grids, and {} must; "
        "lower the traction coefficient, or raise that of friction",
        found.size(), grids.size(), kLeastGrids));
  const Statistics values = statistics(found);
  const double count = static_cast<double>(found.size());
  return {values.mean, values.deviation / (std::sqrt(count - 1) * std::abs(values.mean))};
}

SteadyCreepage steady_creepage(const SteadyCase& steady) {
  constexpr std::size_t kGrids = 12;
  constexpr double kCoarsest = 22;  // cells along a semi-axis
  std::vector<std::optional<double>> grids(kGrids);
  each_item(kGrids, [&](std::size_t i) {
    const double cells = kCoarsest * std::exp2(static_cast<double>(i) / (kGrids - 1.0));
    try {
      grids[i] = creepage_on_grid(steady, cells);
    } catch (const NumericalError&) {  // others may converge
    }
  });
  return mean_of_grids(grids);
}

}  // namespace tread::half_space
