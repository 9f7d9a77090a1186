#include "core/geometry/section_constants.hpp"

#include <algorithm>
#include <vector>

namespace tread {

SectionConstants section_constants(const RailProfile& rail) {
  constexpr int kPoints = 4000;  // a part
  // The running surface reaches below the joint of the side faces; the lower outline begins where it ends.
  const double join = rail.running.end().y, length = rail.running.length();
  const double from = rail.lower.first(0, rail.lower.length(),
                                       [&](const CurvePoint& point) { return join - point.position.y; });
  std::vector<Point2> corners;
  corners.reserve(3 * kPoints);
  for (int i = 0; i < kPoints; ++i) corners.push_back(rail.running.at(length * i / kPoints).position);
  const auto lower = [&](int i) {
    return rail.lower.at(from + (rail.lower.length() - from) * i / kPoints).position;
  };
  for (int i = 0; i < kPoints; ++i) corners.push_back(lower(i));
  for (int i = kPoints; i > 0; --i) corners.push_back({-lower(i).x, lower(i).y});
  std::reverse(corners.begin(), corners.end());
  const AreaMoments m = polygon_moments(corners);
  return {m.area, m.centroid.y + rail.height, m.yy, m.xx};
}

}  // namespace tread
