#include "drivers/studies/paper/paper_numbers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "drivers/studies/multibody/multibody_run.hpp"
#include "drivers/studies/paper/curve_measures.hpp"
#include "drivers/studies/paper/paper_figures.hpp"

namespace tread {

namespace {

using Ours = std::function<std::optional<double>(const PassageRuns&)>;

/// Applies `measure` to a passage's run.
template <class Measure>
Ours of(const Passage& passage, const Measure& measure) {
  return [passage, measure](const PassageRuns& runs) -> std::optional<double> {
    const FinishedRun* run = runs.find(passage);
    return run ? measure(*run) : std::nullopt;
  };
}

/// Value in the run's summary at `path`, times `scale`.
Ours stated(const Passage& passage, std::string path, double scale) {
  return of(passage, [path = std::move(path), scale](const FinishedRun& run) -> std::optional<double> {
    const std::optional<double> value = run.number(path);
    return value ? std::optional(scale * *value) : std::nullopt;
  });
}

/// Value in the summary as by stated(), if the run has come to the end of its corrugation.
Ours over_the_corrugation(const Passage& passage, std::string path, double scale) {
  return [passage, value = stated(passage, std::move(path), scale)](const PassageRuns& runs) {
    const FinishedRun* run = runs.find(passage);
    return run && !vertical_peaks(*run).empty() && has_passed(*run) ? value(runs) : std::nullopt;
  };
}

std::optional<double> first_shift(const FinishedRun& run) {
  const std::vector<CrestPeak> peaks = vertical_peaks(run);
  return peaks.empty() ? std::nullopt : std::optional(peaks.front().shift / std::numbers::pi);
}

std::optional<double> smallest_by_multibody(const FinishedRun& run) {
  return 1e-3 * run_multibody(multibody_model(run.scene, BeamTheory::euler), {}).force.min;
}

constexpr double kSteadyTime = 0.028;  ///< time from which the paper calls forces stable [s]

std::vector<PaperNumber> smooth_numbers() {
  const Passage smooth = smooth_rail();
  Passage sudden = smooth;
  sudden.ramp = 0.1;
  Passage slow = smooth;
  slow.ramp = 10;
  const auto delay = [](const Passage& passage) {
    return of(passage, [](const FinishedRun& run) -> std::optional<double> {
      const auto seconds = longitudinal_delay(run, kSteadyTime);
      return seconds ? std::optional(1e3 * *seconds) : std::nullopt;
    });
  };
  const Ours difference = [=](const PassageRuns& runs) -> std::optional<double> {
    const FinishedRun* a = runs.find(smooth);
    const FinishedRun* b = runs.find(sudden);
    const auto share = a && b ? vertical_difference(*a, *b, kSteadyTime) : std::nullopt;
    return share ? std::optional(100 * *share) : std::nullopt;
  };
  const Ours residual = of(smooth_rail(500), [](const FinishedRun& run) -> std::optional<double> {
    const auto share = residual_oscillation(run, run.scene.zone_start);
    return share ? std::optional(100 * *share) : std::nullopt;
  });
  return {
      {"", "Table 1", "Static wheel load", "kN", 87.56, stated(smooth, "static_wheel_load_N", 1e-3),
       "weight of 8000 + 340 + 586 kg"},
      {"08", "section 3.1", "Oscillation of F_N behind B at 500 km/h", "% of static", 10, residual,
       "the paper: at most so much; ours: largest difference from static, with the part that returns with "
       "every "
       "fastening"},
      {"09", "section 3.2", "Effect of T1 on F_N", "% of static", 1, difference,
       "the paper: much less; ours: T1 = 0.1 against 5 ms, from 28 ms on"},
      {"09", "section 3.2", "Delay of F_L, T1 = 5 ms", "ms", 5, delay(smooth),
       "until F_L, mean over 1 ms, reaches 98 % of its steady mean, less T1"},
      {"09", "section 3.2", "Delay of F_L, T1 = 10 ms", "ms", 5, delay(slow), "as above"},
      {"10", "section 4.2", "Creepage, smooth rail", "%", 0.276, of(smooth, steady_creepage),
       "mean of 28 nodes over the last fastening span"},
  };
}

const std::string kWorkRange = "surface.axis_frictional_work_range_J_in_1.1_mm_cell";

Passage corrugated_at(double speed) {
  Passage passage = corrugated();
  passage.speed = speed;
  return passage;
}

std::vector<PaperNumber> corrugated_numbers() {
  const Passage d = corrugated();
  return {
      {"15", "section 4.2", "Largest F_N over corrugation D", "kN", 193.19,
       over_the_corrugation(d, "vertical_force_N.max", 1e-3), ""},
      {"15", "section 4.2", "Smallest F_N over corrugation D", "kN", 3.02,
       over_the_corrugation(d, "vertical_force_N.min", 1e-3), ""},
      {"18", "section 4.2", "Creepage before the corrugation", "%", 0.276, of(d, steady_creepage),
       "mean of 28 nodes over the last fastening span"},
      {"18", "section 4.2", "Largest creepage over that, at N_cr", "-", 2, of(d, node_creepage_ratio),
       "the paper: close to double; ours: N_cr outside the patch"},
      {"18", "section 4.2", "Largest creepage over that, mean of 28 nodes", "-", 2,
       of(d, mean_creepage_ratio), "the paper's double is that at N_cr"},
  };
}

std::vector<PaperNumber> wavelength_numbers() {
  const auto range = [](double wavelength) -> Ours {
    const Passage passage = corrugated(wavelength);
    return [most = over_the_corrugation(passage, "longitudinal_force_N.max", 1),
            least = over_the_corrugation(passage, "longitudinal_force_N.min", 1)](
               const PassageRuns& runs) -> std::optional<double> {
      const auto high = most(runs), low = least(runs);
      return high && low ? std::optional(*high - *low) : std::nullopt;
    };
  };
  const Ours ratio = [shorter = range(65),
                      usual = range(80)](const PassageRuns& runs) -> std::optional<double> {
    const auto above = shorter(runs), below = usual(runs);
    return above && below ? std::optional(*above / *below) : std::nullopt;
  };
  const Ours share = of(corrugated(65), [](const FinishedRun& run) -> std::optional<double> {
    const auto pattern = wave_pattern(run, history_over_way(run, "longitudinal_force", "N"));
    return pattern ? std::optional(100 * pattern->share) : std::nullopt;
  });
  std::vector<PaperNumber> numbers = {
      {"20", "section 4.3", "Range of F_L at 65 mm over that at 80 mm", "-", 1, ratio,
       "the paper: much smaller"},
      {"20", "section 4.3", "Pattern of the corrugation in F_L, 65 mm", "% of variance", 50, share,
       "the paper: F_L does not follow it; ours: two harmonics, a pattern above 50 %"},
  };
  for (const auto& [wavelength, work] : {std::pair{65.0, 0.016}, {80.0, 0.023}, {95.0, 0.024}})
    numbers.push_back({"21", "section 4.3", fmt::format("Range of the frictional work, {:g} mm", wavelength),
                       "J", work, over_the_corrugation(corrugated(wavelength), kWorkRange, 1),
                       "largest less smallest on the axis, cells of 1.1 mm x 1.1 mm"});
  return numbers;
}

/// Speed with the largest range of the frictional work [km/h]; nullopt unless all have been run.
std::optional<double> hardest_worked_speed(const PassageRuns& runs) {
  std::vector<std::pair<double, double>> by_range;
  for (const double speed : {100.0, 180.0, 250.0, 300.0, 400.0, 500.0}) {
    const std::optional<double> range = over_the_corrugation(corrugated_at(speed), kWorkRange, 1)(runs);
    if (!range) return std::nullopt;
    by_range.emplace_back(*range, speed);
  }
  return std::max_element(by_range.begin(), by_range.end())->second;
}

std::vector<PaperNumber> speed_numbers() {
  Passage worst = corrugated(80, 0.18);
  worst.speed = 500;
  std::vector<PaperNumber> numbers;
  for (const auto& [speed, shift] : {std::pair{100.0, 0.55}, {500.0, 0.21}})
    numbers.push_back(
        {"26", "section 4.5", fmt::format("Shift of F_N at the first crest, {:g} km/h", speed), "pi", shift,
         of(corrugated_at(speed), first_shift),
         "distance of the peak before the first crest behind the start, a wavelength being 2 pi"});
  numbers.push_back({"27", "section 4.5", "Speed of the largest range of the frictional work", "km/h", 250,
                     hardest_worked_speed, "of 100, 180, 250, 300, 400, 500 km/h"});
  numbers.push_back({"28", "section 4.6", "Smallest F_N by the multi-body approach", "kN", 0,
                     of(worst, smallest_by_multibody), "Euler beam, Hertz spring: contact is lost"});
  return numbers;
}

std::vector<PaperNumber> mesh_numbers() {
  const Passage d = corrugated();
  return {
      {"", "section 2.1.2", "Time step", "s", 8.9e-8, stated(d, "dt_s", 1),
       "the paper's for its mesh; ours for the quality that was run"},
      {"", "section 2.1.1", "Elements", "million", 1.46, stated(d, "elements", 1e-6), "as above"},
  };
}

}  // namespace

const std::vector<PaperNumber>& paper_numbers() {
  static const std::vector<PaperNumber> numbers = [] {
    std::vector<PaperNumber> all;
    for (const auto& part :
         {smooth_numbers, corrugated_numbers, wavelength_numbers, speed_numbers, mesh_numbers})
      for (PaperNumber& number : part()) all.push_back(std::move(number));
    return all;
  }();
  return numbers;
}

Table number_table(const PassageRuns& runs) {
  std::vector<Comparison> rows;
  for (const PaperNumber& number : paper_numbers())
    rows.push_back({number.quantity, number.unit, number.value, number.ours(runs),
                    number.place + (number.figure.empty() ? "" : ", Fig. " + shown_id(number.figure)) +
                        (number.remark.empty() ? "" : "; " + number.remark)});
  return comparison_table("", "Paper", rows);
}

std::string number_csv(const PassageRuns& runs) {
  std::string text = "figure,place,quantity,unit,paper,ours,difference [%]\n";
  for (const PaperNumber& number : paper_numbers()) {
    const std::optional<double> ours = number.ours(runs);
    text += fmt::format("{},{},\"{}\",{},{:g},", number.figure, number.place, number.quantity, number.unit,
                        number.value);
    if (ours) text += fmt::format("{:.5g}", *ours);
    text += ',';
    if (ours && number.value != 0) text += fmt::format("{:.2f}", 100 * (*ours / number.value - 1));
    text += '\n';
  }
  return text;
}

}  // namespace tread
