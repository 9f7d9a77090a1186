#include "core/mesh/web_outline.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <span>
#include <utility>

#include "core/error.hpp"

namespace tread {

namespace {

constexpr double kSameRadius = 1e-4;  // of the ends of both faces [m]

/// Number of the first value that does not exceed the one before it, or that of all.
std::size_t growing(std::span<const double> r) {
  const auto falls = std::adjacent_find(r.begin(), r.end(), std::greater_equal<>());
  return falls == r.end() ? r.size() : static_cast<std::size_t>(falls - r.begin()) + 1;
}

}  // namespace

WebOutline::WebOutline(const std::vector<double>& y, const std::vector<double>& r) {
  std::vector<double> across = y, radius = r;
  if (radius.size() > 2 && across.front() == across.back() && radius.front() == radius.back()) {
    across.pop_back();
    radius.pop_back();
  }
  if (radius.size() < 4) throw InputError("an outline has at least two points on each face");
  const std::size_t up = growing(radius);
  std::vector<double> back(radius.rbegin(), radius.rend() - static_cast<std::ptrdiff_t>(up));
  const std::size_t down = growing(back);
  if (up < 2 || down < 2 || down < back.size()) {
    const double top = *std::max_element(radius.begin(), radius.end());
    const bool before_the_rim = up < 2 || back.empty() || radius[up - 1] < top - kSameRadius;
    const std::size_t fault = std::min(before_the_rim ? up : up + back.size() - down, radius.size() - 1);
    throw InputError(fmt::format(
        "point {} at r = {:g} mm: r has to grow from the hub to the rim along one face, and to fall "
        "along the other; leave out points of hub and rim",
        fault + 1, 1e3 * radius[fault]));
  }
  const auto same = [](const char* end, double a, double b) {
    if (std::abs(a - b) > kSameRadius)
      throw InputError(
          fmt::format("the faces end at r = {:g} and {:g} mm at the {}; let both end at the same radius",
                      1e3 * a, 1e3 * b, end));
  };
  same("hub", radius.front(), back.front());
  same("rim", radius[up - 1], back.back());
  const auto split = static_cast<std::ptrdiff_t>(up);
  gauge_ = MonotoneCubic({radius.begin(), radius.begin() + split}, {across.begin(), across.begin() + split},
                         CurveEnds::straight);
  field_ = MonotoneCubic(std::move(back), {across.rbegin(), across.rend() - split}, CurveEnds::straight);
  hub_ = std::max(gauge_.first(), field_.first());
  rim_ = std::min(gauge_.last(), field_.last());
  if (gauge_.value(hub_) > field_.value(hub_)) std::swap(gauge_, field_);
  constexpr int kPlaces = 1000;
  least_thickness_ = 1;
  for (int i = 0; i <= kPlaces; ++i) {
    const auto [gauge, field] = at(hub_ + (rim_ - hub_) * i / kPlaces);
    least_thickness_ = std::min(least_thickness_, field - gauge);
  }
  if (!(least_thickness_ > 0)) throw InputError("the faces of the web meet; check the points' order");
}

}  // namespace tread
