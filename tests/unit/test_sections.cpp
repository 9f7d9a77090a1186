#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/corrugation.hpp"
#include "core/error.hpp"
#include "core/mesh/rail_section.hpp"
#include "core/mesh/structured.hpp"
#include "core/mesh/wheel_section.hpp"
#include "core/millimetre.hpp"
#include "drivers/engine/model/sections.hpp"
#include "kernels/blocks/internal_force.hpp"
#include "kernels/solver/stable_step.hpp"
#include "tests/refusal.hpp"
#include "tests/section_quality.hpp"
#include "tests/swept_samples.hpp"

namespace tread {
namespace {

using samples::node;
using samples::smallest_square;
using samples::worst_quality;

SectionSize size_of(double surface, double coarse) {
  SectionSize size;
  size.surface = surface * mm;
  size.coarse = coarse * mm;
  return size;
}

/// Stable step of the section swept at `pitch` [m], over the time in which a pressure wave crosses the pitch:
/// 1 if the section's cells do not matter.
double step_by_pitch(const Section& section, double pitch) {
  Mesh mesh;
  mesh.add(make_swept_block("piece", Sweep::extruded, section, samples::materials(), 0, {{6, pitch, 0}}));
  const InternalForce force(mesh);
  AlignedVector<double> mass(static_cast<std::size_t>(mesh.slots));
  force.lumped_mass(mass.data());
  AlignedVector<double> inverse_mass(3 * mass.size(), 0.0);
  for (std::int64_t slot = 0; slot < mesh.slots; ++slot)
    for (int c = 0; c < 3; ++c) {
      const double m = mass[static_cast<std::size_t>(slot)];
      if (m > 0) inverse_mass[static_cast<std::size_t>(dof(slot, c))] = 1 / m;
    }
  const auto apply = [&](const double* u, double* f) { force.apply(u, f); };
  const Material steel = samples::steel();
  const double wave = std::sqrt((steel.lame_lambda() + 2 * steel.shear_modulus()) / steel.density);  // [m/s]
  return stable_step(highest_frequency(apply, inverse_mass).omega, 0) * wave / pitch;
}

/// Expects that every edge of the coarse path is straight, starts and ends at fine nodes, and that all fine
/// nodes lie on the edges.
void expect_nested(const Section& fine, const std::vector<int>& fine_path, const Section& coarse,
                   const std::vector<int>& coarse_path) {
  std::size_t at = 0;
  for (std::size_t k = 1; k < coarse_path.size(); ++k) {
    const Point2 a = node(coarse, coarse_path[k - 1]), b = node(coarse, coarse_path[k]);
    const Point2 along = (1 / norm(b - a)) * (b - a);
    ASSERT_LT(norm(node(fine, fine_path[at]) - a), 1e-12);
    do {
      ASSERT_LT(++at, fine_path.size());
      const Point2 d = node(fine, fine_path[at]) - a;
      ASSERT_LT(std::abs(cross(along, d)), 1e-12);
      ASSERT_GT(dot(along, d), 0);
    } while (norm(node(fine, fine_path[at]) - b) > 1e-12);
  }
  EXPECT_EQ(at + 1, fine_path.size());
}

/// Distance of a point from a curve of increasing x.
double distance(const PlaneCurve& curve, Point2 point) {
  double s = curve.at_x(point.x);
  for (int i = 0; i < 30; ++i) {
    const CurvePoint c = curve.at(s);
    s = std::clamp(s + dot(point - c.position, c.tangent), 0.0, curve.length());
  }
  return norm(point - curve.at(s).position);
}

struct SurfaceError {
  double in_band = 0, elsewhere = 0;  // distance of the Hermite curve from the profile [m]
};

/// Checks order, orientation and unit tangents of the running surface; `back` maps it into the profile's
/// axes.
template <class Back>
SurfaceError check_surface(const Section& section, const PlaneCurve& profile, const SectionSize& size,
                           Back back) {
  SurfaceError error;
  for (std::size_t k = 0; k < section.surface.size(); ++k) {
    const SurfaceEdge& edge = section.surface[k];
    if (k > 0) {
      EXPECT_EQ(edge.node[0], section.surface[k - 1].node[1]);
    }
    const Point2 a = node(section, edge.node[0]), b = node(section, edge.node[1]);
    EXPECT_GT(b.x, a.x);
    Point2 middle;
    for (const int n : section.quads[static_cast<std::size_t>(edge.quad)])
      middle = middle + 0.25 * node(section, n);
    EXPECT_LT(cross(b - a, middle - a), 0) << "the body lies on the right of the edge";
    Point2 t[2];
    for (std::size_t end = 0; end < 2; ++end) {
      t[end] = {edge.tangent[end][0], edge.tangent[end][1]};
      EXPECT_NEAR(norm(t[end]), 1, 1e-14);
      const Point2 position = end == 0 ? a : b, inward = end == 0 ? t[0] : -1.0 * t[1];
      EXPECT_LT(distance(profile, back(position)), 1e-12);
      EXPECT_LT(distance(profile, back(position + 1e-6 * inward)), 1e-10) << "tangent against the profile";
    }
    const double chord = norm(b - a);
    for (double x = 0.05; x < 1; x += 0.05) {
      const Point2 point = (1 - x) * (1 - x) * (1 + 2 * x) * a + x * x * (3 - 2 * x) * b +
                           chord * ((x * (1 - x) * (1 - x)) * t[0] - (x * x * (1 - x)) * t[1]);
      const bool in_band = std::abs(a.x - size.band_centre) < size.band_half_width &&
                           std::abs(b.x - size.band_centre) < size.band_half_width;
      double& worst = in_band ? error.in_band : error.elsewhere;
      worst = std::max(worst, distance(profile, back(point)));
    }
  }
  return error;
}

Point2 turned(Point2 a, double angle) {
  return {std::cos(angle) * a.x - std::sin(angle) * a.y, std::sin(angle) * a.x + std::cos(angle) * a.y};
}

struct SizeCase {
  double surface, coarse;  // [mm]
};

const SizeCase kSizes[] = {{1, 6}, {1.1, 8}, {1.5, 10}, {2.2, 9}, {3, 7}, {4, 9}, {6, 6}, {6, 10}};

TEST(RailSection, IsWellShapedAndNestedForAllSizes) {
  for (const auto& [surface, coarse] : kSizes)
    for (const double inclination : {0.0, 1.0 / 40, 1.0 / 20, -1.0 / 40}) {
      SCOPED_TRACE(testing::Message() << surface << " / " << coarse << " mm, inclination " << inclination);
      const SectionSize size = size_of(surface, coarse);
      const RailSections rail = make_rail_sections(cn60(), inclination, size);
      EXPECT_GT(worst_quality(rail.cap), 0.5);
      EXPECT_GT(worst_quality(rail.base), 0.75);
      // Columns of 4 mm follow the rounded corners whatever the size. CornersLeaveTheStepToThePitch tests the
      // cost of coarse cells there.
      EXPECT_GT(smallest_square(rail.cap), (surface <= 2.2 ? 0.88 : 0.72) * size.surface);
      EXPECT_GT(smallest_square(rail.base), 4 * mm);
      expect_nested(rail.cap, rail.cap.paths.at("tie"), rail.base, rail.base.paths.at("tie"));
      const double angle = std::atan(inclination);
      const SurfaceError error =
          check_surface(rail.cap, cn60().running, size, [&](Point2 a) { return turned(a, -angle); });
      if (surface <= 2.2) {
        EXPECT_LT(error.in_band, 1e-8);
        EXPECT_LT(error.elsewhere, 1e-6);  // R13
      }
    }
}

TEST(RailSection, CornersLeaveTheStepToThePitch) {
  for (const auto& [surface, coarse] : kSizes) {
    const Section cap = make_rail_sections(cn60(), 0.025, size_of(surface, coarse)).cap;
    EXPECT_GT(step_by_pitch(cap, surface * mm), 0.7) << surface << " / " << coarse << " mm";
  }
  struct Quality {
    double surface, coarse, band_half_width;  // [mm]
  };
  for (const auto& [surface, coarse, band] : {Quality{2.2, 10, 14}, {1.6, 8, 16}, {1.1, 8, 16}}) {
    SectionSize size = size_of(surface, coarse);
    size.band_centre = -2 * mm;
    size.band_half_width = band * mm;
    const Section cap = make_rail_sections(cn60(), 0.025, size).cap;
    EXPECT_GT(step_by_pitch(cap, size.surface), 0.98) << surface << " mm";
  }
}

TEST(RailSection, HasTheSectionConstantsOfTheRail) {
  for (const auto& [surface, coarse] : kSizes) {
    const RailSections rail = make_rail_sections(cn60(), 0, size_of(surface, coarse));
    const AreaMoments parts[] = {area_moments(rail.cap), area_moments(rail.base)};
    const AreaMoments m = sum(parts);
    EXPECT_NEAR(m.area / 77.45e-4, 1, 6e-3);
    EXPECT_NEAR(m.yy / 3217e-8, 1, 4e-3);
    EXPECT_NEAR(m.xx / 524e-8, 1, 4e-3);
    EXPECT_NEAR(m.centroid.y + 0.176, 81.17 * mm, 0.3 * mm);
  }
}

TEST(RailSection, ElementBudget) {
  const RailSections draft = make_rail_sections(cn60(), 0.025, size_of(2.2, 9));
  EXPECT_LT(draft.cap.quads.size() + draft.base.quads.size(), 300u);
  const RailSections paper = make_rail_sections(cn60(), 0.025, size_of(1.1, 8));
  EXPECT_LT(paper.cap.quads.size() + paper.base.quads.size(), 520u);
}

TEST(RailSection, LeansTowardsTheTrackCentreAboutTheCrown) {
  const RailSections rail = make_rail_sections(cn60(), 0.025, size_of(2.2, 9));
  const auto& foot = rail.base.paths.at("foot");
  const Point2 first = node(rail.base, foot.front()), last = node(rail.base, foot.back());
  EXPECT_NEAR((last.y - first.y) / (last.x - first.x), 0.025, 1e-12);
  EXPECT_NEAR(0.5 * (first.x + last.x), 0.176 * std::sin(std::atan(0.025)), 1e-9);
  EXPECT_NEAR(last.x - first.x, 0.150, 1e-3);
  for (std::size_t i = 1; i < foot.size(); ++i)
    EXPECT_GT(node(rail.base, foot[i]).x, node(rail.base, foot[i - 1]).x);
  EXPECT_LT(distance(cn60().running, {0, 0}), 1e-12);
}

TEST(RailSection, ColumnsFollowTheBand) {
  for (const double surface : {1.1, 2.2, 3.0}) {
    const SectionSize size = size_of(surface, 9);
    const Section cap = make_rail_sections(cn60(), 0.025, size).cap;
    double previous = 0;
    for (const SurfaceEdge& edge : cap.surface) {
      const Point2 a = node(cap, edge.node[0]), b = node(cap, edge.node[1]);
      const double width = norm(b - a);
      if (std::abs(0.5 * (a.x + b.x) - size.band_centre) < size.band_half_width - size.surface) {
        EXPECT_GT(width, 0.9 * size.surface);
        EXPECT_LT(width, 1.25 * size.surface);
      }
      if (previous > 0) {
        EXPECT_LT(std::max(width / previous, previous / width), 1.45) << surface << " mm at " << a.x / mm;
      }
      previous = width;
    }
  }
}

TEST(RailSection, TakesAMeasuredHead) {
  const PlaneCurve exact = cn60().running;
  const double start = exact.at_x(-35.3 * mm), end = exact.length() - start;
  std::vector<double> y, z;
  for (int i = 0; i <= 400; ++i) {
    const Point2 p = exact.at(start + (end - start) * i / 400).position;
    y.push_back(p.x);
    z.push_back(p.y - 0.05 * mm * std::exp(-std::pow((p.x + 5 * mm) / (10 * mm), 2)));  // some wear
  }
  const RailProfile worn = rail_with_head(y, z, cn60());
  const SectionSize size = size_of(1.5, 9);
  const RailSections rail = make_rail_sections(worn, 0.025, size);
  EXPECT_GT(worst_quality(rail.cap), 0.5);
  expect_nested(rail.cap, rail.cap.paths.at("tie"), rail.base, rail.base.paths.at("tie"));
  const SurfaceError error =
      check_surface(rail.cap, worn.running, size, [](Point2 a) { return turned(a, -std::atan(0.025)); });
  EXPECT_LT(error.in_band, 4e-7);  // a table's R80-R300 transition need not fall on a node
}

TEST(WheelSection, IsWellShapedAndNestedForAllSizes) {
  for (const auto& [surface, coarse] : kSizes)
    for (const double offset : {-10.0, 2.85, 6.5, 20.0})
      for (const double diameter : {0.7, 0.86, 1.1}) {
        SCOPED_TRACE(testing::Message() << surface << " / " << coarse << " mm, offset " << offset
                                        << " mm, diameter " << diameter << " m");
        const SectionSize size = size_of(surface, coarse + 4);
        WheelShape shape;
        shape.lateral_offset = offset * mm;
        shape.diameter = diameter;
        shape.brake_ring_thickness = 23 * mm;
        for (const double web : {10.0, 64.0, 100.0}) {
          WheelShape plain = shape;
          plain.web_thickness = web * mm;
          plain.brake_ring_thickness = 0;
          const WheelSections sections = make_wheel_sections(lma(), plain, size);
          EXPECT_GT(worst_quality(sections.disc), 0.45) << web;
          EXPECT_GT(smallest_square(sections.disc), (web < 15 ? 4.5 : 8) * mm) << web;
        }
        const WheelSections wheel = make_wheel_sections(lma(), shape, size);
        EXPECT_GT(worst_quality(wheel.tread), 0.35);
        EXPECT_GT(worst_quality(wheel.disc), 0.6);
        EXPECT_GT(worst_quality(wheel.axle), 0.6);
        EXPECT_GT(smallest_square(wheel.tread), 0.86 * size.surface);
        EXPECT_GT(smallest_square(wheel.disc), 8 * mm);
        EXPECT_GT(smallest_square(wheel.axle), 14 * mm);
        expect_nested(wheel.tread, wheel.tread.paths.at("tie"), wheel.disc, wheel.disc.paths.at("tie_outer"));
        expect_nested(wheel.disc, wheel.disc.paths.at("tie_inner"), wheel.axle, wheel.axle.paths.at("tie"));
        const SurfaceError error = check_surface(wheel.tread, lma().surface, size, [&](Point2 a) {
          return Point2{a.x + shape.lateral_offset, a.y - shape.diameter / 2};
        });
        if (surface <= 2.2) {
          EXPECT_LT(error.in_band, offset < 0 ? 1.5e-7 : 1e-8);  // below 0 the band reaches into the R14 root
          EXPECT_LT(error.elsewhere, 1.5e-6);                    // flange
        }
      }
}

TEST(WheelSection, WebsOfAnyShapeAreWellShapedAndNested) {
  for (const double coarse : {9.0, 13.0, 18.0})
    for (const double diameter : {0.7, 0.86, 1.1})
      for (const double web : {12.0, 25.0, 60.0})
        for (const double offset : {-40.0, -15.0, 0.0, 40.0})
          for (const double wave : {-30.0, 12.0, 30.0}) {
            SCOPED_TRACE(testing::Message() << coarse << " mm, diameter " << diameter << " m, web " << web
                                            << ", offset " << offset << ", wave " << wave << " mm");
            WheelShape shape;
            shape.diameter = diameter;
            shape.web_thickness = web * mm;
            shape.web_offset = offset * mm;
            shape.web_wave = wave * mm;
            const double rim = 0.5 * diameter - 0.065;
            const bool steep = std::abs(wave) > 100 * (rim - 0.145);  // beyond 40 degrees
            if (steep) continue;
            const WheelSections wheel = make_wheel_sections(lma(), shape, size_of(2.2, coarse));
            EXPECT_GT(worst_quality(wheel.disc), 0.3);
            expect_nested(wheel.tread, wheel.tread.paths.at("tie"), wheel.disc,
                          wheel.disc.paths.at("tie_outer"));
            expect_nested(wheel.disc, wheel.disc.paths.at("tie_inner"), wheel.axle,
                          wheel.axle.paths.at("tie"));
          }
}

TEST(WheelSection, WebLeavesHubAndRimRadially) {
  WheelShape shape;
  shape.web_offset = 30 * mm;
  shape.web_wave = 20 * mm;
  EXPECT_NEAR(shape.web_line(0).p, -15 * mm, 1e-15);
  EXPECT_NEAR(shape.web_line(1).p, 15 * mm, 1e-15);
  EXPECT_NEAR(shape.web_line(0).slope, 0, 1e-15);
  EXPECT_NEAR(shape.web_line(1).slope, 0, 1e-15);
  shape.web_offset = 0;
  double largest = 0;
  for (int i = 0; i <= 1000; ++i) {
    const double share = 1e-3 * i;
    largest = std::max(largest, shape.web_line(share).p);
    EXPECT_NEAR(shape.web_line(share).p, -shape.web_line(1 - share).p, 1e-15);
    const double step = 1e-6;
    EXPECT_NEAR((shape.web_line(share + step).p - shape.web_line(share - step).p) / (2 * step),
                shape.web_line(share).slope, 1e-9);
  }
  EXPECT_NEAR(largest, 20 * mm, 1e-7);
  EXPECT_GT(shape.web_line(0.3).p, 0);  // to the field side near the hub
}

/// Points (y, r) around a web, in wheel coordinates [m].
struct WebPoints {
  std::vector<double> y, r;

  /// From faces about `middle`(r) at distances of `half`(r), both in the disc's middle plane [m].
  template <class Middle, class Half>
  WebPoints(double hub, double rim, const Middle& middle, const Half& half) {
    const double plane = 0.5 * (lma().surface.start().x + lma().surface.end().x);
    constexpr int kPoints = 60;
    for (const int side : {-1, 1})
      for (int i = 0; i <= kPoints; ++i) {
        const double share = static_cast<double>(side < 0 ? i : kPoints - i) / kPoints;
        r.push_back(hub + share * (rim - hub));
        y.push_back(plane + middle(r.back()) + side * half(r.back()));
      }
  }
  WebOutline outline() const { return {y, r}; }
};

TEST(WheelSection, OutlineOfAWebIsTheSameWeb) {
  WheelShape stated;
  stated.web_thickness = 28 * mm;
  stated.web_offset = 20 * mm;
  const double hub = 145 * mm, rim = 365 * mm;
  const auto share = [&](double r) { return (r - hub) / (rim - hub); };
  const WebPoints points(
      hub, rim, [&](double r) { return stated.web_line(share(r)).p; },
      [&](double r) {
        const double reach = std::max(0.0, 1 - std::min(r - hub, rim - r) / 0.025);
        return 14 * mm * std::hypot(1, stated.web_line(share(r)).slope / (rim - hub)) +
               8 * mm * reach * reach;
      });
  WheelShape drawn;
  drawn.web_outline = points.outline();
  EXPECT_NEAR(drawn.web_outline->least_thickness(), 28 * mm, 0.05 * mm);
  const SectionSize size = size_of(2.2, 13);
  const Section a = make_wheel_sections(lma(), stated, size).disc;
  const Section b = make_wheel_sections(lma(), drawn, size).disc;
  ASSERT_EQ(a.quads, b.quads);
  for (std::size_t i = 0; i < a.p.size(); ++i) EXPECT_NEAR(a.p[i], b.p[i], 0.02 * mm) << i;

  // The way round and the point to begin with do not matter, nor does a last point like the first.
  WebPoints turned = points;
  std::reverse(turned.y.begin(), turned.y.end());
  std::reverse(turned.r.begin(), turned.r.end());
  turned.y.push_back(turned.y.front());
  turned.r.push_back(turned.r.front());
  drawn.web_outline = turned.outline();
  EXPECT_EQ(make_wheel_sections(lma(), drawn, size).disc.p, b.p);
}

TEST(WheelSection, StraightFacesOfAnOutlineStayStraight) {
  const WebOutline cone({0, 0.02, 0.05, 0.03}, {0.15, 0.36, 0.36, 0.15});
  for (const double r : {0.15, 0.17, 0.255, 0.35}) {
    const double shift = 0.02 * (r - 0.15) / 0.21;
    EXPECT_NEAR(cone.at(r).gauge, shift, 1e-12) << r;
    EXPECT_NEAR(cone.at(r).field, 0.03 + shift, 1e-12) << r;
  }
}

TEST(WheelSection, DrawnWebsAreWellShapedAndNested) {
  for (const double coarse : {9.0, 13.0, 18.0})
    for (const double hub : {140.0, 150.0, 200.0})
      for (const double thin : {12.0, 20.0, 40.0})
        for (const double wave : {-20.0, 0.0, 20.0}) {
          SCOPED_TRACE(testing::Message() << coarse << ", hub " << hub << ", thin " << thin << ", " << wave);
          const double rim = 370;
          const WebPoints points(
              hub * mm, rim * mm,
              [&](double r) { return wave * mm * std::sin(3.1 * (r / mm - hub) / (rim - hub)); },
              [&](double r) {
                const double share = (r / mm - hub) / (rim - hub);
                return mm * (0.5 * thin + 15 * (2 * share - 1) * (2 * share - 1));
              });
          WheelShape shape;
          shape.web_outline = points.outline();
          const WheelSections wheel = make_wheel_sections(lma(), shape, size_of(2.2, coarse));
          EXPECT_GT(worst_quality(wheel.disc), 0.3);
          expect_nested(wheel.tread, wheel.tread.paths.at("tie"), wheel.disc,
                        wheel.disc.paths.at("tie_outer"));
          expect_nested(wheel.disc, wheel.disc.paths.at("tie_inner"), wheel.axle, wheel.axle.paths.at("tie"));
        }
}

TEST(WheelSection, OutlinesThatAreNoWebAreRefused) {
  const auto refused = [](const std::vector<double>& y, const std::vector<double>& r, const char* reason) {
    const auto make = [&] {
      WheelShape shape;
      shape.web_outline.emplace(y, r);
      make_wheel_sections(lma(), shape, size_of(2.2, 13));
    };
    samples::expect_part(samples::refusal<InputError>(make), reason);
  };
  refused({0, 0.03, 0.03, 0}, {0.15, 0.15, 0.36, 0.36}, "point 2 at r = 150 mm");
  refused({0, 0, 0, 0.03, 0.03}, {0.15, 0.14, 0.36, 0.36, 0.15}, "point 2 at r = 140 mm");
  refused({0, 0, 0.03, 0.03, 0.03}, {0.15, 0.36, 0.36, 0.2, 0.21}, "point 5 at r = 210 mm");
  refused({0, 0, 0, 0.03, 0.03}, {0.15, 0.2, 0.14, 0.36, 0.15}, "point 3 at r = 140 mm");
  refused({0, 0}, {0.15, 0.36}, "at least two points");
  refused({}, {}, "at least two points");
  refused({0, 0, 0, 0}, {0.15, 0.2, 0.3, 0.36}, "point 4 at r = 360 mm");
  refused({0, 0, 0.03, 0.03}, {0.15, 0.36, 0.35, 0.15}, "at the rim");
  refused({0, 0, 0.03, 0.03}, {0.15, 0.36, 0.36, 0.16}, "at the hub");
  refused({0, 0, 0.03, -0.03}, {0.15, 0.36, 0.36, 0.15}, "faces of the web meet");
  refused({0, 0, 0.03, 0.03}, {0.13, 0.36, 0.36, 0.13}, "hub's radius of 130.0 mm");
  refused({0, 0, 0.03, 0.03}, {0.15, 0.41, 0.41, 0.15}, "rim's radius of 410.0 mm");
  refused({0, 0, 0.2, 0.2}, {0.15, 0.36, 0.36, 0.15}, "least thickness is 200.0 mm");
  refused({0, 0, 0.006, 0.006}, {0.15, 0.36, 0.36, 0.15}, "least thickness is 6.0 mm");
  refused({0.09, 0, 0.03, 0.12}, {0.15, 0.36, 0.36, 0.15}, "ends at the hub");
}

TEST(WheelSection, FlangeLeavesTheStepToThePitch) {
  for (const double surface : {1.1, 2.2, 3.0, 4.0, 4.5, 5.0, 5.5, 6.0, 8.0}) {
    const Section tread = make_wheel_sections(lma(), {}, size_of(surface, 13)).tread;
    EXPECT_GT(step_by_pitch(tread, surface * mm), surface <= 5 ? 0.98 : 0.84) << surface << " mm";
  }
}

TEST(WheelSection, KinkOfTheConesStaysAKink) {
  const WheelShape shape;
  const Section tread = make_wheel_sections(lma(), shape, size_of(2.2, 13)).tread;
  double kink = 0, at = 0;
  for (std::size_t k = 1; k < tread.surface.size(); ++k) {
    const auto &before = tread.surface[k - 1].tangent[1], &after = tread.surface[k].tangent[0];
    const double angle = std::abs(before[0] * after[1] - before[1] * after[0]);
    if (angle > kink) {
      kink = angle;
      at = node(tread, tread.surface[k].node[0]).x + shape.lateral_offset;
    }
  }
  EXPECT_NEAR(at, 30 * mm, 1e-9);
  EXPECT_NEAR(kink, std::sin(std::atan(1.0 / 15) - std::atan(1.0 / 40)), 1e-9);
}

TEST(WheelSection, PathsLieWhereTheySay) {
  const WheelShape shape;
  const WheelSections wheel = make_wheel_sections(lma(), shape, size_of(2.2, 13));
  for (const int n : wheel.tread.paths.at("tie")) EXPECT_NEAR(node(wheel.tread, n).y, 0.407, 1e-15);
  for (const int n : wheel.axle.paths.at("tie")) EXPECT_NEAR(node(wheel.axle, n).y, 0.127, 1e-15);
  const auto& end = wheel.axle.paths.at("symmetry_end");
  EXPECT_NEAR(node(wheel.axle, end.front()).y, 0.030, 1e-15);
  EXPECT_NEAR(node(wheel.axle, end.back()).y, 0.0875, 1e-15);
  for (const int n : end)
    EXPECT_NEAR(node(wheel.axle, n).x, -0.753, 1e-12);  // half the distance of the rails' centres
  const auto& journal = wheel.axle.paths.at("journal");
  ASSERT_EQ(journal.size(), 3u);
  EXPECT_NEAR(node(wheel.axle, journal[1]).x, 0.2535 - 0.0065, 1e-12);
  for (const int n : journal) EXPECT_NEAR(node(wheel.axle, n).y, 0.065, 1e-15);
  const auto& tie = wheel.tread.paths.at("tie");
  EXPECT_NEAR(node(wheel.tread, tie.back()).x - node(wheel.tread, tie.front()).x, 0.135, 1e-6);
}

double mass(const WheelSections& wheel) {
  return 7790 * (revolved_moments(wheel.tread).volume + revolved_moments(wheel.disc).volume +
                 revolved_moments(wheel.axle).volume);
}

TEST(WheelSection, BrakeRingsReachTheMassOfTheWheelset) {
  WheelShape shape;
  const SectionSize size = size_of(2.2, 13);
  EXPECT_LT(mass(make_wheel_sections(lma(), shape, size)), 500);
  shape.brake_ring_thickness = 10 * mm;
  const double thin = mass(make_wheel_sections(lma(), shape, size));
  shape.brake_ring_thickness = 40 * mm;
  const double thick = mass(make_wheel_sections(lma(), shape, size));
  const double ring = 2 * std::numbers::pi * (0.32 * 0.32 - 0.175 * 0.175) * 7790;
  EXPECT_NEAR((thick - thin) / (30 * mm), ring, 1e-6 * ring);
  shape.brake_ring_thickness = 10 * mm + (586 - thin) / ring;
  EXPECT_NEAR(mass(make_wheel_sections(lma(), shape, size)), 586, 1e-6);
}

TEST(WheelSection, TakesATableWithoutFlange) {
  std::vector<double> y, z;
  for (int i = 0; i <= 130; ++i) {
    y.push_back((-65 + i) * mm);
    z.push_back(-0.03 * y.back() + 0.8 * y.back() * y.back());
  }
  const WheelSections wheel = make_wheel_sections(wheel_from_table(y, z), WheelShape(), size_of(2.2, 13));
  EXPECT_GT(worst_quality(wheel.tread), 0.6);
  expect_nested(wheel.tread, wheel.tread.paths.at("tie"), wheel.disc, wheel.disc.paths.at("tie_outer"));
}

TEST(WheelSection, TakesATableWithFlange) {
  const PlaneCurve exact = lma().surface;
  std::vector<double> y, z;
  const double start = exact.at_x(-69.5 * mm);
  for (int i = 0; i <= 600; ++i) {
    const Point2 p = exact.at(start + (exact.length() - start) * i / 600).position;
    y.push_back(p.x);
    z.push_back(p.y);
  }
  const WheelSections wheel = make_wheel_sections(wheel_from_table(y, z), WheelShape(), size_of(1.5, 13));
  EXPECT_GT(worst_quality(wheel.tread), 0.35);
}

TEST(WheelSection, RefusesWhatDoesNotFit) {
  const SectionSize size = size_of(2.2, 13);
  const auto refused = [&](auto change) {
    WheelShape shape;
    change(shape);
    EXPECT_THROW(make_wheel_sections(lma(), shape, size), InputError);
  };
  refused([](WheelShape& shape) { shape.diameter = 0.4; });
  refused([](WheelShape& shape) { shape.axle_bore = 0; });
  refused([](WheelShape& shape) { shape.axle_bore = 0.13; });
  refused([](WheelShape& shape) { shape.lateral_offset = 0.1; });
  EXPECT_THROW(make_wheel_sections(crowned(0.06, 0.3), WheelShape(), size), InputError);
  EXPECT_THROW(make_wheel_sections(lma(), WheelShape(), size_of(20, 20)), InputError);
  EXPECT_THROW(make_rail_sections(cn60(), 0.025, size_of(-1, 9)), InputError);
  EXPECT_THROW(make_rail_sections(cn60(), 0.5, size), InputError);
}

TEST(SimpleSections, BoxRailAndTyre) {
  SectionSize size = size_of(1, 8);
  size.band_centre = 0;
  size.band_half_width = 10 * mm;
  const Section box = make_box_rail_section(60 * mm, 60 * mm, 0.3, size);
  EXPECT_GT(worst_quality(box), 0.8);
  EXPECT_LT(check_surface(box, crowned(60 * mm, 0.3).surface, size, [](Point2 a) { return a; }).in_band,
            1e-10);
  for (const int n : box.paths.at("foot")) EXPECT_EQ(node(box, n).y, -60 * mm);

  const Section flat = make_box_rail_section(60 * mm, 60 * mm, 0, size);
  EXPECT_NEAR(area_moments(flat).area, 36e-4, 1e-15);

  const Section tyre = make_tyre_section(crowned(50 * mm, 0.43), 0.86, 2 * mm, 60 * mm, size);
  const SurfaceError error = check_surface(tyre, crowned(50 * mm, 0.43).surface, size, [](Point2 a) {
    return Point2{a.x + 2 * mm, a.y - 0.43};
  });
  EXPECT_LT(error.in_band, 1e-10);
  for (const int n : tyre.paths.at("bore")) EXPECT_NEAR(node(tyre, n).y, 0.37, 1e-15);
  const double volume =
      revolved_moments(make_tyre_section(crowned(50 * mm, 0), 0.86, 0, 60 * mm, size)).volume;
  EXPECT_NEAR(volume, std::numbers::pi * (0.43 * 0.43 - 0.37 * 0.37) * 0.05, 1e-14);
}

/// A measured surface lies above and below the smooth one; the mesh follows it either way.
TEST(SimpleSections, NodesFollowARaisedAndALoweredSurface) {
  SectionSize size = size_of(4, 8);
  size.band_half_width = 10 * mm;
  const Section box = make_box_rail_section(60 * mm, 60 * mm, 0, size);
  SweptBlock rail = make_swept_block("rail", Sweep::extruded, box, {samples::steel()}, 0, {{8, 10 * mm, 0}});
  const Corrugation measured({0, 0.02, 0.04, 0.06}, {0, 1e-4, -1e-4, 0}, 0, 0, 30 * mm);
  shift_top_layers(rail, measured, 12 * mm);
  for (const SurfaceEdge& edge : rail.section.surface)
    for (int station = 0; station < rail.station_count(); ++station) {
      const auto shift = rail.node_shift.find(rail.slot(edge.node[0], station));
      const double depth = measured.depth(rail.stations[static_cast<std::size_t>(station)],
                                          rail.section.p[static_cast<std::size_t>(edge.node[0])]);
      EXPECT_EQ(shift == rail.node_shift.end() ? 0 : shift->second.z, -depth);
    }
  EXPECT_LT(measured.depth(0.04, 0), 0);
}

TEST(SimpleSections, RevolvedMomentsOfACylinder) {
  const RevolvedMoments m = revolved_moments(rectangle(-0.1, 0.2, 3, 0.1, 0.5, 4));
  EXPECT_NEAR(m.volume, std::numbers::pi * (0.25 - 0.01) * 0.3, 1e-14);
  EXPECT_NEAR(m.polar, std::numbers::pi / 2 * (0.0625 - 0.0001) * 0.3, 1e-14);
}

TEST(SimpleSections, Rectangle) {
  const Section grid = rectangle(0, 0.2, 4, -0.1, 0, 2);
  EXPECT_NO_THROW(validate(grid, "grid"));
  EXPECT_EQ(grid.quads.size(), 8u);
  EXPECT_NEAR(worst_quality(grid), 1, 1e-12);
  EXPECT_EQ(grid.paths.at("bottom").size(), 5u);
  EXPECT_EQ(grid.paths.at("left").size(), 3u);
  for (const int n : grid.paths.at("top")) EXPECT_EQ(node(grid, n).y, 0);
  EXPECT_THROW(rectangle(0, 0, 4, 0, 1, 2), InputError);
}

TEST(Layers, FillTheDepthWithGentleGrowth) {
  for (const double surface : {1.0, 1.1, 2.2, 3.0, 6.0})
    for (const double depth : {23 * mm, 60 * mm}) {
      const SectionSize size = size_of(surface, 9);
      const auto depths = layer_depths(size, depth);
      EXPECT_EQ(depths.front(), 0);
      EXPECT_EQ(depths.back(), depth);
      for (std::size_t i = 1; i < depths.size(); ++i) {
        const double row = depths[i] - depths[i - 1];
        EXPECT_LT(row, 9.01 * mm);
        EXPECT_GT(row, 0.68 * size.surface);
        if (i > 1) {
          EXPECT_LT(row, 1.4501 * (depths[i - 1] - depths[i - 2]));
        }
      }
    }
}

TEST(Nested, KeepsCoarseNodesAndRefusesTooFewFineOnes) {
  const auto fine = evenly(0, 1, 17), coarse = evenly(0, 1, 5);
  const auto result = nested(fine, coarse, "test");
  ASSERT_EQ(result.size(), fine.size());
  for (const double x : coarse) EXPECT_TRUE(std::find(result.begin(), result.end(), x) != result.end());
  EXPECT_TRUE(std::is_sorted(result.begin(), result.end()));
  EXPECT_THROW(nested(coarse, fine, "test"), InputError);
}

}  // namespace
}  // namespace tread
