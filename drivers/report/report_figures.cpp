#include "drivers/report/report_figures.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "drivers/engine/model/station_plan.hpp"
#include "drivers/report/figure_parts.hpp"

namespace tread {

namespace {

using Value = std::function<double(const Sample&)>;

Series curve(std::string label, const Model& model, const RunResults& r, const Value& value,
             Stroke stroke = Stroke::solid) {
  Series series{std::move(label), abscissae_of(model, r), {}, stroke};
  for (const Sample& sample : r.samples) series.y.push_back(value(sample));
  return series;
}

Layer merged(std::string label, std::vector<Layer> layers) {
  Layer all{std::move(label), {}, {}};
  for (Layer& layer : layers) {
    std::move(layer.cells.begin(), layer.cells.end(), std::back_inserter(all.cells));
    std::move(layer.lines.begin(), layer.lines.end(), std::back_inserter(all.lines));
  }
  return all;
}

/// One layer per group of blocks that exist; `view` draws a block with its wheel `height` above the crown.
template <class View>
std::vector<Layer> layers_of(const Model& model, const View& view) {
  const BlockIndex& index = model.index;
  const char* below = index.slab < 0 ? "rail" : index.rail_base < 0 ? "slab" : "slab and rail";
  const std::vector<std::pair<const char*, std::vector<int>>> groups = {
      {"sleepers", index.sleepers},
      {below, {index.slab, index.rail_base}},
      {index.rail_base >= 0 || index.base_body >= 0 ? "rail head" : "rail", {index.rail_cap}},
      {index.disc >= 0 ? "disc and axle" : "axle", {index.axle, index.disc}},
      {index.axle >= 0 ? "tread" : "tyre", {index.tread}}};
  std::vector<Layer> layers;
  for (const auto& [label, blocks] : groups) {
    std::vector<Layer> parts;
    for (const int b : blocks)
      if (b >= 0) parts.push_back(view(model.mesh.blocks[static_cast<std::size_t>(b)]));
    if (!parts.empty()) layers.push_back(merged(label, std::move(parts)));
  }
  return layers;
}

double axis_height(const Model& model) {
  return model.contact ? model.contact->touching_height() : 0;
}

/// End of the drawings' titles.
const char* without_bodies(const Model& model) {
  return model.mesh.bodies.empty() ? "" : ", without bodies from files";
}

double signed_friction_of(const Model& model, const RunResults& r) {
  return signed_friction(model.scene.contact->largest_friction(), r.longitudinal_force.mean,
                         model.wheel_load());
}

}  // namespace

Figure force_figure(const Model& model, const RunResults& r) {
  const Scene& scene = model.scene;
  const Corrugation& corrugation = model.contact->corrugation();
  const double f = signed_friction_of(model, r);
  const std::string limit = f < 0 ? "−f F_N" : "f F_N";
  Figure figure = over_the_rail(
      "forces",
      corrugation.smooth() ? "Contact forces over the solution zone" : "Contact forces over the corrugation",
      scene, corrugation, stretch_in_sight(model, whole_way(model, r)));
  figure.panels.push_back(
      panel("Force [kN]",
            {curve(limit, model, r, [f](const Sample& s) { return 1e-3 * f * s.vertical_force; }),
             curve("F_L", model, r, [](const Sample& s) { return 1e-3 * s.longitudinal_force; })},
            {{1e-3 * f * model.wheel_load(), "static " + limit}}, 300));
  const double patch_y = r.preload.contact.centre.y;
  add_surface_panel(shown_surfaces(model, patch_y), 90, figure);
  figure.caption += fmt::format("Where F_L meets {} the whole patch slides. f = {:g}", limit, std::abs(f));
  figure.caption += scene.contact->friction_law == "coulomb" ? "." : ", the largest coefficient of friction.";
  return figure;
}

Figure passage_figure(const Model& model, const RunResults& r) {
  const double f = signed_friction_of(model, r);
  Figure figure = over_the_way("passage", "Forces over the whole way", model, r);
  figure.panels.push_back(
      panel("F_N [kN]", {curve("F_N", model, r, [](const Sample& s) { return 1e-3 * s.vertical_force; })},
            {{1e-3 * model.wheel_load(), "static"}}, 200));
  figure.panels.push_back(panel("F_L / F_N",
                                {curve("F_L / F_N", model, r, [](const Sample& s) { return s.traction(); })},
                                {{f, f < 0 ? "−f" : "f"}}, 150));
  figure.panels.push_back(panel("Lateral [kN]",
                                {curve("lateral force on the wheel, to the field side", model, r,
                                       [](const Sample& s) { return 1e-3 * s.lateral_force; })},
                                {}, 110));
  if (!model.torque.empty())
    figure.panels.push_back(panel(
        "Torque [kN m]",
        {curve("torque on the axle", model, r, [](const Sample& s) { return 1e-3 * s.torque; })}, {}, 90));
  return figure;
}

Figure creepage_figure(const Model& model, const RunResults& r, const std::vector<Marker>& levels) {
  Figure figure = over_the_way("creepage", "Longitudinal creepage", model, r);
  const char* mean = model.guide ? "of the bore's carrier" : "mean of 28 nodes around the tread";
  figure.panels.push_back(
      panel("Creepage [%]",
            {curve("at the node that starts in the patch", model, r,
                   [](const Sample& s) { return 100 * s.creepage_node; }),
             curve(mean, model, r, [](const Sample& s) { return 100 * s.creepage_mean; })},
            levels, 280));
  figure.panels.push_back(
      panel("Lateral [%]",
            {curve("lateral creepage", model, r, [](const Sample& s) { return 100 * s.lateral_creepage; })},
            {}, 90));
  figure.panels.push_back(
      panel("Spin [1/m]", {curve("spin creepage", model, r, [](const Sample& s) { return s.spin_creepage; })},
            {}, 90));
  figure.caption +=
      fmt::format("The single node vibrates when it enters the patch and once a turn again; {}.",
                  model.guide ? "the carrier is rigid" : "the mean filters that out");
  return figure;
}

Figure patch_figure(const Model& model, const RunResults& r) {
  Figure figure = over_the_way("patch", "Contact patch", model, r);
  figure.panels.push_back(
      panel("Area [mm²]",
            {curve("in contact", model, r, [](const Sample& s) { return 1e6 * s.patch_area; }),
             curve("slipping", model, r, [](const Sample& s) { return 1e6 * s.slip_area; })},
            {}, 170));
  figure.panels.push_back(panel(
      "Stress [MPa]",
      {curve("largest pressure", model, r, [](const Sample& s) { return 1e-6 * s.max_pressure; }),
       curve("largest surface shear stress", model, r, [](const Sample& s) { return 1e-6 * s.max_shear; })},
      {}, 170));
  figure.panels.push_back(
      panel("Penetration [µm]",
            {curve("largest penetration", model, r, [](const Sample& s) { return 1e6 * s.max_penetration; })},
            {}, 90));
  figure.caption += "Stresses are averages at the rail's surface nodes. ";
  return figure;
}

Figure energy_figure(const Model& model, const RunResults& r) {
  Figure figure = over_the_way("energy", "Energy by kind, change since the start", model, r);
  const EnergyLedger& start = r.samples.front().energy;
  // The torque's work and what it makes of the speed dwarf everything else: a panel of their own.
  std::vector<Series> large;
  std::vector<Series> small;
  const bool turned = model.guide || !model.torque.empty();
  for (const EnergyKind& kind : kEnergyKinds) {
    const Stroke stroke = kind.role == EnergyRole::stored ? Stroke::solid : Stroke::dashed;
    Series change = curve(
        kind.title, model, r, [&](const Sample& s) { return s.energy.*kind.member - start.*kind.member; },
        stroke);
    if (std::ranges::all_of(change.y, [](double joule) { return joule == 0; })) continue;
    const bool driven = kind.member == &EnergyLedger::kinetic || kind.role == EnergyRole::supplied;
    (turned && driven ? large : small).push_back(std::move(change));
  }
  if (!large.empty()) figure.panels.push_back(panel("Energy [J]", std::move(large), {}, 150));
  if (!small.empty()) figure.panels.push_back(panel("Energy [J]", std::move(small), {}, 200));
  figure.panels.push_back(
      panel("Residual [J]", {curve("residual", model, r, [](const Sample& s) { return s.energy.residual; })},
            {}, 110));
  figure.caption +=
      "Energies that do not change are left out. Residual: the sum of all, works of torque, guide and hammer "
      "taken off.";
  return figure;
}

Drawings section_drawings(const Model& model) {
  const double height = axis_height(model);
  const std::vector<Layer> layers = layers_of(model, [&](const SweptBlock& block) {
    const double up = block.sweep == Sweep::revolved ? height : 0;
    return section_layer(block.name, block.section, block.sweep, {0, up});
  });
  const char* missing = without_bodies(model);
  Drawings sections{"mesh-sections", {}};
  std::vector<Drawing>& drawings = sections.drawings;
  if (!model.contact) {
    drawings.push_back({std::string("Cross-section") + missing, layers, std::nullopt, 300});
    return sections;
  }
  drawings.push_back({std::string("Cross-section under the wheel") + missing, layers, std::nullopt,
                      model.index.axle >= 0 ? 920.0 : 440.0});
  if (model.index.axle >= 0)
    drawings.push_back(
        {std::string("Rail and wheel rim") + missing, layers, Window{{-0.1, -0.19}, {0.1, 0.07}}, 360});
  drawings.push_back({"Around the patch", layers, Window{{-0.032, -0.022}, {0.032, 0.022}},
                      model.index.axle >= 0 ? 520.0 : 440.0});
  return sections;
}

Drawings side_drawings(const Model& model) {
  const double height = axis_height(model);
  const double start = model.scene.start_x();
  const std::vector<Layer> layers = layers_of(model, [&](const SweptBlock& block) {
    if (block.sweep == Sweep::extruded) return side_layer(block.name, block);
    SweptBlock without_flange = block;  // the flange would hide where wheel and rail meet
    if (model.contact)
      for (double& radius : without_flange.section.q) radius = std::min(radius, height);
    return side_layer(block.name, without_flange, {start, 0, height});
  });
  const char* missing = without_bodies(model);
  if (!model.contact) return {"mesh-side", {{std::string("Side view") + missing, layers, std::nullopt, 920}}};
  std::vector<Layer> track = layers;
  std::erase_if(track, [](const Layer& layer) {
    return layer.label == "tread" || layer.label == "tyre" || layer.label.ends_with("axle");
  });
  const double zone = zone_span(model.scene).first;
  return {"mesh-side",
          {{fmt::format("Side view of the stations, x = {:g} to {:g} m{}", start - 0.5, start + 0.5, missing),
            layers, Window{{start - 0.5, -0.3}, {start + 0.5, 0.5}}, 440},
           {std::string("The rail where the solution zone begins") + missing, track,
            Window{{zone - 0.2, -0.18}, {zone + 0.2, 0.01}}, 440}}};
}

}  // namespace tread
