// Natural modes of a free ring in plane strain against elasticity.

#include <fmt/core.h>

#include <cmath>

#include "core/error.hpp"
#include "drivers/verify/cases.hpp"
#include "drivers/verify/natural_modes.hpp"
#include "drivers/verify/ring_theory.hpp"
#include "io/scene/scene_reader.hpp"

namespace tread {

namespace {

constexpr int kMostRingWaves = 4;

Scene ring_scene(const PlaneRing& ring, double element_size) {
  const std::string text = fmt::format(
      R"([scene]
element_size = "{h} m"
plane_strain = true
[solution_zone]
start = "0 m"
length = "{turn} m"
[material.steel]
youngs_modulus = "{E} Pa"
poissons_ratio = {nu}
density = "{rho} kg/m3"
[wheel]
shape = "tyre"
profile = "cylinder"
diameter = "{diameter} m"
width = "{h} m"
thickness = "{thickness} m"
lateral_offset = "0 mm"
)",
      fmt::arg("h", element_size), fmt::arg("turn", 7 * ring.outer), fmt::arg("E", ring.youngs_modulus),
      fmt::arg("nu", ring.poissons_ratio), fmt::arg("rho", ring.density),
      fmt::arg("diameter", 2 * ring.outer), fmt::arg("thickness", ring.outer - ring.inner));
  return resolve_scene(SceneSource{"verify", text, {}}).scene;
}

CaseResult ring_modes(const VerifyInputs& inputs, const ProgressText& progress) {
  const double radius = inputs["radius"];
  const double thickness = inputs["thickness"];
  const double size = inputs["element_size"];
  if (thickness > 0.6 * radius || size > 0.3 * thickness)
    throw InputError(
        fmt::format("verify: thickness = {:.3g} mm must lie between {:.3g} mm, for which the elements "
                    "of {:.3g} mm are small enough, and {:.3g} mm, 0.6 of the radius",
                    1e3 * thickness, 1e3 * size / 0.3, 1e3 * size, 600 * radius));
  const PlaneRing ring{radius - thickness, radius, inputs["youngs_modulus"], inputs["poissons_ratio"],
                       kSteelDensity};
  const Model model(ring_scene(ring, size));
  // Three rigid modes and the pairs are asked for; thick rings have others between them.
  const std::vector<NaturalMode> modes = natural_modes(model, 3 + 2 * kMostRingWaves + 4, progress);
  CaseResult result;
  Series ours{"finite elements", {}, {}, Stroke::solid};
  Series exact{"elasticity", {}, {}, Stroke::dashed};
  Series thin{"thin ring", {}, {}, Stroke::dotted};
  double rigid = 0;
  for (const NaturalMode& mode : modes)
    if (mode.waves < 2 && mode.frequency < 0.1 * thin_ring_frequency(ring, 2))
      rigid = std::max(rigid, mode.frequency);
  result.findings.push_back({"rigid modes", "Hz", rigid, 0, 0.1, true});
  for (int waves = 2; waves <= kMostRingWaves; ++waves) {
    double frequency = 0;
    for (const NaturalMode& mode : modes)
      if (mode.waves == waves && frequency == 0) frequency = mode.frequency;
    const double theory = exact_ring_frequency(ring, waves);
    result.findings.push_back({fmt::format("{} waves", waves), "Hz", frequency, theory, 0.005});
    result.findings.push_back({fmt::format("{} waves, against a thin ring", waves),
                               "Hz",
                               frequency,
                               thin_ring_frequency(ring, waves),
                               {}});
    for (Series* s : {&ours, &exact, &thin}) s->x.push_back(waves);
    ours.y.push_back(frequency);
    exact.y.push_back(theory);
    thin.y.push_back(thin_ring_frequency(ring, waves));
  }
  Figure figure;
  figure.title = "In-plane modes of a ring";
  figure.x_label = "Waves around";
  figure.panels = {{"Frequency [Hz]", {ours, exact, thin}, {}, 260, std::nullopt}};
  result.figures = {figure};
  return result;
}

}  // namespace

VerifyCase ring_modes_case() {
  return {"ring_modes",
          "in-plane natural modes of a free ring in plane strain, against elasticity",
          {{"radius", &kLength, "m", 0.43, {0.05, 5}, "the outer radius"},
           {"thickness", &kLength, "mm", 60e-3, {1e-3, 1}, "the ring's thickness"},
           {"youngs_modulus", &kStress, "GPa", 205.9e9, {1e6, 1e13}, "Young's modulus"},
           {"poissons_ratio", nullptr, "", 0.3, {0, 0.45}, "Poisson's ratio"},
           {"element_size", &kLength, "mm", 5e-3, {1e-4, 0.05}, "the elements' size"}},
          ring_modes};
}

}  // namespace tread
