#include "drivers/studies/import/import_study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "core/millimetre.hpp"
#include "drivers/studies/import/mesh_extremes.hpp"
#include "io/scene/body_file.hpp"
#include "io/text/json.hpp"
#include "io/text/units.hpp"

namespace tread {

namespace {

/// Length of a unit [m].
double unit_of(const std::string& unit) {
  try {
    return parse_quantity("1 " + unit, kLength);
  } catch (const InputError& error) {
    throw InputError(fmt::format("--unit {}: {}", unit, error.what()));
  }
}

double positive_option(const char* option, const std::string& text, const Quantity& quantity) {
  const double value = parse_option(option, text, quantity);
  if (!(value > 0)) throw InputError(fmt::format("{} {}: must be above 0", option, text));
  return value;
}

Material material_of(const ImportOptions& options) {
  Material material;
  material.youngs_modulus = positive_option("--youngs-modulus", options.youngs_modulus, kStress);
  material.density = positive_option("--density", options.density, kDensity);
  material.poissons_ratio = options.poissons_ratio;
  if (!(material.poissons_ratio >= 0 && material.poissons_ratio <= 0.49))
    throw InputError(fmt::format("--poissons-ratio {}: must lie between 0 and 0.49", options.poissons_ratio));
  return material;
}

std::map<std::string, std::size_t> part_sizes(const HexMesh& mesh) {
  std::map<std::string, std::size_t> sizes;
  for (const std::int32_t part : mesh.part) ++sizes[mesh.parts[static_cast<std::size_t>(part)]];
  return sizes;
}

std::string text_of(const ImportedMesh& imported, const MeshExtremes& m, const Material& material,
                    const ImportOptions& options) {
  const HexMesh& mesh = imported.mesh;
  std::string text;
  const auto line = [&](const char* name, const std::string& value) {
    text += fmt::format("{:<14}{}\n", name, value);
  };
  line("Read as", fmt::format("{}, lengths in {}", imported.format, options.unit));
  line("Mesh", fmt::format("{} hexahedra, {} nodes", mesh.elements.size(), mesh.nodes.size()));
  constexpr const char* kAxes[] = {"x", "y", "z"};
  for (int i = 0; i < 3; ++i)
    line(kAxes[i], fmt::format("{:.3f} ... {:.3f} mm", m.low[i] / mm, m.high[i] / mm));
  line("Volume", fmt::format("{:.6g} m3, {:.6g} kg of {:g} kg/m3", m.volume, m.volume * material.density,
                             material.density));
  line("Edges",
       fmt::format("{:.4g} mm (element {}) to {:.4g} mm (element {}); largest ratio in an element {:.3g} "
                   "(element {})",
                   m.shortest_edge.value / mm, m.shortest_edge.element, m.longest_edge.value / mm,
                   m.longest_edge.element, m.edge_ratio.value, m.edge_ratio.element));
  line("Jacobian", fmt::format("at a corner at least {:.3g} of the element's mean (element {})",
                               m.jacobian.value, m.jacobian.element));
  line("Stable step",
       fmt::format("{:.4e} s of the free mesh, {:.4e} s of element {} alone; E {:g} GPa, nu {:g}",
                   m.assembled_step, m.stable_step.value, m.stable_step.element,
                   1e-9 * material.youngs_modulus, material.poissons_ratio));
  const char* name = "Parts";
  const auto entry = [&](const std::string& of, std::size_t size, const char* unit) {
    line(name, fmt::format("\"{}\": {} {}", of, size, unit));
    name = "";
  };
  for (const auto& [part, size] : part_sizes(mesh)) entry(part, size, "elements");
  name = "Element sets";
  for (const auto& [set, members] : mesh.element_sets) entry(set, members.size(), "elements");
  name = "Node sets";
  for (const auto& [set, members] : mesh.node_sets) entry(set, members.size(), "nodes");
  name = "Notes";
  for (const std::string& note : imported.notes) {
    line(name, note);
    name = "";
  }
  return text;
}

Json json_of(const ImportedMesh& imported, const MeshExtremes& m, const ImportOptions& options) {
  const HexMesh& mesh = imported.mesh;
  const auto extreme = [](const ElementExtreme& of) {
    return Json{{"value", of.value}, {"element", of.element}};
  };
  Json json = {{"ok", true},
               {"format", imported.format},
               {"unit", options.unit},
               {"elements", mesh.elements.size()},
               {"nodes", mesh.nodes.size()},
               {"low_m", {m.low.x, m.low.y, m.low.z}},
               {"high_m", {m.high.x, m.high.y, m.high.z}},
               {"volume_m3", m.volume},
               {"shortest_edge_m", extreme(m.shortest_edge)},
               {"longest_edge_m", extreme(m.longest_edge)},
               {"largest_edge_ratio", extreme(m.edge_ratio)},
               {"smallest_jacobian", extreme(m.jacobian)},
               {"element_step_s", extreme(m.stable_step)},
               {"stable_step_s", m.assembled_step},
               {"notes", imported.notes}};
  json["parts"] = part_sizes(mesh);
  json["element_sets"] = Json::object();
  for (const auto& [set, members] : mesh.element_sets) json["element_sets"][set] = members.size();
  json["node_sets"] = Json::object();
  for (const auto& [set, members] : mesh.node_sets) json["node_sets"][set] = members.size();
  return json;
}

}  // namespace

ImportedMesh read_mesh_file(const std::filesystem::path& file, const MeshWish& wish) {
  std::vector<Problem> problems;
  ImportedMesh imported = mesh_in(read_mesh_text(file), file, wish, problems);
  if (!problems.empty()) throw ProblemsError(std::move(problems));
  return imported;
}

void import_mesh(const ImportOptions& options) {
  use_threads(options.threads);
  const MeshWish wish = {unit_of(options.unit), options.parts, options.pieces};
  const Material material = material_of(options);
  const ImportedMesh imported = read_mesh_file(options.file, wish);
  const MeshExtremes extremes = mesh_extremes(imported.mesh, material);
  if (options.json)
    fmt::print("{}", json_text(json_of(imported, extremes, options)));
  else
    fmt::print("{}", text_of(imported, extremes, material, options));
}

}  // namespace tread
