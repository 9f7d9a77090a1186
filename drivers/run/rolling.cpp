#include "drivers/run/rolling.hpp"

#include <fmt/core.h>

#include <nlohmann/json.hpp>
#include <type_traits>
#include <utility>

#include "core/error.hpp"
#include "core/parallel/parallel.hpp"
#include "drivers/run/fork.hpp"
#include "io/report/plain_text.hpp"
#include "io/text/json.hpp"
#include "io/text/text.hpp"
#include "kernels/device/device.hpp"

namespace tread {

namespace {

constexpr int kLookInterval = 16;     ///< steps between two looks at the clock
constexpr double kFinalShare = 0.05;  ///< age of a checkpoint over their interval: the end has its own then
constexpr double kRequestInterval = 0.5;  ///< time between two looks into the folder [s]

std::string instant(double time, std::int64_t steps) {
  return fmt::format("t = {:.6e} s (step {})", time, steps);
}

}  // namespace

Rolling::Rolling(RunSession& session, Model& model, RunResults& results)
    : session_(&session), model_(&model), results_(&results) {
  end_ = step_count(model.scene, results.dt);
  fork_step_ = fork_step(model, results.dt);
  if (results.origin && results.origin->steps == fork_step_) fork_step_.reset();  // the other run keeps it
  if (fork_step_ && *fork_step_ > end_)  // of a resumed run with another motion.duration
    session.progress.say("[forks] the run ends before the state for other runs: it keeps none");
}

void Rolling::begin() {
  simulation_.emplace(*model_, results_->preload, results_->dt);
  simulation_->set_sampling_interval(sampling_interval(model_->scene, results_->dt));
  AlignedVector<double>().swap(results_->preload.displacement);  // the simulation has a copy of its own
  results_->measured = MeasuredRows(simulation_->measurements().channels());
  files_.emplace(*model_, session_->folder.path(), *results_);
  frames_.emplace(*model_, session_->folder.path(), end_, results_->dt, 0);
}

void Rolling::go_on(const SealedContent& checkpoint) {
  restore(checkpoint);
  const auto patch = checkpoint.find("patch.h5");
  results_->measured = MeasuredRows(simulation_->measurements().channels(), unpack_measured(checkpoint),
                                    results_->samples.size());
  files_.emplace(*model_, session_->folder.path(), *results_,
                 patch == checkpoint.end() ? "" : std::get<std::string>(patch->second));
  frames_.emplace(*model_, session_->folder.path(), end_, results_->dt, simulation_->steps());
  for (const std::string& gap : frames_->gaps(simulation_->steps()))
    session_->progress.warn("[warning] " + gap);
  written_ = Mark{simulation_->steps(), simulation_->time()};
  seconds_before_ = results_->seconds_rolling;
}

void Rolling::restore(const SealedContent& run) {
  simulation_.emplace(*model_, results_->preload.contact.centre.y, results_->dt);
  unpack_state(run, *model_, *simulation_);
  simulation_->set_sampling_interval(sampling_interval(model_->scene, results_->dt));
}

/// The other ranks take the run over as a process that resumes it would.
void Rolling::begin_ranks() {
  if (followers_.absent()) return;
  followers_.begin(pack_all(""), *simulation_, session_->options.threads);
  session_->progress.say("[ranks] " + followers_.description(0));
}

/// A run goes on with other shares as one does that another number of ranks resumes.
void Rolling::even_ranks() {
  if (!followers_.find_better_shares(seconds_left())) return;
  followers_.fetch(*simulation_);
  SealedContent run = pack_all("");
  restore(run);
  followers_.begin(std::move(run), *simulation_, session_->options.threads);
  session_->progress.say(fmt::format("[ranks] {}: shared anew by the ranks' times; {}",
                                     instant(simulation_->time(), simulation_->steps()),
                                     followers_.shares()));
}

SealedContent Rolling::pack_all(std::string patch) {
  return pack_run(session_->order, *results_, *model_, *simulation_, std::move(patch));
}

void Rolling::to_the_end() {
  begin_ranks();
  started_ = checkpoint_at_ = session_->progress.seconds();
  started_steps_ = simulation_->steps();
  cores_ = CoreWatch();
  session_->interruption.defer();
  try {
    // The preload is expensive, and other values than those of the last checkpoint must not be forgotten.
    if (!written_ || !session_->options.overrides.empty()) write_checkpoint();
    step_to_the_end();
    wait_for_writer();
    require_files();
    files_->close();
  } catch (const NumericalError& error) {
    end_with_what_is_left<NumericalError>(error.what());
  } catch (const ResourceError& error) {
    end_with_what_is_left<ResourceError>(error.what());
  }
  fill_results();
}

void Rolling::step_to_the_end() {
  const int most = model_->scene.stop.steps;
  check_penetration();
  while (simulation_->steps() < end_) {
    if (most > 0 && simulation_->steps() >= most)
      end<ResourceError>(
          fmt::format("stop.steps = {} ends the run here, and each `tread resume` at once", most));
    if (simulation_->steps() == fork_step_) keep_for_forks();
    const double before = session_->progress.seconds();
    followers_.step(*simulation_);
    if (simulation_->sampled()) keep_sample();
    stepping_ += session_->progress.seconds() - before;
    look();
  }
  if (simulation_->steps() == fork_step_) keep_for_forks();  // at the run's end
  if (checkpoint_is_due(kFinalShare)) keep_the_end();
}

/// Writes a checkpoint ahead of evaluation and report: a kill there must not cost more than they do. The
/// results are worth more than it.
void Rolling::keep_the_end() {
  wait_for_writer();
  try {
    write_checkpoint();
    wait_for_writer();
  } catch (const ResourceError& error) {
    session_->progress.warn(fmt::format("[warning] the end of rolling has no checkpoint: {}", error.what()));
  }
}

/// Returns true if the last checkpoint is older than a share of their interval and the energies are balanced.
bool Rolling::checkpoint_is_due(double share) const {
  const double age = session_->progress.seconds() - checkpoint_at_;
  return age >= share * model_->scene.output.checkpoint_interval && simulation_->energy_watch().share() <= 1;
}

void Rolling::keep_sample() {
  const Sample& sample = simulation_->sample();
  const double before = results_->samples.empty() ? sample.time : results_->samples.back().time;
  results_->samples.push_back(sample);
  results_->measured.append(simulation_->measurements().values(), sample.time - before);
  files_->append(sample, results_->measured.row(results_->samples.size() - 1));
}

/// Handles writing, signals, requests and limits between two steps.
void Rolling::look() {
  if (frames_->due(simulation_->steps())) write_frame();
  if (const char* signal = Interruption::stop_wanted()) leave(signal);
  if (Interruption::take_checkpoint_wanted()) write_checkpoint();
  if (simulation_->sampled()) check_penetration();
  if (simulation_->steps() % kLookInterval != 0) return;
  even_ranks();
  const double now = session_->progress.seconds();
  if (!writer_.running()) wait_for_writer();
  if (!writer_.running() && checkpoint_is_due(1)) write_checkpoint();
  if (session_->progress.due(model_->scene.output.progress_interval)) {
    session_->progress.say(progress_line());
    session_->folder.show_status(status());
    notice_busy_cores();
  }
  if (now - looked_at_ < kRequestInterval) return;
  looked_at_ = now;
  obey_request();
  if (const auto limit = model_->scene.stop.wall_time; limit && now > *limit)
    leave(fmt::format("stop.wall_time = {}", duration_text(*limit)));
  check_disk();
}

/// Obeys a request of another process. One that is being obeyed delays the next.
void Rolling::obey_request() {
  if (answers_) return;
  const std::optional<RunRequest> request = session_->folder.take_request();
  if (request == RunRequest::checkpoint) answers_ = write_checkpoint();
  if (request == RunRequest::frame) answers_ = write_frame();
  if (request == RunRequest::stop) leave("tread ctl");
}

void Rolling::check_disk() {
  const std::optional<double>& disk = model_->scene.output.disk_limit;
  if (!disk) return;
  if (const std::int64_t bytes = folder_bytes(session_->folder.path()); static_cast<double>(bytes) > *disk)
    end<ResourceError>(fmt::format(
        "{} has {}, more than output.disk_limit = {}, which ends each `tread resume` "
        "too until its --set output.disk_limit states more",
        session_->folder.path().string(), bytes_text(bytes), bytes_text(static_cast<std::int64_t>(*disk))));
}

/// Looks at the last sample, which may be that of an earlier process.
void Rolling::check_penetration() {
  const StopSpec& stop = model_->scene.stop;
  if (!stop.penetration || results_->samples.empty()) return;
  const double penetration = results_->samples.back().max_penetration;
  if (penetration > *stop.penetration)
    end<NumericalError>(fmt::format(
        "the wheel has penetrated the rail by {:.4g} um, more than stop.penetration = {:.4g} um, which ends "
        "each `tread resume` too until its --set stop.penetration states more",
        1e6 * penetration, 1e6 * *stop.penetration));
}

/// Begins a checkpoint. Returns false for a motion that is not finite; the energies' watch soon ends such a
/// motion.
bool Rolling::write_checkpoint() {
  wait_for_writer();
  require_files();
  followers_.fetch(*simulation_);
  if (!simulation_->finite()) return false;
  const Mark mark{simulation_->steps(), simulation_->time()};
  results_->seconds_rolling = seconds();
  writer_.start([this, mark, content = pack_all(files_->patch_bytes())]() mutable {
    session_->checkpoints.write(mark.steps, std::move(content), session_->options.observer);
  });
  being_written_ = mark;
  checkpoint_at_ = session_->progress.seconds();
  if (!Hdf5File::thread_safe()) wait_for_writer();
  return true;
}

void Rolling::keep_for_forks() {
  wait_for_writer();
  require_files();
  followers_.fetch(*simulation_);
  results_->seconds_rolling = seconds();
  const CheckpointFolder folder(session_->folder / kForkFolder);
  folder.keep(simulation_->steps(), pack_all(files_->patch_bytes()));
  session_->progress.say(fmt::format(
      "[fork] {} is kept: `tread run OTHER.toml --from {} -o OTHER` begins there",
      instant(simulation_->time(), simulation_->steps()), shell_word(session_->folder.path().string())));
}

/// Begins a frame. Returns false for a motion that is not finite.
bool Rolling::write_frame() {
  wait_for_writer();
  require_files();
  followers_.fetch(*simulation_);
  if (!simulation_->finite()) return false;
  frames_->copy(*simulation_);
  writer_.start([this] { frames_->write(); });
  if (!Hdf5File::thread_safe()) wait_for_writer();
  return true;
}

void Rolling::wait_for_writer() {
  const std::optional<Mark> mark = std::exchange(being_written_, std::nullopt);
  writer_.wait();
  if (std::exchange(answers_, false)) session_->folder.answer_request();
  if (!mark) return;
  written_ = mark;
  session_->progress.say(fmt::format("[checkpoint] {}", instant(mark->time, mark->steps)));
}

/// Writes a checkpoint and throws Interrupted, except for a motion that is not finite: that motion ends by
/// its own error.
void Rolling::leave(const std::string& why) {
  followers_.fetch(*simulation_);
  if (!simulation_->finite()) return;
  write_checkpoint();
  wait_for_writer();
  files_->close();
  const std::string text =
      fmt::format("stopped at {} by {}; nothing is lost: {} goes on",
                  instant(simulation_->time(), simulation_->steps()), why, session_->resume_command());
  session_->enter("stopped", text);
  throw Interrupted(text);
}

/// Writes a checkpoint of a run in a sound state and throws E.
template <class E>
void Rolling::end(const std::string& why) {
  write_checkpoint();
  throw E(fmt::format("stopped at {}: {}", instant(simulation_->time(), simulation_->steps()), why));
}

/// Sentence on how the run can go on after an error of type E.
template <class E>
std::string Rolling::how_to_go_on() const {
  if (!written_)
    return fmt::format("there is no checkpoint yet: {} starts again", session_->resume_command());
  std::string last =
      fmt::format("the last checkpoint is that of {}: ", instant(written_->time, written_->steps));
  const int most = model_->scene.stop.steps;
  if (most > 0 && written_->steps >= most)
    return last + session_->resume_command("--set stop.steps=0") + " goes on to the end";
  last += session_->resume_command() + " goes on from there";
  if (!std::is_same_v<E, NumericalError>) return last;
  return last + ", to the same end; --set \"output.history_interval=1 us\" shows more of it";
}

template <class E>
void Rolling::end_with_what_is_left(const std::string& why) {
  std::string text = why;
  try {
    wait_for_writer();
  } catch (const ResourceError& error) {
    text += fmt::format("; {}", error.what());
  }
  close_quietly();
  const std::string folder = session_->folder.path().string();
  if (files_->in_place())
    text += fmt::format("; {} samples are kept in {}; {}", files_->rows_written(), folder, how_to_go_on<E>());
  else if (const std::string moved = moved_text(folder); moved != why)
    text += "; " + moved;
  throw E(text);
}

/// Closes the files without errors: the error already thrown matters more.
void Rolling::close_quietly() {
  try {
    files_->close();
  } catch (const Error&) {
  }
}

void Rolling::require_files() const {
  if (!files_->in_place()) throw ResourceError(moved_text(session_->folder.path()));
}

void Rolling::fill_results() {
  followers_.fetch(*simulation_);
  followers_.end();
  if (!followers_.absent())
    session_->progress.say("[ranks] " + followers_.description(simulation_->steps() - started_steps_));
  results_->seconds_rolling = seconds();
  results_->steps = simulation_->steps();
  results_->state_hash = simulation_->state_hash();
  results_->momentum = simulation_->momentum_check();
  if (const SurfaceFields* surface = simulation_->surface()) results_->surface_fields = *surface;
  if (const RailLine* line = simulation_->rail_line()) results_->rail_line = *line;
  for (int part = 0; part < model_->mesh.parts(); ++part)
    results_->part_energy.push_back(simulation_->fields().energy(part));
}

}  // namespace tread
