#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "core/geometry/plane_curve.hpp"
#include "core/geometry/point_scatter.hpp"
#include "core/geometry/profiles.hpp"
#include "core/millimetre.hpp"
#include "tests/curve_kinks.hpp"
#include "tests/refusal.hpp"

namespace tread {
namespace {

using samples::largest_kink;

/// Expects that tangents are unit vectors and agree with central differences of the position away from
/// joints.
void expect_consistent(const PlaneCurve& curve) {
  std::mt19937 generator(7);
  std::uniform_real_distribution<double> anywhere(1e-4, curve.length() - 1e-4);
  for (int i = 0; i < 500; ++i) {
    const double s = anywhere(generator), step = 2e-7;
    if (!curve.joints(s - step, s + step).empty()) continue;
    const CurvePoint point = curve.at(s);
    EXPECT_NEAR(norm(point.tangent), 1, 1e-14);
    const Point2 difference = (1 / (2 * step)) * (curve.at(s + step).position - curve.at(s - step).position);
    EXPECT_NEAR(cross(difference, point.tangent), 0, 1e-8) << "s = " << s;
    EXPECT_NEAR(norm(difference), 1, 1e-8) << "s = " << s;
  }
}

std::vector<Point2> outline(const RailProfile& rail) {
  const double z_join = rail.lower.start().y;
  const auto below = [&](const CurvePoint& point) { return z_join - point.position.y; };
  const double length = rail.running.length();
  const double right = rail.running.first(length / 2, length, below);
  const double left = rail.running.first(length / 2, 0, below);
  std::vector<Point2> clockwise;
  constexpr int count = 20000;
  clockwise.reserve(2 * count);
  for (int i = 0; i < count; ++i)
    clockwise.push_back(rail.running.at(left + (right - left) * i / count).position);
  for (int i = 0; i < count; ++i)
    clockwise.push_back(rail.lower.at(rail.lower.length() * i / count).position);
  for (int i = 0; i < count; ++i) {
    const Point2 right_half = rail.lower.at(rail.lower.length() * (count - i) / count).position;
    clockwise.push_back({-right_half.x, right_half.y});
  }
  std::reverse(clockwise.begin(), clockwise.end());
  return clockwise;
}

TEST(Cn60, SectionConstantsAreThoseOfTheStandard) {
  const AreaMoments m = polygon_moments(outline(cn60()));
  EXPECT_NEAR(m.area / 77.45e-4, 1, 1e-3);
  EXPECT_NEAR((m.centroid.y + 0.176) / 81.17e-3, 1, 1e-3);
  EXPECT_NEAR(m.centroid.x, 0, 1e-9);
  EXPECT_NEAR(m.yy / 3217e-8, 1, 1e-3);
  EXPECT_NEAR(m.xx / 524e-8, 1, 1.5e-3);
}

TEST(Cn60, CurvesAreTangentContinuousAndConsistent) {
  const RailProfile rail = cn60();
  EXPECT_LT(largest_kink(rail.running), 1e-12);
  EXPECT_LT(largest_kink(rail.lower), 1e-12);
  expect_consistent(rail.running);
  expect_consistent(rail.lower);
  const CurvePoint crown = rail.running.at(rail.running.at_x(0));
  EXPECT_NEAR(crown.position.y, 0, 1e-15);
  EXPECT_NEAR(crown.tangent.y, 0, 1e-12);
}

TEST(Cn60, HeadIsAsWideAsTheDrawing) {
  const RailProfile rail = cn60();
  const double length = rail.running.length();
  const double at_drawing_depth = rail.running.first(
      length / 2, length, [](const CurvePoint& point) { return -14.2 * mm - point.position.y; });
  EXPECT_NEAR(2 * rail.running.at(at_drawing_depth).position.x, 70.8 * mm, 0.02 * mm);
  double widest = 0, web = 1;
  for (int i = 0; i <= 10000; ++i) {
    const Point2 p = rail.lower.at(rail.lower.length() * i / 10000).position;
    widest = std::max(widest, p.y > -0.05 ? p.x : 0);
    if (p.y > -0.12 && p.y < -0.06) web = std::min(web, p.x);
  }
  EXPECT_NEAR(2 * web, 16.5 * mm, 1e-6);
  EXPECT_NEAR(2 * widest, 73 * mm, 0.3 * mm);  // the R3 rounding takes the sharp corner's last 0.1 mm a side
}

TEST(Lma, PassesThroughTheListedJunctions) {
  const PlaneCurve curve = lma().surface;
  const Point2 listed[] = {{-70, 6.619},      {-62.308, 24.659}, {-55.540, 27.901},
                           {-38.746, 15.007}, {-28.436, 3.322},  {-10.750, 0.499},
                           {4.254, -0.126},   {30.000, -0.770},  {65.000, -3.103}};
  // The tolerance is 5 um: the listed R14-R90 junction lies 4 um off both of its own circles.
  std::vector<double> junctions = curve.joints(0, curve.length());
  junctions.insert(junctions.begin(), 0.0);
  junctions.push_back(curve.length());
  ASSERT_EQ(junctions.size(), std::size(listed));
  for (std::size_t i = 0; i < junctions.size(); ++i) {
    const Point2 p = curve.at(junctions[i]).position;
    EXPECT_NEAR(p.x, listed[i].x * mm, 5e-6) << "junction " << i;
    EXPECT_NEAR(p.y, listed[i].y * mm, 5e-6) << "junction " << i;
  }
}

TEST(Lma, IsTangentExceptAtTheConeBreak) {
  const PlaneCurve curve = lma().surface;
  EXPECT_LT(largest_kink(curve, 0, curve.at_x(29 * mm)), 1e-12);
  EXPECT_NEAR(largest_kink(curve, curve.at_x(29 * mm), curve.length()),
              std::atan(1.0 / 15) - std::atan(1.0 / 40), 1e-4);
  expect_consistent(curve);
}

TEST(Lma, NominalPointAndFlangeTip) {
  const PlaneCurve curve = lma().surface;
  const CurvePoint nominal = curve.at(curve.at_x(0));
  EXPECT_NEAR(nominal.position.y, 0, 1e-15);
  EXPECT_NEAR(nominal.tangent.y / nominal.tangent.x, -0.03446, 1e-5);
  const double tip = curve.first(0, curve.length(), [](const CurvePoint& point) { return -point.tangent.y; });
  EXPECT_NEAR(curve.at(tip).position.y, 28.025 * mm, 2e-6);
  for (const double y : {5 * mm, 15 * mm, 29 * mm}) {
    const Point2 t = curve.at(curve.at_x(y)).tangent;
    EXPECT_NEAR(t.y / t.x, -0.025, 1e-12);
  }
}

TEST(CurveThrough, ReproducesAParabolaAndIsC1) {
  std::vector<double> x, y;
  for (int i = 0; i <= 40; ++i) {
    x.push_back(-0.02 + 1e-3 * i + 2e-4 * std::sin(1.7 * i));
    y.push_back(3 * x.back() * x.back() - 0.1 * x.back());
  }
  const PlaneCurve curve = curve_through(x, y, "test");
  EXPECT_TRUE(curve.joints(0, curve.length()).empty());
  for (double at = -0.0195; at < 0.0195; at += 7e-4) {
    const CurvePoint point = curve.at(curve.at_x(at));
    EXPECT_NEAR(point.position.y, 3 * at * at - 0.1 * at, 1e-14);
    EXPECT_NEAR(point.tangent.y / point.tangent.x, 6 * at - 0.1, 1e-11);
  }
}

TEST(CurveThrough, ConvergesToASampledProfile) {
  const PlaneCurve exact = lma().surface;
  double previous = 0;
  for (const int count : {81, 161}) {
    std::vector<double> y, z;
    for (int i = 0; i < count; ++i) {
      const Point2 p = exact.at(exact.at_x(-28 * mm + 56 * mm * i / (count - 1))).position;
      y.push_back(p.x);
      z.push_back(p.y);
    }
    const WheelProfile wheel = wheel_from_table(y, z);
    double error = 0;
    for (double at = -27 * mm; at < 27 * mm; at += 0.05 * mm)
      error = std::max(error, std::abs(wheel.surface.at(wheel.surface.at_x(at)).position.y -
                                       exact.at(exact.at_x(at)).position.y));
    EXPECT_LT(error, 1e-7);
    if (previous > 0) {
      EXPECT_LT(error, 0.5 * previous);
    }
    previous = error;
  }
}

TEST(CurveThrough, RefusesTablesThatAreNotProfiles) {
  const std::vector<double> z = {0, 0, 0, 0};
  EXPECT_THROW(curve_through(std::vector<double>{0, 1, 1, 2}, z, "p"), InputError);
  EXPECT_THROW(curve_through(std::vector<double>{0, 1, 2, std::nan("")}, z, "p"), InputError);
  EXPECT_THROW(curve_through(std::vector<double>{0, 1}, std::vector<double>{0, 1}, "p"), InputError);
  EXPECT_THROW(wheel_from_table(std::vector<double>{1, 2, 3, 4}, z), InputError);
  EXPECT_THROW(rail_with_head(std::vector<double>{-0.01, 0, 0.01, 0.02}, z, cn60()), InputError);
  EXPECT_THROW(crowned(0.06, 0.02), InputError);
}

/// Table of y and z over the head of a rail, shifted.
std::pair<std::vector<double>, std::vector<double>> sampled_head(const RailProfile& rail, Point2 shift) {
  std::vector<double> y, z;
  const double length = rail.running.length();
  const double start = rail.running.at_x(-35.3 * mm), end = length - start;
  for (int i = 0; i <= 300; ++i) {
    const Point2 p = rail.running.at(start + (end - start) * i / 300).position;
    y.push_back(p.x + shift.x);
    z.push_back(p.y + shift.y);
  }
  return {y, z};
}

TEST(RailWithHead, RecoversTheProfileItWasSampledFrom) {
  const RailProfile exact = cn60();
  const auto [y, z] = sampled_head(exact, {0, 0.5});
  const RailProfile rail = rail_with_head(y, z, cn60());
  for (double at = -35 * mm; at < 35 * mm; at += 0.1 * mm)
    EXPECT_NEAR(rail.running.at(rail.running.at_x(at)).position.y,
                exact.running.at(exact.running.at_x(at)).position.y, std::abs(at) < 24.5 * mm ? 3e-8 : 2e-5);
}

TEST(RailWithHead, SuggestsTheShiftInPlaceOfTheStatedOne) {
  const auto head = sampled_head(cn60(), {5 * mm, 0});
  const auto shifted = [&] { rail_with_head(head.first, head.second, cn60(), 2 * mm); };
  samples::expect_part(samples::refusal<InputError>(shifted),
                       "its own middle is y = 5.0 mm, which rail.profile_shift = \"-3.0 mm\" corrects");
}

TEST(HeadLean, TellsAHeadMeasuredInTheTrack) {
  const auto head = [](double slope, double middle) {
    auto [y, z] = sampled_head(cn60(), {0, 0});
    for (std::size_t i = 0; i < y.size(); ++i) {
      const double across = y[i];
      y[i] = across - slope * z[i] + middle;
      z[i] += slope * across;
    }
    return std::pair{y, z};
  };
  const auto lean = [&](double slope) {
    const auto [y, z] = head(slope, 0);
    return head_lean(curve_through(y, z, "head"), 0);
  };
  EXPECT_NEAR(lean(1.0 / 40), 1.0 / 40, 1e-3);
  EXPECT_NEAR(lean(-1.0 / 20), -1.0 / 20, 1e-3);
  EXPECT_EQ(lean(0), 0);
  EXPECT_EQ(lean_hint(0), "");
  samples::expect_part(lean_hint(-0.05),
                       "1:20 to the field side: if it is a right rail, state rail.profile_m");
  const auto beside = [&] {
    const auto [y, z] = head(1.0 / 40, 7 * mm);
    rail_with_head(y, z, cn60());
  };
  samples::expect_part(samples::refusal<InputError>(beside),
                       "corrects; the head leans by 1:42 to the track's middle: if it was measured in the "
                       "track, state rail.inclination = 0");
}

TEST(Crowned, IsTheCircleItSays) {
  const PlaneCurve curve = crowned(60 * mm, 0.3).surface;
  for (double y = -30 * mm; y <= 30 * mm; y += mm)
    EXPECT_NEAR(curve.at(curve.at_x(y)).position.y, std::sqrt(0.09 - y * y) - 0.3, 1e-14);
  EXPECT_NEAR(curve.length(), 2 * 0.3 * std::asin(0.1), 1e-15);
  EXPECT_EQ(crowned(60 * mm, 0).surface.at(0.01).position.y, 0);
}

TEST(PointScatter, IsThatOfTheNoise) {
  std::mt19937 random(7);
  std::normal_distribution<double> noise(0, 1);
  for (const double deviation : {0.0, 0.3e-6, 5e-6}) {
    std::vector<double> y;
    std::vector<double> z;
    for (int i = 0; i < 600; ++i) {
      y.push_back((i == 0 ? 0 : y.back()) + (i % 3 + 1) * 0.1 * mm);
      const double radius = i < 300 ? 13 * mm : 300 * mm;  // a corner in curvature
      const double beside = y.back() - 60 * mm;
      z.push_back(beside * beside / (2 * radius) + deviation * noise(random));
    }
    EXPECT_NEAR(point_scatter(y, z).value(), deviation, 0.15 * deviation + 1e-12);
  }
  EXPECT_FALSE(point_scatter({1, 2, 3, 4}, {1, 2, 3, 4}));
  // Exact points so far apart that the arcs' own third differences are not small.
  const auto [y, z] = sampled_head(cn60(), {0, 0});
  std::vector<double> coarse_y, coarse_z;
  for (std::size_t i = 0; i < y.size(); i += 7) {
    coarse_y.push_back(y[i]);
    coarse_z.push_back(z[i]);
  }
  EXPECT_LT(point_scatter(coarse_y, coarse_z).value(), kRoughProfile);
}

}  // namespace
}  // namespace tread
