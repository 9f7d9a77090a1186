#include "drivers/verify/tyre_on_block.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "io/scene/scene_reader.hpp"

namespace tread {

namespace {

/// The table of a wheel's own material.
std::string wheel_material(const ElasticConstants& wheel) {
  return fmt::format(
      "[material.wheel_steel]\nyoungs_modulus = \"{} Pa\"\npoissons_ratio = {}\ndensity = \"7790 kg/m3\"",
      wheel.youngs_modulus, wheel.poissons_ratio);
}

constexpr const char* kTyreOnBlock = R"([scene]
element_size = "{h} m"
gravity = "0 m/s2"
plane_strain = {slice}
[solution_zone]
start = "{start} m"
length = "{zone} m"
[material.steel]
youngs_modulus = "{E} Pa"
poissons_ratio = {nu}
density = "7790 kg/m3"
{wheel_material}
[wheel]
material = "{wheel_name}"
shape = "tyre"
{profile}
diameter = "{diameter} m"
width = "{width} m"
thickness = "{thickness} m"
lateral_offset = "{aside} m"
{bore}
[rail]
profile = "box"
support = "rigid"
inclination = 0
length = "{length} m"
origin = "{origin} m"
width = "{width} m"
height = "{height} m"
[load]
wheel_load = "{load} N"
[contact]
friction = {f}
points = {points}
surface = "{surface}"
{penetration}
)";

}  // namespace

HertzPatch TyreOnBlock::hertz_patch() const {
  const double modulus = elastic.contact_modulus();
  if (crown_radius > 0) return hertz(radius, crown_radius, modulus, load);
  const double per_width = load / element_size;
  const double a = std::sqrt(4 * per_width * radius / (std::numbers::pi * modulus));
  return {a, 0, 2 * per_width / (std::numbers::pi * a), 0};
}

double TyreOnBlock::fineness() const {
  const HertzPatch patch = hertz_patch();
  return (element_size / 1.1e-3) * (5.25e-3 / std::min(patch.semi_axis_x, patch.semi_axis_y));
}

void TyreOnBlock::roll_on(double speed, double way, double observed, const std::string& keys) {
  const double a = hertz_patch().semi_axis_x;
  roll = way;
  fine = {way - observed - 2 * a, way + 2 * a};
  more = fmt::format("[motion]\nspeed = \"{} m/s\"\nduration = \"{} s\"\n{}\n", speed, way / speed, keys);
}

Scene TyreOnBlock::scene() const {
  const HertzPatch patch = hertz_patch();
  const double a = std::max(patch.semi_axis_x, patch.semi_axis_y);
  const double ring = thickness > 0 ? thickness : std::min(12 * a, 0.6 * radius);
  const Span zone = fine.empty() ? Span{-2 * patch.semi_axis_x, 2 * patch.semi_axis_x} : fine;
  const double shift = grid_offset * element_size;
  const double end = 10 * a + 0.05 * radius;  // length of the block beyond the patch
  const double left = end + std::max(0.0, -zone.first);
  const bool slice = crown_radius == 0;
  const double width = slice ? element_size : std::min(16 * a, 1.9 * crown_radius);
  const bool one_material = elastic.wheel.youngs_modulus == elastic.rail.youngs_modulus &&
                            elastic.wheel.poissons_ratio == elastic.rail.poissons_ratio;
  const std::string text = fmt::format(
      kTyreOnBlock, fmt::arg("h", element_size), fmt::arg("start", zone.first + shift),
      fmt::arg("zone", zone.last - zone.first), fmt::arg("E", elastic.rail.youngs_modulus),
      fmt::arg("nu", elastic.rail.poissons_ratio),
      fmt::arg("wheel_name", one_material ? "steel" : "wheel_steel"),
      fmt::arg("wheel_material", one_material ? "" : wheel_material(elastic.wheel)),
      fmt::arg("diameter", 2 * radius), fmt::arg("slice", slice),
      fmt::arg("profile", slice ? std::string("profile = \"cylinder\"")
                                : fmt::format("profile = \"arc\"\ncrown_radius = \"{} m\"", crown_radius)),
      fmt::arg("bore", guided ? fmt::format("bore = \"guided\"\noverhang = \"{} m\"", 10 * a) : ""),
      fmt::arg("width", width), fmt::arg("thickness", ring), fmt::arg("height", 12 * a),
      fmt::arg("aside", slice ? 0.0 : shift), fmt::arg("length", left + std::max(roll, zone.last) + end),
      fmt::arg("origin", left), fmt::arg("load", load), fmt::arg("f", friction), fmt::arg("points", points),
      fmt::arg("surface", facets ? "facets" : "exact"),
      fmt::arg("penetration", penetration > 0 ? fmt::format("penetration_ratio = {}", penetration) : ""));
  return resolve_scene(SceneSource{"verify", text + more, {}}, overrides).scene;
}

std::vector<VerifyInput> tyre_inputs(bool sphere, double element_size) {
  std::vector<VerifyInput> inputs = {
      {"radius", &kLength, "m", 0.43, {0.05, 5}, "the radius of the rolling circle"},
      {"load", &kForce, "kN", 8926 * 9.81, {10, 1e6}, "the contact force F_N"},
      {"youngs_modulus", &kStress, "GPa", 205.9e9, {1e6, 1e13}, "Young's modulus of the block"},
      {"poissons_ratio", nullptr, "", 0.3, {0, 0.49}, "Poisson's ratio of the block"},
      {"wheel_youngs_modulus", &kStress, "GPa", 0, {0, 1e13}, "Young's modulus of the wheel; 0: the block's"},
      {"wheel_poissons_ratio",
       nullptr,
       "",
       -1,
       {-1, 0.49},
       "Poisson's ratio of the wheel; below 0: the block's"},
      {"element_size", &kLength, "mm", element_size, {1e-5, 0.02}, "the elements' size in the contact"},
      {"grid_offset", nullptr, "", 0, {-0.5, 0.5}, "the meshes' shift in elements, along and across"},
      {"points", nullptr, "", 3, {1, 4}, "contact's integration points per face and direction"},
      {"facets", nullptr, "", 0, {0, 1}, "1: contact on facets, 0: on exact profiles"},
      {"penetration", nullptr, "", 0, {0, 0.2}, "over Hertz's approach; 0: the program's own penalty"}};
  if (!sphere)
    inputs.insert(inputs.begin() + 1,
                  {"crown_radius", &kLength, "m", 0.3, {0.03, 5}, "the wheel's radius across"});
  return inputs;
}

namespace {

ElasticPair elastic_of(const VerifyInputs& inputs) {
  const ElasticConstants block{inputs["youngs_modulus"], inputs["poissons_ratio"]};
  const double modulus = inputs["wheel_youngs_modulus"];
  const double ratio = inputs["wheel_poissons_ratio"];
  return {{modulus > 0 ? modulus : block.youngs_modulus, ratio >= 0 ? ratio : block.poissons_ratio}, block};
}

}  // namespace

TyreOnBlock tyre_of(const VerifyInputs& inputs, bool sphere) {
  TyreOnBlock bodies;
  bodies.radius = inputs["radius"];
  bodies.crown_radius = sphere ? bodies.radius : inputs["crown_radius"];
  bodies.load = inputs["load"];
  bodies.elastic = elastic_of(inputs);
  bodies.element_size = inputs["element_size"];
  bodies.grid_offset = inputs["grid_offset"];
  bodies.points = static_cast<int>(std::lround(inputs["points"]));
  bodies.facets = inputs["facets"] >= 0.5;
  bodies.penetration = inputs["penetration"];
  const HertzPatch patch = bodies.hertz_patch();
  const double smallest = std::min(patch.semi_axis_x, patch.semi_axis_y);
  const double largest = std::max(patch.semi_axis_x, patch.semi_axis_y);
  if (largest > 0.12 * std::min(bodies.radius, bodies.crown_radius))
    throw InputError(fmt::format(
        "verify: the patch's semi-axis of {:.3g} mm is not small against the radii of {:.3g} and {:.3g} mm; "
        "Hertz's theory does not hold; lower load",
        1e3 * largest, 1e3 * bodies.radius, 1e3 * bodies.crown_radius));
  if (bodies.element_size > 0.7 * smallest || bodies.element_size < smallest / 40)
    throw InputError(fmt::format(
        "verify: element_size = {:.3g} mm does not suit the patch's semi-axis of {:.3g} mm; state "
        "{:.3g} to {:.3g} mm",
        1e3 * bodies.element_size, 1e3 * smallest, 1e3 * smallest / 40, 0.7e3 * smallest));
  return bodies;
}

std::vector<VerifyInput> driven_inputs(double element_size) {
  std::vector<VerifyInput> inputs = tyre_inputs(false, element_size);
  inputs.push_back({"friction", nullptr, "", 0.5, {0.01, 2}, "the coefficient of friction f"});
  inputs.push_back({"mu", nullptr, "", 0.3, {-1.9, 1.9}, "the traction coefficient F_L / F_N"});
  return inputs;
}

TyreOnBlock driven_tyre(const VerifyInputs& inputs) {
  TyreOnBlock bodies = tyre_of(inputs, false);
  bodies.friction = inputs["friction"];
  bodies.guided = true;  // light and rigid: motions excited by the torque decay fast
  const double mu = inputs["mu"];
  if (std::abs(mu) > 0.95 * bodies.friction || mu == 0)
    throw InputError(
        fmt::format("verify: mu = {:g} is zero or not below 0.95 of friction = {:g}", mu, bodies.friction));
  return bodies;
}

std::string smooth_traction(double mu, double ramp) {
  return fmt::format("traction = {{ mu = {}, ramp = \"{} s\", shape = \"smooth\" }}", mu, ramp);
}

void add_dundurs(const TyreOnBlock& bodies, CaseResult& result) {
  const double constant = bodies.elastic.dundurs_constant();
  if (constant == 0) return;
  result.findings.push_back(
      {"Dundurs' constant of the bodies, zero in the reference", "-", constant, 0, {}, true});
}

TyreOnBlock slice_of(const VerifyInputs& inputs, const SliceLimits& limits) {
  TyreOnBlock bodies;
  bodies.radius = inputs["radius"];
  bodies.crown_radius = 0;
  const ElasticConstants both{inputs["youngs_modulus"], inputs["poissons_ratio"]};
  bodies.elastic = {both, both};
  bodies.element_size = inputs["element_size"];
  bodies.friction = inputs["friction"];
  const double a = inputs["semi_axis"];
  const double modulus = bodies.elastic.contact_modulus();
  bodies.load = line_load(bodies.radius, modulus, a) * bodies.element_size;
  if (a > limits.semi_axis * bodies.radius || bodies.element_size > limits.element_size * a)
    throw InputError(fmt::format(
        "verify: semi_axis = {:.3g} mm must be at most {:g} of the radius of {:.3g} mm, and element_size = "
        "{:.3g} mm at most {:g} of semi_axis",
        1e3 * a, limits.semi_axis, 1e3 * bodies.radius, 1e3 * bodies.element_size, limits.element_size));
  return bodies;
}

Vec3 displacement_at(const Model& model, int index, double p, double q, double s, ConstNodeField u) {
  const SweptBlock& block = model.mesh.blocks[static_cast<std::size_t>(index)];
  const auto cell = StationFinder(block).find(s);
  constexpr double kEdge = 0.5e-9;
  const int quads = cell.station < 0 ? 0 : static_cast<int>(block.section.quads.size());
  for (int i = 0; i < quads; ++i) {
    const std::optional<QuadPlace> place = place_in_quad(block.section, i, p, q);
    if (!place || place->excess() > kEdge) continue;
    const std::array<int, 4>& quad = block.section.quads[static_cast<std::size_t>(i)];
    const std::array<double, 4> weight = place->weights();
    const double along = cell.distance / cell.pitch;
    Vec3 sum;
    for (std::size_t k = 0; k < 4; ++k)
      for (const int station : {cell.station, cell.next}) {
        const std::int64_t slot = block.base + block.slot(quad[k], station);
        const double share = weight[k] * (station == cell.station ? 1 - along : along);
        sum += share * to_cartesian(block, station, 0, u.at(slot));
      }
    return sum;
  }
  throw InputError(fmt::format("no element of block '{}' holds the point ({:.4g}, {:.4g}) m at {:.4g}",
                               block.name, p, q, s));
}

}  // namespace tread
