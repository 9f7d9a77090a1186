// Static normal contact against Hertz. [Johnson, Contact Mechanics, ch. 4]

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "drivers/verify/cases.hpp"
#include "drivers/verify/tyre_on_block.hpp"

namespace tread {

namespace {

struct StaticContact {
  double max_pressure = 0;  ///< largest nodal average [Pa]
  double area = 0;          ///< [m2]
  double approach = 0;      ///< approach of distant points [m]
  double load = 0;          ///< [N]
  std::vector<ContactPoint> points;
};

/// Displacement of the axis at depth z of a half-space under a Hertz pressure: Boussinesq's point force,
/// integrated over the ellipse. [Johnson, eq. 3.19] [m]
double axis_displacement(const ElasticConstants& body, const HertzPatch& patch, double z) {
  constexpr int kRings = 60;
  constexpr int kSectors = 60;
  const double nu = body.poissons_ratio;
  double sum = 0;
  for (int i = 0; i < kRings; ++i) {
    const double r = (i + 0.5) / kRings;
    for (int j = 0; j < kSectors; ++j) {
      const double angle = 2 * std::numbers::pi * (j + 0.5) / kSectors;
      const double distance =
          std::hypot(r * patch.semi_axis_x * std::cos(angle), r * patch.semi_axis_y * std::sin(angle), z);
      sum += std::sqrt(1 - r * r) * r * (2 * (1 - nu) + z * z / (distance * distance)) / distance;
    }
  }
  const double cell = 2 * std::numbers::pi / (kRings * kSectors) * patch.semi_axis_x * patch.semi_axis_y;
  return (1 + nu) / (2 * std::numbers::pi * body.youngs_modulus) * patch.max_pressure * sum * cell;
}

StaticContact press(const TyreOnBlock& bodies, const ProgressText& progress) {
  Model model(bodies.scene());
  progress(fmt::format("{} elements of {:.3g} mm, shift {:g}", model.elements(), 1e3 * bodies.element_size,
                       bodies.grid_offset));
  const Preload preload = solve_preload(model, {}, progress);
  const HertzPatch patch = bodies.hertz_patch();
  StaticContact contact;
  contact.max_pressure = model.contact->nodes().max_pressure();
  contact.area = preload.contact.area;
  contact.load = -preload.contact.force_on_rail.z;
  contact.points = model.contact->points();
  // The approach is seen from two points on the axis, each three semi-axes deep, plus the remaining
  // displacement of a half-space from there on.
  const double depth = 3 * std::max(patch.semi_axis_x, patch.semi_axis_y);
  const double* u = preload.displacement.data();
  const double rail = displacement_at(model, model.index.rail_cap, 0, -depth, 0, u).z;
  const double wheel =
      displacement_at(model, model.index.tread, 0, bodies.radius - depth, 0, u).z + preload.wheel.origin.z;
  contact.approach = bodies.radius - wheel + rail + axis_displacement(bodies.elastic.wheel, patch, depth) +
                     axis_displacement(bodies.elastic.rail, patch, depth);
  return contact;
}

/// Pressure along the rolling direction through the middle of the patch.
Figure pressure_figure(const TyreOnBlock& bodies, const StaticContact& contact) {
  const HertzPatch patch = bodies.hertz_patch();
  Series ours{"integration points", {}, {}, Stroke::solid};
  Series theory{"Hertz", {}, {}, Stroke::dashed};
  // The figure shows the row of points nearest to the middle.
  double nearest = 1e30;
  for (const ContactPoint& point : contact.points) nearest = std::min(nearest, std::abs(point.position.y));
  std::vector<const ContactPoint*> row;
  for (const ContactPoint& point : contact.points)
    if (std::abs(point.position.y) < nearest + 1e-3 * bodies.element_size) row.push_back(&point);
  std::sort(row.begin(), row.end(), [](const ContactPoint* a, const ContactPoint* b) {
    return std::pair(a->position.x, a->position.y) < std::pair(b->position.x, b->position.y);
  });
  for (const ContactPoint* point : row) {
    ours.x.push_back(1e3 * point->position.x);
    ours.y.push_back(1e-6 * point->pressure);
  }
  for (int i = -60; i <= 60; ++i) {
    const double r = i / 60.0;
    theory.x.push_back(1e3 * r * patch.semi_axis_x);
    theory.y.push_back(1e-6 * patch.max_pressure * std::sqrt(1 - r * r));
  }
  return {"Pressure through the middle of the patch",
          "x [mm]",
          {{"Pressure [MPa]", {ours, theory}, {}, 260, std::nullopt}},
          {},
          {},
          std::nullopt,
          ""};
}

CaseResult hertz_case(const VerifyInputs& inputs, const ProgressText& progress, bool sphere) {
  TyreOnBlock bodies = tyre_of(inputs, sphere);
  const HertzPatch patch = bodies.hertz_patch();
  const double area = std::numbers::pi * patch.semi_axis_x * patch.semi_axis_y;
  const double smallest = std::min(patch.semi_axis_x, patch.semi_axis_y);
  const double bound = 0.03 * bodies.fineness();
  const double spread = 0.02 * bodies.fineness();

  const StaticContact contact = press(bodies, progress);
  CaseResult result;
  result.findings = {{"largest pressure, nodal average", "MPa", 1e-6 * contact.max_pressure,
                      1e-6 * patch.max_pressure, bound},
                     {"patch area", "mm2", 1e6 * contact.area, 1e6 * area, bound},
                     {"approach", "um", 1e6 * contact.approach, 1e6 * patch.approach, 0.03},
                     {"F_N", "kN", 1e-3 * contact.load, 1e-3 * bodies.load, 1e-5}};

  // The contact is repeated with the meshes shifted by parts of an element: no alignment is favoured.
  double low = contact.max_pressure, high = low, small = contact.area, large = small;
  for (const double shift : {0.25, 0.5}) {
    TyreOnBlock shifted = bodies;
    shifted.grid_offset += shift;
    const StaticContact other = press(shifted, progress);
    low = std::min(low, other.max_pressure);
    high = std::max(high, other.max_pressure);
    small = std::min(small, other.area);
    large = std::max(large, other.area);
  }
  result.findings.push_back({"spread of the largest pressure over three alignments", "-",
                             (high - low) / patch.max_pressure, 0, spread, true});
  result.findings.push_back(
      {"spread of the area over three alignments", "-", (large - small) / area, 0, spread, true});

  TyreOnBlock coarse = bodies;
  coarse.element_size *= 2;
  if (coarse.element_size < 0.7 * smallest) {
    const StaticContact other = press(coarse, progress);
    const double order = std::log2(std::abs(other.max_pressure / patch.max_pressure - 1) /
                                   std::abs(contact.max_pressure / patch.max_pressure - 1));
    result.findings.push_back(
        {"order of the largest pressure, elements of 2 h and h", "-", order, 1, {}, true});
  }
  result.figures.push_back(pressure_figure(bodies, contact));
  return result;
}

}  // namespace

VerifyCase hertz_sphere_case() {
  return {"hertz_sphere", "a sphere pressed on a block, against Hertz", tyre_inputs(true),
          [](const VerifyInputs& inputs, const ProgressText& progress) {
            return hertz_case(inputs, progress, true);
          }};
}

VerifyCase hertz_ellipse_case() {
  return {"hertz_ellipse", "a wheel of two radii pressed on a block, against Hertz", tyre_inputs(false),
          [](const VerifyInputs& inputs, const ProgressText& progress) {
            return hertz_case(inputs, progress, false);
          }};
}

}  // namespace tread
