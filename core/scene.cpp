#include "core/scene.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/error.hpp"

namespace tread {

std::pair<double, double> ContactSpec::friction_range() const {
  if (friction_law == "coulomb") return {friction, friction};
  if (friction_law == "falling") return {friction_fast, friction};
  if (friction_law != "table") refuse_friction_law();
  if (friction_at_x.empty()) return {friction, friction};
  const auto [least, largest] = std::minmax_element(friction_at_x.begin(), friction_at_x.end());
  return {*least, *largest};
}

void ContactSpec::refuse_friction_law() const {
  throw InputError(
      fmt::format("contact.friction_law = \"{}\": no such law; state \"coulomb\", \"table\" or \"falling\"",
                  friction_law));
}

const Material& Scene::material(std::string_view name) const {
  const auto found = materials.find(name);
  if (found == materials.end())
    throw InputError(fmt::format("the scene has no material \"{}\"; it has {}", name, material_names()));
  return found->second;
}

const Material& Scene::wheel_material() const {
  if (!wheel) throw InputError("the scene has no wheel, and so no material of it; add [wheel]");
  return material(wheel->material);
}

const Material& Scene::rail_material() const {
  if (!rail) throw InputError("the scene has no rail, and so no material of it; add [rail]");
  return material(rail->material);
}

const Material& Scene::head_material() const {
  return rail && !rail->head_material.empty() ? material(rail->head_material) : rail_material();
}

const std::pair<const std::string, BodySpec>* Scene::body_replacing(std::string_view part) const {
  const auto found =
      std::ranges::find_if(bodies, [&](const auto& body) { return body.second.replaces == part; });
  return found == bodies.end() ? nullptr : &*found;
}

ElasticPair Scene::elastic_pair() const {
  const Material& of_wheel = wheel_material();
  const Material& of_rail = head_material();
  return {{of_wheel.youngs_modulus, of_wheel.poissons_ratio},
          {of_rail.youngs_modulus, of_rail.poissons_ratio}};
}

SupportSpec Scene::support(int fastening) const {
  for (const auto& [name, support] : supports)
    if (support.fastening == fastening + 1) return support;
  if (fastenings) {
    const auto listed =
        std::ranges::lower_bound(fastenings->listed, fastening + 1, {}, &SupportSpec::fastening);
    if (listed != fastenings->listed.end() && listed->fastening == fastening + 1) return *listed;
  }
  return {.fastening = fastening + 1};
}

double Scene::fastening_x(int fastening) const {
  return fastenings->first + fastening * fastenings->spacing + support(fastening).shift - rail->origin;
}

std::string Scene::material_names() const {
  std::string names;
  for (const auto& [name, material] : materials) names += (names.empty() ? "" : ", ") + name;
  return names.empty() ? "none" : names;
}

std::vector<ZoneSpec> Scene::all_zones() const {
  std::vector<ZoneSpec> all = {solution_zone()};
  for (const auto& [name, zone] : zones) all.push_back(zone);
  return all;
}

}  // namespace tread
