#include "io/scene/body_file.hpp"

#include <fmt/format.h>

#include <cstddef>
#include <memory>
#include <utility>

#include "io/text/text_file.hpp"
#include "io/text/units.hpp"

namespace tread {

namespace {

/// "12,345"
std::string in_thousands(std::size_t count) {
  std::string text = std::to_string(count);
  for (std::size_t end = text.size(); end > 3; end -= 3) text.insert(end - 3, ",");
  return text;
}

}  // namespace

std::string read_mesh_text(const std::filesystem::path& path) {
  return without_mark(read_bytes(path, kLargestMeshFile));
}

ImportedMesh mesh_in(const std::string& text, const std::filesystem::path& name, const MeshWish& wish,
                     std::vector<Problem>& problems) {
  MeshFaults faults;
  ImportedMesh imported = mesh_of(text, name, wish, faults);
  for (const LineFault& fault : faults.list())
    problems.push_back({name.string(), fault.line, 0, "", fault.message});
  return imported;
}

void set_mesh(const std::string& text, const std::string& name, const std::string& table, BodySpec& body,
              std::vector<Problem>& problems) {
  MeshWish wish;
  wish.unit_key = table + ".unit";
  wish.unit = parse_quantity("1 " + body.unit, kLength);
  if (!body.part.empty()) wish.parts = {body.part};
  const std::size_t known = problems.size();
  ImportedMesh imported = mesh_in(text, name, wish, problems);
  if (problems.size() > known) return;
  const Vec3 origin{body.origin_x, body.origin_y, body.origin_z};
  for (Vec3& at : imported.mesh.nodes) at = at - origin;
  body.reading =
      fmt::format("{}: {} hexahedra, {} nodes", imported.format, in_thousands(imported.mesh.elements.size()),
                  in_thousands(imported.mesh.nodes.size()));
  body.notes = std::move(imported.notes);
  body.mesh = std::make_shared<const HexMesh>(std::move(imported.mesh));
}

std::vector<std::string> body_notes(const Scene& scene) {
  std::vector<std::string> all;
  for (const auto& [name, body] : scene.bodies)
    for (const std::string& note : body.notes) all.push_back(fmt::format("body.{}: {}", name, note));
  return all;
}

}  // namespace tread
