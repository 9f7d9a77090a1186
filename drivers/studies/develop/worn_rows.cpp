#include "drivers/studies/develop/worn_rows.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "core/error.hpp"

namespace tread {

namespace {

/// Weighted mean of the rows within `reach` of each row; weights fall as a cosine to 0 at `reach`.
std::vector<std::vector<double>> smoothed_across(const std::vector<std::vector<double>>& values,
                                                 const std::vector<WorkRow>& rows, double reach) {
  std::vector<std::vector<double>> result;
  for (std::size_t j = 0; j < rows.size(); ++j) {
    std::vector<double> row(values[j].size(), 0.0);
    double weights = 0;
    for (std::size_t k = 0; k < rows.size(); ++k) {
      const double distance = std::abs(rows[k].y - rows[j].y);
      if (distance >= reach && k != j) continue;
      const double weight = rows[k].width * (1 + std::cos(std::numbers::pi * distance / reach));
      for (std::size_t i = 0; i < row.size(); ++i) row[i] += weight * values[k][i];
      weights += weight;
    }
    for (double& value : row) value /= weights;
    result.push_back(std::move(row));
  }
  return result;
}

}  // namespace

void SurfaceWork::average() {
  double whole = 0;
  for (WorkRow& row : rows) {
    row.share = 0;
    for (std::size_t i = 0; i < row.work.size(); ++i) row.share += mean.length[i] * row.work[i] * row.width;
    whole += row.share;
  }
  mean.work.assign(mean.x.size(), 0.0);
  for (WorkRow& row : rows) {
    row.share = whole > 0 ? row.share / whole : 0;
    for (std::size_t i = 0; i < row.work.size(); ++i) mean.work[i] += row.share * row.work[i];
  }
}

PassageWork SurfaceWork::along(std::size_t row) const {
  return {mean.x, mean.length, rows[row].work};
}

void WornRows::add(double factor, const std::vector<std::vector<double>>& values) {
  for (std::size_t j = 0; j < depth.size(); ++j)
    for (std::size_t i = 0; i < depth[j].size(); ++i) depth[j][i] += factor * values[j][i];
}

WornProfile WornRows::mean(WornProfile profile) const {
  std::fill(profile.depth.begin(), profile.depth.end(), 0.0);
  for (std::size_t j = 0; j < depth.size(); ++j)
    for (std::size_t i = 0; i < profile.depth.size(); ++i) profile.depth[i] += share[j] * depth[j][i];
  return profile;
}

double range_of_rows(const std::vector<std::vector<double>>& rows) {
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (const std::vector<double>& row : rows) {
    const auto [least, most] = std::minmax_element(row.begin(), row.end());
    low = std::min(low, *least);
    high = std::max(high, *most);
  }
  return high - low;
}

std::vector<std::vector<double>> uneven_rows(const SurfaceWork& work, const SurfaceWork& smooth,
                                             const WornProfile& profile, const WearBand& band, double reach) {
  if (work.rows.size() != smooth.rows.size())
    throw InputError("the passages are of different meshes: begin the development in another folder");
  std::vector<std::vector<double>> uneven;
  for (std::size_t j = 0; j < work.rows.size(); ++j)
    uneven.push_back(uneven_work(without(work.along(j), smooth.along(j)), profile, band));
  return smoothed_across(uneven, work.rows, reach);
}

}  // namespace tread
