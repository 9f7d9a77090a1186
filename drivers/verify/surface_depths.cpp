// Static contact of surfaces with flats, dips and dents against half-spaces with the same gap.

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "drivers/engine/model/surfaces.hpp"
#include "drivers/verify/cases.hpp"
#include "drivers/verify/tyre_on_block.hpp"
#include "kernels/half_space/half_space.hpp"

namespace tread {

namespace {

/// A depth on one of the surfaces and its place from the patch's middle.
struct SurfaceCase {
  const char* name;
  bool edged;         ///< an edge lies in the patch: the pressure there has no bound in theory
  const char* table;  ///< keys of [surface.NAME]
};

const std::vector<SurfaceCase>& shapes() {
  static const std::vector<SurfaceCase> kShapes = {
      {"round", false, ""},
      {"wheel over a dip", false, "kind = \"dip\"\ndepth = \"0.08 mm\"\nlength = \"40 mm\"\nat = \"5 mm\""},
      {"wheel's dip", false,
       "kind = \"dip\"\non = \"wheel\"\ndepth = \"0.08 mm\"\nlength = \"40 mm\"\nat = \"5 mm\""},
      {"dent", false,
       "kind = \"dent\"\ndepth = \"0.05 mm\"\nlength = \"30 mm\"\nwidth = \"24 mm\"\nat = \"3 mm\"\ncentre = "
       "\"-2 mm\""},
      {"middle of a flat", true, "kind = \"flat\"\nlength = \"16 mm\"\nat = \"0 m\""},
      {"flat, 4 mm from its edge", true, "kind = \"flat\"\nlength = \"40 mm\"\nat = \"16 mm\""},
      {"edge of a flat", true, "kind = \"flat\"\nlength = \"40 mm\"\nat = \"20 mm\""}};
  return kShapes;
}

/// Half-spaces under pressure and the pressure's middle.
struct PressedDepths {
  half_space::NormalContact contact;
  double x = 0, y = 0;  ///< [m]
};

PressedDepths reference(const TyreOnBlock& bodies, const Scene& scene) {
  constexpr int kCells = 14;  // of the smaller semi-axis
  const HertzPatch patch = bodies.hertz_patch();
  const RunningSurface rail = rail_surface(scene);
  const RunningSurface wheel = wheel_surface(scene);
  const half_space::Gap smooth = half_space::quadratic_gap(bodies.radius, bodies.crown_radius);
  const half_space::Influence influence(
      half_space::centred_grid(4 * patch.semi_axis_x, 2.5 * patch.semi_axis_y,
                               std::min(patch.semi_axis_x, patch.semi_axis_y) / kCells),
      bodies.elastic.alike());
  PressedDepths pressed{half_space::press(
      influence,
      [&](double x, double y) { return smooth(x, y) + rail.at(x, y).depth + wheel.at(x, y).depth; },
      bodies.load)};
  const half_space::Grid& grid = influence.grid;
  for (int k = 0; k < grid.size(); ++k) {
    const double share =
        pressed.contact.pressure[static_cast<std::size_t>(k)] * grid.dx * grid.dy / pressed.contact.load;
    pressed.x += share * grid.x(k % grid.nx);
    pressed.y += share * grid.y(k / grid.nx);
  }
  return pressed;
}

CaseResult surface_depths(const VerifyInputs& inputs, const ProgressText& progress) {
  constexpr double kMiddle = 0.1;  // [mm], as in profiles_in_contact
  const TyreOnBlock bodies = tyre_of(inputs, false);
  CaseResult result;
  for (const SurfaceCase& shape : shapes()) {
    TyreOnBlock shaped = bodies;
    const double a = bodies.hertz_patch().semi_axis_x;
    shaped.fine = {-5 * a, 5 * a};
    if (*shape.table) shaped.more = fmt::format("[surface.shape]\n{}\n", shape.table);
    const Scene scene = shaped.scene();
    Model model(scene);
    progress(shape.name);
    const Preload preload = solve_preload(model, {}, progress);
    const PressedDepths pressed = reference(bodies, scene);
    const half_space::NormalContact& theory = pressed.contact;
    const std::string name = shape.name;
    const auto bound = [&](double share) {
      return shape.edged ? std::nullopt : std::optional(share * bodies.fineness());
    };
    result.findings.push_back({name + ": largest pressure, nodal average", "MPa",
                               1e-6 * model.contact->nodes().max_pressure(), 1e-6 * theory.max_pressure,
                               bound(0.03)});
    result.findings.push_back(
        {name + ": patch area", "mm2", 1e6 * preload.contact.area, 1e6 * theory.area, bound(0.05)});
    result.findings.push_back(
        {name + ": F_N", "kN", -1e-3 * preload.contact.force_on_rail.z, 1e-3 * bodies.load, 1e-5});
    // A mirrored surface moves the middle of a dip or a dent by millimetres.
    const auto middle = shape.edged || bodies.grid_offset != 0 ? std::nullopt : std::optional(kMiddle);
    const Vec3& centre = preload.contact.centre;
    result.findings.push_back(
        {name + ": middle of the pressure along", "mm", 1e3 * centre.x, 1e3 * pressed.x, middle, true});
    result.findings.push_back(
        {name + ": middle of the pressure across", "mm", 1e3 * centre.y, 1e3 * pressed.y, middle, true});
  }
  return result;
}

}  // namespace

VerifyCase surface_depths_case() {
  return {"surface_depths", "flats, dips and dents on wheel and rail, against half-spaces of the same gap",
          tyre_inputs(false), surface_depths};
}

}  // namespace tread
