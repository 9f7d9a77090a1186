#include "drivers/studies/multibody/solid_rail.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "drivers/engine/model/sections.hpp"
#include "drivers/engine/start/rail_beam.hpp"
#include "kernels/harmonics/harmonic_solid.hpp"

namespace tread {

namespace {

constexpr int kOfLowRail = 32;         ///< Lanczos vectors of a harmonic that has modes in the band
constexpr int kOfHighRail = 8;         ///< of the others, which answer at once
constexpr double kLeastMotion = 1e-3;  ///< of a mode that counts, over that of the rigid motion
constexpr std::size_t kHead = 0, kFootAlong = 1, kFoot = 2;

/// Parts and ties of the upright rail.
HarmonicSolid upright(const Scene& scene, double element) {
  Scene fine = scene;
  fine.quality = "draft";
  fine.element_size = element;
  fine.rail->inclination = 0;
  const MeshSizes sizes = mesh_sizes(fine);
  const Material& material = scene.rail_material();
  const double length = scene.rail->length;
  if (scene.rail->profile == "box") return {{{box_rail_section(fine, sizes), material}}, {}, length};
  const RailSections sections = rail_sections(fine, sizes);
  return {{{sections.cap, scene.head_material()}, {sections.base, material}}, {{0, "tie", 1, "tie"}}, length};
}

/// Harmonics of the rail: each of the first, which have modes in the band, and some beyond.
struct RailHarmonics {
  int dense = 0;  ///< last of those that are solved each
  std::vector<int> some;
  std::vector<HarmonicModes> solved;  ///< by `some`

  std::vector<double> flexibilities(std::size_t load) const {
    std::vector<double> values;
    for (const HarmonicModes& one : solved) values.push_back(one.flexibility[load]);
    return values;
  }
};

RailHarmonics rail_harmonics(const Scene& scene, const ForceRegion& region, int dense, double element) {
  const HarmonicSolid solid = upright(scene, element);
  const std::size_t base = scene.rail->profile == "box" ? 0 : 1;
  // In the middle a force leaves the odd motions at rest.
  const std::vector<double> head =
      solid.surface_load(0, 2, [&](double p) { return region.density(region.centre + p); });
  const double last = region.last_wave_number() * scene.rail->length / std::numbers::pi;
  RailHarmonics out{dense, some_harmonics(dense, std::max(dense, static_cast<int>(last))), {}};
  out.solved =
      solid.modes(out.some, {head, solid.path_load(base, 0, "foot")}, {solid.path_load(base, 2, "foot")},
                  [&](int n) { return n <= dense ? kOfLowRail : kOfHighRail; });
  return out;
}

}  // namespace

ModalBeam solid_rail(const Scene& scene, const ForceRegion& region, double top, double element) {
  const double length = scene.rail->length;
  // No even wave is as slow as those of bending.
  const BeamProperties beam = timoshenko(rail_beam_section(scene), scene.rail_material());
  const RailHarmonics rail = rail_harmonics(scene, region, 10 + modes_below(beam, length, top), element);
  // A spring along the foot holds the stretch about it.
  const ForceRegion held{0, kFootPitch};
  const auto share_of = [&](const ForceRegion& at, int n) {
    return at.coefficient(n * std::numbers::pi / length);
  };
  // A harmonic counts with half its peak, the mean along the rail.
  const auto mean = [](int n) { return n == 0 ? 1.0 : 0.5; };

  ModalBeam::Modes out;
  out.residual = sum_of_harmonics(rail.some, rail.flexibilities(kHead),
                                  [&](int n) { return mean(n) * std::pow(share_of(region, n), 2); }) -
                 half_space_flexibility(region, scene.head_material());
  out.foot_residual = rail.flexibilities(kFootAlong);
  out.foot_residual.resize(static_cast<std::size_t>(rail.dense) + 1);
  out.foot_residual[0] = 0;
  for (int n = 1; n <= rail.dense; ++n)
    out.foot_residual[static_cast<std::size_t>(n)] *= mean(n) * std::pow(share_of(held, n), 2);
  // Rounding finds rigid motions more than once, and odd motions.
  const double rigid = 1 / std::sqrt(beam.mass * length);
  const double highest = 2 * std::numbers::pi * top;
  out.modes.push_back({0, 0, rigid, rigid, 0});
  const auto counts = [&](const HarmonicMode& mode) {
    return !mode.rigid && mode.stiffness < highest * highest &&
           std::max(std::abs(mode.amplitude[kHead]), std::abs(mode.amplitude[kFoot])) > kLeastMotion * rigid;
  };
  // By families, along which the harmonics follow one another.
  for (std::size_t family = 0; family < static_cast<std::size_t>(kOfLowRail); ++family)
    for (int n = 0; n <= rail.dense; ++n) {
      const auto i = static_cast<std::size_t>(n);
      const std::vector<HarmonicMode>& modes = rail.solved[i].modes;
      if (family >= modes.size() || !counts(modes[family])) continue;
      const HarmonicMode& mode = modes[family];
      const double share = share_of(region, n);
      const double foot = n == 0 ? 0 : share_of(held, n) * mode.amplitude[kFootAlong];
      out.modes.push_back(
          {n, std::sqrt(mode.stiffness), mode.amplitude[kFoot], share * mode.amplitude[kHead], foot});
      out.residual -= mean(n) * share * share * mode.flexibility;
      out.foot_residual[i] -= mean(n) * foot * foot / mode.stiffness;
    }
  return {-scene.rail->origin, length, std::move(out)};
}

}  // namespace tread
