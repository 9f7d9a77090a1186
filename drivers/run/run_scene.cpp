#include "drivers/run/run_scene.hpp"

#include <fmt/chrono.h>
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <exception>
#include <functional>
#include <optional>
#include <system_error>

#include "core/error.hpp"
#include "core/parallel/parallel.hpp"
#include "core/parallel/ranks.hpp"
#include "drivers/process/machine.hpp"
#include "drivers/report/patch_snapshots.hpp"
#include "drivers/report/run_report.hpp"
#include "drivers/results/deflection.hpp"
#include "drivers/results/disk_use.hpp"
#include "drivers/results/frame_files.hpp"
#include "drivers/results/patch_file.hpp"
#include "drivers/results/resolution.hpp"
#include "drivers/results/root_attributes.hpp"
#include "drivers/results/run_results.hpp"
#include "drivers/results/run_warnings.hpp"
#include "drivers/run/fork.hpp"
#include "drivers/run/point_state.hpp"
#include "drivers/run/preload_cache.hpp"
#include "drivers/run/rolling.hpp"
#include "drivers/run/run_model.hpp"
#include "drivers/run/run_refusals.hpp"
#include "drivers/run/run_session.hpp"
#include "drivers/run/scene_content.hpp"
#include "io/files/output_file.hpp"
#include "io/report/figure_files.hpp"
#include "io/scene/body_file.hpp"
#include "io/text/text_file.hpp"
#include "kernels/device/device.hpp"

namespace tread {

namespace {

constexpr int kMovieFrames = 200;

/// Writes the fields of the rail's surface, and reads the parts of patch.h5 that the report shows: instants
/// of a wave, or of the last patch lengths on a smooth rail; a movie of the whole evaluated stretch.
void leave_surface(const Model& model, RunResults& results, const std::filesystem::path& directory) {
  if (!results.surface_fields) return;
  write_surface(directory / "surface.h5", *results.surface_fields, root_attributes(model.scene));
  write_axis(directory / "surface_axis.csv", results.surface);
  write_deflection(directory / "deflection.csv", deflection(*results.rail_line, model.scene.start_x()));
  const Span stretch{results.evaluated_first, results.evaluated_last};
  std::vector<double> x, pressure;
  for (const Sample& sample : results.samples) {
    x.push_back(sample.wheel_x);
    pressure.push_back(sample.max_pressure);
  }
  const std::filesystem::path patch = directory / kPatchFile;
  results.instants =
      read_patch(patch, typical_places(model.scene, stretch, 4 * model.contact->reach(), x, pressure));
  results.movie = read_patch(patch, even_places(stretch, kMovieFrames));
}

/// Writes the patch of the static state where nothing rolls after it.
void leave_static_patch(const Model& model, RunResults& results, const std::filesystem::path& directory) {
  const std::filesystem::path path = directory / kPatchFile;
  const double x = results.preload.wheel.origin.x;
  PatchFile file(path, model.contact->nodes(), root_attributes(model.scene));
  file.append(0, x, model.contact->nodes());
  file.close();
  force_to_disk(path);
  results.movie = read_patch(path, {x});
}

void obey_before_first_step(const RunSession& session) {
  if (!session.folder.take_stop()) return;
  const std::string text =
      fmt::format("stopped before the first step; {} starts again", session.resume_command());
  session.show("stopped", text);
  throw Interrupted(text);
}

Preload solve_statics(const RunSession& session, Model& model) {
  // The other ranks sleep meanwhile: their cores are free.
  const int own = threads();
  if (const auto ranks = chosen_ranks()) set_threads(std::min(machine_cores(), own * ranks->on_cores()));
  Preload preload = solve_preload(model, steady_motion(model), [&](const std::string& text) {
    session.enter("preload", text);
    obey_before_first_step(session);
  });
  set_threads(own);
  return preload;
}

/// `resolved`: what the model was made of.
void find_statics(const RunSession& session, const ResolvedScene& resolved, Model& model,
                  RunResults& results) {
  FoundPreload found = find_preload(
      preload_cache(session.options.cache), resolved, model, [&] { return solve_statics(session, model); },
      [&](const std::string& text) { session.enter("preload", text); },
      [&] { obey_before_first_step(session); });
  results.preload = std::move(found.preload);
  if (found.cached) results.preload_cached = 1;
  // Waiting and reading are no cost of the scene: a cached preload keeps the time of its solving.
  results.seconds_preload = found.seconds;
}

/// `results`: with the step of the smooth rail, if that is known.
void choose_step(const RunSession& session, const Model& model, RunResults& results) {
  const bool moved_nodes = model.scene.corrugation && model.scene.corrugation->apply == "nodes";
  if (moved_nodes || results.dt == 0) {
    session.enter("step", "looks for the largest stable one");
    find_step(model, results);
  }
  session.enter("step", fmt::format("dt {:.3e} s, {} steps; {}", results.dt,
                                    step_count(model.scene, results.dt), results.limit.reason));
  require_disk(model, results.dt, file_bytes(session.order.scene));
}

void leave_results(RunSession& session, const Model& model, RunResults& results) {
  session.show("results", "evaluates and writes them");
  evaluate(model, results);
  leave_surface(model, results, session.folder.path());
  results.warnings = run_warnings(model, results);
  const std::string summary = summary_json(model, session.resolved, results);
  write_text_file(session.folder / "summary.json", summary);
  write_run_report(session.folder / "report.html", model, session.resolved, results,
                   {session.options.program, session.order.command});
  if (session.options.json) fmt::print("{}", summary);
}

/// The other run's state becomes the first checkpoint of this one.
void begin_fork(RunSession& session, const Fork& fork, const Model& model, RunResults& results) {
  require_same_past(fork, model, results.samples);
  require_disk(model, results.dt, file_bytes(session.order.scene));
  const ForkOrigin& origin = *fork.order.origin;
  require_fork_step(model, results.dt, origin.steps);
  results.seconds_mesh = session.progress.seconds();
  if (model.scene.output.frames > 0)
    FrameFiles::take_over(origin.folder, session.folder.path(), origin.steps);
  session.checkpoints.write(origin.steps, fork.content);
  session.begin_with_state();
  session.checkpoints.write_order(pack_order(session.order));  // not before: without a state it begins anew
  session.progress.say(
      fmt::format("[fork] from {} at t = {:.6e} s (step {}); histories and frames up to there are copies",
                  origin.folder, origin.time, origin.steps));
}

/// Calls `act` and shows in status.json why it failed; a run that was stopped has shown that itself. What a
/// study has noted of an earlier failure holds no more unless it fails again.
void showing_failure(const RunSession& session, const std::function<void()>& act) {
  try {
    act();
    forget_failure(session.folder.path());
  } catch (const Interrupted&) {
    forget_failure(session.folder.path());
    throw;
  } catch (const std::exception& error) {
    session.show("failed", error.what());
    throw;
  }
}

/// From the mesh to the report; from `checkpoint` on where there is one, that of a `fork` that begins
/// included; it is left empty.
void carry_out(RunSession& session, SealedContent* checkpoint, const Fork* fork = nullptr) {
  const bool resumed = checkpoint && !fork;
  if (!resumed) keep_scene(session.folder.path(), session.resolved);
  session.enter("mesh", "begins");
  const ResolvedScene made = resolve_scene(session.order.scene, session.order.overrides);
  RunResults results;
  results.origin = session.order.origin;
  Model model = run_model(made, checkpoint, results);
  adopt_later_values(model, session.resolved.scene);
  settle_device(model, session.options.device, session.progress);
  const double seconds_mesh = session.progress.seconds();
  if (!checkpoint) results.seconds_mesh = seconds_mesh;
  session.enter("mesh", fmt::format("{} elements, {} nodes, {} parts, {}", model.elements(), model.nodes(),
                                    model.mesh.parts(), duration_text(seconds_mesh)));
  const std::vector<std::string> of_mesh = resolution_warnings(model);
  for (const std::string& warning : of_mesh) session.progress.warn("[warning] " + warning);
  for (const std::string& note : body_notes(model.scene)) session.progress.say("[note] " + note);
  const Scene& scene = model.scene;
  if (checkpoint) {
    if (const std::string other = other_origin(*checkpoint, model); !other.empty())
      session.progress.say(fmt::format("[resume] {}: the last bits may differ", other));
    require_free_disk(session, model, results.dt);
  } else {
    if (scene.output.disk_limit || scene.forks) find_step(model, results);  // takes seconds on fine meshes
    require_runnable(model, results.dt, file_bytes(session.order.scene));
    require_free_disk(session, model, results.dt);
    find_statics(session, made, model, results);
    if (model.contact && !scene.motion) leave_static_patch(model, results, session.folder.path());
    model.apply_corrugation(deepest_line(scene, results.preload));
  }
  if (fork) begin_fork(session, *fork, model, results);
  if (scene.motion) {
    if (!checkpoint) choose_step(session, model, results);
    Rolling rolling(session, model, results);
    if (checkpoint) {
      rolling.go_on(*checkpoint);
      checkpoint->clear();  // it is as large as the run's own state
      // Not before: a refused checkpoint must leave the scene of the run as it was.
      if (resumed) keep_scene(session.folder.path(), session.resolved);
    } else {
      rolling.begin();
    }
    rolling.to_the_end();
  }
  try {
    leave_results(session, model, results);
  } catch (const ResourceError& error) {
    const std::string way_on =
        session.folder.in_place()
            ? fmt::format("once that is mended, {} leaves the results", session.resume_command())
            : moved_text(session.folder.path());
    throw ResourceError(fmt::format("{}; {}", error.what(), way_on));
  }
  for (const std::string& warning : results.warnings)
    if (std::find(of_mesh.begin(), of_mesh.end(), warning) == of_mesh.end())
      session.progress.warn("[warning] " + warning);
  session.checkpoints.clear();
  session.enter("done", fmt::format("{} in {}", session.folder.path().string(),
                                    duration_text(session.progress.seconds())));
}

/// Removes results of an earlier run: files of a finished run must not stand beside one that is not.
void remove_results(const std::filesystem::path& directory) {
  std::error_code ignored;
  for (const char* name :
       {"summary.json", "report.html", "surface.h5", "surface_axis.csv", "deflection.csv", "run.h5",
        "histories.csv", kPatchFile, "scene.files.json", "compare.json", "compare.html"})
    std::filesystem::remove(directory / name, ignored);
  FrameFiles::remove(directory);
  remove_figures(directory / kFigureFolder);
}

std::string listed(const std::vector<std::string>& sentences) {
  std::string text;
  for (const std::string& sentence : sentences) text += (text.empty() ? "" : "; ") + sentence;
  return text;
}

/// The order of the run; nothing where a run that has states has lost it.
std::optional<SealedContent> kept_order(const RunSession& session) {
  try {
    return session.checkpoints.read_order();
  } catch (const InputError&) {
    return std::nullopt;
  }
}

/// The newest sound checkpoint; nothing where the run has none yet. InputError where none is sound.
std::optional<CheckpointFolder::Found> find_checkpoint(const RunSession& session) {
  std::vector<std::string> refused;
  const std::optional<SealedContent> order = kept_order(session);
  std::optional<CheckpointFolder::Found> found =
      session.checkpoints.newest(refused, [&](const CheckpointFolder::Found& state) {
        require_state(state);
        if (order) require_same_order(state.content, *order);
      });
  if (!found && !refused.empty())
    throw InputError(
        fmt::format("no checkpoint is of use: {}; start the run anew with `tread run ... "
                    "--overwrite`",
                    listed(refused)));
  for (const std::string& reason : refused) session.progress.say("[resume] " + reason);
  return found;
}

/// The run that options.from names must not be the one that is thrown away for the new one.
Fork read_other(const RunOptions& options, const RunOrder& wanted) {
  Fork fork = fork_from(options.from, wanted, Progress(options.quiet));
  std::error_code ignored;
  if (std::filesystem::equivalent(fork.order.origin->folder, options.output, ignored))
    throw InputError(
        fmt::format("--from {}: a fork needs a folder of its own; choose another one than {} with -o",
                    options.from, options.output.string()));
  require_later_end(resolve_scene(fork.order.scene, fork.order.overrides).scene,
                    resolve_with_later(fork.order).scene, &fork.content);
  return fork;
}

/// Reads the order of the run and the values that are asked for later.
void read_order(RunSession& session, const std::optional<CheckpointFolder::Found>& found) {
  RunOrder& order = session.order;
  order = unpack_order(found ? found->content : session.checkpoints.read_order());
  if (!found && order.origin)
    throw InputError(fmt::format("{} has lost the states of its fork; start it anew with --from {}",
                                 session.folder.path().string(), order.origin->folder));
  const std::vector<std::string>& now = session.options.overrides;
  refuse_other_keys(now);
  const ResolvedScene made = resolve_order(order, session.folder.path());
  order.later.insert(order.later.end(), now.begin(), now.end());
  session.resolved = resolve_with_later(order);
  require_later_end(made.scene, session.resolved.scene, found ? &found->content : nullptr);
}

/// A new folder "corrugation-d-20140512-093000", of a scene's file and the local time; "-2" and so on behind
/// that where it is another run's. One that cannot be made is left to RunSession, which says why.
std::filesystem::path make_dated_folder(const std::filesystem::path& scene) {
  const std::time_t now = std::time(nullptr);
  std::tm local{};
  ::localtime_r(&now, &local);
  const std::string name = fmt::format("{}-{:%Y%m%d-%H%M%S}", scene.stem().string(), local);
  std::filesystem::path folder = name;
  std::error_code error;
  for (int i = 2; !std::filesystem::create_directory(folder, error) && !error; ++i)
    folder = fmt::format("{}-{}", name, i);
  return folder;
}

/// Threads and device of a run.
void take_machine(const RunOptions& options) {
  use_threads(options.threads);
  if (const std::shared_ptr<Ranks> ranks = chosen_ranks())
    choose_devices(*ranks, options.device);
  else
    choose_device(options.device);
}

}  // namespace

void run_scene(const ResolvedScene& resolved, const RunOptions& given) {
  RunOptions options = given;
  const bool dated = options.output.empty();
  const bool holds_run = !dated && require_folder_of(options.output, "run");
  take_machine(options);
  settle_device(resolved.scene, options.device, Progress(options.quiet));
  const RunOrder wanted{resolved.source,         resolved.overrides, {},
                        resolved_toml(resolved), options.command,    {}};
  std::optional<Fork> fork;
  if (!options.from.empty()) fork = read_other(options, wanted);
  if (dated) options.output = make_dated_folder(resolved.source.name);
  RunSession session(options);
  session.order = fork ? fork->order : wanted;
  session.resolved = fork ? resolve_with_later(session.order) : resolved;
  refuse_to_overwrite(session, fork ? &*fork : nullptr);
  session.checkpoints.clear();
  CheckpointFolder(session.folder / kForkFolder).clear();
  if (holds_run) remove_results(session.folder.path());
  if (!fork) session.checkpoints.write_order(pack_order(session.order));
  showing_failure(session,
                  [&] { carry_out(session, fork ? &fork->content : nullptr, fork ? &*fork : nullptr); });
}

void resume_run(const RunOptions& options) {
  take_machine(options);
  require_run_folder(options.output);
  RunSession session(options);
  if (!session.checkpoints.holds_run()) {
    if (!std::filesystem::exists(session.folder / "summary.json"))
      throw InputError(no_run_text(options.output));
    if (!options.overrides.empty())
      throw InputError(
          fmt::format("--set {}: {} holds a finished run, which cannot go on; start another one with these "
                      "values, from a state that [forks] has kept if it is to have the same past",
                      options.overrides.front(), options.output.string()));
    const std::string text = fmt::format("{} holds a finished run: see {}", options.output.string(),
                                         (session.folder / "report.html").string());
    session.progress.say(text);
    session.show("done", text);  // its process may have been killed before it said so
    if (options.json) fmt::print("{}", read_text_file(session.folder / "summary.json", 1 << 24));
    return;
  }
  std::optional<CheckpointFolder::Found> found = find_checkpoint(session);
  read_order(session, found);
  settle_device(session.resolved.scene, options.device, session.progress);
  if (found)
    session.progress.say(fmt::format("[resume] from {}", found->path.string()));
  else if (!options.overrides.empty())
    session.checkpoints.write_order(pack_order(session.order));  // until a state carries the values
  showing_failure(session, [&] { carry_out(session, found ? &found->content : nullptr); });
}

}  // namespace tread
