#include "drivers/studies/multibody/calibration.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/error.hpp"
#include "core/math/interpolation.hpp"
#include "core/parallel/each_item.hpp"
#include "drivers/engine/model/evaluated_stretch.hpp"
#include "drivers/run/run_folder.hpp"
#include "drivers/run/scene_content.hpp"
#include "drivers/studies/multibody/model_difference.hpp"
#include "io/files/checkpoint_folder.hpp"
#include "io/files/history_reader.hpp"

namespace tread {

namespace {

constexpr double kSoftest = 0.05;  ///< softest value tried, over the scene's C
constexpr double kStiffest = 3;
constexpr int kScan = 24;    ///< number of values tried at first
constexpr int kRefine = 24;  ///< number of further values about the best

struct Curve {
  std::vector<double> x, force;
};

/// Comparison of model and run over the stretch that both cover.
class Fit {
 public:
  Fit(const MultibodyModel& model, const TransientRun& run, const MultibodyStep& step)
      : model_(model), step_(step), run_{run.x, run.force} {
    const Span stretch = evaluated_stretch(model.scene, model.corrugation);
    first = std::max(stretch.first, run.x.front());
    last = std::min(stretch.last, run.x.back());
    for (std::size_t i = 0; i < run.x.size(); ++i)
      if (run.x[i] >= first && run.x[i] <= last) {
        x.push_back(run.x[i]);
        force_.push_back(run.force[i]);
      }
    model_.speed = run.speed_between(first, last);
  }

  CurveFit of_run() const { return fit(run_); }
  CurveFit of_model(double contact) const { return fit(rolled(contact)); }
  double misfit(double contact) const { return of_model(contact).misfit; }
  double speed() const { return model_.speed; }

  double first = 0, last = 0;  ///< [m]
  std::vector<double> x;       ///< places of the run between them [m]

 private:
  Curve rolled(double contact) const {
    MultibodyModel model = model_;
    model.vehicle.contact = contact;
    const MultibodyResult result = run_multibody(model, step_);
    Curve curve;
    for (const MultibodySample& s : result.samples) {
      curve.x.push_back(s.x);
      curve.force.push_back(s.force);
    }
    return curve;
  }

  CurveFit fit(const Curve& curve) const {
    CurveFit fit;
    double squares = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
      // Its first and last sample are up to a step within the run's.
      const double value = value_at(curve.x, curve.force, std::clamp(x[i], curve.x.front(), curve.x.back()));
      fit.values.push_back(value);
      squares += (value - force_[i]) * (value - force_[i]);
    }
    fit.misfit = std::sqrt(squares / static_cast<double>(x.size()));
    fit.force = statistics(fit.values);
    if (model_.scene.corrugation && model_.scene.corrugation->kind == "sine") fit.shift = shift_of(curve);
    return fit;
  }

  /// Mean over the crests that the run covers, too: the model rolls on to the corrugation's end.
  double shift_of(const Curve& curve) const {
    const double wavelength = model_.scene.corrugation->wavelength;
    std::vector<CrestPeak> peaks = crest_peaks(model_.corrugation, wavelength, curve.x, curve.force);
    std::erase_if(peaks, [&](const CrestPeak& peak) {
      return peak.crest - 0.5 * wavelength <= run_.x.front() ||
             peak.crest + 0.5 * wavelength >= run_.x.back();
    });
    return mean_shift(peaks);
  }

  MultibodyModel model_;
  MultibodyStep step_;
  Curve run_;
  std::vector<double> force_;  ///< force of the run at x [N]
};

/// TransientRun::unfinished of the run in a folder.
std::string unfinished_text(const std::filesystem::path& folder) {
  if (!CheckpointFolder(folder / kCheckpointFolder).holds_run()) return "";
  return fmt::format("the run is not done: {}",
                     is_taken(folder) ? "a process works on it" : resume_text(folder) + " goes on");
}

void require_same_passage(const MultibodyModel& model, const TransientRun& run) {
  const MultibodyModel theirs = multibody_model(run.scene, model.theory);
  std::string apart = track_difference(model, theirs);
  if (apart.empty()) apart = corrugation_difference(model, theirs);
  if (apart.empty()) apart = surface_difference(model, theirs);
  const double ours = model.scene.motion->speed;
  if (apart.empty() && std::abs(ours - theirs.speed) > 1e-6 * ours)
    apart = fmt::format("motion.speed is {:.6g} m/s here and {:.6g} m/s there", ours, theirs.speed);
  if (!apart.empty())
    throw InputError(
        fmt::format("--calibrate {}: {} (here: the scene, there: the run); calibrate with the "
                    "run's own scene, {}",
                    run.directory.string(), apart, (run.directory / kKeptScene).string()));
}

}  // namespace

double TransientRun::speed_between(double first, double last) const {
  const auto begin = std::lower_bound(x.begin(), x.end(), first) - x.begin();
  const auto end = std::upper_bound(x.begin(), x.end(), last) - x.begin();
  if (end - begin < 2) return 0;
  const auto a = static_cast<std::size_t>(begin);
  const auto b = static_cast<std::size_t>(end) - 1;
  return (x[b] - x[a]) / (time[b] - time[a]);
}

std::string TransientRun::further() const {
  return unfinished.empty() ? "let it roll further (motion.duration)" : unfinished;
}

TransientRun read_transient_run(const std::filesystem::path& directory, const std::string& force) {
  TransientRun run;
  run.directory = directory;
  require_run_folder(directory);
  run.unfinished = unfinished_text(directory);
  if (!std::filesystem::exists(directory / kKeptScene))
    throw InputError(
        fmt::format("{}: it is no run's folder, it has no {}; give the one that `tread run -o` was given, of "
                    "a study that of one of its runs",
                    directory.string(), kKeptScene));
  KeptScene kept = kept_scene(directory);
  run.changed = difference(scene_content(kept.resolved), kept.content);
  run.scene = std::move(kept.resolved.scene);
  if (!run.scene.motion)
    throw InputError(
        fmt::format("{}: a run without [motion] has no histories; give the folder of a run that rolls",
                    directory.string()));
  const std::filesystem::path histories = directory / "histories.csv";
  if (!run.unfinished.empty() && !std::filesystem::exists(histories))
    throw InputError(fmt::format("{}: it has not rolled yet; {}", directory.string(), run.unfinished));
  std::vector<std::vector<double>> columns =
      read_history(histories, {{"time", "s"}, {"wheel_x", "m"}, {force, "N"}});
  run.time = std::move(columns[0]);
  run.x = std::move(columns[1]);
  run.force = std::move(columns[2]);
  if (run.x.size() < 2 || !std::is_sorted(run.x.begin(), run.x.end()))
    throw InputError(fmt::format("{}: expected at least two rows with a growing wheel_x; {}",
                                 histories.string(), run.further()));
  return run;
}

void require_same_files(const TransientRun& run, const std::string& option) {
  if (!run.changed.empty())
    throw InputError(
        fmt::format("{}: {} (here: on the disk, there: the run); put back what the run had, or run it again",
                    option, run.changed));
}

void require_samples(const TransientRun& run, const std::string& option, const Span& stretch, double wave) {
  constexpr double kOfAWave = 8;
  int count = 0;
  double widest = 0;
  double before = stretch.first;
  for (const double x : run.x) {
    if (x < stretch.first || x > stretch.last) continue;
    ++count;
    widest = std::max(widest, x - before);
    before = x;
  }
  widest = std::max(widest, stretch.last - before);
  if (count >= 2 && widest <= wave / kOfAWave) return;
  throw InputError(fmt::format(
      "{}: its histories.csv has {} row{} in x = {:.3f} to {:.3f} m, up to {:.3g} mm apart, and "
      "a wave of {:.3g} mm takes {:g}; run it again with a shorter output.history_interval",
      option, count, count == 1 ? "" : "s", stretch.first, stretch.last, 1e3 * widest, 1e3 * wave, kOfAWave));
}

Calibration calibrate(const MultibodyModel& model, const TransientRun& run, const MultibodyStep& step) {
  const std::string option = "--calibrate " + run.directory.string();
  require_same_files(run, option);
  require_same_passage(model, run);
  const Fit fit(model, run, step);
  const double wave = model.scene.corrugation && model.scene.corrugation->kind == "sine"
                          ? model.scene.corrugation->wavelength
                          : 0.05;
  if (fit.last - fit.first < wave)
    throw InputError(
        fmt::format("{}: the run covers x = {:.3f} to {:.3f} m, less than {:.3g} mm of the stretch that is "
                    "evaluated; {}",
                    option, run.x.front(), run.x.back(), 1e3 * wave, run.further()));
  require_samples(run, option, {fit.first, fit.last}, wave);
  Calibration c;
  c.first = fit.first;
  c.last = fit.last;
  c.speed = fit.speed();
  c.x = fit.x;
  c.run = fit.of_run();
  c.before = fit.of_model(model.vehicle.contact);

  // After a scan, as many values again are tried between the neighbours of the best.
  const auto tried = [&](double low, double high, int count) {
    std::vector<std::pair<double, double>> found(static_cast<std::size_t>(count) + 1);
    each_item(found.size(), [&](std::size_t i) {
      const double factor = low * std::pow(high / low, static_cast<double>(i) / count);
      found[i] = {factor, fit.misfit(factor * model.vehicle.contact)};
    });
    return found;
  };
  std::vector<std::pair<double, double>> all = tried(kSoftest, kStiffest, kScan);
  const auto less = [](const auto& a, const auto& b) { return a.second < b.second; };
  const auto best = std::min_element(all.begin(), all.end(), less);
  c.at_bound = best == all.begin() || best == all.end() - 1;
  if (!c.at_bound) {
    const auto finer = tried((best - 1)->first, (best + 1)->first, kRefine);
    all.insert(all.end(), finer.begin() + 1, finer.end() - 1);
  }
  std::sort(all.begin(), all.end());
  const double factor = std::min_element(all.begin(), all.end(), less)->first;
  c.contact = factor * model.vehicle.contact;
  c.after = fit.of_model(c.contact);
  for (const auto& [tried_factor, misfit] : all) {
    c.factors.push_back(tried_factor);
    c.misfits.push_back(misfit);
  }
  return c;
}

}  // namespace tread
