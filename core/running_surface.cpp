#include "core/running_surface.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace tread {

void RunningSurface::add(DepthShapePointer shape, double at) {
  steepest_ += shape->bounds().steepest;
  placed_.push_back({shape->view(), at});
  shapes_.push_back(std::move(shape));
}

double RunningSurface::room(double radius, double gap) const {
  double sum = 0;
  for (const DepthShapePointer& shape : shapes_) {
    const DepthBounds& bounds = shape->bounds();
    const double rise = radius * bounds.steepest;
    const double reach = rise + std::sqrt(rise * rise + 2 * radius * gap);  // where slope and circle part
    sum += std::min(bounds.deepest + bounds.highest, bounds.steepest * reach);
  }
  return sum;
}

double traced_depth(const RunningSurface& rail, const RunningSurface& wheel, double wheel_radius, double x,
                    double y) {
  constexpr double kStep = 2e-4;  // [m]
  const auto depth = [&](double s) { return rail.at(x + s, y).depth + wheel.at(x + s, y).depth; };
  double least = depth(0);
  // Beyond this distance the wheel's own circle is higher than any place that could carry it.
  constexpr double kAnyGap = std::numeric_limits<double>::infinity();
  const double range = rail.room(wheel_radius, kAnyGap) + wheel.room(wheel_radius, kAnyGap);
  const double reach =
      std::min(2 * wheel_radius * (rail.steepest() + wheel.steepest()), std::sqrt(2 * wheel_radius * range));
  for (double s = kStep; s < reach + kStep; s += kStep)
    for (const double at : {-s, s}) least = std::min(least, depth(at) + 0.5 * at * at / wheel_radius);
  return least;
}

}  // namespace tread
