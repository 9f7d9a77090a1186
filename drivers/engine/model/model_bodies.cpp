// The bodies of a model that come from files, and the sums over them and the blocks.

#include <fmt/core.h>

#include <string>
#include <utility>

#include "core/mesh/hex_mesh.hpp"
#include "drivers/engine/model/model.hpp"
#include "kernels/hexahedra/hex_chunks.hpp"

namespace tread {

int Model::add_body(const std::string& name, const BodySpec& spec, const Material& material) {
  HexBody body;
  body.name = name;
  body.mesh = *spec.mesh;
  number_by_chunks(body.mesh);
  body.materials.assign(body.mesh.parts.size(),
                        spec.material.empty() ? material : scene.material(spec.material));
  body.spins = spec.on_wheel();
  return mesh.add(std::move(body));
}

void Model::build_bodies() {
  const auto tie = [&](int body, const std::string& name, const char* key, const std::string& set, int block,
                       const char* path, bool whole) {
    body_ties.push_back({body, set, fmt::format("body.{}.{}", name, key), block, path, whole});
  };
  if (const auto* disc = scene.body_replacing("disc"); disc && index.tread >= 0) {
    const auto& [name, spec] = *disc;
    index.disc_body = add_body(name, spec, scene.wheel_material());
    tie(index.disc_body, name, "tread", spec.tread, index.tread, "tie", true);
    tie(index.disc_body, name, "axle", spec.axle, index.axle, "tie", false);
  }
  if (const auto* rail = scene.body_replacing("rail"); rail && index.rail_cap >= 0) {
    const auto& [name, spec] = *rail;
    index.base_body = add_body(name, spec, scene.rail_material());
    tie(index.base_body, name, "head", spec.head, index.rail_cap, "tie", true);
  }
}

void Model::tie_blocks() {
  if (tie_specs.empty() && body_ties.empty()) return;
  for (const TieSpec& spec : tie_specs) place_on_chords(mesh, spec);
  std::vector<FollowingNode> tied;
  for (const BodyTieSpec& spec : body_ties) {
    const BodyTie& made = made_ties.emplace_back(tie_body(mesh, spec));
    tied.insert(tied.end(), made.nodes.begin(), made.nodes.end());
  }
  ties.emplace(mesh, tie_specs, tied);
}

std::int64_t Model::elements() const {
  std::int64_t sum = 0;
  for (const SweptBlock& block : mesh.blocks) sum += block.elements();
  for (const HexBody& body : mesh.bodies) sum += body.elements();
  return sum;
}

std::int64_t Model::nodes() const {
  std::int64_t sum = 0;
  for (const SweptBlock& block : mesh.blocks) sum += block.nodes();
  for (const HexBody& body : mesh.bodies) sum += body.nodes();
  return sum;
}

void Model::add_lumped_mass(double* of_nodes) const {
  internal->lumped_mass(of_nodes);
  for (const auto& body : body_forces) body->add_mass(of_nodes);
}

void Model::keep_masses(std::span<const unsigned char> groups) {
  keep_marked(mass, groups, kLanes);
}

void Model::internal_force(const double* u, double* f) const {
  internal->internal_force(u, nullptr, f);
  for (const auto& body : body_forces) body->internal_force<double, double>(u, nullptr, nullptr, f);
}

void Model::apply_stiffness(const double* u, double* f) const {
  internal->apply(u, f);
  for (const auto& body : body_forces) body->apply(u, f);
}

namespace {

/// The blocks as parts of a mesh, with a body where there is one.
std::vector<int> with_body(std::vector<int> parts, const Mesh& mesh, int body) {
  if (body >= 0) parts.push_back(static_cast<int>(mesh.blocks.size()) + body);
  return parts;
}

}  // namespace

std::vector<int> Model::wheel_parts() const {
  return with_body(index.wheel(), mesh, index.disc_body);
}

std::vector<int> Model::rail_parts() const {
  return with_body(index.rail(), mesh, index.base_body);
}

const BodyForce* Model::body_force_of(int part) const {
  const std::size_t blocks = mesh.blocks.size();
  const auto at = static_cast<std::size_t>(part);
  return at < blocks ? nullptr : body_forces[at - blocks].get();
}

DeformationEnergy Model::energy(int part, const double* u) const {
  const BodyForce* body = body_force_of(part);
  return body != nullptr ? body->energy(u) : internal->energy(part, u);
}

}  // namespace tread
