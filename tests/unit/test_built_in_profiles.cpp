// Profiles of the standards: section constants, listed places, tangents, and their meshes.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.hpp"
#include "core/geometry/built_in_profiles.hpp"
#include "core/geometry/section_constants.hpp"
#include "core/geometry/touching.hpp"
#include "core/mesh/rail_section.hpp"
#include "core/mesh/wheel_section.hpp"
#include "core/millimetre.hpp"
#include "io/scene/schema.hpp"
#include "tests/curve_kinks.hpp"
#include "tests/section_quality.hpp"

namespace tread {
namespace {

using samples::largest_kink;
using samples::smallest_square;
using samples::worst_quality;

double z_at(const PlaneCurve& curve, double y) {
  return curve.at(curve.at_x(y * mm)).position.y / mm;
}

struct Standard {
  const char* name;
  double height, area, mass, vertical, lateral;  // [mm, cm2, kg/m, cm4, cm4]
  double tolerance;                              // [-]
};

TEST(BuiltInRails, SectionConstantsAreThoseOfTheStandard) {
  // Masses with 7850 kg/m3. [GB 2585; EN 13674-1:2011, annex A]
  for (const Standard& rail : {Standard{"CN60", 176, 77.45, 60.80, 3217, 524, 1.5e-3},
                               Standard{"60E1", 172, 76.70, 60.21, 3038.3, 512.3, 5e-4},
                               Standard{"60E2", 172, 76.48, 60.03, 3021.5, 510.5, 5e-4},
                               Standard{"49E1", 149, 62.92, 49.39, 1816, 319.1, 2e-3}}) {
    SCOPED_TRACE(rail.name);
    const RailProfile profile = built_in_rail(rail.name);
    const SectionConstants c = section_constants(profile);
    EXPECT_DOUBLE_EQ(profile.height, rail.height * mm);
    EXPECT_NEAR(c.area / (rail.area * 1e-4), 1, rail.tolerance);
    EXPECT_NEAR(7850 * c.area / rail.mass, 1, rail.tolerance);
    EXPECT_NEAR(c.vertical / (rail.vertical * 1e-8), 1, rail.tolerance);
    EXPECT_NEAR(c.lateral / (rail.lateral * 1e-8), 1, rail.tolerance);
    EXPECT_LT(largest_kink(profile.running), 1e-12);
    EXPECT_LT(largest_kink(profile.lower), 1e-12);
    EXPECT_NEAR(norm(profile.running.at(profile.running.at_x(0)).position), 0, 1e-12);
  }
}

TEST(BuiltInRails, HeadsMeetTheListedDimensions) {
  const PlaneCurve e60 = built_in_rail("60E1").running, e49 = built_in_rail("49E1").running;
  const auto width = [](const PlaneCurve& curve, double depth) {
    const double middle = curve.at_x(0);
    const auto below = [&](const CurvePoint& p) { return -depth * mm - p.position.y; };
    return 2 * curve.at(curve.first(middle, curve.length(), below)).position.x / mm;
  };
  EXPECT_NEAR(width(e60, 14.3), 72, 1e-3);
  EXPECT_NEAR(width(e49, 14), 67, 0.01);  // within the corner's arc, which ends at 14.1 mm
  // Joints of 60E1's arcs: 20.456 and 52.053 mm apart.
  const auto joints = e60.joints(0, e60.length());
  ASSERT_EQ(joints.size(), 6U);
  EXPECT_NEAR(e60.at(joints[3]).position.x / mm, 20.456 / 2, 1e-3);
  EXPECT_NEAR(e60.at(joints[4]).position.x / mm, 52.053 / 2, 1e-3);
  EXPECT_THROW(built_in_rail("60E3"), std::invalid_argument);
}

TEST(S1002, PassesThroughThePlacesOfTheStandard) {
  const PlaneCurve curve = built_in_wheel("S1002").surface;
  EXPECT_NEAR(curve.start().x, -70 * mm, 1e-12);
  EXPECT_NEAR(curve.end().x, 60 * mm, 1e-12);
  EXPECT_NEAR(z_at(curve, 0), 0, 1e-9);
  EXPECT_NEAR(z_at(curve, -55), 28, 1e-6);  // the flange's tip
  EXPECT_NEAR(z_at(curve, 60), 1.364323640 - 60.0 / 15, 1e-4);
  EXPECT_NEAR(z_at(curve, -26), 2.742, 5e-3);
  EXPECT_LT(largest_kink(curve), 1e-5);  // the equations' ten digits
  EXPECT_THROW(built_in_wheel("S1003"), std::invalid_argument);
}

SectionSize size_of(double surface, double coarse, double centre) {
  SectionSize size;
  size.surface = surface * mm;
  size.coarse = coarse * mm;
  size.band_centre = centre;
  size.band_half_width = std::max(14.0, 6 * surface) * mm;
  return size;
}

TEST(BuiltInProfiles, CanBeStatedInScenes) {
  const auto states = [](const char* key, std::string_view name) {
    const std::vector<std::string> allowed = find_key(key)->allowed;
    return std::find(allowed.begin(), allowed.end(), name) != allowed.end();
  };
  for (const std::string_view name : kBuiltInRails)
    EXPECT_TRUE(states("rail.profile", name) && states("rail.section", name)) << name;
  for (const std::string_view name : kBuiltInWheels) EXPECT_TRUE(states("wheel.profile", name)) << name;
}

TEST(BuiltInPairs, AreMeshedWhereTheyTouch) {
  for (const auto rail_name : kBuiltInRails)
    for (const auto wheel_name : kBuiltInWheels)
      for (const double offset : {0.0, 3.5, 9.0}) {
        const RailProfile rail = built_in_rail(std::string(rail_name));
        const WheelProfile wheel = built_in_wheel(std::string(wheel_name));
        const Touching place = touching(rail.running, 1.0 / 40, wheel.surface, offset * mm);
        EXPECT_LT(std::abs(place.slope), 0.12);
        for (const double h : {6.0, 4.0, 2.2}) {
          SCOPED_TRACE(testing::Message() << wheel_name << " on " << rail_name << ", offset " << offset
                                          << " mm, " << h << " mm");
          const double coarse = std::min(12.0, 10 * h / 2.2);
          const RailSections sections =
              make_rail_sections(rail, 1.0 / 40, size_of(h, coarse, place.on_rail.x));
          EXPECT_GT(worst_quality(sections.cap), 0.45);
          EXPECT_GT(worst_quality(sections.base), 0.75);
          EXPECT_GT(smallest_square(sections.cap), 0.65 * h * mm);
          EXPECT_GT(smallest_square(sections.base), 6.5 * mm);
          const double meshed = area_moments(sections.cap).area + area_moments(sections.base).area;
          EXPECT_NEAR(meshed / section_constants(rail).area, 1, 9e-3);
          WheelShape shape;
          shape.lateral_offset = offset * mm;
          const WheelSections parts = make_wheel_sections(wheel, shape, size_of(h, 1.4 * coarse, place.y));
          EXPECT_GT(worst_quality(parts.tread), 0.33);
          EXPECT_GT(smallest_square(parts.tread), 0.8 * h * mm);
        }
      }
}

TEST(Touching, OfTwoCirclesLiesOnTheLineOfTheirCentres) {
  // A concave wheel of 400 mm on a head of 300 mm: the vertical gap is least where both slopes are alike.
  const PlaneCurve head = crowned(60 * mm, 0.3).surface;
  PlaneCurve hollow({-60 * mm, 0.4 - std::sqrt(0.16 - 3.6e-3)});
  hollow.arc_to({60 * mm, 0.4 - std::sqrt(0.16 - 3.6e-3)}, {0, 0.4});
  for (const double offset : {-4 * mm, 0.0, 7 * mm}) {
    // y / 0.3 = (y + offset) / 0.4 for the slopes of a circle and of one that curves less.
    const Touching place = touching(head, 0, hollow, offset);
    EXPECT_NEAR(place.y, 3 * offset, 2e-5);
    EXPECT_NEAR(place.wheel_y, 4 * offset, 2e-5);
    EXPECT_NEAR(place.slope, -std::tan(std::asin(place.y / 0.3)), 1e-4);
  }
  // An inclined head touches a cylinder at its highest line.
  const Touching inclined = touching(head, 1.0 / 40, crowned(80 * mm, 0).surface, 0);
  EXPECT_NEAR(inclined.on_rail.x, 0.3 * std::sin(std::atan(1.0 / 40)), 2e-5);
  EXPECT_THROW(touching(head, 0, hollow, 200 * mm), InputError);
}

}  // namespace
}  // namespace tread
