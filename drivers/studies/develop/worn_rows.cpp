#include "drivers/studies/develop/worn_rows.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/error.hpp"

namespace tread {

void SurfaceWork::average() {
  double whole = 0;
  for (WorkRow& row : rows) {
    row.share = 0;
    for (std::size_t i = 0; i < row.work.size(); ++i) row.share += mean.length[i] * row.work[i] * row.width;
    whole += row.share;
  }
  for (WorkRow& row : rows) row.share = whole > 0 ? row.share / whole : 0;
  weigh();
}

void SurfaceWork::weigh() {
  mean.work.assign(mean.x.size(), 0.0);
  for (const WorkRow& row : rows)
    for (std::size_t i = 0; i < row.work.size(); ++i) mean.work[i] += row.share * row.work[i];
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

SurfaceWork smoothed_across(SurfaceWork work, double reach) {
  const std::vector<WorkRow> rows = work.rows;
  for (WorkRow& row : work.rows) {
    std::fill(row.work.begin(), row.work.end(), 0.0);
    double weights = 0;
    for (const WorkRow& other : rows) {
      const double distance = std::abs(other.y - row.y);
      if (distance >= reach && distance > 0) continue;
      // It falls as a cosine to 0 at `reach`.
      const double weight = other.width * (1 + std::cos(std::numbers::pi * distance / reach));
      for (std::size_t i = 0; i < row.work.size(); ++i) row.work[i] += weight * other.work[i];
      weights += weight;
    }
    for (double& value : row.work) value /= weights;
  }
  work.weigh();
  return work;
}

SurfaceWork work_beyond(SurfaceWork work, const SurfaceWork& smooth) {
  if (work.rows.size() != smooth.rows.size())
    throw InputError("the passages are of different meshes: begin the development in another folder");
  for (std::size_t j = 0; j < work.rows.size(); ++j) {
    work.rows[j].work = without(work.along(j), smooth.along(j)).work;
    work.rows[j].share = smooth.rows[j].share;
  }
  work.weigh();
  return work;
}

std::vector<std::vector<double>> uneven_rows(const SurfaceWork& work, const WornProfile& profile,
                                             const WearBand& band) {
  std::vector<std::vector<double>> uneven;
  for (std::size_t j = 0; j < work.rows.size(); ++j)
    uneven.push_back(uneven_work(work.along(j), profile, band));
  return uneven;
}

}  // namespace tread
