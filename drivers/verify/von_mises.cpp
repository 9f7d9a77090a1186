// Von Mises stress of the rail's surface elements, frictionless at rest and in rolling under traction,
// against the half-space's mean over boxes of their size. [Johnson, Contact Mechanics, sect. 3.2 and 3.6]

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "drivers/verify/cases.hpp"
#include "drivers/verify/roll_tyre.hpp"
#include "kernels/half_space/half_space_stress.hpp"

namespace tread {

namespace {

/// The half-space under the patch; an odd number of cells fits into a surface element.
struct StressedHalfSpace {
  half_space::Influence influence;
  half_space::NormalContact contact;

  StressedHalfSpace(const TyreOnBlock& bodies, double load)
      : influence(grid_of(bodies), bodies.elastic.alike()),
        contact(press(influence, half_space::quadratic_gap(bodies.radius, bodies.crown_radius), load)) {}

  static half_space::Grid grid_of(const TyreOnBlock& bodies) {
    const HertzPatch patch = bodies.hertz_patch();
    const double semi = std::min(patch.semi_axis_x, patch.semi_axis_y);
    const int per_box = std::clamp(2 * static_cast<int>(std::ceil(3 * bodies.element_size / semi)) + 1, 3, 9);
    return half_space::centred_grid(1.3 * patch.semi_axis_x, 1.3 * patch.semi_axis_y,
                                    bodies.element_size / per_box);
  }
};

/// Stress of a row of surface elements against x.
struct Row {
  std::vector<double> x;          ///< distance of the elements' middle from the patch's [m]
  std::vector<double> stress;     ///< Von Mises [Pa]
  std::vector<double> reference;  ///< Von Mises stress of the half-space's boxes [Pa]
};

/// The row of elements with the largest stress under the wheel at rest, and its element.
struct Pressed {
  Row row;
  double largest = 0, reference = 0;  ///< [Pa]
};

Pressed press_wheel(const TyreOnBlock& bodies, const ProgressText& progress) {
  Model model(bodies.scene());
  progress(fmt::format("{} elements of {:.3g} mm", model.elements(), 1e3 * bodies.element_size));
  const Preload preload = solve_preload(model, {}, progress);
  const SurfaceGrid& grid = model.contact->nodes().grid();
  SurfaceFields fields(grid);
  fields.add_stress(model.contact->nodes(), *model.internal, model.index.rail_cap,
                    {preload.displacement.data()});
  const std::span<const double> stress = fields.max_von_mises();
  const auto strongest =
      static_cast<std::size_t>(std::max_element(stress.begin(), stress.end()) - stress.begin());
  const std::size_t row = strongest % grid.quad.size();

  const StressedHalfSpace half_space(bodies, bodies.load);
  const std::vector<double> zero(static_cast<std::size_t>(half_space.influence.grid.size()), 0.0);
  const half_space::Tractions none{zero, zero};
  const half_space::SurfaceLoad load{half_space.influence.grid, half_space.contact.pressure, none,
                                     bodies.elastic.rail.poissons_ratio};
  const double across = grid.y[row + 1] - grid.y[row];
  const double y = 0.5 * (grid.y[row] + grid.y[row + 1]) - preload.contact.centre.y;
  Pressed pressed;
  for (int station = 0; station + 1 < grid.stations(); ++station) {
    const auto s = static_cast<std::size_t>(station);
    const std::size_t cell = grid.cell(station, static_cast<int>(row));
    if (stress[cell] == 0) continue;
    const double x = 0.5 * (grid.x[s] + grid.x[s + 1]) - preload.contact.centre.x;
    const half_space::Box box{x, y, 0, grid.x[s + 1] - grid.x[s], across, bodies.element_size};
    pressed.row.x.push_back(x);
    pressed.row.stress.push_back(stress[cell]);
    pressed.row.reference.push_back(half_space::von_mises(mean_rail_stress(load, box)));
    if (cell != strongest) continue;
    pressed.largest = stress[cell];
    pressed.reference = pressed.row.reference.back();
  }
  return pressed;
}

/// Largest box stress of steady rolling [Pa].
double rolling_reference(const TyreOnBlock& bodies, const Rolled& rolled) {
  const StressedHalfSpace half_space(bodies, rolled.normal_force);
  const half_space::Grid& grid = half_space.influence.grid;
  const half_space::FrictionState state =
      half_space::RollingContact(half_space.influence, half_space.contact, bodies.friction)
          .steady(rolled.force);
  const int middle = static_cast<int>(std::lround(-grid.y0 / grid.dy));
  int strongest = 0;
  const auto shear = [&](int i) {
    return std::abs(state.tractions.x[static_cast<std::size_t>(grid.index(i, middle))]);
  };
  for (int i = 1; i < grid.nx; ++i)
    if (shear(i) > shear(strongest)) strongest = i;
  // Elements stand beside the axis if nodes stand on it.
  const double h = bodies.element_size;
  const double aside = (0.5 - std::abs(bodies.grid_offset)) * h;
  return half_space::largest_box_stress(
      {grid, half_space.contact.pressure, state.tractions, bodies.elastic.rail.poissons_ratio},
      {grid.x(strongest), aside, 0, h, h, h}, 0.5 * bodies.hertz_patch().semi_axis_x);
}

CaseResult von_mises_of_elements(const VerifyInputs& inputs, const ProgressText& progress) {
  TyreOnBlock bodies = driven_tyre(inputs);
  const double mu = inputs["mu"];
  const Pressed pressed = press_wheel(bodies, progress);

  const double speed = inputs["speed"];
  const double ramp = inputs["ramp"];
  const double a = bodies.hertz_patch().semi_axis_x;
  // Rolling is steady after two semi-axes; then the patch passes the observed stretch from end to end.
  const double observed = 2.6 * a + std::max(6 * bodies.element_size, a);
  bodies.roll_on(speed, speed * ramp + 2 * a + observed, observed + 2 * a, smooth_traction(mu, ramp));
  const Rolled rolled = roll_tyre(bodies, observed, progress);
  const double rolling = rolling_reference(bodies, rolled);

  const double bound = 0.04 * std::max(1.0, bodies.fineness());
  CaseResult result;
  result.findings = {
      {"Von Mises stress at rest, no friction", "MPa", 1e-6 * pressed.largest, 1e-6 * pressed.reference,
       bound},
      {"Von Mises stress, rolling", "MPa", 1e-6 * rolled.surface.von_mises.mean, 1e-6 * rolling, bound},
      {"its standard deviation along the rail / mean",
       "-",
       rolled.surface.von_mises.deviation / rolled.surface.von_mises.mean,
       0,
       {},
       true},
      {"F_L / F_N", "-", rolled.force / rolled.normal_force, mu, 0.02}};
  Series ours{"surface elements", {}, {}, Stroke::solid};
  Series theory{"half-space, boxes", {}, {}, Stroke::dashed};
  for (std::size_t i = 0; i < pressed.row.x.size(); ++i) {
    ours.x.push_back(1e3 * pressed.row.x[i]);
    theory.x.push_back(1e3 * pressed.row.x[i]);
    ours.y.push_back(1e-6 * pressed.row.stress[i]);
    theory.y.push_back(1e-6 * pressed.row.reference[i]);
  }
  Figure at_rest;
  at_rest.title = "Von Mises stress of the surface elements, at rest without friction";
  at_rest.x_label = "x [mm]";
  at_rest.panels = {{"Von Mises stress [MPa]", {ours, theory}, {}, 240, std::nullopt}};
  Series along{"surface elements", {}, {}, Stroke::solid};
  for (const AxisNode& node : rolled.surface.axis) {
    along.x.push_back(1e3 * node.x);
    along.y.push_back(1e-6 * node.max_von_mises);
  }
  Figure passage;
  passage.title = "Largest Von Mises stress of the surface elements over the passage";
  passage.x_label = "x [mm]";
  passage.panels = {
      {"Von Mises stress [MPa]", {along}, {{1e-6 * rolling, "half-space, steady"}}, 240, std::nullopt}};
  add_dundurs(bodies, result);
  result.figures = {at_rest, passage};
  return result;
}

}  // namespace

VerifyCase von_mises_case() {
  std::vector<VerifyInput> inputs = driven_inputs(1.6e-3);
  inputs.push_back({"speed", &kSpeed, "m/s", 5, {0.5, 20}, "the rolling speed"});
  inputs.push_back({"ramp", &kTime, "ms", 1.5e-3, {1e-5, 0.1}, "the time in which the torque grows"});
  return {"von_mises", "stress of the surface elements, at rest and rolling, against the half-space",
          std::move(inputs), von_mises_of_elements};
}

}  // namespace tread
