#include "drivers/studies/multibody/solid_rail.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "drivers/engine/rail_beam.hpp"
#include "drivers/engine/sections.hpp"
#include "kernels/harmonics/harmonic_solid.hpp"

namespace tread {

namespace {

constexpr int kOfLow = 32;             ///< Lanczos vectors of a harmonic that has modes in the band
constexpr int kOfHigh = 8;             ///< of the others, which answer at once
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
  return {{{sections.cap, material}, {sections.base, material}}, {{0, "tie", 1, "tie"}}, length};
}

}  // namespace

ModalBeam solid_rail(const Scene& scene, const ForceRegion& region, double top, double element) {
  const HarmonicSolid solid = upright(scene, element);
  const double length = scene.rail->length;
  const std::size_t base = scene.rail->profile == "box" ? 0 : 1;
  // In the middle a force leaves the odd motions at rest.
  const std::vector<double> head_load =
      solid.surface_load(0, 2, [&](double p) { return region.density(region.centre + p); });
  // A spring along the foot holds the stretch about it.
  const ForceRegion held{0, kFootPitch};
  const auto wave_number = [&](int n) { return n * std::numbers::pi / length; };
  // No wave is as slow as those of bending.
  const BeamProperties beam = timoshenko(rail_beam_section(scene), scene.rail_material());
  const int dense = 10 + modes_below(beam, length, top);
  const std::vector<int> some = some_harmonics(
      dense, std::max(dense, static_cast<int>(region.last_wave_number() * length / std::numbers::pi)));
  const std::vector<HarmonicModes> harmonics =
      solid.modes(some, {head_load, solid.path_load(base, 0, "foot")}, {solid.path_load(base, 2, "foot")},
                  [&](int n) { return n <= dense ? kOfLow : kOfHigh; });

  ModalBeam::Modes out;
  const double highest = 2 * std::numbers::pi * top;
  std::vector<double> head, along;
  // A harmonic counts with half its peak, the mean along the rail.
  const auto mean = [](int n) { return n == 0 ? 1.0 : 0.5; };
  for (std::size_t i = 0; i < some.size(); ++i) {
    head.push_back(harmonics[i].flexibility[kHead]);
    along.push_back(harmonics[i].flexibility[kFootAlong]);
  }
  const auto of_head = [&](int n) { return std::pow(region.coefficient(wave_number(n)), 2) * mean(n); };
  out.residual =
      sum_of_harmonics(some, head, of_head) - half_space_flexibility(region, scene.rail_material());
  const auto of_foot = [&](int n) { return std::pow(held.coefficient(wave_number(n)), 2) * mean(n); };
  for (int n = 0; n <= dense; ++n)
    out.foot_residual.push_back(n == 0 ? 0 : of_foot(n) * along[static_cast<std::size_t>(n)]);
  // Rounding finds rigid motions more than once, and odd motions.
  const double rigid = 1 / std::sqrt(beam.mass * length);
  out.modes.push_back({0, 0, rigid, rigid, 0});
  const auto counts = [&](const HarmonicMode& mode) {
    return !mode.rigid() && mode.stiffness < highest * highest &&
           std::max(std::abs(mode.amplitude[kHead]), std::abs(mode.amplitude[kFoot])) > kLeastMotion * rigid;
  };
  // By families, along which the harmonics follow one another.
  for (std::size_t family = 0; family < static_cast<std::size_t>(kOfLow); ++family)
    for (std::size_t i = 0; i <= static_cast<std::size_t>(dense); ++i) {
      if (family >= harmonics[i].modes.size() || !counts(harmonics[i].modes[family])) continue;
      const HarmonicMode& mode = harmonics[i].modes[family];
      const int n = some[i];
      const double share = region.coefficient(wave_number(n));
      const double foot = n == 0 ? 0 : held.coefficient(wave_number(n)) * mode.amplitude[kFootAlong];
      out.modes.push_back(
          {n, std::sqrt(mode.stiffness), mode.amplitude[kFoot], share * mode.amplitude[kHead], foot});
      out.residual -= mean(n) * share * share * mode.flexibility;
      out.foot_residual[i] -= mean(n) * foot * foot / mode.stiffness;
    }
  return {-scene.rail->origin, length, std::move(out)};
}

}  // namespace tread
