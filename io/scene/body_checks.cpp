#include "io/scene/body_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <iterator>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "core/mesh/hex_mesh.hpp"
#include "io/mesh/mesh_text.hpp"
#include "io/scene/key.hpp"
#include "io/scene/schema.hpp"

namespace tread {

namespace {

void check_disc(const Scene& scene, const std::string& table, Require require) {
  const std::string key = table + ".replaces";
  require(scene.wheel.has_value(), {key, table},
          fmt::format("\"disc\" is a part of the wheel, and there is none; add [wheel], or state "
                      "{}.present = false",
                      table));
  require(!scene.wheel || scene.wheel->shape == "half_wheelset", {key, "wheel.shape"},
          "\"disc\" is a part of a half wheelset, and wheel.shape is \"tyre\", a ring without a disc; state "
          "wheel.shape = \"half_wheelset\"");
  if (!scene.wheel) return;
  const WheelSpec& wheel = *scene.wheel;
  require(!wheel.brake_rings, {"wheel.brake_rings", key},
          "the rings lie on the disc, which the file replaces; state wheel.brake_rings = false");
  for (const auto& [name, value] :
       {std::pair("wheel.web_offset", wheel.web_offset), std::pair("wheel.web_wave", wheel.web_wave)})
    require(value == 0, {name, key},
            fmt::format("the web is a part of the disc, which the file replaces; state {} = \"0 mm\"", name));
}

void check_web_and_foot(const Scene& scene, const std::string& table, Require require) {
  const std::string key = table + ".replaces";
  require(scene.rail.has_value(), {key, table},
          fmt::format("\"rail\" is the rail below its head, and there is none; add [rail], or state "
                      "{}.present = false",
                      table));
  require(!scene.rail || scene.rail->profile != "box", {key, "rail.profile"},
          "\"rail\" is the rail below its head, and rail.profile is \"box\", which has no head; state a rail "
          "such as rail.profile = \"CN60\"");
}

/// Bodies do not yield.
void check_law(const Scene& scene, const std::string& table, const BodySpec& body, Require require) {
  std::string name = body.material;
  if (name.empty() && body.on_wheel() && scene.wheel) name = scene.wheel->material;
  if (name.empty() && !body.on_wheel() && scene.rail) name = scene.rail->material;
  const auto material = scene.materials.find(name);
  if (material == scene.materials.end()) return;
  const std::string& law = material->second.law;
  const std::string of = std::string(kMaterialTables) + name;
  require(law == "elastic", {table + ".material", of + ".law"},
          fmt::format("[{}] has law = \"{}\", and a body from a file is elastic; state {}.material, a "
                      "material with law = \"elastic\"",
                      of, law, table));
}

std::string file_name(const BodySpec& body) {
  return std::filesystem::path(body.file).filename().string();
}

/// `"axle", "tread"`, and how many others there are
std::string listed(const std::vector<std::string>& names) {
  constexpr std::size_t kMost = 10;
  std::string text;
  for (std::size_t i = 0; i < names.size() && i < kMost; ++i)
    text += fmt::format("{}\"{}\"", i == 0 ? "" : ", ", shown(names[i]));
  return names.size() > kMost ? fmt::format("{} and {} others", text, names.size() - kMost) : text;
}

/// `"tread (1)" (4 nodes) or "tread (2)" (12 nodes)` for a name that several sets of a file have; else empty.
std::string sets_of_one_name(const HexMesh& mesh, const std::string& set) {
  std::vector<std::string> texts;
  for (int copy = 1;; ++copy) {
    const std::string name = fmt::format("{} ({})", set, copy);
    const auto found = mesh.node_sets.find(name);
    if (found == mesh.node_sets.end()) break;
    texts.push_back(fmt::format("\"{}\" ({} nodes)", shown(name), found->second.size()));
  }
  return texts.size() < 2 ? "" : fmt::format("{}", fmt::join(texts, " or "));
}

/// The nodes of a set; null, and a problem, where there are none.
const std::vector<std::int32_t>* found_set(const std::string& key, const std::string& set,
                                           const BodySpec& body, Require require) {
  const auto& sets = body.mesh->node_sets;
  if (const auto found = sets.find(set); found != sets.end() && !found->second.empty()) return &found->second;
  if (const std::string several = sets_of_one_name(*body.mesh, set); !several.empty()) {
    require(false, {key},
            fmt::format("{} has several sets \"{}\"; state {}, or give each a name of its own in the file",
                        file_name(body), shown(set), several));
    return nullptr;
  }
  std::vector<std::string> names;
  for (const auto& [name, nodes] : sets)
    if (!nodes.empty()) names.push_back(name);
  const std::string similar = similar_text(set, names);
  require(false, {key},
          fmt::format("{} has no set \"{}\" with nodes of the body; {}{}", file_name(body), shown(set),
                      names.empty() ? "add it to the file, as *SET_NODE, physical surface or *NSET"
                                    : "state one of " + listed(names),
                      similar.empty() ? "" : fmt::format(" (did you mean \"{}\"?)", shown(similar))));
  return nullptr;
}

void check_sets(const std::string& table, const BodySpec& body, Require require) {
  if (!body.mesh) return;
  const bool disc = body.on_wheel();
  const std::string first = table + (disc ? ".tread" : ".head");
  const std::string second = table + (disc ? ".axle" : ".foot");
  const std::string& name = disc ? body.tread : body.head;
  const auto* one = found_set(first, name, body, require);
  const auto* other = found_set(second, disc ? body.axle : body.foot, body, require);
  if (!one || !other) return;
  std::vector<std::int32_t> common;
  std::ranges::set_intersection(*one, *other, std::back_inserter(common));
  if (common.empty()) return;
  require(false, {second, first},
          fmt::format("node {} of {} is in \"{}\" of {} too; a node is tied to one part: leave it out of "
                      "one of the sets",
                      body.mesh->node_number[static_cast<std::size_t>(common.front())], file_name(body),
                      shown(name), first));
}

}  // namespace

void check_bodies(const Scene& scene, Require require) {
  std::map<std::string, std::string> known;  // tables by the part that they replace
  for (const auto& [name, body] : scene.bodies) {
    const std::string table = std::string(kBodyTables) + name;
    const auto [first, fresh] = known.emplace(body.replaces, table);
    require(fresh, {table + ".replaces", first->second + ".replaces"},
            fmt::format("\"{}\" is replaced by [{}] too; state {}.present = false, or one mesh of both in "
                        "one table",
                        body.replaces, first->second, table));
    if (body.on_wheel())
      check_disc(scene, table, require);
    else
      check_web_and_foot(scene, table, require);
    check_law(scene, table, body, require);
    check_sets(table, body, require);
  }
}

}  // namespace tread
