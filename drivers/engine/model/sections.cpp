#include "drivers/engine/model/sections.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "core/error.hpp"
#include "core/geometry/built_in_profiles.hpp"
#include "core/geometry/profiles.hpp"
#include "core/geometry/touching.hpp"
#include "core/mesh/structured.hpp"

namespace tread {

namespace {

/// Columns of h stand where the patch can lie, about `band_centre`.
SectionSize section_size(const MeshSizes& sizes, double coarse, double band_centre) {
  SectionSize size;
  size.surface = sizes.contact;
  size.coarse = coarse;
  size.band_centre = band_centre;
  size.band_half_width = sizes.band_half_width;
  size.fine_layers = 2;
  return size;
}

/// Coarse quads of the rail [m], whatever the element size: the fastenings' dampers act on points, and the
/// nodes of a finer foot are too light for them at the step of the contact's elements.
constexpr double kLeastRailCoarse = 8e-3;

constexpr double kWheelToRailCoarse =
    1.4;  ///< disc elements may be larger than those of the rail's web and foot
WheelProfile wheel_profile(const WheelSpec& wheel) {
  if (!wheel.profile_y.empty()) return wheel_from_table(wheel.profile_y, wheel.profile_z);
  if (wheel.profile == "arc") return crowned(wheel.width, wheel.crown_radius);
  if (wheel.profile == "cylinder") return crowned(wheel.width, 0);
  return built_in_wheel(wheel.profile);
}

RailProfile rail_profile(const RailSpec& rail) {
  if (rail.profile_y.empty()) return built_in_rail(rail.profile);
  return rail_with_head(rail.profile_y, rail.profile_z, built_in_rail(rail.section), rail.profile_shift);
}

/// Middles of the fine bands on rail and wheel, each in its section's own coordinate p [m].
struct Bands {
  double rail = 0, wheel = 0;
};

/// Running surface of the rail.
PlaneCurve running_surface(const RailSpec& rail) {
  return rail.profile == "box" ? crowned(rail.width, rail.crown_radius).surface : rail_profile(rail).running;
}

/// InputError if the wheel stands on its flange.
void require_tread(const PlaneCurve& wheel, const Touching& place, double lateral_offset) {
  constexpr double kDeepest = 12e-3;  // of the tread and its transition to the flange [m]
  const auto height = [&](double y) { return wheel.at(wheel.at_x(y)).position.y; };
  const double depth = height(place.wheel_y) - height(0);
  if (depth <= kDeepest) return;
  throw InputError(fmt::format(
      "wheel.lateral_offset = {:.2f} mm: the wheel's flange stands on the rail, {:.1f} mm below the nominal "
      "rolling circle; the patch has to lie {:.0f} mm below it at most: state a larger offset, which is "
      "positive to the field side, or shift the profiles by wheel.profile_shift and rail.profile_shift",
      1e3 * lateral_offset, 1e3 * depth, 1e3 * kDeepest));
}

/// InputError if the rail is too steep where the profiles touch.
void require_gentle(const Touching& place, double lateral_offset) {
  constexpr double kSteepest = 0.5;
  if (std::abs(place.slope) <= kSteepest) return;
  throw InputError(fmt::format(
      "wheel.lateral_offset = {:.2f} mm: the profiles touch at y = {:.1f} mm from the rail's middle, where "
      "the rail leans by {:.0f} degrees; the patch has to lie where it leans by {:.0f} degrees at most: "
      "shift the wheel, or the profiles by wheel.profile_shift and rail.profile_shift",
      1e3 * lateral_offset, 1e3 * place.y, std::atan(std::abs(place.slope)) * 180 / std::numbers::pi,
      std::atan(kSteepest) * 180 / std::numbers::pi));
}

/// The bands lie about the place where the rigid profiles touch, or about the usual one if that is near; for
/// CN60 and LMA half-way between both otherwise. InputError if the rail is too steep where they touch.
Bands bands_of(const Scene& scene) {
  const bool box = !scene.rail || scene.rail->profile == "box";
  const bool tyre = scene.wheel && scene.wheel->shape == "tyre";
  constexpr double kUsual = -2e-3;  // of CN60 and LMA
  const Bands usual{box ? 0 : kUsual, tyre ? 0 : kUsual};
  if (!scene.wheel || !scene.rail) return usual;
  const RailSpec& rail = *scene.rail;
  const WheelSpec& wheel = *scene.wheel;
  if (box && rail.crown_radius == 0 && wheel.profile == "cylinder") return usual;  // they touch all across
  const PlaneCurve tread = wheel_profile(wheel).surface;
  const Touching place =
      touching(running_surface(rail), box ? 0 : rail.inclination, tread, wheel.lateral_offset);
  require_tread(tread, place, wheel.lateral_offset);
  require_gentle(place, wheel.lateral_offset);
  // One band for all places that are near: offsets of some mm then have the same mesh.
  // The surfaces of CN60 and LMA almost fit: with offsets of -1.5, -2, -3 mm rigid ones touch at y = -16,
  // -20, -25 mm, and the patch under load lies about -8, -10, -17 mm.
  const double share = box || tyre || rail.profile != "CN60" || wheel.profile != "LMA" ? 1 : 0.5;
  const auto band = [&](double common, double touching_place) {
    const double beside = place.y - common;
    const double least = box || tyre ? -8e-3 : -10e-3;
    return beside >= least && beside <= 8e-3 ? common : common + share * (touching_place - common);
  };
  Bands bands{place.on_rail.x, place.y};
  if (box || (rail.profile == "CN60" && (tyre || wheel.profile == "LMA")))
    bands.rail = band(usual.rail, bands.rail);
  if (box || tyre || (rail.profile == "CN60" && wheel.profile == "LMA"))
    bands.wheel = band(usual.wheel, bands.wheel);
  return bands;
}

}  // namespace

RailSections rail_sections(const Scene& scene, const MeshSizes& sizes) {
  const RailSpec& rail = *scene.rail;
  return make_rail_sections(
      rail_profile(rail), rail.inclination,
      section_size(sizes, std::max(sizes.section, kLeastRailCoarse), bands_of(scene).rail));
}

Section box_rail_section(const Scene& scene, const MeshSizes& sizes) {
  const RailSpec& rail = *scene.rail;
  return make_box_rail_section(rail.width, rail.height, rail.crown_radius,
                               section_size(sizes, sizes.section, bands_of(scene).rail));
}

Section tyre_section(const Scene& scene, const MeshSizes& sizes) {
  const WheelSpec& wheel = *scene.wheel;
  return make_tyre_section(wheel_profile(wheel), wheel.diameter, wheel.lateral_offset, wheel.thickness,
                           section_size(sizes, sizes.section, bands_of(scene).wheel));
}

Section sleeper_section(const SleeperSpec& sleeper, double top, const MeshSizes& sizes) {
  constexpr int kLayers = 2;
  constexpr int kLeastColumns = 8;
  const int columns =
      std::max(kLeastColumns, static_cast<int>(std::lround(sleeper.length / (1.5 * sizes.slab))));
  return rectangle(sleeper.offset - 0.5 * sleeper.length, sleeper.offset + 0.5 * sleeper.length, columns,
                   top - sleeper.height, top, kLayers);
}

Section slab_section(const SlabSpec& slab, double top, const MeshSizes& sizes) {
  const double left = slab.offset - 0.5 * slab.width;
  const int columns = std::max(2, static_cast<int>(std::lround(slab.width / (1.5 * sizes.slab))));
  const int layers = std::max(2, static_cast<int>(std::lround(slab.thickness / sizes.slab)));
  std::vector<double> p;
  for (int i = 0; i <= columns; ++i) p.push_back(left + slab.width * i / columns);
  std::vector<double> q = {top - slab.thickness - slab.mortar_thickness};
  for (int j = 0; j <= layers; ++j) q.push_back(top - slab.thickness + slab.thickness * j / layers);
  Section section = rectangle(p, q);
  section.quad_material.assign(section.quads.size(), 0);
  for (std::size_t quad = 0; quad < section.quads.size(); ++quad)
    if (section.q[static_cast<std::size_t>(section.quads[quad][2])] < top - slab.thickness + 1e-6)
      section.quad_material[quad] = 2;  // mortar, whatever lies above it
  return section;
}

namespace {

constexpr double kThinnestRing = 2e-3, kThickestRing = 0.08;  // [m]
constexpr double kSameMass = 0.01;                            // of a stated web and a stated mass

/// The sections of a half wheelset and their mass with the plan's polygons.
class WheelBuilder {
 public:
  WheelBuilder(const Scene& scene, const MeshSizes& sizes, const WheelPlan& plan)
      : profile_(wheel_profile(*scene.wheel)),
        size_(section_size(sizes, kWheelToRailCoarse * sizes.section, bands_of(scene).wheel)),
        plan_(plan),
        density_(scene.wheel_material().density) {
    shape.diameter = scene.wheel->diameter;
    shape.lateral_offset = scene.wheel->lateral_offset;
    shape.axle_bore = scene.wheel->axle_bore;
    shape.web_offset = scene.wheel->web_offset;
    shape.web_wave = scene.wheel->web_wave;
    if (!scene.wheel->web_r.empty()) shape.web_outline.emplace(scene.wheel->web_y, scene.wheel->web_r);
  }

  WheelShape shape;

  WheelSections sections() const { return make_wheel_sections(profile_, shape, size_); }

  double mass() const {
    const WheelSections s = sections();
    return density_ * (revolved_moments(s.tread).volume * polygon(plan_.tread) +
                       revolved_moments(s.disc).volume * polygon(plan_.disc) +
                       revolved_moments(s.axle).volume * polygon(plan_.axle));
  }
  double mass_with(double WheelShape::*part, double thickness) {
    shape.*part = thickness;
    return mass();
  }

 private:
  /// Elements between two stations are straight: a polygon's volume is that of the body times sin(d) / d.
  static double polygon(const std::vector<Segment>& segments) {
    double sum = 0;
    for (const Segment& s : segments) sum += s.elements * std::sin(s.pitch);
    return sum / (2 * std::numbers::pi);
  }

  WheelProfile profile_;
  SectionSize size_;
  WheelPlan plan_;
  double density_;
};

/// A part whose thickness is found by the wheelset's mass.
struct SizedPart {
  double WheelShape::*thickness;
  const char* name;
  double thinnest, thickest;  ///< [m]
};

/// Makes the part as thick as the mass needs, which grows almost linearly with it.
void size_by_mass(WheelBuilder& builder, const SizedPart& part, double wanted) {
  constexpr double kTolerance = 0.05;  // [kg]
  const auto mass = [&](double thickness) { return builder.mass_with(part.thickness, thickness); };
  double last_thickness = 0.012;
  double last_mass = mass(last_thickness);
  double thickness = 0.02;
  for (int i = 0; i < 12; ++i) {
    const double m = mass(thickness);
    if (std::abs(m - wanted) < kTolerance) return;
    const double slope = (m - last_mass) / (thickness - last_thickness);
    last_thickness = thickness;
    last_mass = m;
    thickness += (wanted - m) / slope;
    if (!(thickness > part.thinnest && thickness < part.thickest))
      throw InputError(fmt::format(
          "wheel.mass = {:.1f} kg cannot be met: {} of {:.1f} mm would be needed; {:g} to {:g} mm make half "
          "wheelsets of {:.1f} to {:.1f} kg: state a mass between, or another wheel.diameter",
          wanted, part.name, 1e3 * thickness, 1e3 * part.thinnest, 1e3 * part.thickest, mass(part.thinnest),
          mass(part.thickest)));
  }
}

}  // namespace

SizedWheel wheel_sections(const Scene& scene, const MeshSizes& sizes, const WheelPlan& plan) {
  const WheelSpec& wheel = *scene.wheel;
  WheelBuilder builder(scene, sizes, plan);
  WheelShape& shape = builder.shape;
  if (wheel.web_thickness) shape.web_thickness = *wheel.web_thickness;
  if (scene.body_replacing("disc")) return {builder.sections(), 0, 0};
  if (wheel.brake_rings) {
    size_by_mass(builder, {&WheelShape::brake_ring_thickness, "brake rings", kThinnestRing, kThickestRing},
                 wheel.mass);
  } else if (!wheel.web_thickness && !shape.web_outline) {
    size_by_mass(builder, {&WheelShape::web_thickness, "a web", kThinnestWeb, kThickestWeb}, wheel.mass);
  } else if (const double mass = builder.mass(); std::abs(mass / wheel.mass - 1) > kSameMass) {
    const auto [web, others] =
        shape.web_outline
            ? std::pair<std::string, const char*>("the file of wheel.web", "")
            : std::pair(fmt::format("wheel.web_thickness = {:.4g} mm", 1e3 * shape.web_thickness),
                        ", leave wheel.web_thickness out and the web is sized by the mass, or state "
                        "wheel.brake_rings = true and two plates make up the rest");
    throw InputError(fmt::format(
        "{} makes a half wheelset of {:.1f} kg, wheel.mass = {:.1f} kg; state wheel.mass = \"{:.1f} kg\"{}",
        web, mass, wheel.mass, mass, others));
  }
  return {builder.sections(), shape.thinnest_web(), shape.brake_ring_thickness};
}

Corrugation corrugation_of(const CorrugationSpec& spec, double centre) {
  if (spec.kind == "table")
    return Corrugation(spec.table_x, spec.table_depth, spec.start, centre, spec.width);
  if (spec.kind == "map")
    return {measured_map(spec.table_x, spec.map_y, spec.table_depth, centre), spec.start, centre,
            std::max(std::abs(spec.map_y.front()), std::abs(spec.map_y.back()))};
  if (spec.kind == "random")
    return Corrugation::rough({spec.rms, spec.shortest, spec.longest, static_cast<std::uint64_t>(spec.seed)},
                              spec.start, spec.length, centre, spec.width);
  return Corrugation({spec.wavelength, spec.depth}, spec.start, spec.length, centre, spec.width);
}

double depth_room(const Scene& scene) {
  if (scene.forks) return forks_room(scene);
  return scene.contact ? scene.contact->depth_room.value_or(0) : 0;
}

double forks_room(const Scene& scene) {
  constexpr double kUsual = 0.2e-3;
  return scene.contact ? scene.contact->depth_room.value_or(kUsual) : 0;
}

double corrugation_depth(const Scene& scene) {
  return scene.corrugation ? corrugation_of(*scene.corrugation, 0).deepest() : 0;
}

void shift_top_layers(SweptBlock& block, const Corrugation& corrugation, double fade) {
  const Section& section = block.section;
  // Depth of every section node below the running surface, by the surface edge over it.
  const auto surface_height = [&](double p) {
    for (const SurfaceEdge& edge : section.surface) {
      const auto a = static_cast<std::size_t>(edge.node[0]);
      const auto b = static_cast<std::size_t>(edge.node[1]);
      if (p < section.p[a] - 1e-9 || p > section.p[b] + 1e-9) continue;
      return section.q[a] +
             (section.q[b] - section.q[a]) * (p - section.p[a]) / (section.p[b] - section.p[a]);
    }
    return 1e9;
  };
  std::vector<bool> on_surface(section.p.size(), false);
  for (const SurfaceEdge& edge : section.surface)
    for (const int node : edge.node) on_surface[static_cast<std::size_t>(node)] = true;
  for (int node = 0; node < section.nodes(); ++node) {
    const auto n = static_cast<std::size_t>(node);
    const double below = on_surface[n] ? 0.0 : surface_height(section.p[n]) - section.q[n];
    const double share = 1 - below / fade;
    if (share <= 1e-9 || below < -1e-6) continue;
    for (int station = 0; station < block.station_count(); ++station) {
      const double depth = corrugation.depth(block.stations[static_cast<std::size_t>(station)], section.p[n]);
      if (depth != 0) block.node_shift[block.slot(node, station)] += Vec3{0, 0, -share * depth};
    }
  }
}

}  // namespace tread
