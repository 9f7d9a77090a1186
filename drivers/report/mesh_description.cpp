#include "drivers/report/mesh_description.hpp"

#include <fmt/core.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "core/parallel/parallel.hpp"
#include "drivers/engine/start/step_limit.hpp"
#include "drivers/process/machine.hpp"
#include "drivers/report/mesh_measures.hpp"
#include "drivers/results/frame_files.hpp"
#include "drivers/results/root_attributes.hpp"
#include "drivers/results/scene_model.hpp"
#include "io/files/output_file.hpp"
#include "io/report/markup.hpp"
#include "io/report/plain_text.hpp"
#include "io/text/json.hpp"
#include "io/vtk/vtkhdf.hpp"

namespace tread {

namespace {

/// A body beside what it should weigh.
struct BodyMass {
  std::string name;
  double mass = 0;     ///< of the mesh [kg]
  double nominal = 0;  ///< that the scene asks for, or of the section swept without facets [kg]
  std::string remark;
};

BodyMass sum_of(const std::string& name, const std::vector<int>& indices,
                const std::vector<BlockMeasures>& blocks) {
  BodyMass body{name, 0, 0, ""};
  for (const int b : indices) {
    body.mass += blocks[static_cast<std::size_t>(b)].mass;
    body.nominal += blocks[static_cast<std::size_t>(b)].swept_mass;
  }
  return body;
}

std::vector<BodyMass> bodies_of(const Model& model, const std::vector<BlockMeasures>& blocks) {
  std::vector<BodyMass> bodies;
  if (model.wheelset) {
    BodyMass wheel = sum_of(model.index.axle >= 0 ? "half wheelset" : "tyre", model.wheel_parts(), blocks);
    if (model.index.disc_body >= 0) {
      wheel.remark = fmt::format(
          "with the disc of {}",
          std::filesystem::path(model.scene.body_replacing("disc")->second.file).filename().string());
    } else if (model.index.axle >= 0) {
      wheel.nominal = model.scene.wheel->mass;
      wheel.remark = fmt::format("with a web of {:.2f} mm{}", 1e3 * model.web_thickness,
                                 model.scene.wheel->web == "stated" ? "" : " where it is thinnest");
      if (model.brake_ring_thickness > 0)
        wheel.remark += fmt::format(" and two brake rings of {:.2f} mm", 1e3 * model.brake_ring_thickness);
    }
    bodies.push_back(wheel);
  }
  if (model.scene.rail) {
    BodyMass rail = sum_of("rail", model.rail_parts(), blocks);
    double volume = 0;
    for (const int part : model.rail_parts()) {
      const HexBody* body = model.mesh.body_of(part);
      const auto b = static_cast<std::size_t>(part);
      const Material& material = body ? body->materials.front() : model.mesh.blocks[b].materials.front();
      volume += blocks[b].mass / material.density;
    }
    rail.remark = fmt::format("{:.3f} kg/m, {:.2f} cm2", rail.mass / model.scene.rail->length,
                              1e4 * volume / model.scene.rail->length);
    bodies.push_back(rail);
  }
  if (model.index.slab >= 0) {
    BodyMass slab = sum_of("slab, gaps and mortar", {model.index.slab}, blocks);
    slab.remark = fmt::format("{:.1f} kg/m of half track", slab.mass / model.scene.rail->length);
    bodies.push_back(slab);
  }
  if (!model.index.sleepers.empty()) {
    BodyMass sleepers = sum_of("half sleepers", model.index.sleepers, blocks);
    sleepers.remark =
        fmt::format("{:.1f} kg each", sleepers.mass / static_cast<double>(model.index.sleepers.size()));
    bodies.push_back(sleepers);
  }
  return bodies;
}

Table mass_table(const std::vector<BodyMass>& bodies) {
  Table table{"Masses",
              {{"Body"},
               {"Mass [kg]", Align::right},
               {"Nominal [kg]", Align::right},
               {"Difference", Align::right},
               {"Remark"}},
              {}};
  for (const BodyMass& body : bodies)
    table.rows.push_back({body.name, fmt::format("{:.2f}", body.mass), fmt::format("{:.2f}", body.nominal),
                          fmt::format("{:+.3f} %", 100 * (body.mass / body.nominal - 1)), body.remark});
  return table;
}

/// Surfaces to which a body from a file may be tied in place of the block below.
Table tied_surface_table(const Model& model) {
  Table table{"Tied surfaces", {{"Block"}, {"Surface"}}, {}};
  const auto add = [&](int block, const char* path) {
    const SweptBlock& of = model.mesh.blocks[static_cast<std::size_t>(block)];
    table.rows.push_back({of.name, surface_extents(of, path)});
  };
  const bool base = model.index.rail_base >= 0 || model.index.base_body >= 0;
  if (base) add(model.index.rail_cap, "tie");
  if (model.index.axle >= 0)
    for (const int block : {model.index.tread, model.index.axle}) add(block, "tie");
  return table;
}

Table inertia_table(const SpinningBody& wheelset) {
  return {"Wheelset",
          {{"Quantity"}, {"Value", Align::right}, {"Unit"}},
          {{"inertia about the axle", readable(wheelset.inertia(), 5), "kg m2"},
           {"inertia about a diameter through the mass centre", readable(wheelset.transverse_inertia(), 5),
            "kg m2"},
           {"mass centre from the rail's centre line", readable(1e3 * wheelset.centre_y(), 5), "mm"}}};
}

/// The stable step of each block alone beside the shortest.
Table step_table(const StepLimit& limit) {
  Table table{"",
              {{"Block"},
               {"Stiffest element at (x, y, z) [m]"},
               {"Stable step of it alone [s]", Align::right},
               {"Over the shortest", Align::right}},
              {}};
  const double shortest = limit.stiffest[limit.stiffest_block()].step;
  for (const StiffestElement& element : limit.stiffest)
    table.rows.push_back({element.name, place(element.at), fmt::format("{:.3e}", element.step),
                          fmt::format("{:.2f}", element.step / shortest)});
  return table;
}

void write_mesh(const Model& model, const std::filesystem::path& directory) {
  make_directory(directory);
  write_vtk_mesh(directory / "mesh.hdf", model.mesh, make_vtk_grid(model.mesh, VtkCells::elements),
                 resting_places(model), root_attributes(model.scene));
}

Json extreme_json(const Extreme& extreme) {
  return {{"value", extreme.value}, {"at_m", {extreme.at.x, extreme.at.y, extreme.at.z}}};
}

std::string mesh_json(const Model& model, const std::vector<BlockMeasures>& blocks, const StepLimit& limit) {
  Json json = {{"elements", model.elements()}, {"nodes", model.nodes()}};
  json["blocks"] = Json::array();
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    const BlockMeasures& b = blocks[i];
    json["blocks"].push_back({{"name", b.name},
                              {"elements", b.elements},
                              {"nodes", b.nodes},
                              {"quads", b.quads},
                              {"stations", b.stations},
                              {"shortest_edge_m", extreme_json(b.shortest_edge)},
                              {"longest_edge_m", extreme_json(b.longest_edge)},
                              {"worst_quality", extreme_json(b.worst_quality)},
                              {"mass_kg", b.mass},
                              {"swept_mass_kg", b.swept_mass},
                              {"stiffest_element_step_s", limit.stiffest[i].step}});
  }
  json["bodies"] = Json::array();
  for (const BodyMass& body : bodies_of(model, blocks))
    json["bodies"].push_back({{"name", body.name}, {"mass_kg", body.mass}, {"nominal_kg", body.nominal}});
  if (model.wheelset) {
    Json& wheelset = json["wheelset"];
    wheelset["polar_inertia_kg_m2"] = model.wheelset->inertia();
    wheelset["transverse_inertia_kg_m2"] = model.wheelset->transverse_inertia();
    wheelset["centre_y_m"] = model.wheelset->centre_y();
    if (model.index.disc >= 0) {
      wheelset["web_thickness_m"] = model.web_thickness;
      wheelset["brake_ring_thickness_m"] = model.brake_ring_thickness;
    }
  }
  json["stable_step_s"] = limit.stable_step;
  json["stable_step_reason"] = limit.reason;
  return json_text(json);
}

}  // namespace

void describe_mesh(const ResolvedScene& resolved, const MeshOptions& options) {
  use_threads(options.threads);
  const Model model = scene_model(resolved.scene, resolved);
  const std::vector<BlockMeasures> blocks = measure_blocks(model);
  const StepLimit limit = step_limit(model);
  if (!options.output.empty()) write_mesh(model, options.output);
  if (options.json) {
    fmt::print("{}", mesh_json(model, blocks, limit));
    return;
  }
  const std::vector<BlockMeasures> groups = by_group(model, blocks);
  fmt::print("{}\n{}\n{}\n{}\n", plain_text(count_table(groups)), plain_text(quality_table(groups)),
             plain_text(step_table(limit)), plain_text(mass_table(bodies_of(model, blocks))));
  if (const Table tied = tied_surface_table(model); !tied.rows.empty()) fmt::print("{}\n", plain_text(tied));
  if (model.wheelset) fmt::print("{}\n", plain_text(inertia_table(*model.wheelset)));
  fmt::print("Stable step  {:.4e} s: {}\n", limit.stable_step, limit.reason);
  if (!options.output.empty()) fmt::print("Mesh         {}\n", (options.output / "mesh.hdf").string());
}

}  // namespace tread
