#include "drivers/engine/model/surfaces.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

namespace tread {

namespace {

/// Measured depths, rows of one or many lines; those of a wheel closed: after a turn they return to the
/// first.
struct Measured {
  std::vector<double> x, depth;
};

Measured measured(const SurfaceSpec& spec, double radius) {
  constexpr double kSame = 1e-6;  // of a turn
  if (!spec.on_wheel()) return {spec.file_x, spec.file_depth};
  Measured closed{spec.file_x, {}};
  const double turn = 2 * std::numbers::pi * radius;
  const double end = spec.file_x.front() + turn;
  const bool open = spec.file_x.back() < end - kSame * turn;
  if (open) closed.x.push_back(end);
  closed.x.back() = end;
  const std::size_t columns = spec.file_x.size();
  for (std::size_t first = 0; first < spec.file_depth.size(); first += columns) {
    for (std::size_t i = 0; i < columns; ++i) closed.depth.push_back(spec.file_depth[first + i]);
    if (open) closed.depth.push_back(spec.file_depth[first]);
  }
  return closed;
}

}  // namespace

DepthShapePointer shape_of(const Scene& scene, const SurfaceSpec& spec) {
  const double radius = scene.wheel ? 0.5 * scene.wheel->diameter : 0;
  if (spec.kind == "dent") return dent(spec.depth, spec.length, spec.width, spec.centre);
  if (spec.kind == "waves")
    return waves(spec.depth, spec.wavelength, static_cast<int>(spec.length / spec.wavelength + 1e-9));
  if (spec.kind == "polygon")
    return waves(spec.depth, 2 * std::numbers::pi * radius / spec.order, spec.order);
  if (spec.kind == "flat") return chord_flat(spec.length, radius);
  if (spec.kind == "map" || spec.kind == "profile") {
    const Measured depths = measured(spec, radius);
    return spec.kind == "map" ? measured_map(depths.x, spec.file_y, depths.depth, spec.centre)
                              : measured_profile(depths.x, depths.depth);
  }
  return dip(spec.depth, spec.length, spec.shape == "pointed");
}

namespace {

RunningSurface surface_of(const Scene& scene, bool wheel) {
  RunningSurface surface =
      wheel && scene.wheel ? RunningSurface(0.5 * scene.wheel->diameter, scene.start_x()) : RunningSurface();
  for (const auto& [name, spec] : scene.surfaces)
    if (spec.on_wheel() == wheel) surface.add(shape_of(scene, spec), spec.at);
  return surface;
}

}  // namespace

RunningSurface rail_surface(const Scene& scene) {
  return surface_of(scene, false);
}

RunningSurface wheel_surface(const Scene& scene) {
  return surface_of(scene, true);
}

std::vector<Span> places_of(const Scene& scene, const SurfaceSpec& spec, const Span& way) {
  const DepthBounds bounds = shape_of(scene, spec)->bounds();
  const Span once{spec.at + bounds.first, spec.at + bounds.last};
  std::vector<Span> places;
  const auto add = [&](double shift) {
    const Span place{std::max(once.first + shift, way.first), std::min(once.last + shift, way.last)};
    if (place.first < place.last) places.push_back(place);
  };
  if (!spec.on_wheel()) {
    add(0);
    return places;
  }
  const double turn = std::numbers::pi * scene.wheel->diameter;
  const auto last = static_cast<int>(std::floor((way.last - once.first) / turn));
  for (auto i = static_cast<int>(std::ceil((way.first - once.last) / turn)); i <= last; ++i) add(i * turn);
  return places;
}

}  // namespace tread
