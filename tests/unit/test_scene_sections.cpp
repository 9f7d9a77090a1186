// Sections of a scene: fine columns under the patch, wherever that is; supports of the beam
// that goes on before the rail.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "core/geometry/built_in_profiles.hpp"
#include "core/millimetre.hpp"
#include "drivers/engine/model/sections.hpp"
#include "drivers/engine/start/rail_beam.hpp"
#include "tests/refusal.hpp"
#include "tests/tyre_scene.hpp"

namespace tread {
namespace {

Scene smooth(const std::vector<std::string>& overrides) {
  return read_scene(std::string(TREAD_SOURCE_DIR) + "/scenes/smooth.toml", overrides);
}

/// Widest column of a running surface within 7 mm of a place p [m].
double widest_about(const Section& section, double p) {
  double widest = 0;
  for (const SurfaceEdge& edge : section.surface) {
    const auto a = static_cast<std::size_t>(edge.node[0]);
    const auto b = static_cast<std::size_t>(edge.node[1]);
    if (section.p[b] < p - 7 * mm || section.p[a] > p + 7 * mm) continue;
    widest = std::max(widest, std::abs(section.p[b] - section.p[a]));
  }
  return widest;
}

/// Places: of the patch under load, by static runs on 3 mm.
TEST(SceneSections, FineColumnsLieUnderThePatch) {
  for (const auto& [offset, place] : {std::pair(-3.0, -16.9), {-2.0, -10.2}, {-1.5, -7.8}}) {
    const Scene scene = smooth({fmt::format("wheel.lateral_offset={} mm", offset), "rail.inclination=1:40"});
    const MeshSizes sizes = mesh_sizes(scene);
    EXPECT_LT(widest_about(rail_sections(scene, sizes).cap, place * mm), 1.3 * sizes.contact) << offset;
  }
}

TEST(SceneSections, FineColumnsOfATyreBesideTheMiddle) {
  const Scene scene = samples::tyre_scene({"wheel.lateral_offset=24 mm", "scene.element_size=2 mm"});
  const MeshSizes sizes = mesh_sizes(scene);
  EXPECT_LT(widest_about(box_rail_section(scene, sizes), -24 * mm), 1.3 * sizes.contact);
  EXPECT_LT(widest_about(tyre_section(scene, sizes), -24 * mm), 1.3 * sizes.contact);
}

/// The message with which a wheel's place over the rail is refused; empty where it is accepted.
std::string refusal(const Scene& scene) {
  return samples::refusal<InputError>([&] { rail_sections(scene, mesh_sizes(scene)); });
}

TEST(SceneSections, AWheelOnItsFlangeIsRefused) {
  for (const char* offset : {"-5", "-10", "-20", "-25", "-30"}) {
    const std::string message = refusal(smooth({fmt::format("wheel.lateral_offset={} mm", offset)}));
    EXPECT_NE(message.find(fmt::format(
                  "wheel.lateral_offset = {}.00 mm: the wheel's flange stands on the rail", offset)),
              std::string::npos)
        << message;
    EXPECT_NE(message.find("positive to the field side"), std::string::npos) << message;
  }
  for (const char* offset : {"-2.5", "0", "30"})
    EXPECT_EQ(refusal(smooth({fmt::format("wheel.lateral_offset={} mm", offset)})), "") << offset;
}

/// Tables whose y = 0 lies on the root of the flange, on its tip and at the side of the tread, and whose z =
/// 0 lies elsewhere.
TEST(SceneSections, TheHeightOfATreadIsThatOfItsOwnTable) {
  const PlaneCurve surface = built_in_wheel("LMA").surface;
  for (const double shift : {30 * mm, 50 * mm, -30 * mm}) {
    Scene scene = smooth({});
    for (double y = -69.5 * mm; y < 60 * mm; y += 0.5 * mm) {
      scene.wheel->profile_y.push_back(y + shift);
      scene.wheel->profile_z.push_back(surface.at(surface.at_x(y)).position.y - 0.1);
    }
    scene.wheel->lateral_offset += shift;
    EXPECT_EQ(refusal(scene), "") << shift;
  }
}

/// A track goes on before the rail, not on a stretch of it that has no fastenings.
TEST(SceneSections, BeamHasNoMoreFasteningsThanTheRail) {
  for (const auto& [first, before] : std::vector<std::pair<std::string, int>>{{"0.325 m", 4}, {"2 m", 1}}) {
    const Scene scene = smooth({"fastenings.first=" + first, "fastenings.count=10"});
    int on_rail = 0;
    int beyond = 0;
    for (const BeamSupport& support : rail_supports(scene, 4))
      ++(support.x < -scene.rail->origin ? beyond : on_rail);
    EXPECT_EQ(on_rail, 10 * scene.fastenings->columns) << first;
    EXPECT_EQ(beyond, before * scene.fastenings->columns) << first;
  }
}

}  // namespace
}  // namespace tread
