#include "drivers/studies/profile/profile_figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/millimetre.hpp"

namespace tread {

Figure profile_figure(const ShownProfile& profile) {
  Series surface{"surface", {}, {}, Stroke::solid, 0};
  Series curvature{"curvature", {}, {}, Stroke::solid, 1};
  constexpr int kSamples = 1200;
  const double left = profile.curve.start().x, right = profile.curve.end().x;
  for (int i = 0; i <= kSamples; ++i) {
    surface.x.push_back(profile.curve.at(profile.curve.length() * i / kSamples).position.x / mm);
    surface.y.push_back(profile.curve.at(profile.curve.length() * i / kSamples).position.y / mm);
    const double y = left + (right - left) * i / kSamples;
    curvature.x.push_back(y / mm);
    curvature.y.push_back(curvature_at(profile, y));
  }
  Figure figure;
  figure.title = fmt::format("{}, {}", profile.name.substr(profile.name.rfind('/') + 1),
                             profile.wheel ? "wheel" : "rail");
  figure.x_label = "y [mm], to the field side";
  Panel height{
      profile.wheel ? "z to the flange tip [mm]" : "z upwards [mm]", {std::move(surface)}, {}, 240, {}};
  if (profile.file) {
    Series points{"points of the file", {}, {}, Stroke::dotted, 2};
    const UnderstoodProfile& file = *profile.file;
    double nearest = file.raw_z.empty() ? 0 : file.raw_z.front(), distance = 1;
    for (std::size_t i = 0; i < file.raw_y.size(); ++i)
      if (std::abs(file.raw_y[i]) < distance) {
        distance = std::abs(file.raw_y[i]);
        nearest = file.raw_z[i];
      }
    for (std::size_t i = 0; i < file.raw_y.size(); ++i) {
      points.x.push_back(file.raw_y[i] / mm);
      points.y.push_back((file.raw_z[i] - nearest) / mm);
    }
    height.series.push_back(std::move(points));
  }
  figure.panels.push_back(std::move(height));
  figure.panels.push_back({"Curvature [1/m], convex +", {std::move(curvature)}, {}, 160, Range{-100, 100}});
  figure.caption = "The curvature is the change of the tangent over 1 mm.";
  if (profile.file && !profile.file->deviation.empty()) {
    Series deviation{"distance of the spline from the point", {}, {}, Stroke::solid, 3};
    for (std::size_t i = 0; i < profile.file->deviation.size(); ++i) {
      deviation.x.push_back(profile.file->raw_y[i] / mm);
      deviation.y.push_back(1e6 * profile.file->deviation[i]);
    }
    figure.panels.push_back({"Smoothing [µm]", {std::move(deviation)}, {}, 120, {}});
  }
  return figure;
}

std::vector<TouchingAt> touching_over_offset(const ShownProfile& rail, double inclination,
                                             const ShownProfile& wheel, double step) {
  constexpr double kFirst = -10 * mm, kLast = 15 * mm;
  std::vector<TouchingAt> places;
  const int count = static_cast<int>(std::lround((kLast - kFirst) / step));
  for (int i = 0; i <= count; ++i) {
    const double offset = kFirst + i * step;
    places.push_back({offset, touching(rail.curve, inclination, wheel.curve, offset)});
  }
  return places;
}

Figure touching_figure(const std::vector<TouchingAt>& places, const ShownProfile& rail,
                       const ShownProfile& wheel) {
  Series on_rail{"on the rail, from its middle", {}, {}, Stroke::dotted, 0};
  Series on_wheel{"on the wheel, from the nominal rolling circle", {}, {}, Stroke::dotted, 1};
  Series slope{"slope of the rail", {}, {}, Stroke::dotted, 2};
  for (const TouchingAt& at : places) {
    const double x = at.lateral_offset / mm;
    for (Series* series : {&on_rail, &on_wheel, &slope}) series->x.push_back(x);
    on_rail.y.push_back(at.place.y / mm);
    on_wheel.y.push_back(at.place.wheel_y / mm);
    slope.y.push_back(std::clamp(at.place.slope, -3.0, 3.0));
  }
  Figure figure;
  figure.title = fmt::format("{} on {}: place of contact", wheel.name.substr(wheel.name.rfind('/') + 1),
                             rail.name.substr(rail.name.rfind('/') + 1));
  figure.x_label = "wheel.lateral_offset [mm]: the rail's middle in wheel coordinates";
  figure.panels.push_back({"y [mm]", {std::move(on_rail), std::move(on_wheel)}, {}, 240, {}});
  figure.panels.push_back({"Slope [-]", {std::move(slope)}, {}, 120, {}});
  figure.caption = "Rigid profiles, no yaw, no roll. A jump is contact at two places.";
  return figure;
}

}  // namespace tread
