// Nearest faces, and ties between a body of hexahedra and a swept block.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "core/index.hpp"
#include "core/mesh/structured.hpp"
#include "kernels/ties/body_tie.hpp"
#include "kernels/ties/face_finder.hpp"
#include "kernels/ties/tie.hpp"
#include "tests/refusal.hpp"
#include "tests/swept_samples.hpp"

namespace tread {
namespace {

const FaceCorners kWarped = {Vec3{0, 0, 0}, {1, 0, 0.2}, {1.1, 0.9, 0}, {0, 1, 0.1}};

TEST(FaceFinder, FindsThePointOverWhichOneStands) {
  const FaceFinder finder({kWarped}, 0.5);
  for (const auto& [xi, eta] : {std::pair(0.3, 0.7), {0.9, 0.1}, {0.5, 0.5}}) {
    const std::array<double, 4> share = QuadPlace{xi, eta}.weights();
    Vec3 at;
    for (std::size_t k = 0; k < 4; ++k) at += share[k] * kWarped[k];
    const Vec3 along_xi = (1 - eta) * (kWarped[1] - kWarped[0]) + eta * (kWarped[2] - kWarped[3]);
    const Vec3 along_eta = (1 - xi) * (kWarped[3] - kWarped[0]) + xi * (kWarped[2] - kWarped[1]);
    Vec3 normal = cross(along_xi, along_eta);
    normal = (1 / norm(normal)) * normal;
    const FacePlace place = finder.nearest(at + 0.05 * normal);
    ASSERT_EQ(place.face, 0);
    EXPECT_NEAR(place.distance, 0.05, 1e-9);
    for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(place.share[k], share[k], 1e-8);
  }
}

TEST(FaceFinder, EndsAtTheBorderAndSnapsToIt) {
  const FaceFinder finder({kWarped}, 0.5);
  const FacePlace beside = finder.nearest({-0.2, 0, 0});
  EXPECT_NEAR(beside.share[0], 1, 0.05);
  EXPECT_EQ(beside.share[1], 0);
  EXPECT_EQ(beside.share[2], 0);
  const FacePlace corner = finder.nearest(kWarped[2] + Vec3{1e-9, -1e-9, 0});
  EXPECT_EQ(corner.share[2], 1);
  EXPECT_EQ(FaceFinder({kWarped}, 0.1).nearest({5, 5, 5}).face, -1);
  EXPECT_FALSE(FacePlace{}.is_within(1));
}

/// A block of 0.2 x 0.1 m at z = 0 to 0.02, `pitch` long elements, and a body of hexahedra under it.
Mesh block_on_body(int elements, int body_elements, double gap) {
  Mesh mesh;
  SweptBlock block = make_swept_block("upper", Sweep::extruded, rectangle(0, 0.1, 5, 0, 0.02, 1),
                                      {samples::steel()}, 0, {{elements, 0.2 / elements, 0}});
  mesh.add(std::move(block));
  const SweptBlock lower =
      make_swept_block("lower", Sweep::extruded, rectangle(0, 0.1, 4, -0.03 - gap, -gap, 1),
                       {samples::steel()}, 0, {{body_elements, 0.2 / body_elements, 0}});
  HexBody body;
  body.name = "lower";
  body.mesh = hexahedra_of(lower);
  body.materials = lower.materials;
  for (std::size_t node = 0; node < body.mesh.nodes.size(); ++node) {
    const Vec3& at = body.mesh.nodes[node];
    const auto number = static_cast<std::int32_t>(node);
    if (at.z > -0.01 - gap) body.mesh.node_sets["top"].push_back(number);
    if (at.z > -0.01 - gap && at.x < 0.15) body.mesh.node_sets["most"].push_back(number);
    if (at.z > -0.01 - gap && at.y < 0.01) body.mesh.node_sets["line"].push_back(number);
  }
  mesh.add(std::move(body));
  return mesh;
}

std::string refusal(Mesh mesh, const BodyTieSpec& spec) {
  return samples::refusal<InputError>([&] { tie_body(mesh, spec); });
}

/// The finer side follows, and a field that is linear in space passes the tie.
TEST(BodyTie, FollowsLinearFields) {
  for (const auto& [elements, body_elements] : {std::pair(12, 5), {5, 12}}) {
    Mesh mesh = block_on_body(elements, body_elements, 0.001);
    const BodyTie tied = tie_body(mesh, {0, "top", "body.x.set", 0, "bottom", true});
    const Ties ties(mesh, {}, tied.nodes);
    const bool body_leads = elements > body_elements;
    EXPECT_EQ(tied.body_leads, body_leads);
    EXPECT_NEAR(tied.farthest, 0.001, 1e-12);
    EXPECT_EQ(ties.secondary_count(), body_leads ? 13 * 6 : 13 * 5);
    std::vector<double> field(index(3 * mesh.slots), 0.0);
    const auto value = [](const Vec3& at) { return Vec3{at.x + 2 * at.y, 3 - at.z, at.y - at.x + at.z}; };
    const NodeField view(field.data());
    const auto each_node = [&](const auto& visit) {
      const SweptBlock& block = mesh.blocks[0];
      for (int station = 0; station < block.station_count(); ++station)
        for (int node = 0; node < block.section.nodes(); ++node)
          visit(block.base + block.slot(node, station), position(block, node, station));
      for (std::int64_t node = 0; node < mesh.bodies[0].nodes(); ++node)
        visit(mesh.bodies[0].slot(node), mesh.bodies[0].mesh.nodes[index(node)]);
    };
    each_node([&](std::int64_t slot, const Vec3& at) { view.set(slot, value(at)); });
    ties.clear(field.data());
    ties.follow({field.data()});
    each_node([&](std::int64_t slot, const Vec3& at) { EXPECT_LT(norm(view.at(slot) - value(at)), 1e-12); });
    // Forces go the other way: their sum stays.
    Vec3 before, after;
    each_node([&](std::int64_t slot, const Vec3& /*at*/) { before += view.at(slot); });
    ties.gather(field.data());
    each_node([&](std::int64_t slot, const Vec3& /*at*/) { after += view.at(slot); });
    EXPECT_LT(norm(before - after), 1e-9);
  }
}

TEST(BodyTie, IsRefusedWithThePlaceAndTheWayOut) {
  const BodyTieSpec spec{0, "top", "body.x.set", 0, "bottom", true};
  const std::string far = refusal(block_on_body(12, 5, 0.006), spec);
  EXPECT_NE(far.find("body.x.set = \"top\""), std::string::npos) << far;
  EXPECT_NE(far.find("more than 4.000 mm off the faces"), std::string::npos) << far;
  EXPECT_NE(far.find("z = 0 mm"), std::string::npos) << far;
  EXPECT_NE(far.find("origin_z"), std::string::npos) << far;
  BodyTieSpec other = spec;
  other.set = "line";
  EXPECT_NE(refusal(block_on_body(12, 5, 0), other).find("no outer face"), std::string::npos);
  other.set = "most";
  EXPECT_NE(refusal(block_on_body(12, 5, 0), other).find("its faces cover 60.0 %"), std::string::npos)
      << refusal(block_on_body(12, 5, 0), other);
  EXPECT_EQ(refusal(block_on_body(12, 5, 0.003), spec), "");
}

/// A ring of 40 elements around, and a shorter one of hexahedra on it.
Mesh ring_on_ring(int elements) {
  const auto ring = [](const std::string& name, double width, double inner, double outer, int around) {
    return make_swept_block(name, Sweep::revolved, rectangle(0, width, 2, inner, outer, 1),
                            {samples::steel()}, 0.1, {{around, 2 * std::numbers::pi / around, 0}});
  };
  Mesh mesh;
  mesh.add(ring("axle", 0.1, 0.08, 0.1, 40));
  const SweptBlock outer = ring("disc", 0.06, 0.1, 0.12, elements);
  HexBody body;
  body.name = "disc";
  body.mesh = hexahedra_of(outer);
  body.materials = outer.materials;
  for (std::size_t node = 0; node < body.mesh.nodes.size(); ++node) {
    const Vec3& at = body.mesh.nodes[node];
    if (std::hypot(at.x, at.z) > 0.11) continue;
    const auto number = static_cast<std::int32_t>(node);
    body.mesh.node_sets["bore"].push_back(number);
    if (at.x > 0 && at.z > 0) body.mesh.node_sets["quarter"].push_back(number);
    if (at.x < 0) body.mesh.node_sets["half"].push_back(number);
  }
  mesh.add(std::move(body));
  return mesh;
}

TEST(BodyTie, MustGoAroundAnAxleThatItMayCoverInPart) {
  for (const int elements : {40, 64}) {
    const Mesh mesh = ring_on_ring(elements);
    EXPECT_EQ(refusal(mesh, {0, "bore", "body.x.axle", 0, "top", false}), "") << elements;
    for (const char* set : {"quarter", "half"}) {
      const std::string text = refusal(mesh, {0, set, "body.x.axle", 0, "top", false});
      EXPECT_EQ(text.find(std::string("body.x.axle = \"") + set + "\": its faces go "), 0U) << text;
      EXPECT_NE(text.find(" % of the way around the axle, at least 95 % are needed"), std::string::npos)
          << text;
    }
  }
}

/// A layer of 2 mm, whose upper nodes would move down by 3 mm.
TEST(BodyTie, RefusesElementsThatMovedNodesFold) {
  Mesh mesh = block_on_body(5, 12, -0.003);
  for (Vec3& at : mesh.bodies[0].mesh.nodes) at.z = std::max(at.z, 0.001);
  const std::string folded = refusal(mesh, {0, "top", "body.x.set", 0, "bottom", true});
  EXPECT_NE(folded.find("body.x.set = \"top\""), std::string::npos) << folded;
  EXPECT_NE(folded.find("up to 3.000 mm onto the faces of the upper, which folds element "),
            std::string::npos)
      << folded;
  EXPECT_NE(folded.find("origin_z"), std::string::npos) << folded;
}

TEST(BodyTie, LeavesNodesWithinTheDigitsOfAFile) {
  Mesh mesh = block_on_body(12, 5, 1e-9);
  tie_body(mesh, {0, "top", "body.x.set", 0, "bottom", true});
  EXPECT_TRUE(mesh.blocks[0].node_shift.empty());
}

}  // namespace
}  // namespace tread
