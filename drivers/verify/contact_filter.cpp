// A wheel that lies on a corrugated rail: the fraction of the corrugation's depth that its height shows.
// [reference: half-space contact on the same surfaces]

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/error.hpp"
#include "drivers/verify/cases.hpp"
#include "drivers/verify/tyre_on_block.hpp"
#include "kernels/half_space/half_space.hpp"

namespace tread {

namespace {

struct Waves {
  double wavelength, depth, width;  ///< L, d_m, W of the paper's eqs. (6), (7) [m]
  bool by_gap;                      ///< true: depth added to the contact gap; false: moved nodes

  /// Half the length of whole waves from crest to crest: of one about a trough, of two about a crest [m].
  double half_length(bool trough) const { return (trough ? 0.5 : 1.0) * wavelength; }
};

struct Rest {
  double height = 0;        ///< height of the wheel above the smooth rail, deformation included [m]
  double max_pressure = 0;  ///< [Pa]
};

/// The wheel at rest on a crest or in a trough.
Rest rest(TyreOnBlock bodies, const Waves& waves, bool trough, const ProgressText& progress) {
  const double half = waves.half_length(trough);
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

half_space::Grid grid_under(const TyreOnBlock& bodies, const Waves& waves, bool trough) {
  const HertzPatch patch = bodies.hertz_patch();
  const double hollow = trough ? waves.depth : 0;
  const double along = 0.5 * hollow * std::pow(2 * std::numbers::pi / waves.wavelength, 2);
  const double across = 2 * hollow / (waves.width * waves.width);
  return half_space::centred_grid(
      half_space::reach_in_hollow(patch.semi_axis_x, bodies.radius, along, 0, waves.half_length(trough)),
      half_space::reach_in_hollow(patch.semi_axis_y, bodies.crown_radius, across, 0, waves.width),
      std::min(patch.semi_axis_x, patch.semi_axis_y) / 10);
}

/// Throws InputError where the wheel touches the rail beyond the waves that the finite elements have.
void require_own_waves(const half_space::Grid& grid, const std::vector<double>& pressure, const Waves& waves,
                       bool trough) {
  for (int j = 0; j < grid.ny; ++j)
    for (int i = 0; i < grid.nx; ++i)
      if (std::abs(grid.x(i)) > waves.half_length(trough) &&
          pressure[static_cast<std::size_t>(grid.index(i, j))] > 0)
        throw InputError(fmt::format(
            "verify: at depth = {:.3g} mm and wavelength = {:.3g} mm the wheel {} touches further waves, "
            "which the finite elements do not have; state a longer wavelength or a smaller depth or load",
            1e3 * waves.depth, 1e3 * waves.wavelength, trough ? "in a trough" : "on a crest"));
}

/// The wheel at rest by the half-space.
Rest half_space_rest(const TyreOnBlock& bodies, const Waves& waves, bool trough) {
  using namespace half_space;
  const Influence influence(grid_under(bodies, waves, trough), bodies.elastic.alike());
  const Gap smooth = quadratic_gap(bodies.radius, bodies.crown_radius);
  const NormalContact contact = press(
      influence,
      [&](double x, double y) {
        const double phase = 2 * std::numbers::pi * x / waves.wavelength + (trough ? std::numbers::pi : 0);
        const double across = std::max(0.0, 1 - y * y / (waves.width * waves.width));
        return smooth(x, y) + 0.5 * waves.depth * (1 - std::cos(phase)) * across;
      },
      bodies.load);
  require_own_waves(influence.grid, contact.pressure, waves, trough);
  return {-contact.approach, contact.max_pressure};
}

CaseResult contact_filter(const VerifyInputs& inputs, const ProgressText& progress) {
  const TyreOnBlock bodies = tyre_of(inputs, false);
  CaseResult result;
  const auto compare = [&](const Waves& waves) {
    const Rest half_crest = half_space_rest(bodies, waves, false);
    const Rest half_trough = half_space_rest(bodies, waves, true);
    const Rest crest = rest(bodies, waves, false, progress);
    const Rest trough = rest(bodies, waves, true, progress);
    const std::string at = fmt::format(" at {:.3g} mm", 1e3 * waves.wavelength);
    const double gain = (half_crest.height - half_trough.height) / waves.depth;
    // A tenth of what the patch takes from the depth.
    const double bound = std::max(0.002, 0.1 * (1 - gain)) * std::max(1.0, bodies.fineness());
    result.findings.push_back(
        {"gain" + at, "-", (crest.height - trough.height) / waves.depth, gain, bound, true});
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
