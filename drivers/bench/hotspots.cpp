#include <fmt/core.h>

#include <algorithm>
#include <deque>
#include <memory>
#include <nlohmann/json.hpp>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "core/math/statistics.hpp"
#include "core/parallel/parallel.hpp"
#include "drivers/bench/benchmarks.hpp"
#include "drivers/bench/device_kernels.hpp"
#include "drivers/bench/hardware_counters.hpp"
#include "drivers/bench/measurement.hpp"
#include "drivers/bench/projection.hpp"
#include "drivers/bench/rolling_scene.hpp"
#include "drivers/bench/step_work.hpp"
#include "drivers/process/core_watch.hpp"
#include "drivers/results/run_results.hpp"
#include "io/report/plain_text.hpp"
#include "io/text/json.hpp"
#include "kernels/blocks/internal_force.hpp"
#include "kernels/device/device.hpp"

namespace tread {

namespace {

constexpr std::int64_t kWarmUpSteps = 20;

/// A phase in the mean of the measured steps.
struct Hotspot {
  const char* name;
  double seconds;         ///< of a step [s]
  double beside;          ///< of these, beside the elements [s]
  double parallel_share;  ///< of it, in parallel calls [-]
  double imbalance;       ///< slowest thread's busy time over the mean; 0: never parallel
  Load load;
  Limit limit;
  CounterValues counters;  ///< of all steps
  PhaseWork work;
};

/// Copies and launches of the steps on a device.
class DeviceSteps {
 public:
  DeviceSteps() : device_(chosen_device()) {
    if (device_) before_ = device_->traffic();
  }

  bool any() const { return !to_device_.empty(); }
  /// A step has ended.
  void note() {
    if (!device_) return;
    const DeviceTraffic now = device_->traffic();
    to_device_.push_back(static_cast<double>(now.to_device - before_.to_device));
    from_device_.push_back(static_cast<double>(now.from_device - before_.from_device));
    launches_.push_back(static_cast<double>(now.launches - before_.launches));
    before_ = now;
  }

  Json json() const {
    Json json;
    for (const auto& [name, values] :
         {std::pair{"bytes_to_device", &to_device_}, std::pair{"bytes_from_device", &from_device_},
          std::pair{"launches", &launches_}}) {
      json[name] = median(*values);
      json[std::string("mean_") + name] = mean(*values);
    }
    return json;
  }
  std::string text() const {
    return fmt::format(
        "Device: a step copies {:.0f} B to it and {:.0f} B from it, and starts {:.0f} kernels; with the "
        "steps "
        "that look at energies or anchor the wheel, {:.0f} B and {:.0f} B in the mean.\n",
        median(to_device_), median(from_device_), median(launches_), mean(to_device_), mean(from_device_));
  }

 private:
  static double mean(const std::vector<double>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
  }

  std::shared_ptr<Device> device_;
  DeviceTraffic before_;
  std::vector<double> to_device_, from_device_, launches_;  ///< by step
};

/// Sentences under the table.
std::string closing_note(const DeviceSteps& on_device) {
  if (!on_device.any())
    return "Beside: core-time beside the elements, whose time holds it. All other phases run one after the "
           "other.\n";
  return "Work on a device overlaps: a phase holds what the processor does, and waits for, in it. The limit "
         "is the "
         "device's triad.\n" +
         on_device.text();
}

double imbalance(const ParallelTimes& times) {
  const double sum = times.busy();
  double most = 0;
  for (const ParallelTimes::Thread& thread : times.by_thread) most = std::max(most, thread.busy);
  return sum > 0 ? most * threads() / sum : 0;
}

/// `of_byte`: the device's byte_seconds(). The bytes of a step are moved some time during it: phases then
/// have no load and no limit. 0: the processor takes the steps [s]
std::vector<Hotspot> hotspots_of(const Model& model, const PhaseClock& clock, std::int64_t steps,
                                 Limits& limits, double of_byte) {
  std::vector<Hotspot> spots;
  Hotspot whole{"whole step", 0, 0, 0, 0, {}, {}, {}, {}};
  const auto each = [steps](double all) { return all / static_cast<double>(steps); };
  for (const StepPhase phase : clock.phases()) {
    const PhaseTimes& times = clock.times(phase);
    const Load load = phase_load(model, phase);
    Hotspot spot{name_of(phase),
                 each(times.seconds),
                 each(times.beside),
                 times.parallel.wall / times.seconds,
                 imbalance(times.parallel),
                 {},
                 {},
                 times.counters,
                 {}};
    const double busy = times.parallel.busy();
    spot.work = {spot.name,
                 each(times.seconds - times.beside - times.parallel.wall),
                 each(busy),
                 each(times.parallel.longest),
                 each(times.parallel.wall - busy / threads()),
                 each(static_cast<double>(times.parallel.calls)),
                 load.bytes};
    if (of_byte == 0) {
      spot.load = load;
      spot.limit = limits.of(load, model.scene.precision == "double", model.internal->instruction_set());
    }
    whole.seconds += spot.seconds - spot.beside;
    whole.beside += spot.beside;
    whole.parallel_share += spot.parallel_share * spot.seconds;
    whole.load.flops += load.flops;
    whole.load.bytes += load.bytes;
    whole.limit.seconds += of_byte > 0 ? load.bytes * of_byte : spot.limit.seconds;
    whole.counters.cycles += spot.counters.cycles;
    whole.counters.instructions += spot.counters.instructions;
    whole.counters.cache_misses += spot.counters.cache_misses;
    spots.push_back(spot);
  }
  whole.parallel_share /= whole.seconds;
  spots.push_back(whole);
  return spots;
}

std::string optional_text(double value, const char* format) {
  return value > 0 ? fmt::format(fmt::runtime(format), value) : "";
}

Table hotspot_table(const std::vector<Hotspot>& spots, bool counted) {
  Table table{"",
              {{"Phase"},
               {"us/step", Align::right},
               {"Share", Align::right},
               {"In parallel", Align::right},
               {"Beside, us", Align::right},
               {"Imbalance", Align::right},
               {"MB/step", Align::right},
               {"GB/s", Align::right},
               {"MFLOP/step", Align::right},
               {"GFLOP/s", Align::right},
               {"Of limit", Align::right},
               {""}},
              {}};
  if (counted) {
    table.columns.push_back({"Instructions/cycle", Align::right});
    table.columns.push_back({"Cache misses/1000 instr.", Align::right});
  }
  const double whole = spots.back().seconds;
  for (const Hotspot& s : spots) {
    std::vector<std::string> row = {s.name,
                                    fmt::format("{:.1f}", 1e6 * s.seconds),
                                    fmt::format("{:.1f} %", 100 * s.seconds / whole),
                                    fmt::format("{:.0f} %", 100 * s.parallel_share),
                                    optional_text(1e6 * s.beside, "{:.1f}"),
                                    optional_text(s.imbalance, "{:.2f}"),
                                    optional_text(1e-6 * s.load.bytes, "{:.2f}"),
                                    optional_text(1e-9 * s.load.bytes / s.seconds, "{:.2f}"),
                                    optional_text(1e-6 * s.load.flops, "{:.2f}"),
                                    optional_text(1e-9 * s.load.flops / s.seconds, "{:.2f}"),
                                    optional_text(s.limit.seconds / s.seconds, "{:.2f}"),
                                    s.limit.seconds > 0 && &s != &spots.back() ? s.limit.name() : ""};
    if (counted) {
      const auto instructions = static_cast<double>(std::max<std::int64_t>(1, s.counters.instructions));
      const auto cycles = static_cast<double>(std::max<std::int64_t>(1, s.counters.cycles));
      row.push_back(fmt::format("{:.2f}", instructions / cycles));
      row.push_back(fmt::format("{:.2f}", 1e3 * static_cast<double>(s.counters.cache_misses) / instructions));
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

/// The middle one of the runs by the time of their steps; of an even number the faster of both.
const std::vector<Hotspot>& median_run(std::vector<std::vector<Hotspot>>& runs) {
  const auto middle = runs.begin() + static_cast<std::ptrdiff_t>((runs.size() - 1) / 2);
  std::nth_element(runs.begin(), middle, runs.end(),
                   [](const auto& a, const auto& b) { return a.back().seconds < b.back().seconds; });
  return *middle;
}

Measurement of_whole_steps(const std::vector<std::vector<Hotspot>>& runs, double processor_share) {
  std::vector<double> seconds;
  seconds.reserve(runs.size());
  for (const std::vector<Hotspot>& spots : runs) seconds.push_back(spots.back().seconds);
  return summarise(seconds, processor_share);
}

std::string json_lines(const std::vector<Hotspot>& spots, const Measurement& measured, std::int64_t elements,
                       bool counted) {
  std::string lines;
  for (const Hotspot& s : spots) {
    Json json = {{"phase", s.name},
                 {"backend", backend()},
                 {"device", device_name()},
                 {"threads", threads()},
                 {"elements", elements},
                 {"repetitions", measured.repetitions},
                 {"processor_share", measured.processor_share},
                 {"spread", measured.spread},
                 {"seconds_per_step", s.seconds},
                 {"share", s.seconds / spots.back().seconds},
                 {"parallel_share", s.parallel_share},
                 {"beside_s", s.beside},
                 {"imbalance", s.imbalance},
                 {"serial_s", s.work.serial},
                 {"busy_s", s.work.busy},
                 {"longest_items_s", s.work.longest},
                 {"parallel_calls", s.work.calls}};
    if (!chosen_device() || &s == &spots.back()) {
      json["bytes_per_step"] = s.load.bytes;
      json["flops_per_step"] = s.load.flops;
      json["gb_per_s"] = 1e-9 * s.load.bytes / s.seconds;
      json["gflops"] = 1e-9 * s.load.flops / s.seconds;
      json["fraction_of_limit"] = s.limit.seconds / s.seconds;
    }
    if (counted) {
      json["cycles"] = s.counters.cycles;
      json["instructions"] = s.counters.instructions;
      json["cache_misses"] = s.counters.cache_misses;
    }
    lines += json_line(json);
  }
  return lines;
}

/// Steps on other numbers of cores, from the phases of one run.
class Projection {
 public:
  Projection(const std::vector<Hotspot>& spots, const std::vector<int>& cores) {
    std::vector<PhaseWork> phases;
    for (auto spot = spots.begin(); spot + 1 != spots.end(); ++spot) phases.push_back(spot->work);
    waits_ = fit_waits(phases, threads());
    for (const int count : cores) steps_.push_back(project(phases, waits_, count));
  }

  std::string text(double elements) const {
    return fmt::format(
        "Projected from these phases: serial time, work over the cores or the longest items, and waits of "
        "{:.1f} us a call, times the binary logarithm of the cores, and {:.1f} % of the work\n"
        "Work is the core-time of bodies on {} thread{}. More threads slow one another's bodies, which the "
        "model leaves out: efficiencies are upper estimates\n{}",
        1e6 * waits_.call, 100 * waits_.share, threads(), threads() == 1 ? "" : "s",
        plain_text(projection_table(steps_, elements)));
  }
  std::string json_lines() const {
    std::string lines;
    for (const ProjectedStep& step : steps_)
      lines += json_line({{"projected_cores", step.cores},
                          {"seconds_per_step", step.seconds},
                          {"efficiency", step.efficiency},
                          {"lost_serial", step.serial},
                          {"lost_uneven", step.uneven},
                          {"lost_waiting", step.waiting},
                          {"memory_bytes_per_s", step.bandwidth},
                          {"wait_of_a_call_s", waits_.call},
                          {"wait_share", waits_.share},
                          {"largest_loss", step.limit}});
    return lines;
  }

 private:
  WaitModel waits_;
  std::vector<ProjectedStep> steps_;
};

}  // namespace

void bench_hotspots(const ResolvedScene& resolved, const BenchHotspotsOptions& options) {
  const HardwareCounters counters;  // before the threads start, so that theirs count
  use_threads(options.threads);
  choose_device(options.device);
  if (!options.cores.empty() && chosen_device())
    throw InputError("bench hotspots: --cores projects steps of the processor; leave out --device");
  const Progress progress(options.quiet);
  const RollingScene scene(resolved, progress, options.device);
  Simulation simulation = scene.start();
  const std::int64_t all = step_count(resolved.scene, scene.dt());
  const std::int64_t before = std::min(kWarmUpSteps, all / 2);
  const int repetitions = options.plan.repetitions;
  const std::int64_t steps = std::clamp((all - before) / repetitions, std::int64_t{1}, options.steps);
  while (simulation.steps() < before) simulation.step();
  std::deque<PhaseClock> clocks;
  DeviceSteps on_device;
  const CoreWatch cores;
  while (clocks.size() < static_cast<std::size_t>(repetitions) && simulation.steps() + steps <= all) {
    PhaseClock& clock = clocks.emplace_back(
        counters.available() ? std::function<CounterValues()>([&] { return counters.read(); })
                             : std::function<CounterValues()>());
    simulation.observe(&clock);
    for (std::int64_t i = 0; i < steps; ++i) {
      simulation.step();
      on_device.note();
    }
    simulation.observe(nullptr);
    clock.stop();
  }
  const double processor_share = cores.share();
  Limits limits(options.plan);
  std::vector<std::vector<Hotspot>> runs;
  runs.reserve(clocks.size());
  const double of_byte = on_device.any() ? byte_seconds(*chosen_device(), options.plan) : 0;
  for (const PhaseClock& clock : clocks)
    runs.push_back(hotspots_of(scene.model(), clock, steps, limits, of_byte));
  limits.warn_of_busy_cores();
  const Measurement measured = of_whole_steps(runs, processor_share);
  const std::vector<Hotspot>& spots = median_run(runs);
  const std::int64_t elements = scene.model().elements();
  const Projection projection(spots, options.cores);
  if (options.json) {
    fmt::print("{}{}", json_lines(spots, measured, elements, counters.available()), projection.json_lines());
    if (on_device.any()) fmt::print("{}", json_line(on_device.json()));
    return;
  }
  fmt::print(
      "{} elements, {} steps, {} thread{} of {}, {}; {:.2f} ns an element-step, {:.2f} million a second "
      "(median of {}, spread {:.0f} %)\n",
      grouped(elements), steps, threads(), threads() == 1 ? "" : "s", backend(),
      scene.model().internal->instruction_set(), 1e9 * spots.back().seconds / static_cast<double>(elements),
      1e-6 * static_cast<double>(elements) / spots.back().seconds, measured.repetitions,
      100 * measured.spread);
  fmt::print("{}", plain_text(hotspot_table(spots, counters.available())));
  fmt::print("{}", closing_note(on_device));
  if (!options.cores.empty()) fmt::print("\n{}", projection.text(static_cast<double>(elements)));
  if (!counters.available()) fmt::print("Hardware counters are not at hand ({}).\n", counters.reason());
}

}  // namespace tread
