#include "drivers/verify/roll_tyre.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "drivers/verify/ride.hpp"

namespace tread {

namespace {

std::vector<PatchPoint> axis_nodes(const PatchNodes& patch, double axle) {
  const SurfaceGrid& grid = patch.grid();
  int axis = 0;
  double largest = 0;
  for (int station = patch.first(); station <= patch.last(); ++station)
    for (int row = 0; row < grid.rows(); ++row)
      if (patch.at(station, row).pressure > largest) {
        largest = patch.at(station, row).pressure;
        axis = row;
      }
  std::vector<PatchPoint> nodes;
  for (int station = patch.first(); station <= patch.last(); ++station) {
    const NodalContact& node = patch.at(station, axis);
    if (node.touching <= 0) continue;
    nodes.push_back({grid.x[static_cast<std::size_t>(station)] - axle, grid.y[static_cast<std::size_t>(axis)],
                     node.pressure, -node.shear.along});
  }
  return nodes;
}

}  // namespace

Rolled roll_tyre(const TyreOnBlock& bodies, double observed, const ProgressText& progress) {
  Model model(bodies.scene());
  progress(fmt::format("{} elements of {:.3g} mm", model.elements(), 1e3 * bodies.element_size));
  const Preload preload = solve_preload(model, steady_motion(model), progress);
  constexpr int kSamples = 1000;
  WholeRun run = whole_run(model, preload, kSamples);
  const Simulation& simulation = run.simulation;
  progress(fmt::format("{} steps of {:.3e} s", run.steps, simulation.dt()));
  Rolled rolled;
  run.roll([&] {
    const Sample& sample = simulation.sample();
    rolled.samples.push_back(sample);
    if (rolled.samples.size() % 100 == 0)
      progress(fmt::format("x {:.1f} mm, F_N {:.2f} kN, F_L / F_N {:.4f}, creepage {:.4f} %",
                           1e3 * sample.wheel_x, 1e-3 * sample.vertical_force, sample.traction(),
                           100 * sample.creepage_mean));
  });

  const double first = bodies.roll - observed;
  const std::vector<Sample>& s = rolled.samples;
  if (s.back().wheel_x <= first)
    throw NumericalError(
        fmt::format("verify: the wheel ends at x = {:.1f} mm, before the observed stretch from {:.1f} mm on; "
                    "raise speed",
                    1e3 * s.back().wheel_x, 1e3 * first));
  const auto over_stretch = [&](auto value) {
    return statistics(
        s, [&](const Sample& a) { return a.wheel_x >= first; }, value);
  };
  const auto mean = [&](auto value) { return over_stretch(value).mean; };
  const Statistics force = over_stretch([](const Sample& a) { return a.longitudinal_force; });
  rolled.force = force.mean;
  rolled.force_deviation = force.deviation / std::abs(force.mean);
  rolled.normal_force = mean([](const Sample& a) { return a.vertical_force; });
  rolled.creepage = mean([](const Sample& a) { return a.creepage_mean; });
  rolled.slip_fraction =
      mean([](const Sample& a) { return a.patch_area > 0 ? a.slip_area / a.patch_area : 0.0; });
  const auto start = std::find_if(s.begin(), s.end(), [&](const Sample& a) { return a.wheel_x >= first; });
  rolled.work_creepage = creepage_of_work(s, first, s.back().wheel_x, model.wheel_radius()).value_or(0);
  rolled.lead_loss = (s.back().energy.contact_loss - start->energy.contact_loss) /
                     (s.back().energy.frictional_work - start->energy.frictional_work);
  rolled.energy_residual = std::abs(s.back().energy.residual) / s.back().energy.frictional_work;

  const SurfaceFields& record = *simulation.surface();  // fetches the points, too, from a device
  const double axle = simulation.wheel().origin.x;
  for (const ContactPoint& point : model.contact->points())
    rolled.patch.push_back({point.position.x - axle, point.position.y, point.pressure, -point.shear.along});

  rolled.nodes = axis_nodes(model.contact->nodes(), axle);

  // Only nodes that the whole patch has passed count.
  const double half = 1.3 * bodies.hertz_patch().semi_axis_x;
  rolled.surface = surface_results(record, first + half, s.back().wheel_x - half);
  const auto inside = [&](const AxisNode& node) { return rolled.surface.covers(node); };
  rolled.shear = statistics(rolled.surface.axis, inside, [](const AxisNode& node) { return node.max_shear; });
  rolled.work = statistics(rolled.surface.axis, inside, [](const AxisNode& node) { return node.work; }).mean;
  return rolled;
}

double free_creepage(TyreOnBlock bodies, double speed, double way, double observed,
                     const ProgressText& progress) {
  bodies.roll_on(speed, way, observed, smooth_traction(0, way / speed));
  return roll_tyre(bodies, observed, progress).creepage;
}

Figure creepage_figure(const Rolled& rolled, double free, double reference) {
  Series ours{"mean of 28 nodes less free rolling", {}, {}, Stroke::solid};
  Series traction{"F_L / F_N", {}, {}, Stroke::solid};
  for (const Sample& sample : rolled.samples) {
    ours.x.push_back(1e3 * sample.wheel_x);
    ours.y.push_back(100 * (sample.creepage_mean - free));
    traction.x.push_back(1e3 * sample.wheel_x);
    traction.y.push_back(sample.traction());
  }
  Figure figure;
  figure.title = "Creepage on the way to steady rolling";
  figure.x_label = "Position of the wheel [mm]";
  figure.panels = {{"Creepage [%]", {ours}, {{100 * reference, "theory"}}, 240, std::nullopt},
                   {"Traction coefficient [-]", {traction}, {}, 160, std::nullopt}};
  return figure;
}

}  // namespace tread
