// A disc that comes as a body of hexahedra is the swept disc that it was made of.

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "core/index.hpp"
#include "drivers/engine/preload.hpp"
#include "drivers/engine/simulation.hpp"
#include "drivers/engine/static_system.hpp"
#include "io/scene/scene_reader.hpp"
#include "kernels/hexahedra/body_force.hpp"
#include "tests/swept_samples.hpp"

namespace tread {
namespace {

Scene wheelset_scene(const std::vector<std::string>& overrides) {
  std::vector<std::string> all = {"scene.element_size=9mm",    "rail.length=1.4m",
                                  "fastenings.count=2",        "fastenings.first=0.35m",
                                  "rail.origin=0.6m",          "solution_zone.start=0.05m",
                                  "solution_zone.length=0.1m", "corrugation.start=0.07m",
                                  "corrugation.length=0.08m",  "motion.duration=1.2ms"};
  all.insert(all.end(), overrides.begin(), overrides.end());
  SceneSource source{"bodies", "[scene]\nbased_on = \"highspeed-slab-2014\"\n", "/nowhere"};
  return resolve_scene(source, all).scene;
}

/// Nodes of a path of the block's section at all stations, as hexahedra_of() numbers them.
std::vector<std::int32_t> nodes_on(const SweptBlock& block, const std::string& path) {
  std::vector<std::int32_t> nodes;
  for (int station = 0; station < block.station_count(); ++station)
    for (const int node : block.section.paths.at(path))
      nodes.push_back(station * block.section.nodes() + node);
  std::sort(nodes.begin(), nodes.end());
  return nodes;
}

/// A smooth field: of a body that moves and stretches.
AlignedVector<double> smooth_field(const Mesh& mesh) {
  AlignedVector<double> field(index(3 * mesh.slots), 0.0);
  for (const SweptBlock& block : mesh.blocks)
    for (int station = 0; station < block.station_count(); ++station)
      for (int node = 0; node < block.section.nodes(); ++node) {
        const Vec3 x = position(block, node, station);
        const Vec3 u = {1e-5 * std::sin(3 * x.z + x.y), 1e-5 * std::cos(4 * x.x),
                        1e-5 * std::sin(2 * x.x - 5 * x.y)};
        NodeField(field.data()).set(block.base + block.slot(node, station), to_local(block, station, 0, u));
      }
  return field;
}

/// The scene with the model's swept disc as a body.
Scene with_body(const Model& model, Scene scene) {
  const SweptBlock& disc = model.mesh.blocks[index(model.index.disc)];
  HexMesh mesh = hexahedra_of(disc);
  mesh.node_sets["outer"] = nodes_on(disc, "tie_outer");
  mesh.node_sets["inner"] = nodes_on(disc, "tie_inner");
  BodySpec spec;
  spec.tread = "outer";
  spec.axle = "inner";
  spec.mesh = std::make_shared<const HexMesh>(std::move(mesh));
  scene.bodies["disc"] = spec;
  scene.wheel->web_thickness = model.web_thickness;  // lines of the tread meet those of the web
  return scene;
}

TEST(Bodies, HaveTheMassesOfTheSweptDisc) {
  const Scene scene = wheelset_scene({});
  const Model swept(scene);
  const Model model(with_body(swept, scene));
  ASSERT_EQ(model.mesh.bodies.size(), 1u);
  EXPECT_EQ(model.elements(), swept.elements());
  EXPECT_NEAR(model.wheelset->mass() / swept.wheelset->mass(), 1, 1e-12);
  EXPECT_NEAR(model.wheelset->inertia() / swept.wheelset->inertia(), 1, 1e-6);
  EXPECT_NEAR(model.wheelset->transverse_inertia() / swept.wheelset->transverse_inertia(), 1, 1e-5);
  EXPECT_NEAR(model.wheelset->centre_y(), swept.wheelset->centre_y(), 1e-12);
  EXPECT_EQ(model.ties->secondary_count(), swept.ties->secondary_count());
  EXPECT_EQ(model.ties->primary_count(), swept.ties->primary_count());
  EXPECT_NEAR(stable_step_of(model) / stable_step_of(swept), 1, 1e-4);
}

/// The scene with the model's swept rail below the head as a body.
Scene with_base(const Model& model, Scene scene) {
  const SweptBlock& base = model.mesh.blocks[index(model.index.rail_base)];
  HexMesh mesh = hexahedra_of(base);
  mesh.node_sets["top"] = nodes_on(base, "tie");
  mesh.node_sets["bottom"] = nodes_on(base, "foot");
  BodySpec spec;
  spec.replaces = "rail";
  spec.head = "top";
  spec.foot = "bottom";
  spec.mesh = std::make_shared<const HexMesh>(std::move(mesh));
  scene.bodies["base"] = spec;
  return scene;
}

/// The field of the swept model in the fields of the model with the body.
AlignedVector<double> carried_over(const Model& swept, const Model& model,
                                   const AlignedVector<double>& field) {
  AlignedVector<double> out(index(3 * model.mesh.slots), 0.0);
  const ConstNodeField from(field.data());
  const NodeField to(out.data());
  for (const SweptBlock& block : swept.mesh.blocks) {
    const auto same = std::find_if(model.mesh.blocks.begin(), model.mesh.blocks.end(),
                                   [&](const SweptBlock& other) { return other.name == block.name; });
    for (int station = 0; station < block.station_count(); ++station)
      for (int node = 0; node < block.section.nodes(); ++node) {
        const Vec3 value = from.at(block.base + block.slot(node, station));
        if (same != model.mesh.blocks.end())
          to.set(same->base + same->slot(node, station), value);
        else
          to.set(model.mesh.bodies[0].slot(std::int64_t{station} * block.section.nodes() + node),
                 to_cartesian(block, station, 0, value));
      }
  }
  return out;
}

double difference(const AlignedVector<double>& a, const AlignedVector<double>& b) {
  double largest = 0, farthest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    largest = std::max(largest, std::abs(b[i]));
    farthest = std::max(farthest, std::abs(a[i] - b[i]));
  }
  return farthest / largest;
}

TEST(Bodies, HaveTheForcesAndTheMotionOfTheSweptDisc) {
  const Scene scene = wheelset_scene({});
  Model swept(scene);
  Model model(with_body(swept, scene));
  AlignedVector<double> u = smooth_field(swept.mesh), f(u.size());
  swept.ties->follow({u.data()});
  const AlignedVector<double> u2 = carried_over(swept, model, u);
  AlignedVector<double> g(u2.size(), 0.0), followed = u2;
  model.ties->follow({followed.data()});
  EXPECT_LT(difference(followed, u2), 1e-12);
  swept.internal_force(u.data(), f.data());
  model.internal_force(u2.data(), g.data());
  EXPECT_LT(difference(g, carried_over(swept, model, f)), 1e-12);
  swept.ties->gather(f.data());
  model.ties->gather(g.data());
  EXPECT_LT(difference(g, carried_over(swept, model, f)), 1e-12);
  swept.apply_stiffness(u.data(), f.data());
  model.apply_stiffness(u2.data(), g.data());
  EXPECT_LT(difference(g, carried_over(swept, model, f)), 1e-12);
}

TEST(Bodies, HaveTheForcesOfTheSweptRail) {
  const Scene scene = wheelset_scene({});
  Model swept(scene);
  Model model(with_base(swept, scene));
  EXPECT_EQ(model.restrained.size(), swept.restrained.size());
  AlignedVector<double> u = smooth_field(swept.mesh), f(u.size());
  swept.ties->follow({u.data()});
  const AlignedVector<double> u2 = carried_over(swept, model, u);
  AlignedVector<double> g(u2.size(), 0.0), followed = u2;
  model.ties->follow({followed.data()});
  EXPECT_LT(difference(followed, u2), 1e-12);
  swept.internal_force(u.data(), f.data());
  model.internal_force(u2.data(), g.data());
  EXPECT_LT(difference(g, carried_over(swept, model, f)), 1e-11);
  swept.ties->gather(f.data());
  model.ties->gather(g.data());
  EXPECT_LT(difference(g, carried_over(swept, model, f)), 1e-11);
}

/// F_N and F_L of every step, and the results of the preload.
struct Passage {
  Preload preload;
  std::vector<double> normal, along;
  double energy_missed = 0;
};

Passage pass(Model& model, double dt, int steps) {
  Passage passage;
  passage.preload =
      solve_preload(model, steady_motion(model), [](const std::string& text) { fmt::print("{}\n", text); });
  model.apply_corrugation(passage.preload.contact.centre.y);
  Simulation simulation(model, passage.preload, dt);
  simulation.set_sampling_interval(1);
  for (int i = 0; i < steps; ++i) {
    simulation.step();
    passage.normal.push_back(-model.contact->totals().force_on_rail.z);
    passage.along.push_back(model.contact->totals().force_on_rail.x);
  }
  return passage;
}

TEST(Bodies, RollAsTheSweptDiscDoes) {
  const char* more = std::getenv("MORE");
  std::vector<std::string> o;
  if (more) {
    std::string t = more;
    std::size_t a = 0;
    while (a < t.size()) {
      auto b = t.find(',', a);
      if (b == t.npos) b = t.size();
      o.push_back(t.substr(a, b - a));
      a = b + 1;
    }
  }
  const Scene scene = wheelset_scene(o);
  Model swept(scene);
  Model model(std::getenv("RAIL") ? with_base(swept, scene) : with_body(swept, scene));
  const double dt = 0.9 * stable_step_of(swept);
  const Passage expected = pass(swept, dt, 400);
  const Passage passage = pass(model, dt, 400);
  EXPECT_NEAR(passage.preload.rail_deflection / expected.preload.rail_deflection, 1, 1e-6);
  double farthest = 0, farthest_along = 0;
  for (std::size_t i = 0; i < expected.normal.size(); ++i) {
    farthest = std::max(farthest, std::abs(passage.normal[i] - expected.normal[i]));
    farthest_along = std::max(farthest_along, std::abs(passage.along[i] - expected.along[i]));
    if (i % 40 == 0)
      fmt::print("{} {:.6f} {:.6f} {:.6f} {:.6f}\n", i, expected.normal[i], passage.normal[i],
                 expected.along[i], passage.along[i]);
  }
  EXPECT_LT(farthest / expected.normal.front(), 1e-6);
  EXPECT_LT(farthest_along / expected.normal.front(), 1e-6);
}

}  // namespace
}  // namespace tread
