#include "drivers/studies/paper/paper_figures.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <utility>

#include "drivers/results/surface_results.hpp"

namespace tread {

namespace {

constexpr std::array<double, 6> kSpeeds = {100, 180, 250, 300, 400, 500};  // [km/h]
constexpr std::array<double, 6> kMus = {0, 0.1, 0.2, 0.3, 0.4, 0.5};
constexpr std::array<double, 3> kWavelengths = {65, 80, 95};         // [mm]
constexpr std::array<double, 4> kDepths = {0.04, 0.08, 0.14, 0.18};  // [mm]

/// Copies of `base` with `member` set to each value.
template <class Values>
std::vector<Passage> varied(const Passage& base, double Passage::*member, const Values& values) {
  std::vector<Passage> passages;
  for (const double value : values) {
    passages.push_back(base);
    passages.back().*member = value;
  }
  return passages;
}

std::function<std::string(const Passage&)> labelled(double Passage::*member, const char* format) {
  return [member, format](const Passage& p) { return fmt::format(fmt::runtime(format), p.*member); };
}

std::function<double(const Passage&)> value_of(double Passage::*member) {
  return [member](const Passage& p) { return p.*member; };
}

CurvePanel history(std::string y_label, const char* column, const char* unit, double scale,
                   std::string prefix) {
  return {std::move(y_label), {.y = {column, unit}, .y_scale = scale}, std::move(prefix)};
}

CurvePanel vertical() {
  return history("F_N [kN]", "vertical_force", "N", 1e-3, "F_N, ");
}
CurvePanel longitudinal() {
  return history("F_L [kN]", "longitudinal_force", "N", 1e-3, "F_L, ");
}
CurvePanel longitudinal_with_limit() {
  CurvePanel panel = longitudinal();
  panel.y_label = "Force [kN]";
  panel.limit = true;
  return panel;
}
CurvePanel creepage() {
  return history("Creepage [%]", "creepage_mean", "-", 100, "mean of 28 nodes, ");
}

std::vector<CurvePanel> surface_displacement() {
  const auto state = [](const char* column, std::string prefix) {
    const RunCurve curve{
        .file = "deflection.csv", .x = {"x_from_wheel", "m"}, .y = {column, "m"}, .y_scale = 1e3};
    return CurvePanel{"Upwards [mm]", curve, std::move(prefix)};
  };
  return {state("static", "static, "), state("rolling", "rolling, ")};
}

std::vector<CurvePanel> along_the_axis() {
  const auto axis = [](std::string y_label, const char* column, const char* unit, double scale,
                       std::string prefix) {
    const RunCurve curve{.file = "surface_axis.csv", .x = {"x", "m"}, .y = {column, unit}, .y_scale = scale};
    return CurvePanel{std::move(y_label), curve, std::move(prefix), 140};
  };
  return {axis("Pressure [MPa]", "max_pressure", "Pa", 1e-6, "largest pressure, "),
          axis("Shear [MPa]", "max_shear", "Pa", 1e-6, "largest surface shear stress, "),
          axis("Von Mises [MPa]", "max_von_mises", "Pa", 1e-6, "largest Von Mises stress, "),
          axis("Work [mJ]", "frictional_work_in_1.1_mm_cell", "J", 1e3, "frictional work, ")};
}

std::vector<TrendPanel> forces_of() {
  const std::vector<TrendPanel> all = fluctuation_panels();
  return {all.begin(), all.begin() + 2};
}
/// Panels of Von Mises stress and frictional work.
std::vector<TrendPanel> responses() {
  const std::vector<TrendPanel> all = fluctuation_panels();
  return {all.begin() + 2, all.end()};
}

std::vector<TrendPanel> stresses_and_work() {
  std::vector<TrendPanel> panels = {
      {"Shear [MPa]", {{"largest surface shear stress, mean of the samples", "max_shear_Pa"}}, 1e-6}};
  for (TrendPanel& panel : responses()) panels.push_back(std::move(panel));
  return panels;
}

SurfaceView largest_pressure() {
  return {"max_pressure", "Largest pressure", "[MPa]", 1e-6};
}

std::vector<SurfaceView> surface_views() {
  return {largest_pressure(),
          {"max_shear", "Largest surface shear stress", "[MPa]", 1e-6},
          {"max_von_mises", "Largest Von Mises stress", "[MPa]", 1e-6},
          {"frictional_work", "Frictional work in a cell of 1.1 mm x 1.1 mm", "[mJ]", 1e3 * kWorkCell}};
}

/// The waves of Figs. 14 and 20 to 22.
std::vector<Passage> wave_passages() {
  return varied(corrugated(), &Passage::wavelength, kWavelengths);
}

std::vector<PaperFigure> smooth_figures() {
  const Passage smooth = smooth_rail();
  const auto by_speed = labelled(&Passage::speed, "{:g} km/h");
  const auto by_mu = labelled(&Passage::mu, "mu {:g}");
  const auto by_ramp = labelled(&Passage::ramp, "T1 = {:g} ms");
  const std::string way = "Position of the wheel [m]";
  return {
      {.id = "07",
       .title = "Vertical displacement of the rail's surface about the wheel, smooth rail, 300 km/h",
       .section = "3.1",
       .passages = {smooth},
       .label = by_speed,
       .curves = {"", "From the wheel, ahead positive [m]", surface_displacement(), true, false},
       .one_panel = true},
      {"08",
       "Vertical force at different speeds, smooth rail",
       "3.1",
       varied(smooth, &Passage::speed, kSpeeds),
       by_speed,
       {"", way, {vertical()}, true}},
      {"09",
       "Forces for different T1, smooth rail, mu 0.3, 300 km/h",
       "3.2",
       varied(smooth, &Passage::ramp, std::array{0.1, 5.0, 10.0}),
       by_ramp,
       {"", "Time [ms]", {over_time(longitudinal_with_limit())}, true}},
      {"10",
       "Longitudinal force at different speeds, smooth rail, mu 0.3",
       "3.2",
       varied(smooth, &Passage::speed, kSpeeds),
       by_speed,
       {"", way, {longitudinal()}, true}},
      {"11",
       "Forces at different traction coefficients, smooth rail, 300 km/h",
       "3.2",
       varied(smooth, &Passage::mu, kMus),
       by_mu,
       {"", way, {vertical(), longitudinal()}, true}},
      {"12",
       "Largest stresses and frictional work along the axis, smooth rail, mu 0.3, 300 km/h",
       "3.3",
       {smooth},
       by_speed,
       {"", "Position on the rail [m]", along_the_axis()}},
      {.id = "12b",
       .title = "Largest stresses and frictional work along and across, smooth rail, mu 0.3, 300 km/h",
       .section = "3.3",
       .passages = {smooth},
       .surface = surface_views()},
      {.id = "13",
       .title = "Stresses and frictional work against mu, smooth rail, 300 km/h",
       .section = "3.3",
       .passages = varied(smooth, &Passage::mu, kMus),
       .label = by_mu,
       .x_label = "mu",
       .x = value_of(&Passage::mu),
       .trends = stresses_and_work()},
  };
}

std::vector<PaperFigure> corrugation_d_figures() {
  const Passage d = corrugated();
  const auto name = [](const Passage&) { return std::string("corrugation D"); };
  const std::string way = "Position of the wheel [m]";
  return {
      {.id = "14",
       .title = "Roughness levels of waves 0.14 mm deep, 65, 80 and 95 mm long",
       .section = "4.1",
       .waves = wave_passages()},
      {"15",
       "Forces over corrugation D, mu 0.3, 300 km/h",
       "4.2",
       {d},
       name,
       {"", way, {longitudinal_with_limit(), vertical()}}},
      {.id = "16",
       .title = "The patch's longitudinal axis at ten instants, corrugation D, mu 0.3, 300 km/h",
       .section = "4.2",
       .passages = {d},
       .instants = true},
      {.id = "17a",
       .title = "Largest pressure, corrugation D, mu 0.3, 300 km/h",
       .section = "4.2",
       .passages = {d},
       .surface = {largest_pressure()}},
      {.id = "17b",
       .title = "Largest pressure, smooth rail, mu 0.3, 300 km/h",
       .section = "4.2",
       .passages = {smooth_rail()},
       .surface = {largest_pressure()}},
      {"18",
       "Creepage over corrugation D, mu 0.3, 300 km/h",
       "4.2",
       {d},
       name,
       {"", way, {history("Creepage [%]", "creepage_node", "-", 100, "at N_cr, "), creepage()}}},
      {"19",
       "Largest stresses and frictional work along the axis, corrugation D, mu 0.3, 300 km/h",
       "4.2",
       {d},
       name,
       {"", "Position on the rail [m]", along_the_axis()}},
      {.id = "19b",
       .title = "Largest stresses and frictional work along and across, corrugation D, mu 0.3, 300 km/h",
       .section = "4.2",
       .passages = {d},
       .surface = surface_views()},
  };
}

std::vector<PaperFigure> geometry_figures() {
  const Passage d = corrugated();
  const std::vector<Passage> waves = wave_passages();
  const auto by_wave = labelled(&Passage::wavelength, "{:g} mm");
  const auto by_depth = labelled(&Passage::depth, "{:g} mm");
  const std::string way = "Position of the wheel [m]";
  std::vector<TrendPanel> all = forces_of();
  for (TrendPanel& panel : responses()) all.push_back(std::move(panel));
  return {
      {"20",
       "Forces for different wavelengths, depth 0.14 mm, mu 0.3, 300 km/h",
       "4.3",
       waves,
       by_wave,
       {"", way, {vertical(), longitudinal()}}},
      {.id = "21",
       .title = "Von Mises stress and frictional work against the wavelength",
       .section = "4.3",
       .passages = waves,
       .label = by_wave,
       .x_label = "Wavelength [mm]",
       .x = value_of(&Passage::wavelength),
       .trends = responses()},
      {"22", "Creepage for different wavelengths", "4.3", waves, by_wave, {"", way, {creepage()}}},
      {.id = "23",
       .title = "Forces, Von Mises stress and frictional work against the depth, 80 mm",
       .section = "4.3",
       .passages = varied(d, &Passage::depth, kDepths),
       .label = by_depth,
       .x_label = "Depth [mm]",
       .x = value_of(&Passage::depth),
       .trends = all},
  };
}

std::vector<PaperFigure> operation_figures() {
  const Passage d = corrugated();
  const std::vector<Passage> mus = varied(d, &Passage::mu, kMus);
  const std::vector<Passage> speeds = varied(d, &Passage::speed, kSpeeds);
  const auto by_mu = labelled(&Passage::mu, "mu {:g}");
  const auto by_speed = labelled(&Passage::speed, "{:g} km/h");
  const std::string way = "Position of the wheel [m]";
  Passage worst = corrugated(80, 0.18);
  worst.speed = 500;
  return {
      {"24",
       "Forces at different traction coefficients over corrugation D, 300 km/h",
       "4.4",
       mus,
       by_mu,
       {"", way, {vertical(), longitudinal()}}},
      {"24b",
       "Braking beside traction over corrugation D, 300 km/h",
       "5",
       varied(d, &Passage::mu, std::array{0.3, -0.3}),
       by_mu,
       {"", way, {longitudinal(), creepage()}}},
      {.id = "25",
       .title = "Von Mises stress and frictional work against mu, corrugation D, 300 km/h",
       .section = "4.4",
       .passages = mus,
       .label = by_mu,
       .x_label = "mu",
       .x = value_of(&Passage::mu),
       .trends = responses()},
      {"26",
       "Forces at different speeds over corrugation D, mu 0.3",
       "4.5",
       speeds,
       by_speed,
       {"", way, {vertical(), longitudinal()}}},
      {.id = "27",
       .title = "Von Mises stress and frictional work against the speed, corrugation D",
       .section = "4.5",
       .passages = speeds,
       .label = by_speed,
       .x_label = "Speed [km/h]",
       .x = value_of(&Passage::speed),
       .trends = responses()},
      {.id = "28",
       .title = "Vertical force beside the multi-body approach, 500 km/h, 80 mm, 0.18 mm",
       .section = "4.6",
       .passages = {worst},
       .label = [](const Passage&) { return std::string("transient"); },
       .curves = {"", way, {vertical()}},
       .multibody = true},
  };
}

}  // namespace

const std::vector<PaperFigure>& paper_figures() {
  static const std::vector<PaperFigure> figures = [] {
    std::vector<PaperFigure> all = smooth_figures();
    for (const auto& more : {corrugation_d_figures(), geometry_figures(), operation_figures()})
      all.insert(all.end(), more.begin(), more.end());
    return all;
  }();
  return figures;
}

std::string shown_id(const std::string& id) {
  return id.substr(std::min(id.find_first_not_of('0'), id.size()));
}

}  // namespace tread
