#include "drivers/results/root_attributes.hpp"

#include <nlohmann/json.hpp>
#include <variant>

#include "drivers/process/version.hpp"

namespace tread {

Hdf5Attributes root_attributes(const Scene& scene) {
  Hdf5Attributes attributes = {
      {"program", "tread"},
      {"version", program_version()},
      {"title", scene.title},
      {"quality", scene.quality},
      {"axes", "x along the rail, forwards; y across, to the field side of a left rail; z upwards"},
      {"units", "SI"}};
  if (!program_commit().empty()) attributes["commit"] = program_commit();
  if (scene.motion && scene.wheel) attributes["speed_m_per_s"] = scene.motion->speed;
  if (scene.contact) {
    attributes["friction_law"] = scene.contact->friction_law;
    attributes["friction_coefficient"] = scene.contact->largest_friction();
  }
  return attributes;
}

void add_attributes(const Hdf5Attributes& attributes, Json& json) {
  for (const auto& attribute : attributes)
    std::visit([&](const auto& value) { json[attribute.first] = value; }, attribute.second);
}

}  // namespace tread
