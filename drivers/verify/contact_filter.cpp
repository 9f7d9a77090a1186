// A wheel that lies on a corrugated rail: the fraction of the corrugation's depth that its height shows.
// [reference: half-space contact on the same surfaces]

#include <fmt/core.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "drivers/verify/cases.hpp"
#include "drivers/verify/tyre_on_block.hpp"
#include "kernels/half_space/half_space.hpp"

namespace tread {

namespace {

struct Waves {
  double wavelength, depth, width;  ///< L, d_m, W of the paper's eqs. (6), (7) [m]
  bool by_gap;                      ///< true: depth added to the contact gap; false: moved nodes
};

struct Rest {
  double height = 0;        ///< height of the wheel above the smooth rail, deformation included [m]
  double max_pressure = 0;  ///< [Pa]
};

/// The wheel at rest on a crest or in a trough.
Rest rest(TyreOnBlock bodies, const Waves& waves, bool trough, const ProgressText& progress) {
  // Whole waves begin at a crest, so that x = 0 is the middle of a single wave or the crest between two.
  const int count = trough ? 1 : 2;
  const double half = 0.5 * count * waves.wavelength;
  bodies.fine = {-half - 2 * bodies.element_size, half + 2 * bodies.element_size};
  bodies.more = fmt::format(
      "[corrugation]\nwavelength = \"{} m\"\ndepth = \"{} m\"\nwidth = \"{} m\"\nstart = \"{} m\"\n"
      "length = \"{} m\"\ncentre = \"0 m\"\napply = \"{}\"\n",
      waves.wavelength, waves.depth, waves.width, -half, 2 * half * (1 + 1e-9),
      waves.by_gap ? "gap" : "nodes");
  Model model(bodies.scene());
  model.apply_corrugation(0);
  progress(fmt::format("{} elements of {:.3g} mm, {} at {:.3g} mm", model.elements(),
                       1e3 * bodies.element_size, trough ? "trough" : "crest", 1e3 * waves.wavelength));
  const Preload preload = solve_preload(model, {}, progress);
  const double journal =
      model.journal.displacement(preload.displacement.data(), preload.wheel).z + preload.wheel.origin.z;
  return {journal, model.contact->nodes().max_pressure()};
}

/// The wheel at rest by the half-space.
Rest half_space_rest(const TyreOnBlock& bodies, const Waves& waves, bool trough) {
  using namespace half_space;
  const HertzPatch patch = bodies.hertz_patch();
  const double cell = std::min(patch.semi_axis_x, patch.semi_axis_y) / 10;
  const Influence influence(centred_grid(2 * patch.semi_axis_x, 2 * patch.semi_axis_y, cell),
                            bodies.elastic.alike());
  const Gap smooth = quadratic_gap(bodies.radius, bodies.crown_radius);
  const NormalContact contact = press(
      influence,
      [&](double x, double y) {
        const double phase = 2 * std::numbers::pi * x / waves.wavelength + (trough ? std::numbers::pi : 0);
        const double across = std::max(0.0, 1 - y * y / (waves.width * waves.width));
        return smooth(x, y) + 0.5 * waves.depth * (1 - std::cos(phase)) * across;
      },
      bodies.load);
  return {-contact.approach, contact.max_pressure};
}

CaseResult contact_filter(const VerifyInputs& inputs, const ProgressText& progress) {
  const TyreOnBlock bodies = tyre_of(inputs, false);
  CaseResult result;
  const auto compare = [&](const Waves& waves) {
    const Rest crest = rest(bodies, waves, false, progress);
    const Rest trough = rest(bodies, waves, true, progress);
    const Rest half_crest = half_space_rest(bodies, waves, false);
    const Rest half_trough = half_space_rest(bodies, waves, true);
    const std::string at = fmt::format(" at {:.3g} mm", 1e3 * waves.wavelength);
    result.findings.push_back({"gain" + at, "-", (crest.height - trough.height) / waves.depth,
                               (half_crest.height - half_trough.height) / waves.depth, 0.02, true});
    result.findings.push_back({"largest pressure, crest / trough" + at, "-",
                               crest.max_pressure / trough.max_pressure,
                               half_crest.max_pressure / half_trough.max_pressure, 0.03 * bodies.fineness()});
  };
  const double wanted = inputs["wavelength"];
  for (const double wavelength :
       wanted > 0 ? std::vector<double>{wanted} : std::vector<double>{0.065, 0.080, 0.095})
    compare({wavelength, inputs["depth"], inputs["width"], inputs["gap"] > 0});
  return result;
}

}  // namespace

VerifyCase contact_filter_case() {
  std::vector<VerifyInput> inputs = tyre_inputs(false);
  inputs.push_back({"wavelength", &kLength, "mm", 0, {0, 1}, "the wavelength L; 0: 65, 80 and 95 mm"});
  inputs.push_back({"depth", &kLength, "mm", 0.14e-3, {1e-6, 1e-3}, "the depth d_m from crest to trough"});
  inputs.push_back({"width", &kLength, "mm", 30e-3, {1e-3, 0.1}, "the half width W"});
  inputs.push_back({"gap", nullptr, "", 0, {0, 1}, "1: the corrugation is added to the gap; 0: moved nodes"});
  return {"contact_filter", "a wheel at rest on crests and in troughs, against the half-space",
          std::move(inputs), contact_filter};
}

}  // namespace tread
