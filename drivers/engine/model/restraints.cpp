#include "drivers/engine/model/restraints.hpp"

#include <algorithm>
#include <string>

#include "core/mesh/node_field.hpp"
#include "drivers/engine/model/rail_foot.hpp"

namespace tread {

namespace {

class Restraints {
 public:
  Restraints(const Scene& scene, const TiedBodies& bodies) : scene_(scene), bodies_(bodies) {}

  std::vector<std::int64_t> collect() {
    if (!scene_.pulse) hold_rail_ends();  // under a pulse they are free
    if (bodies_.index.rail_cap >= 0) hold_foot();
    if (bodies_.index.slab >= 0) hold_slab(block(bodies_.index.slab));
    for (const int b : bodies_.index.sleepers) hold_sleeper(block(b));
    if (scene_.plane_strain)
      for (const SweptBlock& body : bodies_.mesh.blocks) hold_all(body, 1);
    if (bodies_.index.axle >= 0)
      hold_path(block(bodies_.index.axle), "symmetry_end", 1);
    else if (bodies_.index.tread >= 0)
      hold_path(block(bodies_.index.tread), "bore", 1);
    release_secondary_nodes();
    std::sort(unknowns_.begin(), unknowns_.end());
    unknowns_.erase(std::unique(unknowns_.begin(), unknowns_.end()), unknowns_.end());
    unknowns_.shrink_to_fit();
    return std::move(unknowns_);
  }

 private:
  const SweptBlock& block(int b) const { return bodies_.mesh.blocks[static_cast<std::size_t>(b)]; }

  void hold(const SweptBlock& body, int node, int station, int component) {
    unknowns_.push_back(dof(body.base + body.slot(node, station), component));
  }
  void hold_path(const SweptBlock& body, const std::string& path, int component) {
    for (const int node : body.section.paths.at(path))
      for (int station = 0; station < body.station_count(); ++station) hold(body, node, station, component);
  }
  void hold_all(const SweptBlock& body, int component) {
    for (int node = 0; node < body.section.nodes(); ++node)
      for (int station = 0; station < body.station_count(); ++station) hold(body, node, station, component);
  }

  void hold(std::int64_t slot, int component) { unknowns_.push_back(dof(slot, component)); }

  void hold_rail_ends() {
    for (const int b : bodies_.index.rail())
      for (int node = 0; node < block(b).section.nodes(); ++node)
        for (const int station : {0, block(b).station_count() - 1}) hold(block(b), node, station, 0);
    if (bodies_.index.base_body >= 0)
      hold_ends(bodies_.mesh.bodies[static_cast<std::size_t>(bodies_.index.base_body)]);
  }

  /// Nodes of a body in the planes of its ends.
  void hold_ends(const HexBody& body) {
    const auto along = [](const Vec3& a, const Vec3& b) { return a.x < b.x; };
    const auto [first, last] = std::minmax_element(body.mesh.nodes.begin(), body.mesh.nodes.end(), along);
    const double digits = 1e-6 * (last->x - first->x);
    for (std::int64_t node = 0; node < body.nodes(); ++node) {
      const double x = body.mesh.nodes[static_cast<std::size_t>(node)].x;
      if (x < first->x + digits || x > last->x - digits) hold(body.slot(node), 0);
    }
  }

  void hold_foot() {
    const bool rigid = scene_.rail->support == "rigid";
    const bool along = scene_.fastenings && scene_.fastenings->along.kind == "held";
    const bool across = scene_.fastenings && scene_.fastenings->across.kind == "held";
    if (!rigid && !along && !across) return;
    const RailFoot foot = foot_of_rail(scene_, bodies_.mesh, bodies_.index);
    if (rigid) {
      for (const FootNode& node : foot.nodes())
        for (int c = 0; c < 3; ++c) hold(node.slot, c);
      return;
    }
    for (const FootNode& node : held_foot_nodes(scene_, foot)) {
      if (along) hold(node.slot, 0);
      if (across) hold(node.slot, 1);
    }
  }

  void hold_slab(const SweptBlock& body) {
    for (int c = 0; c < 2; ++c) hold_all(body, c);
    hold_path(body, "bottom", 2);
  }

  void hold_sleeper(const SweptBlock& body) {
    hold_all(body, 0);
    hold_path(body, "left", 1);
  }

  void release_secondary_nodes() {
    if (!bodies_.ties) return;
    std::vector<std::int64_t> tied;
    for (const std::int64_t slot : bodies_.ties->secondary_slots())
      for (int c = 0; c < 3; ++c) tied.push_back(dof(slot, c));
    std::sort(tied.begin(), tied.end());
    std::erase_if(unknowns_, [&](std::int64_t u) { return std::binary_search(tied.begin(), tied.end(), u); });
  }

  const Scene& scene_;
  TiedBodies bodies_;
  std::vector<std::int64_t> unknowns_;
};

}  // namespace

std::vector<std::int64_t> restrained_unknowns(const Scene& scene, const TiedBodies& bodies) {
  return Restraints(scene, bodies).collect();
}

std::vector<std::int64_t> held_unknowns(const Mesh& mesh, std::vector<std::int64_t> restrained) {
  for (const SweptBlock& block : mesh.blocks) {
    if (!block.vertical_only) continue;
    std::erase_if(restrained, [&](std::int64_t unknown) {
      return unknown >= 3 * block.base && unknown < 3 * (block.base + block.slots()) &&
             unknown / kLanes % 3 != 2;
    });
  }
  restrained.shrink_to_fit();
  return restrained;
}

}  // namespace tread
