// Material damping over its whole range: the resulting step, the decay of a bar's first mode, and the refusal
// of larger damping.

#include <fmt/core.h>

#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "core/error.hpp"
#include "core/math/statistics.hpp"
#include "drivers/engine/start/step_limit.hpp"
#include "drivers/verify/cases.hpp"
#include "drivers/verify/small_models.hpp"

namespace tread {

namespace {

constexpr double kLeastShare = 0.5;  ///< smallest share of the undamped step; below it a scene is refused

/// The first longitudinal mode of a free bar of linear elements with lumped masses.
class FirstMode {
 public:
  FirstMode(const Model& model, double element_size)
      : model_(&model), block_(&model.mesh.blocks[0]), element_size_(element_size) {
    length_ = block_->stations.back() - block_->stations.front();
  }
  double frequency() const {  // angular frequency [rad/s]
    const Material& steel = model_->scene.rail_material();
    const double sound = std::sqrt(steel.youngs_modulus / steel.density);
    return 2 * sound / element_size_ * std::sin(0.5 * std::numbers::pi * element_size_ / length_);
  }
  /// Mass-weighted projection of a field's component along the bar.
  double amplitude(ConstNodeField field) const {
    double sum = 0;
    for (int station = 0; station < block_->station_count(); ++station) {
      const double x = block_->stations[static_cast<std::size_t>(station)] - block_->stations.front();
      const double shape = std::cos(std::numbers::pi * x / length_);
      for (int node = 0; node < block_->section.nodes(); ++node) {
        const std::int64_t slot = block_->base + block_->slot(node, station);
        sum += model_->mass[static_cast<std::size_t>(slot)] * shape * field[dof(slot, 0)];
      }
    }
    return sum;
  }

 private:
  const Model* model_;
  const SweptBlock* block_;
  double element_size_, length_ = 0;
};

/// Decay rate of the mode's amplitude [1/s]: the slope of half the logarithm of v- v+ + (w u)^2, which
/// central difference conserves without damping.
double measured_decay(Model& model, double element_size, double dt, std::int64_t steps, Series& curve) {
  const Preload preload = solve_preload(model, {}, [](const std::string&) {});
  Simulation simulation(model, preload, dt);
  const FirstMode mode(model, element_size);
  const double omega = mode.frequency();
  double first = 0;
  LineFit logarithms;
  while (simulation.steps() < steps) {
    const double velocity = mode.amplitude(simulation.velocity());
    const double displacement = mode.amplitude(simulation.displacement());
    const double time = simulation.time();
    simulation.step();
    if (simulation.steps() == 1)
      continue;  // the first velocity is that of the start, not of the half step before
    const double energy =
        velocity * mode.amplitude(simulation.velocity()) + std::pow(omega * displacement, 2);
    if (first == 0) first = energy;
    if (energy <= 1e-12 * first) break;  // the amplitude has decayed
    const double logarithm = 0.5 * std::log(energy / first);
    logarithms.add(time, logarithm);
    curve.x.push_back(1e3 * time);
    curve.y.push_back(std::exp(logarithm));
  }
  return -logarithms.slope();
}

struct Damping {
  std::string label;
  std::string value;  ///< TOML value
  double beta = -1;   ///< beta [s]; -1 where a fraction is stated
  double fraction = -1;
};

std::vector<Damping> dampings() {
  std::vector<Damping> list;
  for (const double beta : {0.0, 1e-9, 1e-8, 1e-7, 3e-7, 1e-6, 1e-5, 1e-4})
    list.push_back({fmt::format("rayleigh_beta = {:g} s", beta),
                    fmt::format("{{ kind = \"rayleigh_beta\", value = \"{} s\" }}", beta), beta, -1});
  for (const double fraction : {1e-4, 1e-3, 0.01, 0.1, 0.25})
    list.push_back({fmt::format("high_frequency_fraction = {:g}", fraction),
                    fmt::format("{{ kind = \"high_frequency_fraction\", value = {} }}", fraction), -1,
                    fraction});
  return list;
}

CaseResult extremes_damping(const VerifyInputs& inputs, const ProgressText& progress) {
  const OneThread one_thread;
  const double h = inputs["element_size"];
  BarScene bar{.element_size = h, .length = inputs["elements"] * h, .poissons_ratio = 0};
  const Model undamped(bar.scene());
  const double free_step = step_limit(undamped).stable_step;
  CaseResult result;
  Figure figure;
  figure.title = "Decay of the bar's first mode";
  figure.x_label = "Time [ms]";
  figure.panels = {{"Amplitude / first [-]", {}, {}, 260, std::nullopt}};
  for (const Damping& damping : dampings()) {
    bar.damping = damping.value;
    Model model(bar.scene());
    const double beta = model.beta[0];
    const double xi = beta / free_step;  // beta w / 2, w = 2 / free_step
    const double share = std::sqrt(1 + xi * xi) - xi;
    const auto find = [&](const char* what, const char* unit, double value, double reference,
                          std::optional<double> bound, bool absolute) {
      result.findings.push_back({damping.label + ": " + what, unit, value, reference, bound, absolute});
    };
    double dt = 0;
    try {
      dt = step_limit(model).stable_step;
    } catch (const InputError& error) {
      progress(error.what());
      find("step / undamped, refused below 0.5", "-", share, 0, kLeastShare, true);
      const bool formula = std::string(error.what()).find("2/w (sqrt(1 + xi^2) - xi)") != std::string::npos;
      find("the refusal states the formula", "-", formula ? 1 : 0, 1, 0.0, true);
      continue;
    }
    if (share < kLeastShare) find("refusals of a step below 0.5 of the undamped", "-", 0, 1, 0.0, true);
    find("step / undamped", "-", dt / free_step, share, 1e-3, false);
    Series curve{damping.label, {}, {}, Stroke::solid};
    const double omega = FirstMode(model, h).frequency();
    const double theory = 0.5 * beta * omega * omega;
    const double decay =
        measured_decay(model, h, 0.95 * dt, static_cast<std::int64_t>(inputs["steps"]), curve);
    progress(fmt::format("{}: dt {:.3e} s, decay {:.5g} 1/s", damping.label, dt, decay));
    // Undamped: nothing decays by more than rounding in a period.
    if (beta == 0)
      find("decay of the first mode in a period", "-", decay * 2 * std::numbers::pi / omega, 0, 1e-9, true);
    else
      find("decay of the first mode", "1/s", decay, theory, 0.02, false);
    figure.panels[0].series.push_back(curve);
  }
  result.figures.push_back(figure);
  return result;
}

}  // namespace

VerifyCase extremes_damping_case() {
  std::vector<VerifyInput> inputs = {
      {"element_size", &kLength, "mm", 5e-3, {1e-4, 0.05}, "the bar's elements"},
      {"elements", nullptr, "", 40, {10, 1000}, "elements along the bar"},
      {"steps", nullptr, "", 4000, {500, 1e6}, "steps of each run"}};
  return {"extremes_damping", "step and decay of a bar under material damping, from none to what is refused",
          std::move(inputs), extremes_damping, kExtremes};
}

}  // namespace tread
