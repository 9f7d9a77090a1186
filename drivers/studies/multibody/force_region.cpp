#include "drivers/studies/multibody/force_region.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/math/raised_cosine.hpp"
#include "kernels/half_space/half_space.hpp"

namespace tread {

double ForceRegion::density(double y) const {
  return raised_cosine(y - centre, half);
}

double ForceRegion::coefficient(double wave_number) const {
  return raised_cosine_coefficient(wave_number, half);
}

double ForceRegion::last_wave_number() const {
  return 3 * std::numbers::pi / half;
}

double half_space_flexibility(const ForceRegion& region, const Material& material) {
  using namespace half_space;
  constexpr int kCells = 20;  // over half the region
  const double cell = region.half / kCells;
  const Influence influence(centred_grid(region.half, region.half, cell),
                            {material.youngs_modulus, material.poissons_ratio});
  const Grid& grid = influence.grid;
  const ForceRegion centred{0, region.half};
  std::vector<double> pressure(static_cast<std::size_t>(grid.size()));
  double force = 0;
  for (int j = 0; j < grid.ny; ++j)
    for (int i = 0; i < grid.nx; ++i) {
      double& p = pressure[static_cast<std::size_t>(grid.index(i, j))];
      p = centred.density(grid.x(i)) * centred.density(grid.y(j));
      force += p * cell * cell;
    }
  std::vector<double> approach(pressure.size());
  apply(influence.normal, grid, pressure, approach);
  double work = 0;
  for (std::size_t k = 0; k < pressure.size(); ++k) work += pressure[k] * approach[k] * cell * cell;
  return 0.5 * work / (force * force);  // the approach is that of two bodies
}

std::vector<int> some_harmonics(int dense, int last) {
  constexpr int kGrowth = 6;  // the next is larger by a part of that many
  std::vector<int> some;
  for (int n = 0; n <= dense; ++n) some.push_back(n);
  while (some.back() < last) some.push_back(std::min(last, some.back() + std::max(1, some.back() / kGrowth)));
  return some;
}

double sum_of_harmonics(const std::vector<int>& some, const std::vector<double>& value,
                        const std::function<double(int)>& weight) {
  double sum = weight(some.front()) * value.front();
  for (std::size_t i = 1; i < some.size(); ++i) {
    const int from = some[i - 1];
    const int to = some[i];
    sum += weight(to) * value[i];
    if (to == from + 1) continue;
    const double power = std::log(value[i] / value[i - 1]) / std::log(static_cast<double>(to) / from);
    for (int n = from + 1; n < to; ++n)
      sum += weight(n) * value[i - 1] * std::pow(static_cast<double>(n) / from, power);
  }
  return sum;
}

}  // namespace tread
