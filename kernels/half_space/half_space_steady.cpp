#include "kernels/half_space/half_space_steady.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/math/hertz.hpp"

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

SteadySummary steady_summary(const SteadyCase& steady, double cell) {
  const Material& m = steady.material;
  const double modulus = contact_modulus(m.youngs_modulus, m.poissons_ratio);
  const HertzPatch patch = hertz(steady.radius_x, steady.radius_y, modulus, steady.load);
  const double margin = 2 * cell;
  const Influence influence(centred_grid(patch.semi_axis_x + margin, patch.semi_axis_y + margin, cell), m);
  const NormalContact contact =
      press(influence, quadratic_gap(steady.radius_x, steady.radius_y), steady.load);
  const RollingContact rolling(influence, contact, steady.friction_coefficient);
  const FrictionState state = rolling.steady(steady.force);
  return {state.creepage, state.slip_fraction, state.max_shear, state.work,
          centre_element_work(influence.grid, state, steady.element)};
}

SteadySummary extrapolated_summary(const SteadyCase& steady, double cell) {
  constexpr int kGrids = 12;
  std::vector<double> size;
  std::vector<SteadySummary> summary;
  for (int i = 0; i < kGrids; ++i) {
    size.push_back(cell * std::exp2(-i / (kGrids - 1.0)));
    summary.push_back(steady_summary(steady, size.back()));
  }
  double mean = 0;
  for (const double h : size) mean += h / kGrids;
  double spread = 0;
  for (const double h : size) spread += (h - mean) * (h - mean);
  // Value at size 0 of the line of least squares.
  const auto limit = [&](double SteadySummary::*value) {
    double sum = 0;
    for (std::size_t i = 0; i < kGrids; ++i)
      sum += summary[i].*value * (1.0 / kGrids - mean * (size[i] - mean) / spread);
    return sum;
  };
  return {limit(&SteadySummary::creepage), limit(&SteadySummary::slip_fraction),
          limit(&SteadySummary::max_shear), limit(&SteadySummary::work), limit(&SteadySummary::element_work)};
}

}  // namespace tread::half_space
