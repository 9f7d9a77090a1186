#include "drivers/studies/multibody/modal_wheel.hpp"

#include <cmath>
#include <numbers>

#include "drivers/engine/model/sections.hpp"
#include "kernels/harmonics/harmonic_solid.hpp"

namespace tread {

namespace {

constexpr int kEachWave = 12;    ///< waves up to which harmonics have modes in the band and are solved each
constexpr int kOfLowWheel = 60;  ///< Lanczos vectors of these
constexpr int kOfHighWheel = 8;  ///< of the others, which answer at once

HarmonicSolid half_wheelset(const Scene& scene, double element) {
  Scene fine = scene;
  fine.quality = "draft";
  fine.element_size = element;
  const MeshSizes sizes = mesh_sizes(fine);
  const WheelSections sections =
      wheel_sections(fine, sizes, plan_wheel(0.5 * scene.wheel->diameter, {}, sizes)).sections;
  const Material& material = scene.wheel_material();
  constexpr std::size_t kTread = 0, kDisc = 1, kAxle = 2;
  HarmonicSolid solid({{sections.tread, material}, {sections.disc, material}, {sections.axle, material}},
                      {{kTread, "tie", kDisc, "tie_outer"}, {kDisc, "tie_inner", kAxle, "tie"}});
  solid.hold(kAxle, "symmetry_end", 1);
  if (scene.vehicle) solid.carry(kAxle, "journal", scene.vehicle->unsprung_mass);
  return solid;
}

}  // namespace

ModalWheel modal_wheel(const Scene& scene, const ForceRegion& region, double top, double element) {
  const HarmonicSolid solid = half_wheelset(scene, element);
  constexpr std::size_t kTread = 0;
  constexpr int kRadial = 2;
  const std::vector<double> load =
      solid.surface_load(kTread, kRadial, [&](double p) { return region.density(p); });
  const double radius = 0.5 * scene.wheel->diameter;
  const auto share = [&](int n) { return region.coefficient(n / radius); };
  const std::vector<int> some =
      some_harmonics(kEachWave, static_cast<int>(region.last_wave_number() * radius));
  const std::vector<HarmonicModes> harmonics =
      solid.modes(some, {load}, {}, [](int n) { return n <= kEachWave ? kOfLowWheel : kOfHighWheel; });

  ModalWheel wheel;
  wheel.top = top;
  const double highest = 2 * std::numbers::pi * top;
  std::vector<double> flexibility;
  for (std::size_t i = 0; i < some.size(); ++i) {
    flexibility.push_back(harmonics[i].flexibility.front());
    for (const HarmonicMode& mode : harmonics[i].modes) {
      const double amplitude = share(some[i]) * mode.amplitude.front();
      if (mode.rigid) {
        wheel.mass = 1 / (amplitude * amplitude);
      } else if (mode.stiffness < highest * highest) {
        wheel.modes.push_back({some[i], std::sqrt(mode.stiffness), amplitude, mode.turning});
        wheel.flexibility -= share(some[i]) * share(some[i]) * mode.flexibility;
      }
    }
  }
  wheel.flexibility += sum_of_harmonics(some, flexibility, [&](int n) { return share(n) * share(n); });
  wheel.flexibility -= half_space_flexibility(region, scene.wheel_material());
  return wheel;
}

}  // namespace tread
