#include "io/scene/idle_materials.hpp"

#include <fmt/format.h>

#include <set>

#include "io/scene/schema.hpp"

namespace tread {

std::vector<std::string> idle_materials(const Scene& scene) {
  std::set<std::string> used;
  for (const MaterialUse& use : material_uses(scene)) {
    if (!scene.materials.contains(use.name)) return {};
    used.insert(use.name);
  }
  std::vector<std::string> idle;
  for (const auto& [name, material] : scene.materials)
    if (!used.contains(name)) idle.push_back(name);
  return idle;
}

std::string why_idle(const Scene& scene, const std::string& material) {
  const std::string user = usual_user(material);
  if (!user.empty() && !table_of(user)->exists(scene)) return fmt::format("has no effect without [{}]", user);
  std::string uses;
  for (const MaterialUse& use : material_uses(scene))
    uses += fmt::format("{}{} = \"{}\"", uses.empty() ? "" : ", ", use.key, use.name);
  return fmt::format("has no effect, because no part is of it; the parts state {}", uses);
}

}  // namespace tread
