// The time step: distance of the computed stable step from the true one, and the behaviour on either side.

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/error.hpp"
#include "drivers/engine/start/step_limit.hpp"
#include "drivers/verify/cases.hpp"
#include "drivers/verify/small_models.hpp"

namespace tread {

namespace {

constexpr std::int64_t kNoticed = 1000;  ///< number of steps within which a step beyond the limit shows

struct Candidate {
  std::string name;
  Scene scene;
};

std::vector<Candidate> candidates(const VerifyInputs& inputs) {
  const double h = inputs["element_size"];
  BarScene bar{.element_size = inputs["bar_element_size"], .length = 40 * inputs["bar_element_size"]};
  TyreScene tyre{.element_size = h};
  std::vector<Candidate> list = {{"bar", bar.scene()}, {"in contact", tyre.scene()}};
  const Model undamped(list[0].scene);
  // xi = 0.5: the step falls to 0.62.
  bar.damping =
      fmt::format("{{ kind = \"rayleigh_beta\", value = \"{} s\" }}", 0.5 * step_limit(undamped).stable_step);
  list.push_back({"bar, damped", bar.scene()});
  TyreScene stiff = tyre;
  const Model usual(tyre.scene());
  const HertzPatch& patch = usual.hertz_patch;
  stiff.contact = fmt::format("penetration_ratio = {}",
                              patch.max_pressure / (9 * patch.approach * usual.contact->options().penalty));
  list.push_back({"in contact, penalty times 9", stiff.scene()});
  TyreScene damped = tyre;
  damped.damping = "{ kind = \"high_frequency_fraction\", value = 0.2 }";
  list.push_back({"in contact, damped", damped.scene()});
  TyreScene tied = tyre;
  tied.rail = "CN60";
  list.push_back({"tied blocks, in contact", tied.scene()});
  TyreScene fastened = tyre;
  fastened.support = "fastenings";
  fastened.more =
      "[fastenings]\ncount = 2\nspacing = \"0.3 m\"\nfirst = \"0.15 m\"\npad_length = \"0.1 m\"\n"
      "pad_width = \"60 mm\"\ndamping = \"2 MN s/m\"\n";
  list.push_back({"fastenings' dampers times 10, in contact", fastened.scene()});
  return list;
}

struct Limit {
  double computed = 0;          ///< [s]
  bool holds = false;           ///< true if the computed step itself is stable
  double longest = 0;           ///< longest step found stable [s]
  std::vector<double> beyond;   ///< unstable steps over `longest` [-]
  std::vector<double> endured;  ///< number of steps done with each of them
};

/// Bisects from the computed step towards 0.9 or 1.1 of it.
Limit true_limit(const Candidate& candidate, const Preload& preload, double computed, std::int64_t steps) {
  constexpr double kReach = 0.1;
  constexpr double kResolution = 1e-4;
  std::vector<std::pair<double, double>> stops;
  const auto stopped = [&](double dt) {
    const SmallRun run = run_small(candidate.scene, preload, dt, steps);
    if (run.stopped) stops.emplace_back(dt, static_cast<double>(run.steps));
    return run.stopped;
  };
  Limit limit{computed, !stopped(computed), computed, {}, {}};
  double unstable = (limit.holds ? 1 + kReach : 1) * computed;
  if (!limit.holds) limit.longest = (1 - kReach) * computed;
  if (stopped(limit.holds ? unstable : limit.longest) != limit.holds)
    throw NumericalError(
        fmt::format("verify: {}: the true limit differs by more than {:g} % from the computed {:.4e} s",
                    candidate.name, 100 * kReach, computed));
  while (unstable - limit.longest > kResolution * computed) {
    const double middle = 0.5 * (limit.longest + unstable);
    (stopped(middle) ? unstable : limit.longest) = middle;
  }
  std::sort(stops.begin(), stops.end());
  for (const auto& [dt, done] : stops) {
    limit.beyond.push_back(dt / limit.longest);
    limit.endured.push_back(done);
  }
  return limit;
}

/// Number of steps in which rounding grows to the size of the motion: the larger root of z^2 + (4 r^2 - 2) z
/// + 1.
Series growth_theory() {
  Series series{"rounding grows to 1", {}, {}, Stroke::dashed};
  for (double r = 1.0005; r < 1.1; r += r < 1.005 ? 0.0005 : 0.0025) {
    series.x.push_back(r);
    series.y.push_back(std::log10(-std::log(2e-16) / std::acosh(2 * r * r - 1)));
  }
  return series;
}

/// Energy over many steps just below the limit.
void add_long_run(const Candidate& bar, double dt, std::int64_t steps, CaseResult& result) {
  Model model(bar.scene);
  const Preload preload = solve_preload(model, {}, [](const std::string&) {});
  double drift = 0;
  double energy = 0;
  Series residual{"bar at 0.99 of the computed step", {}, {}, Stroke::solid};
  const SmallRun run = run_small(bar.scene, preload, dt, steps, [&](const Simulation& simulation) {
    const EnergyLedger& e = simulation.sample().energy;
    energy = std::max(energy, e.kinetic + e.strain);
    drift = std::max(drift, std::abs(e.residual));
    if (simulation.steps() % 1024 != 1) return;
    residual.x.push_back(1e-3 * static_cast<double>(simulation.steps()));
    residual.y.push_back(1e12 * e.residual / energy);
  });
  const double done = static_cast<double>(run.steps);
  result.findings.push_back({"bar at 0.99: steps done", "-", done, static_cast<double>(steps), 0.0, true});
  result.findings.push_back(
      {"bar at 0.99: largest change of the energy / energy", "-", drift / energy, 0, 1e-6, true});
  Figure figure;
  figure.title = "Energy just below the limit";
  figure.x_label = "Steps [1000]";
  figure.panels = {{"Change of the energy / energy [1e-12]", {residual}, {}, 200, std::nullopt}};
  result.figures.push_back(figure);
}

CaseResult extremes_step(const VerifyInputs& inputs, const ProgressText& progress) {
  const OneThread one_thread;
  const auto steps = static_cast<std::int64_t>(inputs["steps"]);
  CaseResult result;
  Figure figure;
  figure.title = "Where stability ends";
  figure.x_label = "Time step / true limit [-]";
  figure.panels = {{"log10 of the steps until the run stops", {growth_theory()}, {}, 260, std::nullopt}};
  figure.caption = "Below 1 no run stops.";
  const std::vector<Candidate> models = candidates(inputs);
  double bar_step = 0;
  for (const Candidate& candidate : models) {
    Model model(candidate.scene);
    const Preload preload = solve_preload(model, steady_motion(model), [](const std::string&) {});
    const double computed = step_limit(model).stable_step;
    if (bar_step == 0) bar_step = computed;
    const Limit limit = true_limit(candidate, preload, computed, steps);
    progress(
        fmt::format("{}: computed {:.5e} s, true limit {:.5e} s", candidate.name, computed, limit.longest));
    const auto find = [&](const char* what, const char* unit, double value, double reference,
                          std::optional<double> bound) {
      result.findings.push_back({candidate.name + ": " + what, unit, value, reference, bound, true});
    };
    find("computed step / true limit", "-", computed / limit.longest, 1, 0.01);
    find("the computed step itself is stable", "-", limit.holds ? 1 : 0, 1, 0.0);
    const SmallRun below = run_small(candidate.scene, preload, 0.99 * computed, steps);
    find("at 0.99, largest share of the energy that ends a run", "-", below.largest_share, 0, {});
    const SmallRun beyond = run_small(candidate.scene, preload, 1.02 * limit.longest, kNoticed);
    find("at 1.02, steps until it is stopped", "-", static_cast<double>(beyond.steps), 0, kNoticed - 1.0);
    const bool named = beyond.reason.find("exceeds the stable step") != std::string::npos;
    find("at 1.02, the reason names the step", "-", named ? 1 : 0, 1, 0.0);
    progress(beyond.reason);
    figure.panels[0].series.push_back({candidate.name, limit.beyond, limit.endured, Stroke::solid});
  }
  for (Series& series : figure.panels[0].series)
    if (series.stroke == Stroke::solid)
      for (double& y : series.y) y = std::log10(y);
  result.figures.push_back(figure);
  add_long_run(models[0], 0.99 * bar_step, static_cast<std::int64_t>(inputs["long_steps"]), result);
  return result;
}

}  // namespace

VerifyCase extremes_step_case() {
  std::vector<VerifyInput> inputs = {
      {"element_size", &kLength, "mm", 8e-3, {2e-3, 0.02}, "the elements' size in the contact"},
      {"bar_element_size", &kLength, "mm", 5e-3, {1e-4, 0.1}, "the bar's elements"},
      {"steps", nullptr, "", 3000, {1000, 1e6}, "steps that a stable run must do"},
      {"long_steps", nullptr, "", 2e5, {1000, 1e9}, "steps just below the limit"}};
  return {"extremes_step", "the computed stable step against the true one, found by bisection",
          std::move(inputs), extremes_step, kExtremes};
}

}  // namespace tread
