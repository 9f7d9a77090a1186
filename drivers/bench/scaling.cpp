#include <fmt/core.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "core/page_vector.hpp"
#include "core/parallel/chunks.hpp"
#include "core/parallel/parallel.hpp"
#include "drivers/bench/benchmarks.hpp"
#include "drivers/bench/limits.hpp"
#include "drivers/bench/made_up_blocks.hpp"
#include "drivers/bench/measurement.hpp"
#include "drivers/bench/rolling_scene.hpp"
#include "drivers/process/core_watch.hpp"
#include "drivers/results/run_results.hpp"
#include "io/report/plain_text.hpp"
#include "io/text/json.hpp"
#include "kernels/blocks/internal_force.hpp"
#include "kernels/blocks/time_update.hpp"

namespace tread {

namespace {

/// Approximate bytes of an element: three vectors and the inverse mass of a node [B].
constexpr double kBytes = 10 * sizeof(double);

/// Parts of a step's time in the run of median time, in the mean of both middle ones of an even number [s].
struct StepTimes {
  Measurement measured;  ///< wall clock
  double parallel = 0;   ///< wall clock within parallel calls
  double busy = 0;       ///< core-time of all threads within bodies
};

/// Means of the steps of a run [s].
struct RunTimes {
  double wall, parallel, busy;
};

RunTimes time_run(const TimedCall& step, int calls) {
  ParallelTimes times;
  const auto reset = [&] {
    measure_parallel(nullptr);
    step.reset();
    measure_parallel(&times);
  };
  measure_parallel(&times);
  const double wall = time_calls({step.call, step.reset ? reset : std::function<void()>()}, calls);
  measure_parallel(nullptr);
  return {wall / calls, times.wall / calls, times.busy() / calls};
}

/// Steps of the warm-up do not count.
StepTimes time_steps(const TimedCall& step, const MeasurementPlan& plan) {
  const int calls = warm_up(step, plan);
  std::vector<RunTimes> runs;
  std::vector<double> walls;
  const CoreWatch cores;
  for (int i = 0; i < plan.repetitions; ++i) {
    runs.push_back(time_run(step, calls));
    walls.push_back(runs.back().wall);
  }
  const Measurement measured = summarise(walls, cores.share());
  std::ranges::sort(runs, {}, &RunTimes::wall);
  const RunTimes& low = runs[(runs.size() - 1) / 2];
  const RunTimes& high = runs[runs.size() / 2];
  return {measured, 0.5 * (low.parallel + high.parallel), 0.5 * (low.busy + high.busy)};
}

struct ScalingRow {
  const char* kind;  ///< "strong" or "weak"
  std::string_view backend;
  int threads;
  std::int64_t elements;
  StepTimes step;
  StepTimes one;  ///< times of the first row
  double triad;   ///< bandwidth on as many bytes, over that of one thread [-]

  /// Work relative to the first row [-].
  double growth() const { return kind[0] == 'w' ? threads : 1; }
  double core_time() const { return threads * step.measured.seconds; }
  double efficiency() const { return growth() * one.measured.seconds / core_time(); }
  /// Fraction of the core-time lost outside parallel calls [-].
  double lost_serial() const {
    const double serial = step.measured.seconds - step.parallel;
    return (threads * serial - growth() * (one.measured.seconds - one.parallel)) / core_time();
  }
  /// Fraction of the core-time lost in parallel calls by waiting for work or for the slowest thread [-].
  double lost_waiting() const { return (threads * step.parallel - step.busy) / core_time(); }
  /// Fraction of the core-time lost because the work takes longer beside the other threads [-].
  double lost_slower() const { return (step.busy - growth() * one.parallel) / core_time(); }
};

/// Makes, for a mesh of so many elements, a call that does one step with the threads that are set, on fields
/// whose pages these threads touch first. The data of an earlier call may go.
using StepMaker = std::function<TimedCall(std::int64_t elements)>;

PageVector<double> copied_by_threads(const AlignedVector<double>& values) {
  PageVector<double> copy(values.size());
  for_chunks(std::ssize(values), [&](std::int64_t first, std::int64_t last) {
    std::copy(values.data() + first, values.data() + last, copy.data() + first);
  });
  return copy;
}

TimedCall made_up_step(std::int64_t elements) {
  struct Data {
    explicit Data(std::int64_t count)
        : mesh(made_up_mesh(Sweep::extruded, false, count)),
          internal(mesh),
          u(copied_by_threads(made_up_field<double>(mesh, 1e-5))),
          v(u.size()),
          f(u.size()),
          inverse_mass(copied_by_threads(made_up_inverse_mass<double>(mesh))),
          update(mesh, inverse_mass.data()) {}
    Mesh mesh;
    InternalForce internal;
    PageVector<double> u, v, f, inverse_mass;
    TimeUpdate update;
  };
  const auto data = std::make_shared<Data>(elements);
  return {[data] {
    StepLoads loads;
    loads.dt = 1e-10;  // far below the stable step: the data stay bounded
    data->internal.move(data->update, loads, {data->u.data(), data->v.data(), data->f.data()});
    data->update.move_rest(loads, {data->u.data(), data->v.data(), data->f.data()},
                           data->internal.unmoved_tiles());
  }};
}

/// Rows for one to `most` threads of every backend. All backends share the first row: one thread needs no
/// backend.
class Scaling {
 public:
  Scaling(const BenchScalingOptions& options) : options_(options), limits_(options.plan) {
    use_threads(options.threads);
    most_ = threads();
    teams_ = options.threads.backend.empty() ? backends() : std::vector<std::string_view>{backend()};
  }

  void measure_kind(const char* kind, std::int64_t elements, const StepMaker& make) {
    const bool grows = kind[0] == 'w';
    StepTimes one;
    double alone = 0;  ///< time of a triad on one thread [s]
    for (int count = 1; count <= most_; ++count) {
      set_threads(count);
      const std::int64_t size = grows ? count * elements : elements;
      for (const std::string_view team : teams_) {
        if (count == 1 && team != teams_.front()) continue;
        set_backend(team);
        const StepTimes times = time_steps(make(size), options_.plan);
        const double triad =
            limits_.triad(static_cast<std::int64_t>(kBytes * static_cast<double>(size))).seconds;
        if (count == 1) {
          one = times;
          alone = triad;
        }
        rows_.push_back({kind, team, count, size, times, one, alone / triad});
      }
    }
  }

  void print() const {
    fmt::print("{}", options_.json ? json() : plain_text(table()));
    limits_.warn_of_busy_cores();
  }

 private:
  Table table() const {
    Table table{"",
                {{"Kind"},
                 {"Backend"},
                 {"Threads", Align::right},
                 {"Elements", Align::right},
                 {"ns/element-step", Align::right},
                 {"1e6/s", Align::right},
                 {"Efficiency", Align::right},
                 {"Lost: serial", Align::right},
                 {"waiting", Align::right},
                 {"slower", Align::right},
                 {"Triad", Align::right},
                 {"Spread", Align::right}},
                {}};
    const auto percent = [](double share) { return fmt::format("{:.1f} %", 100 * share); };
    for (const ScalingRow& r : rows_) {
      const double each = r.step.measured.seconds / static_cast<double>(r.elements);
      table.rows.push_back({r.kind, r.threads == 1 ? "" : std::string(r.backend), std::to_string(r.threads),
                            grouped(r.elements), fmt::format("{:.2f}", 1e9 * each),
                            fmt::format("{:.1f}", 1e-6 / each), percent(r.efficiency()),
                            percent(r.lost_serial()), percent(r.lost_waiting()), percent(r.lost_slower()),
                            fmt::format("{:.2f}", r.triad), percent(r.step.measured.spread)});
    }
    return table;
  }

  std::string json() const {
    std::string lines;
    for (const ScalingRow& r : rows_)
      lines += json_line({{"kind", r.kind},
                          {"backend", r.backend},
                          {"threads", r.threads},
                          {"elements", r.elements},
                          {"seconds_per_step", r.step.measured.seconds},
                          {"element_steps_per_s", static_cast<double>(r.elements) / r.step.measured.seconds},
                          {"efficiency", r.efficiency()},
                          {"lost_serial", r.lost_serial()},
                          {"lost_waiting", r.lost_waiting()},
                          {"lost_slower", r.lost_slower()},
                          {"triad_ratio", r.triad},
                          {"spread", r.step.measured.spread},
                          {"repetitions", r.step.measured.repetitions},
                          {"processor_share", r.step.measured.processor_share}});
    return lines;
  }

  BenchScalingOptions options_;
  Limits limits_;
  int most_ = 1;
  std::vector<std::string_view> teams_;
  std::vector<ScalingRow> rows_;
};

}  // namespace

void bench_scaling(const BenchScalingOptions& options) {
  Scaling scaling(options);
  for (const char* kind : {"strong", "weak"}) scaling.measure_kind(kind, options.elements, made_up_step);
  scaling.print();
}

void bench_scaling(const ResolvedScene& resolved, const BenchScalingOptions& options) {
  Scaling scaling(options);
  const Progress progress(options.json);
  const RollingScene scene(resolved, progress);
  const std::int64_t all = step_count(resolved.scene, scene.dt());
  std::optional<Simulation> simulation;
  const auto start = [&] {
    simulation.reset();  // one at a time
    simulation.emplace(scene.start());
  };
  const auto start_anew = [&] {
    if (simulation->steps() >= all) start();
  };
  scaling.measure_kind("strong", scene.model().elements(), [&](std::int64_t) {
    start();
    return TimedCall{[&] { simulation->step(); }, start_anew};
  });
  scaling.print();
}

}  // namespace tread
