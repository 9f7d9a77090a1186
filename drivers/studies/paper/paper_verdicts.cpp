#include "drivers/studies/paper/paper_verdicts.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <functional>
#include <initializer_list>
#include <numbers>
#include <optional>
#include <utility>

#include "drivers/studies/multibody/multibody_run.hpp"
#include "drivers/studies/paper/curve_measures.hpp"

namespace tread {

namespace {

const std::string kVonMises = "surface.axis_max_von_mises_Pa";
const std::string kWork = "surface.axis_frictional_work_J_in_1.1_mm_cell";
constexpr double kPi = std::numbers::pi;

Judgement missing(const std::string& what) {
  return {Verdict::not_run, "not run: " + what};
}

Verdict of_parts(std::initializer_list<bool> parts) {
  const auto held = std::count(parts.begin(), parts.end(), true);
  if (held == static_cast<std::ptrdiff_t>(parts.size())) return Verdict::reproduced;
  return held == 0 ? Verdict::not_reproduced : Verdict::partly;
}

bool passed(const FinishedRun* run) {
  return run && has_passed(*run);
}

/// Names those of the passages that have not passed their corrugation.
Judgement missing(const PassageRuns& runs, const std::vector<Passage>& passages) {
  std::vector<std::string> names;
  for (const Passage& passage : passages)
    if (!passed(runs.find(passage))) names.push_back(name_of(passage));
  return missing(names.empty() ? "their surfaces" : fmt::format("{}", fmt::join(names, "; ")));
}

std::vector<Passage> joined(std::vector<Passage> passages, const std::vector<Passage>& more) {
  for (const Passage& one : more)
    if (std::find(passages.begin(), passages.end(), one) == passages.end()) passages.push_back(one);
  return passages;
}

Passage at_speed(double speed) {
  Passage passage = corrugated();
  passage.speed = speed;
  return passage;
}

std::optional<double> range_of(const FinishedRun& run, const std::string& path) {
  const auto high = run.number(path + ".max");
  const auto low = run.number(path + ".min");
  return high && low ? std::optional(*high - *low) : std::nullopt;
}

/// Values of some passages.
struct Listed {
  std::vector<double> at, values;

  double place_of_largest() const {
    return at[static_cast<std::size_t>(std::max_element(values.begin(), values.end()) - values.begin())];
  }
  bool grows() const {
    return std::adjacent_find(values.begin(), values.end(), std::greater_equal<>()) == values.end();
  }
  std::string text(const char* format, double scale) const {
    std::string list;
    for (const double v : values)
      list += (list.empty() ? "" : ", ") + fmt::format(fmt::runtime(format), scale * v);
    return list;
  }
};

/// Lists `value` of every passage that has passed its corrugation; nullopt unless all have.
template <class Value>
std::optional<Listed> list(const PassageRuns& runs, const std::vector<Passage>& passages,
                           double Passage::*member, const Value& value) {
  Listed listed;
  for (const Passage& passage : passages) {
    const FinishedRun* run = runs.find(passage);
    const std::optional<double> v = passed(run) ? value(*run) : std::nullopt;
    if (!v) return std::nullopt;
    listed.at.push_back(passage.*member);
    listed.values.push_back(*v);
  }
  return listed;
}

Judgement follows_the_pattern(const PassageRuns& runs) {
  const FinishedRun* run = runs.find(corrugated());
  if (!passed(run)) return missing("corrugation D");
  const auto axis = [&](const char* column, const char* unit) { return along_axis(*run, column, unit); };
  const CurvePoints pressure = axis("max_pressure", "Pa");
  const CurvePoints shear = axis("max_shear", "Pa");
  const CurvePoints von_mises = axis("max_von_mises", "Pa");
  const CurvePoints work = axis("frictional_work", "J/m2");
  bool pattern = true;
  std::string shares;
  for (const auto& [name, curve] : {std::pair{"F_N", history_over_way(*run, "vertical_force", "N")},
                                    std::pair{"F_L", history_over_way(*run, "longitudinal_force", "N")},
                                    std::pair{"p", pressure}, std::pair{"shear", shear}}) {
    const auto wave = wave_pattern(*run, curve);
    if (!wave) return missing("its surface");
    constexpr double kMost = 0.5;
    pattern = pattern && wave->share > kMost;
    shares += fmt::format("{} {:.0f} %, {:.2f} pi; ", name, 100 * wave->share, wave->shift / kPi);
  }
  const auto v_shear = correlation(*run, von_mises, shear);
  const auto v_pressure = correlation(*run, von_mises, pressure);
  const auto w_shear = correlation(*run, work, shear);
  const auto w_pressure = correlation(*run, work, pressure);
  if (!v_shear || !v_pressure || !w_shear || !w_pressure) return missing("its surface");
  return {
      of_parts({pattern, *v_shear > *v_pressure, *w_shear > *w_pressure}),
      fmt::format("share of the corrugation's pattern and shift before the crest: {}correlation of Von Mises "
                  "with shear {:.2f}, with pressure {:.2f}; of work {:.2f}, {:.2f}",
                  shares, *v_shear, *v_pressure, *w_shear, *w_pressure)};
}

Judgement feels_the_supports(const PassageRuns& runs) {
  const FinishedRun* run = runs.find(corrugated());
  const auto effect = passed(run) ? fastening_effect(*run) : std::nullopt;
  if (!effect) return missing("corrugation D");
  std::string text = fmt::format("{:+.1f} % of static at 300 km/h", 100 * *effect);
  for (const double speed : {100.0, 180.0, 250.0, 400.0, 500.0})
    if (const FinishedRun* other = runs.find(at_speed(speed)); passed(other))
      if (const auto value = fastening_effect(*other))
        text += fmt::format(", {:+.1f} % at {:g}", 100 * *value, speed);
  constexpr double kConsiderable = 0.05;
  return {*effect > kConsiderable ? Verdict::reproduced : Verdict::not_reproduced, text};
}

Judgement oscillates_to_full_sliding(const PassageRuns& runs) {
  const FinishedRun* run = runs.find(corrugated());
  if (!passed(run)) return missing("corrugation D");
  const auto slip = run->number("full_slip_share");
  const auto at_node = node_creepage_ratio(*run);
  const auto mean = mean_creepage_ratio(*run);
  if (!slip) return missing("its share of full slip");
  if (!at_node || !mean) return missing("a steady creepage before corrugation D");
  constexpr double kSignificant = 1.5;
  return {
      of_parts({*slip > 0 && *slip<1, *at_node> kSignificant}),
      fmt::format(
          "the whole patch slides during {:.1f} % of the way; largest creepage over the steady one {:.2f} "
          "at N_cr outside the patch, {:.2f} in the mean of 28 nodes",
          100 * *slip, *at_node, *mean)};
}

Judgement grows_with_traction(const PassageRuns& runs) {
  std::vector<Passage> passages;
  for (const double mu : {0.1, 0.2, 0.3, 0.4, 0.5}) {
    passages.push_back(corrugated());
    passages.back().mu = mu;
  }
  const auto range = [&](const std::string& path) {
    return list(runs, passages, &Passage::mu, [&](const FinishedRun& run) { return range_of(run, path); });
  };
  const auto von_mises = range(kVonMises);
  const auto work = range(kWork);
  if (!von_mises || !work) return missing(runs, passages);
  return {of_parts({von_mises->grows(), work->grows()}),
          fmt::format("ranges at mu 0.1 to 0.5: Von Mises {} MPa, work {} mJ",
                      von_mises->text("{:.0f}", 1e-6), work->text("{:.1f}", 1e3))};
}

Judgement worst_wave_and_speed(const PassageRuns& runs) {
  const std::vector<Passage> waves = {corrugated(65), corrugated(80), corrugated(95)};
  std::vector<Passage> speeds;
  for (const double speed : {100.0, 180.0, 250.0, 300.0, 400.0, 500.0}) speeds.push_back(at_speed(speed));
  const auto most = [](const FinishedRun& run) { return run.number("vertical_force_N.max"); };
  const auto most_l = [](const FinishedRun& run) { return run.number("longitudinal_force_N.max"); };
  const auto stress = [](const FinishedRun& run) { return range_of(run, kVonMises); };
  const auto by_wave = list(runs, waves, &Passage::wavelength, most);
  const auto by_wave_l = list(runs, waves, &Passage::wavelength, most_l);
  const auto by_wave_v = list(runs, waves, &Passage::wavelength, stress);
  const auto by_speed = list(runs, speeds, &Passage::speed, most);
  const auto by_speed_v = list(runs, speeds, &Passage::speed, stress);
  if (!by_wave || !by_wave_l || !by_wave_v || !by_speed || !by_speed_v)
    return missing(runs, joined(waves, speeds));
  const auto between = [](double speed) { return speed >= 250 && speed <= 300; };
  return {of_parts({by_wave->place_of_largest() == 80, by_wave_l->place_of_largest() == 80,
                    by_wave_v->place_of_largest() == 80, between(by_speed->place_of_largest()),
                    between(by_speed_v->place_of_largest())}),
          fmt::format(
              "largest F_N at 65, 80, 95 mm: {} kN, F_L {} kN, range of Von Mises {} MPa; F_N at 100 to 500 "
              "km/h: {} kN, range of Von Mises {} MPa",
              by_wave->text("{:.1f}", 1e-3), by_wave_l->text("{:.1f}", 1e-3), by_wave_v->text("{:.0f}", 1e-6),
              by_speed->text("{:.1f}", 1e-3), by_speed_v->text("{:.0f}", 1e-6))};
}

Judgement multibody_overestimates(const PassageRuns& runs) {
  Passage worst = corrugated(80, 0.18);
  worst.speed = 500;
  const FinishedRun* run = runs.find(worst);
  if (!passed(run)) return missing("80 mm, 0.18 mm at 500 km/h");
  const MultibodyResult cheap = run_multibody(multibody_model(run->scene, BeamTheory::euler), {});
  const double high = run->number("vertical_force_N.max").value_or(0);
  const double lost = way_without_contact(*run, history_over_way(*run, "vertical_force", "N"));
  const double cheap_lost = way_without_contact(*run, force_over_way(cheap));
  return {of_parts({cheap.force.max > high, cheap_lost > 0, lost == 0}),
          fmt::format(
              "largest F_N {:.1f} kN, without contact over {:.0f} mm of the corrugation; by the multi-body "
              "approach {:.1f} kN and {:.0f} mm",
              1e-3 * high, 1e3 * lost, 1e-3 * cheap.force.max, 1e3 * cheap_lost)};
}

/// Premise of the paper's theory: the response to a corrugation is larger at crests and grows with depth.
Judgement response_fights_the_corrugation(const PassageRuns& runs) {
  const FinishedRun* run = runs.find(corrugated());
  std::vector<Passage> depths;
  for (const double depth : {0.04, 0.08, 0.14, 0.18}) depths.push_back(corrugated(80, depth));
  const auto ranges =
      list(runs, depths, &Passage::depth, [](const FinishedRun& one) { return range_of(one, kWork); });
  if (!passed(run) || !ranges) return missing(runs, depths);
  const auto work = wave_pattern(*run, along_axis(*run, "frictional_work", "J/m2"));
  const auto von_mises = wave_pattern(*run, along_axis(*run, "max_von_mises", "Pa"));
  if (!work || !von_mises) return missing("its surface");
  return {of_parts({work->larger_at_crests(), von_mises->larger_at_crests(), ranges->grows()}),
          fmt::format(
              "not decided by single passages; what it rests on: work peaks {:.2f} pi, Von Mises {:.2f} pi "
              "before the crests; range of work at 0.04 to 0.18 mm {} mJ",
              work->shift / kPi, von_mises->shift / kPi, ranges->text("{:.1f}", 1e3))};
}

}  // namespace

const char* name_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::reproduced:
      return "reproduced";
    case Verdict::partly:
      return "partly";
    case Verdict::not_reproduced:
      return "not reproduced";
    default:
      return "not run";
  }
}

const std::vector<Conclusion>& paper_conclusions() {
  static const std::vector<Conclusion> conclusions = {
      {1,
       "Forces, pressure and shear follow the corrugation with slightly different phases; Von Mises stress "
       "and "
       "frictional work are closer to the shear than to the pressure",
       "two harmonics of the wavelength carry more than half of the variance of F_N, F_L, pressure and "
       "shear; "
       "correlations along the axis",
       follows_the_pattern},
      {2, "The discrete supports have a considerable influence at certain speeds",
       "F_N's peaks over fastenings exceed those between by more than 5 % of static at 300 km/h",
       feels_the_supports},
      {3,
       "The contact may oscillate between rolling-sliding and full sliding, with a significantly higher "
       "creepage",
       "the whole patch slides on a part of the way; largest creepage at N_cr outside the patch above 1.5 "
       "times the steady one",
       oscillates_to_full_sliding},
      {4, "Fluctuations of Von Mises stress and frictional work grow with the traction coefficient",
       "both ranges grow from mu 0.1 to 0.5", grows_with_traction},
      {5, "A wavelength about 80 mm and a speed of 250 to 300 km/h are worst",
       "largest F_N, F_L and range of Von Mises of 65, 80, 95 mm at 80; largest F_N and range of Von Mises "
       "over "
       "speed at 250 or 300 km/h",
       worst_wave_and_speed},
      {6, "The multi-body approach overestimates the interaction",
       "at 500 km/h and 0.18 mm its F_N is larger and it loses contact over the corrugation, the transient "
       "model does not",
       multibody_overestimates},
      {7, "The response to a corrugation works against its growth, so that it stabilises",
       "frictional work and Von Mises stress are larger at crests than at troughs; work's range grows with "
       "depth",
       response_fights_the_corrugation},
  };
  return conclusions;
}

Table short_verdict_table(const PassageRuns& runs) {
  Table table{"", {{"No."}, {"Verdict"}, {"Our numbers"}}, {}};
  for (const std::vector<std::string>& row : verdict_table(runs).rows)
    table.rows.push_back({row[0], row[3], row[4]});
  return table;
}

Table verdict_table(const PassageRuns& runs) {
  Table table{"", {{"No."}, {"Conclusion"}, {"Decided by"}, {"Verdict"}, {"Our numbers"}}, {}};
  for (const Conclusion& conclusion : paper_conclusions()) {
    const Judgement judgement = conclusion.judge(runs);
    table.rows.push_back({std::to_string(conclusion.number), conclusion.claim, conclusion.decided,
                          name_of(judgement.verdict), judgement.why});
  }
  return table;
}

}  // namespace tread
