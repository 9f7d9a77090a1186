// `tread sweep` as a user calls it: points, refusals, failures, interruptions.

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <array>
#include <csignal>
#include <cstddef>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <utility>

#include "drivers/process/host.hpp"
#include "drivers/process/version.hpp"
#include "drivers/run/run_folder.hpp"
#include "drivers/run/scene_content.hpp"
#include "drivers/studies/study/study_plan.hpp"
#include "drivers/studies/study/study_report.hpp"
#include "io/text/json.hpp"
#include "tests/program.hpp"

namespace tread {
namespace {

namespace fs = std::filesystem;
using samples::content_of;
using samples::has;

class Sweep : public testing::Test {
 protected:
  fs::path study(const char* scene_name, const std::string& rest) const {
    const fs::path scene = fs::path(TREAD_SOURCE_DIR) / "scenes" / scene_name;
    return program_.write("study.toml", fmt::format("[study]\nscene = \"{}\"\n{}", scene.string(), rest));
  }
  /// A wave in a bar of a few elements.
  fs::path bars(const std::string& grid) const {
    return study("bar-wave.toml", "[set]\nmotion.duration = \"20 us\"\n" + grid);
  }
  /// Tyres that roll for some seconds.
  fs::path tyres() const { return tyres_of("8 mm", "1.5 ms", "0.1, 0.3"); }
  /// One tyre that rolls far longer than a test looks at it.
  fs::path endless_tyre() const { return tyres_of("5 mm", "5 ms", "0.1"); }
  fs::path tyres_of(const char* size, const char* duration, const char* tractions) const {
    return study("tyre.toml",
                 fmt::format("[set]\nscene.element_size = \"{}\"\nmotion.duration = \"{}\"\n"
                             "output.progress_interval = \"10 ms\"\n[grid]\nmotion.traction.mu = [{}]\n",
                             size, duration, tractions));
  }
  fs::path executable(const std::string& name, const std::string& lines) const {
    fs::create_directories((program_.folder / name).parent_path());
    const fs::path path = program_.write(name, lines);
    fs::permissions(path, fs::perms::owner_all);
    return path;
  }
  /// Stands for Slurm's program, which the job array asks to queue it again.
  void write_scontrol() const {
    executable("bin/scontrol", "#!/bin/sh\necho \"$@\" >>" + (program_.folder / "queued").string() + "\n");
  }
  int sweep(const fs::path& file, const std::string& more = "") const {
    return program_.call(fmt::format("sweep {} -o {} {}", file.string(), runs_.string(), more));
  }
  std::string queued() const { return content_of(program_.folder / "queued"); }
  bool rolls(const char* point) const {
    return has(content_of(runs_ / point / "status.json"), "\"rolling\"");
  }
  /// Starts an element of a job array as Slurm does, in another folder than the study's; its output goes to
  /// "log". The element is job 7 and belongs to array 5. `more`: other variables.
  pid_t start_element(const fs::path& script, int number, const std::string& more = "") const {
    const std::string command = fmt::format(
        "cd / && PATH={0}/bin:$PATH SLURM_JOB_ID=7 SLURM_ARRAY_JOB_ID=5 SLURM_ARRAY_TASK_ID={1} {3} "
        "exec bash {2} >{0}/log 2>&1",
        program_.folder.string(), number, shell_word(script.string()), more);
    return samples::child([&] {
      ::execl("/bin/sh", "sh", "-c", command.c_str(), nullptr);
      ::_exit(127);
    });
  }
  /// The same, and waits until its run rolls.
  pid_t start_rolling(const fs::path& script, const char* point) const {
    const pid_t element = start_element(script, 0);
    EXPECT_TRUE(samples::wait_until([&] { return rolls(point); })) << log();
    return element;
  }
  std::string errors() const { return program_.errors(); }
  std::string log() const { return content_of(program_.folder / "log"); }
  JsonRecord status() const { return read_json(runs_ / "status.json"); }

  samples::Program program_;
  fs::path runs_ = program_.folder / "runs";
};

TEST_F(Sweep, RunsEveryPointOnce) {
  const fs::path file = bars("[grid]\npulse.velocity = [\"1 m/s\", \"2 m/s\"]\npulse.length = [\"0.1 m\"]\n");
  ASSERT_EQ(sweep(file), 0) << errors();
  for (const char* point : {"velocity=1m_s,length=0.1m", "velocity=2m_s,length=0.1m"})
    EXPECT_TRUE(fs::exists(runs_ / point / "report.html")) << point;
  EXPECT_EQ(number_in(status(), "done"), 2);
  EXPECT_EQ(text_in(status(), "stage"), "ended");
  const std::string csv = content_of(runs_ / "sweep.csv");
  EXPECT_TRUE(has(csv, "point,state,pulse.velocity [m/s],pulse.length [m],")) << csv;
  EXPECT_TRUE(has(csv, "\"velocity=2m_s,length=0.1m\",done,2,0.1,")) << csv;
  EXPECT_TRUE(has(csv, ",warnings [-],state_hash\n")) << csv;
  const std::string report = content_of(runs_ / "report.html");
  EXPECT_TRUE(has(report, "velocity=2m_s,length=0.1m"));
  for (const std::string& origin :
       {std::string("Provenance"), std::string(program_version()), file.string(), host_name()})
    EXPECT_TRUE(has(report, origin)) << origin;

  const auto written = fs::last_write_time(runs_ / "velocity=1m_s,length=0.1m/summary.json");
  fs::create_directory(runs_ / "figures");  // of a report that had another figure
  program_.write("runs/figures/old.svg", "<svg/>\n<!-- figure old of a report of tread -->\n");
  ASSERT_EQ(sweep(file, "--json"), 0) << errors();
  EXPECT_FALSE(fs::exists(runs_ / "figures"));
  const JsonRecord json = parse_json(program_.out(), "sweep");
  EXPECT_EQ(number_in(json, "points.1.varied.pulse.velocity.value"), 2);
  EXPECT_EQ(text_in(json, "points.1.varied.pulse.velocity.unit"), "m/s");
  const std::string hash = text_in(json, "points.1.state_hash");
  EXPECT_TRUE(!hash.empty() && has(csv, "," + hash + "\n")) << hash;
  EXPECT_EQ(fs::last_write_time(runs_ / "velocity=1m_s,length=0.1m/summary.json"), written);
  EXPECT_EQ(content_of(runs_ / "sweep.csv"), csv);
}

TEST_F(Sweep, RefusesBeforeAnythingRuns) {
  for (const auto& [grid, part] : std::vector<std::pair<std::string, std::string>>{
           {"[grid]\npulse.velocity = [\"1 m/s\", \"2 kg\"]\n", "study.toml:6:28: pulse.velocity: "},
           {"[grid]\npulse.velocty = [\"1 m/s\"]\n", "did you mean pulse.velocity?"},
           {"[grid]\nwheel.diameter = [\"1 m\"]\n", "study.toml:6:19: wheel: "},
           {"[grid]\npulse.velocity = [\"1 m/s\", \"1000 mm/s\"]\n", "are the same scene"},
           {"[grid]\npulse.velocity = [\"1 m/s\"]\nmaterial.steel.damping = [{ kind = \"rayleigh_beta\", "
            "value "
            "= \"1 s\" }]\n",
            "bar-wave.toml: material damping: "},
       }) {
    EXPECT_EQ(sweep(bars(grid)), 2) << grid;
    EXPECT_TRUE(has(errors(), part)) << errors();
  }
  EXPECT_EQ(program_.call("sweep " + bars("[grid]\npulse.velocity = [\"1 m/s\"]\n").string()), 2);
  EXPECT_TRUE(has(errors(), "-o is missing")) << errors();
  EXPECT_EQ(sweep(bars("[grid]\npulse.velocity = [\"1 m/s\"]\n"), "--jobs 1000"), 2);
  EXPECT_TRUE(has(errors(), "lower --jobs")) << errors();
  EXPECT_EQ(sweep(bars("[grid]\npulse.velocity = [\"1 m/s\"]\n"), "--jobs 2 --device gpu:0"), 2);
  EXPECT_TRUE(has(errors(), "a card takes one run at a time, and there is one")) << errors();
  EXPECT_EQ(sweep(bars("[grid]\npulse.velocity = [\"1 m/s\"]\n"), "--device gpu:1000"), 4);
  EXPECT_TRUE(has(errors(), "--device gpu:1000: ")) << errors();
  for (const std::string& elsewhere :
       {std::string("--list"), "--slurm " + (program_.folder / "job.sh").string()}) {
    EXPECT_EQ(sweep(bars("[grid]\npulse.velocity = [\"1 m/s\"]\n"), elsewhere + " --device cuda"), 2);
    EXPECT_TRUE(has(errors(), "--device cuda: it is cpu, gpu")) << errors();
  }
  EXPECT_EQ(sweep(bars("[grid]\npulse.velocity = [\"1 m/s\"]\n"), "--set \"pulse.velocity=2 m/s\""), 2);
  EXPECT_TRUE(has(errors(), "differ in pulse.velocity")) << errors();
  EXPECT_EQ(sweep(bars("[grid]\npulse.velocity = [\"1 m/s\"]\n"), "--set \"scene.title=\xFF\""), 2);
  EXPECT_TRUE(has(errors(), "tread: --set: scene.title: \"scene.title=?\" has bytes")) << errors();
  EXPECT_FALSE(fs::exists(runs_ / "velocity=1m_s"));
}

TEST_F(Sweep, AFolderOfOtherResultsIsLeftAlone) {
  ASSERT_EQ(sweep(bars("[grid]\npulse.velocity = [\"1 m/s\"]\n")), 0) << errors();
  const std::string csv = content_of(runs_ / "sweep.csv");
  const std::string report = content_of(runs_ / "report.html");
  EXPECT_EQ(sweep(bars("[grid]\npulse.velocity = [\"3 m/s\"]\n")), 2);
  EXPECT_TRUE(has(errors(), "it holds runs of another study (velocity=1m_s)")) << errors();
  const fs::path rail = program_.write("rail.txt", "# x [mm] height [um]\n0 1\n1 2\n");
  for (const std::string& command : std::vector<std::string>{
           "run --overwrite " + samples::scene_word("bar-wave.toml"), "paper --set motion.duration=1ms",
           "multibody " + samples::scene_word("corrugation-d.toml"), "roughness " + rail.string()}) {
    EXPECT_EQ(program_.call(fmt::format("{} -o {}", command, runs_.string())), 2) << command;
    EXPECT_TRUE(has(errors(), "it holds results of `tread sweep` (sweep.csv)")) << command << errors();
  }
  EXPECT_EQ(content_of(runs_ / "sweep.csv"), csv);
  EXPECT_EQ(content_of(runs_ / "report.html"), report);
  EXPECT_FALSE(fs::exists(runs_ / "scene.resolved.toml"));
  // A study may grow.
  ASSERT_EQ(sweep(bars("[grid]\npulse.velocity = [\"1 m/s\", \"3 m/s\"]\n")), 0) << errors();
  // Before there is a table, the status tells whose folder it is.
  fs::remove(runs_ / "sweep.csv");
  EXPECT_EQ(program_.call(fmt::format("roughness {} -o {}", rail.string(), runs_.string())), 2);
  EXPECT_TRUE(has(errors(), "it holds results of `tread sweep` (status.json)")) << errors();
}

TEST_F(Sweep, LauncherStartsTheRuns) {
  const fs::path file = bars("[grid]\npulse.velocity = [\"1 m/s\", \"2 m/s\"]\n");
  EXPECT_EQ(sweep(file, "--launcher no-such-program"), 2);
  EXPECT_TRUE(has(errors(), "--launcher: there is no program 'no-such-program' in PATH")) << errors();
  EXPECT_FALSE(fs::exists(runs_));
  const fs::path launcher =
      executable("launcher", "#!/bin/sh\necho \"$@\" >>" + (program_.folder / "calls").string() +
                                 "\nshift 2\nexec \"$@\"\n");
  // A run elsewhere takes the cores that it is given; more of them at once than this machine has cores.
  ASSERT_EQ(sweep(file, fmt::format("--jobs 1000 --launcher \"{} -N 1\"", launcher.string())), 0) << errors();
  const std::string calls = content_of(program_.folder / "calls");
  EXPECT_TRUE(has(calls, "-N 1 /")) << calls;
  EXPECT_TRUE(has(calls, "tread run ")) << calls;
  EXPECT_FALSE(has(calls, " -t ")) << calls;
  EXPECT_EQ(number_in(status(), "done"), 2);
}

/// Its runs have no contact force and leave no surface.
TEST_F(Sweep, AWheelWithoutARailHasNoCurves) {
  const fs::path file = study("tyre.toml", R"([set]
scene.element_size = "12 mm"
motion.duration = "10 us"
motion.traction.mu = 0
rail.present = false
contact.present = false
load.present = false
[grid]
motion.speed = ["10 km/h"]
)");
  ASSERT_EQ(sweep(file, "-t 1"), 0) << errors();
  EXPECT_FALSE(has(content_of(runs_ / "report.html"), "Contact forces"));
}

/// Cores and programs of a cluster are not those of the machine that writes the array.
TEST_F(Sweep, JobArrayStartsByTheLauncherOnOtherMachines) {
  const fs::path file = bars("[grid]\npulse.velocity = [\"1 m/s\", \"2 m/s\"]\n");
  const fs::path script = program_.folder / "array.sh";
  const std::string more =
      fmt::format("-t 1000 --launcher \"no-such-program -N 1\" --slurm {} ", script.string());
  ASSERT_EQ(sweep(file, more), 0) << errors();
  EXPECT_FALSE(has(errors(), "warning")) << errors();
  const std::string text = content_of(script);
  EXPECT_TRUE(has(text, "tread=( no-such-program -N 1 ")) << text;
  EXPECT_TRUE(has(text, "place=( -t 1000 ) changed=( )")) << text;
  EXPECT_TRUE(has(text, "#SBATCH --array=0-1\n")) << text;
  ASSERT_EQ(sweep(file, more + "--jobs 1"), 0) << errors();
  EXPECT_TRUE(has(content_of(script), "#SBATCH --array=0-1%1\n")) << content_of(script);
}

TEST_F(Sweep, JobArrayRunsResumesAndQueuesAgain) {
  const fs::path file = tyres();
  const fs::path script = program_.folder / "array.sh";
  ASSERT_EQ(sweep(file, "--slurm " + script.string() + " --set 'output.progress_interval=2 ms'"), 0)
      << errors();
  EXPECT_TRUE(has(content_of(script),
                  fmt::format("-o {} --set 'output.progress_interval=2 ms'` collects", runs_.string())))
      << content_of(script);
  ASSERT_EQ(sweep(file, fmt::format("-t 1 --slurm {}", script.string())), 0) << errors();
  const std::string text = content_of(script);
  EXPECT_TRUE(has(text, "place=( -t 1 )")) << text;
  EXPECT_TRUE(has(text, "#SBATCH --array=0-1\n")) << text;
  EXPECT_FALSE(fs::exists(runs_ / "mu=0.1" / "summary.json"));
  write_scontrol();
  const auto element = [&](int number) { return samples::wait_for(start_element(script, number)); };
  EXPECT_EQ(element(2), 2) << log();
  // Slurm's SIGTERM at the end of the time leaves a checkpoint, and the element is queued again.
  const pid_t first = start_rolling(script, "mu=0.1");
  ::kill(first, SIGTERM);
  EXPECT_EQ(samples::wait_for(first), 75) << log();
  EXPECT_EQ(queued(), "requeue 5_0\n");
  EXPECT_TRUE(fs::exists(runs_ / "mu=0.1" / "checkpoint"));
  EXPECT_FALSE(fs::exists(runs_ / "mu=0.1/failed.json"));
  EXPECT_EQ(element(0), 0) << log();
  EXPECT_EQ(element(1), 0) << log();
  const auto written = fs::last_write_time(runs_ / "mu=0.1/summary.json");
  EXPECT_EQ(element(0), 0) << log();  // queued again by the system after its end
  EXPECT_EQ(fs::last_write_time(runs_ / "mu=0.1/summary.json"), written);
  // The machine that collects the results lacks the cores, cards and launcher of those that ran.
  for (const char* more : {"-t 1000", "--jobs 1000", "--jobs 2 --device gpu:0", "--launcher no-such-program"})
    ASSERT_EQ(sweep(file, more), 0) << more << errors();
  EXPECT_EQ(number_in(status(), "done"), 2);
  EXPECT_EQ(sweep(file, "--slurm " + script.string()), 2);
  EXPECT_TRUE(has(errors(), "--slurm: no point is left to run")) << errors();
}

/// The script knows the folder in which paths are as the study's command states them.
TEST_F(Sweep, JobArrayRunsFromAnyFolder) {
  bars("[grid]\npulse.velocity = [\"1 m/s\"]\n");
  const std::string before = fmt::format("cd {} &&", program_.folder.string());
  const pid_t writer =
      samples::start_program("sweep study.toml -o runs --slurm 'my array.sh'", program_.folder, before);
  ASSERT_EQ(samples::wait_for(writer), 0) << errors();
  const fs::path script = program_.folder / "my array.sh";
  EXPECT_TRUE(has(content_of(script), ": sbatch 'my array.sh'. State")) << content_of(script);
  EXPECT_EQ(samples::wait_for(start_element(script, 0)), 0) << log();
  EXPECT_TRUE(fs::exists(runs_ / "velocity=1m_s/summary.json"));
}

/// The signal ends the script's wait, and then the run ends before the script has looked whether it lives.
TEST_F(Sweep, JobArrayQueuesARunAgainThatObeysAtOnce) {
  const fs::path run = executable(
      "launcher", fmt::format("#!/bin/bash\ntrap 'exit 75' TERM\n: >{}\nwhile :; do sleep 0.01; done\n",
                              (program_.folder / "ready").string()));
  const fs::path slow = program_.write("slow.sh",
                                       "kill() {\n  command kill \"$@\"; local code=$?\n"
                                       "  [[ $1 != -TERM ]] || sleep 0.3\n  return $code\n}\n");
  const fs::path script = program_.folder / "array.sh";
  const std::string more = fmt::format("--launcher {} --slurm {}", run.string(), script.string());
  ASSERT_EQ(sweep(bars("[grid]\npulse.velocity = [\"1 m/s\"]\n"), more), 0) << errors();
  write_scontrol();
  const pid_t element = start_element(script, 0, "BASH_ENV=" + slow.string());
  ASSERT_TRUE(samples::wait_until([&] { return fs::exists(program_.folder / "ready"); })) << log();
  ::kill(element, SIGTERM);
  EXPECT_EQ(samples::wait_for(element), 75) << log();
  EXPECT_EQ(queued(), "requeue 5_0\n");
}

/// As mpirun, the launcher ends a run that it was to signal, and has a code of its own for one that stopped.
TEST_F(Sweep, JobArrayStopsARunBehindItsLauncher) {
  const fs::path launcher = executable("launcher",
                                       "#!/bin/bash\n\"$@\" &\ntrap 'kill -KILL $!' TERM\n"
                                       "wait $!; code=$?\n[[ $code != 75 ]] || exit 1\nexit $code\n");
  const fs::path script = program_.folder / "array.sh";
  ASSERT_EQ(
      sweep(endless_tyre(), fmt::format("-t 1 --launcher {} --slurm {}", launcher.string(), script.string())),
      0)
      << errors();
  write_scontrol();
  const pid_t element = start_rolling(script, "mu=0.1");
  ::kill(element, SIGTERM);
  EXPECT_EQ(samples::wait_for(element), 75) << log();
  EXPECT_EQ(text_in(read_json(runs_ / "mu=0.1/status.json"), "stage"), "stopped") << log();
  EXPECT_EQ(queued(), "requeue 5_0\n") << log();
  EXPECT_FALSE(fs::exists(runs_ / "mu=0.1/failed.json"));
  // An older status does not speak for a launcher that fails.
  executable("launcher", "#!/bin/sh\nexit 1\n");
  EXPECT_EQ(samples::wait_for(start_element(script, 0)), 1) << log();
  EXPECT_EQ(queued(), "requeue 5_0\n") << log();
}

/// A limit of the study's queues an element again, a user's stop does not, even if Slurm stops it, too.
TEST_F(Sweep, JobArrayLeavesWhatAUserHasStopped) {
  const fs::path file = endless_tyre();
  const fs::path script = program_.folder / "array.sh";
  const fs::path point = runs_ / "mu=0.1";
  const auto write_array = [&](const std::string& more) {
    ASSERT_EQ(sweep(file, fmt::format("-t 1 {} --slurm {}", more, script.string())), 0) << errors();
  };
  write_array("");
  write_scontrol();
  const auto expect_left = [&](pid_t element) {
    EXPECT_EQ(samples::wait_for(element), 75) << log();
    EXPECT_TRUE(has(log(), "job 5_0: stopped by tread ctl, not queued again")) << log();
    EXPECT_EQ(queued(), "") << log();
    EXPECT_FALSE(fs::exists(point / "failed.json"));
  };
  const pid_t stopped = start_rolling(script, "mu=0.1");
  EXPECT_EQ(program_.call(fmt::format("ctl {} stop", point.string())), 0) << errors();
  expect_left(stopped);
  const pid_t signalled = start_rolling(script, "mu=0.1");
  leave_request(point, RunRequest::stop);
  ::kill(signalled, SIGTERM);
  expect_left(signalled);
  write_array("--set 'stop.wall_time=1 ms'");
  EXPECT_EQ(samples::wait_for(start_element(script, 0)), 75) << log();
  EXPECT_EQ(queued(), "requeue 5_0\n") << log();
}

/// The collecting command must not take up on the login node what has failed in the array.
TEST_F(Sweep, JobArrayNotesFailures) {
  const fs::path file = bars(
      "[[point]]\nname = \"ends\"\nstop.steps = 3\npulse.velocity = \"1 m/s\"\n[[point]]\nname = "
      "\"whole\"\npulse.velocity = \"2 m/s\"\n");
  const fs::path script = program_.folder / "array.sh";
  ASSERT_EQ(sweep(file, "--slurm=" + script.string()), 0) << errors();
  EXPECT_TRUE(has(content_of(script), fmt::format("-o {}` collects", runs_.string()))) << content_of(script);
  EXPECT_EQ(samples::wait_for(start_element(script, 0)), 4) << log();
  EXPECT_EQ(samples::wait_for(start_element(script, 1)), 0) << log();
  const JsonRecord failure = read_json(runs_ / "ends/failed.json");
  EXPECT_EQ(number_in(failure, "exit"), 4);
  EXPECT_EQ(truth_in(failure, "anew"), false);
  EXPECT_TRUE(has(content_of(script), "mv \"$folder/failed.json.part\" \"$folder/failed.json\"\n"));
  EXPECT_EQ(sweep(file), 4) << errors();
  EXPECT_FALSE(has(errors(), "[ends]")) << errors();
  EXPECT_TRUE(has(errors(), "ends: exit 4: see the output of job 5_0, slurm-5_0.out")) << errors();
  EXPECT_EQ(number_in(status(), "done"), 1);
  // Another array goes on without the limit.
  std::string free = content_of(file);
  free.erase(free.find("stop.steps = 3\n"), std::strlen("stop.steps = 3\n"));
  std::ofstream(file) << free;
  ASSERT_EQ(sweep(file, "--retry --slurm=" + script.string()), 0) << errors();
  EXPECT_EQ(samples::wait_for(start_element(script, 0)), 0) << log();
}

TEST_F(Sweep, ListsCostWithoutRunning) {
  const fs::path file = bars("[grid]\npulse.velocity = [\"1 m/s\", \"2 m/s\"]\n");
  // A list needs no cores.
  EXPECT_EQ(program_.call(fmt::format("sweep {} --list --json -t 1000", file.string())), 0) << errors();
  const JsonRecord list = parse_json(program_.out(), "list");
  EXPECT_EQ(text_in(list, "points.1.name"), "velocity=2m_s");
  EXPECT_EQ(text_in(list, "points.1.state"), "waiting");
  EXPECT_GT(number_in(list, "points.1.steps"), 1);
  EXPECT_GT(number_in(list, "disk_bytes"), 1);
  // The elements of one mesh are timed once.
  const fs::path intervals = bars("[grid]\noutput.history_interval = [\"1 us\", \"2 us\"]\n");
  EXPECT_EQ(program_.call(fmt::format("sweep {} --list --json", intervals.string())), 0) << errors();
  const JsonRecord alike = parse_json(program_.out(), "list");
  EXPECT_EQ(number_in(alike, "points.0.seconds"), number_in(alike, "points.1.seconds"));
  EXPECT_EQ(program_.call(fmt::format("sweep {} --list --device auto", file.string())), 0) << errors();
  EXPECT_TRUE(has(program_.out(), "times are the processor's")) << program_.out();
}

TEST_F(Sweep, FailuresAreReportedAndTheRestGoesOn) {
  // stop.steps alone does not make another scene: the velocity tells the points apart.
  const fs::path file = bars(
      "[[point]]\nname = \"ends\"\nstop.steps = 3\npulse.velocity = \"1 m/s\"\n[[point]]\nname = "
      "\"whole\"\npulse.velocity = \"2 m/s\"\n");
  EXPECT_EQ(sweep(file), 4) << errors();
  EXPECT_TRUE(has(errors(), "1 of 2 points failed")) << errors();
  EXPECT_TRUE(has(errors(), "ends: exit 4: stopped at")) << errors();
  EXPECT_TRUE(fs::exists(runs_ / "whole/report.html"));
  EXPECT_TRUE(has(content_of(runs_ / "sweep.csv"), "ends,failed,3,1,")) << content_of(runs_ / "sweep.csv");
  EXPECT_EQ(number_in(status(), "failed"), 1);

  EXPECT_EQ(sweep(file), 4);
  EXPECT_FALSE(has(errors(), "[ends] goes on")) << errors();
  EXPECT_EQ(sweep(file, "--retry"), 4);
  EXPECT_TRUE(has(errors(), "[ends] goes on") && has(errors(), " --retry` tries them again")) << errors();
  EXPECT_FALSE(has(errors(), "--retry --retry")) << errors();
  fs::remove(runs_ / "whole/summary.json");
  const RunFolder taken(runs_ / "whole");
  EXPECT_EQ(sweep(file), 4);
  EXPECT_TRUE(has(errors(), "\n1 of 2 points are not done\n")) << errors();
}

TEST_F(Sweep, APointWithoutAFolderLeavesTheRest) {
  const fs::path file = bars("[grid]\npulse.velocity = [\"1 m/s\", \"2 m/s\"]\n");
  fs::create_directory(runs_);
  program_.write("runs/velocity=1m_s", "mine");
  EXPECT_EQ(sweep(file, "--jobs 1"), 4) << errors();
  EXPECT_TRUE(has(errors(), "\n  velocity=1m_s: not begun: cannot create " +
                                (runs_ / "velocity=1m_s").string() +
                                ": a file of that name is there; remove or rename "))
      << errors();
  EXPECT_TRUE(fs::exists(runs_ / "velocity=2m_s/report.html"));
  const std::string csv = content_of(runs_ / "sweep.csv");
  EXPECT_TRUE(has(csv, "velocity=1m_s,failed,1,") && has(csv, "velocity=2m_s,done,2,")) << csv;
  EXPECT_EQ(content_of(runs_ / "velocity=1m_s"), "mine");
}

/// A limit that a study states no more does not end its runs again.
TEST_F(Sweep, LimitsAreThoseOfTheStudyWhenAPointGoesOn) {
  const auto limited = [&](const std::string& limit) {
    return bars("[[point]]\nname = \"a\"\npulse.velocity = \"1 m/s\"\n" + limit);
  };
  EXPECT_EQ(sweep(limited("stop.steps = 3\nstop.wall_time = \"1 h\"\noutput.disk_limit = \"1 GB\"\n")), 4)
      << errors();
  EXPECT_EQ(sweep(limited(""), "--retry"), 0) << errors();
  EXPECT_TRUE(has(errors(), "[a] goes on")) << errors();
}

/// A failure is no more than that of an earlier process once a user has taken the run up.
TEST_F(Sweep, APointThatAUserHasTakenUpIsAsItsRunLeftIt) {
  const fs::path file = bars("[[point]]\nname = \"a\"\nstop.steps = 3\npulse.velocity = \"1 m/s\"\n");
  const auto resume = [&](const char* steps) {
    return program_.call(fmt::format("resume {} --set stop.steps={}", (runs_ / "a").string(), steps));
  };
  EXPECT_EQ(sweep(file), 4) << errors();
  EXPECT_EQ(resume("5"), 4) << errors();
  EXPECT_TRUE(fs::exists(runs_ / "a/failed.json")) << "it has failed again";
  EXPECT_EQ(resume("0"), 0) << errors();
  EXPECT_FALSE(fs::exists(runs_ / "a/failed.json"));
  EXPECT_EQ(sweep(file), 0) << errors();
}

/// As on a full disk: the end of one point cannot be written.
TEST_F(Sweep, AFailureWithoutASoundRecordLeavesTheRest) {
  const fs::path file = bars(
      "[[point]]\nname = \"ends\"\nstop.steps = 3\npulse.velocity = \"1 m/s\"\n[[point]]\nname = "
      "\"whole\"\npulse.velocity = \"2 m/s\"\n");
  fs::create_directories(runs_ / "ends/failed.json.part/full");
  EXPECT_EQ(sweep(file, "--jobs 1"), 4) << errors();
  EXPECT_TRUE(has(errors(), "ends: exit 4: stopped at")) << errors();
  EXPECT_TRUE(has(errors(), "failed.json: Is a directory")) << errors();
  for (const char* name : {"whole/report.html", "report.html"}) EXPECT_TRUE(fs::exists(runs_ / name)) << name;
  EXPECT_FALSE(fs::exists(runs_ / "ends/failed.json"));

  fs::remove_all(runs_ / "ends/failed.json.part");
  program_.write("runs/ends/failed.json", "{\"exit\": ");
  EXPECT_EQ(sweep(file), 4) << errors();
  EXPECT_TRUE(has(errors(), "ends: its failed.json does not read")) << errors();
  EXPECT_EQ(sweep(file, "--retry"), 4) << errors();
  EXPECT_TRUE(has(errors(), "[ends] goes on")) << errors();
  EXPECT_EQ(number_in(read_json(runs_ / "ends/failed.json"), "exit"), 4);

  runs_ = program_.folder / "tyres";
  fs::create_directories(runs_ / "pressed/failed.json.part/full");
  EXPECT_EQ(sweep(study("tyre.toml",
                        "[set]\nscene.element_size = \"8 mm\"\nmotion.duration = \"0.1 ms\"\n[[point]]\n"
                        "name = \"pressed\"\nstop.penetration = \"1 nm\"\n")),
            3)
      << errors();
  EXPECT_TRUE(has(errors(), "failed.json: Is a directory")) << errors();
}

TEST_F(Sweep, DamagedResultsOfAPointNameItsFolder) {
  const fs::path file = bars("[grid]\npulse.velocity = [\"1 m/s\", \"2 m/s\"]\n");
  ASSERT_EQ(sweep(file), 0) << errors();
  const fs::path point = runs_ / "velocity=1m_s";
  program_.write("runs/velocity=1m_s/summary.json", "{\"steps\": ");
  EXPECT_EQ(sweep(file), 2);
  EXPECT_TRUE(has(errors(), "summary.json: no JSON object")) << errors();
  EXPECT_TRUE(has(errors(), "remove " + point.string() + ", and start")) << errors();
  EXPECT_FALSE(has(errors(), "writes the file anew")) << errors();
  program_.write("runs/velocity=1m_s/summary.json", "{}");
  EXPECT_EQ(sweep(file), 2);
  EXPECT_TRUE(has(errors(), "summary.json: 'elements' is not a number; the results")) << errors();
  const std::string sound = content_of(runs_ / "velocity=2m_s/summary.json");
  program_.write("runs/velocity=1m_s/summary.json", sound);
  fs::resize_file(point / "run.h5", 100);
  EXPECT_EQ(sweep(file), 2);
  EXPECT_TRUE(has(errors(), "run.h5") && has(errors(), "remove " + point.string() + ", and start"))
      << errors();
  fs::remove_all(point);
  EXPECT_EQ(sweep(file), 0) << errors();
}

TEST_F(Sweep, AnotherSceneInAFolderIsNotTouched) {
  ASSERT_EQ(sweep(bars("[[point]]\nname = \"a\"\npulse.velocity = \"1 m/s\"\n")), 0) << errors();
  EXPECT_EQ(sweep(bars("[[point]]\nname = \"a\"\npulse.velocity = \"2 m/s\"\n")), 2);
  EXPECT_TRUE(has(errors(), "pulse.velocity is 2 m/s here and 1 m/s there")) << errors();
}

TEST_F(Sweep, AStopPassesToTheRunsAndTheNextSweepGoesOn) {
  const fs::path file = tyres();
  const fs::path whole = program_.folder / "whole";
  ASSERT_EQ(program_.call(fmt::format("sweep {} -o {} --jobs 1", file.string(), whole.string())), 0)
      << errors();

  const fs::path first = runs_ / "mu=0.1";
  const pid_t process = program_.start(fmt::format("sweep {} -o {} --jobs 1", file.string(), runs_.string()));
  ASSERT_TRUE(samples::wait_until([&] { return has(content_of(first / "status.json"), "\"rolling\""); }));
  EXPECT_EQ(program_.call(fmt::format("sweep {} -o {}", file.string(), runs_.string())), 4);
  EXPECT_TRUE(has(errors(), "another process works on")) << errors();
  ::kill(process, SIGTERM);
  EXPECT_EQ(samples::wait_for(process), 75);
  EXPECT_TRUE(fs::exists(first / "checkpoint"));
  EXPECT_FALSE(fs::exists(runs_ / "mu=0.3"));
  EXPECT_EQ(text_in(status(), "command_line"),
            fmt::format("tread sweep {} -o {} --jobs 1", file.string(), runs_.string()));

  ASSERT_EQ(sweep(file, "--jobs 1"), 0) << errors();
  EXPECT_TRUE(has(errors(), "[mu=0.1] goes on")) << errors();
  for (const char* point : {"mu=0.1", "mu=0.3"})
    for (const char* name : {"histories.csv", "surface_axis.csv"})
      EXPECT_TRUE(content_of(runs_ / point / name) == content_of(whole / point / name)) << point << name;
  const std::string report = content_of(runs_ / "report.html");
  for (const char* part : {"F_L, mu=0.3", "Contact forces", "Trends"}) {
    const std::string shown = part;
    const auto subscript = shown.find("F_L");
    EXPECT_TRUE(has(report, subscript == 0 ? "F<sub>L</sub>, mu=0.3" : shown)) << part;
  }
  fs::remove(first / "histories.csv");
  EXPECT_EQ(sweep(file), 2);
  EXPECT_TRUE(has(errors(), "remove " + first.string() + ", and start")) << errors();
}

/// status.json as a killed study leaves it.
TEST_F(Sweep, TheStatusOfAKilledStudyNamesTheCommandThatGoesOn) {
  for (const char* place : {"killed/checkpoint", "elsewhere", "ended", "broken"})
    fs::create_directories(runs_ / place);
  for (const char* file : {"killed/checkpoint/order.h5", "ended/summary.json", "broken/failed.json"})
    program_.write(fmt::format("runs/{}", file), "{}");
  program_.write("runs/status.json", R"({
  "stage": "sweep", "command": "sweep", "command_line": "tread sweep 'a b.toml' -o runs",
  "waiting": 0, "interrupted": 1, "running": 5, "done": 1, "failed": 0,
  "points": [{"name": "stopped", "state": "interrupted"}, {"name": "killed", "state": "running"},
             {"name": "elsewhere", "state": "running"}, {"name": "gone", "state": "running"},
             {"name": "done", "state": "done"}, {"name": "ended", "state": "running"},
             {"name": "broken", "state": "running"}]
})");
  const RunFolder taken(runs_ / "elsewhere");
  EXPECT_EQ(program_.call(fmt::format("ctl {} status", runs_.string())), 75);
  EXPECT_TRUE(has(errors(), runs_.string() + ": `tread sweep 'a b.toml' -o runs` goes on")) << errors();
  const JsonRecord shown = parse_json(program_.out(), "status");
  EXPECT_TRUE(!truth_in(shown, "alive") && truth_in(shown, "resumable"));
  for (const auto& [state, count] :
       {std::pair{"interrupted", 2}, {"running", 1}, {"waiting", 1}, {"done", 2}, {"failed", 1}})
    EXPECT_EQ(number_in(shown, state), count) << state;
  const std::array states = {"interrupted", "interrupted", "running", "waiting", "done", "done", "failed"};
  for (std::size_t i = 0; i < states.size(); ++i)
    EXPECT_EQ(text_in(shown, fmt::format("points.{}.state", i)), states[i]) << i;
  EXPECT_EQ(program_.call(fmt::format("ctl {} stop", runs_.string())), 2);
  EXPECT_TRUE(has(errors(), "; `tread sweep 'a b.toml' -o runs` goes on")) << errors();
}

/// Points of two speeds, of which one does not reach the corrugation, and of two waves on one mesh.
TEST_F(Sweep, ListsWarningsOnceWithTheirPoints) {
  const std::string wave =
      "corrugation.apply = \"gap\"\ncorrugation.start = \"0.13 m\"\ncorrugation.length = \"40 mm\"\n"
      "corrugation.wavelength = ";
  const auto point = [&](const char* name, const char* length, const char* speed) {
    return fmt::format("[[point]]\nname = \"{}\"\nmotion.speed = \"{} km/h\"\n{}\"{} mm\"\n", name, speed,
                       wave, length);
  };
  const fs::path file = study(
      "tyre.toml", "[set]\nscene.element_size = \"10 mm\"\nmotion.duration = \"2.2 ms\"\n" +
                       point("short", "20", "300") + point("long", "40", "300") + point("slow", "20", "150"));
  ASSERT_EQ(program_.call(fmt::format("sweep {} --list", file.string())), 0) << errors();
  const std::string list = program_.out();
  EXPECT_TRUE(has(list, "3 of 3 points have warnings:\n")) << list;
  EXPECT_TRUE(has(list, "\n  slow: the wheel rolls to x = ")) << list;
  EXPECT_TRUE(has(list, " m and does not reach the corrugation")) << list;
  EXPECT_TRUE(has(list, "\n  short and 1 more: a wave of the corrugation has 2.0 elements")) << list;
  EXPECT_TRUE(has(list, "\n  long: a wave of the corrugation has 4.0 elements")) << list;
  EXPECT_TRUE(has(list, "\n  short and 2 more: the contact patch has ")) << list;
  ASSERT_EQ(program_.call(fmt::format("sweep {} --list --json", file.string())), 0) << errors();
  const JsonRecord json = parse_json(program_.out(), "list");
  EXPECT_TRUE(has(text_in(json, "warnings.0.text"), "the contact patch has")) << program_.out();
  EXPECT_EQ(text_in(json, "warnings.0.points.2"), "slow");
}

/// The scene's file counts by its contents: results and scene may lie elsewhere when they are collected.
TEST_F(Sweep, ResultsOfASceneThatHasMovedAreCollected) {
  const auto planned = [&](const char* place, const char* depth) {
    const fs::path folder = program_.folder / place;
    fs::create_directory(folder);
    std::ofstream(folder / "depth.txt") << "# x [mm] d [mm]\n0 0\n40 " << depth << "\n80 0\n";
    std::ofstream(folder / "scene.toml")
        << "[scene]\nbased_on = \"highspeed-slab-2014\"\n[corrugation]\nkind = \"table\"\n"
           "file = \"depth.txt\"\n";
    std::ofstream(folder / "study.toml")
        << "[study]\nscene = \"scene.toml\"\n[[point]]\nname = \"one\"\nmotion.duration = \"1 ms\"\n";
    return plan_study(read_study(folder / "study.toml"), runs_);
  };
  const StudyPlan first = planned("there", "0.02");
  fs::create_directories(runs_ / "one");
  keep_scene(runs_ / "one", first.points[0].resolved);
  program_.write("runs/one/summary.json", "{}");
  fs::remove_all(program_.folder / "there");
  StudyPlan same = planned("here", "0.02");
  look_into_folders(same);
  EXPECT_EQ(same.points[0].status.state, PointState::done);
  StudyPlan other = planned("here", "0.03");
  try {
    look_into_folders(other);
    ADD_FAILURE() << "results of another file";
  } catch (const InputError& error) {
    EXPECT_TRUE(has(error.what(), "there/depth.txt of checksum ")) << error.what();
  }
}

/// 300 km/h in SI by a km/h in SI is no 300.
TEST(StudyTable, HasTheNumbersThatTheStudyStates) {
  const samples::Program program;
  const fs::path file =
      program.write("study.toml", fmt::format("[study]\nscene = \"{}/scenes/tyre.toml\"\n[grid]\n"
                                              "motion.speed = [\"300 km/h\", \"300.0001 km/h\"]\n",
                                              TREAD_SOURCE_DIR));
  const StudyPlan plan = plan_study(read_study(file), program.folder / "runs");
  const JsonRecord table = parse_json(sweep_json(plan, {}), "sweep");
  EXPECT_EQ(number_in(table, "points.0.varied.motion.speed.value"), 300);
  EXPECT_EQ(text_in(table, "points.0.varied.motion.speed.unit"), "km/h");
  EXPECT_EQ(number_in(table, "points.1.varied.motion.speed.value"), 300.0001);
  EXPECT_TRUE(has(sweep_csv(plan, {}), ",waiting,300.0001,")) << sweep_csv(plan, {});
}

/// A study that goes on has part of its files already.
TEST(StudyDisk, FilesThatLieInThePointsFoldersAreNotNeededAgain) {
  const samples::Program program;
  StudyPlan plan;
  plan.jobs = 1;
  for (const char* name : {"one", "other"}) {
    PlannedPoint point;
    point.name = name;
    point.folder = program.folder / name;
    point.cost.emplace();
    point.cost->disk.results = 1000;
    point.cost->disk.frames = 500;
    point.cost->disk.checkpoints = 300;
    fs::create_directory(point.folder);
    plan.points.push_back(std::move(point));
  }
  EXPECT_EQ(total_cost(plan).disk, 3300);
  EXPECT_EQ(disk_still_needed(plan), 3300);
  program.write("one/patch.h5", std::string(400, 'x'));
  EXPECT_EQ(disk_still_needed(plan), 2900);
  program.write("one/patch.h5", std::string(10000, 'x'));  // more than the run was thought to need
  EXPECT_EQ(disk_still_needed(plan), 1800);
  program.write("other/patch.h5", std::string(1700, 'x'));
  EXPECT_EQ(disk_still_needed(plan), 100);
  plan.points.back().cost.reset();  // done
  EXPECT_EQ(disk_still_needed(plan), 0);
  EXPECT_EQ(total_cost(plan).disk, 1800);
}

/// The paper's passages on a mesh that is fast rather than good, for an instant.
TEST_F(Sweep, ThePaperSharesPassagesBetweenFigures) {
  const std::string coarse =
      "--set \"scene.element_size=10 mm\" --set \"motion.duration=20 us\" --set \"solution_zone.length=0.15 "
      "m\" "
      "--set \"corrugation.length=0.1 m\" --set \"corrugation.start=2.41 m\"";
  ASSERT_EQ(program_.call(fmt::format("paper --fig 15 --fig 22 --list --json {}", coarse)), 0) << errors();
  const JsonRecord list = parse_json(program_.out(), "list");
  EXPECT_EQ(text_in(list, "points.0.name"), "80mm,0.14mm,300km_h,mu=0.3");
  EXPECT_EQ(text_in(list, "points.2.name"), "95mm,0.14mm,300km_h,mu=0.3");
  EXPECT_EQ(list.count("points.3.name"), 0U);

  ASSERT_EQ(program_.call(fmt::format("paper --fig 15 --fig 17a --fig 18 -o {} {}", runs_.string(), coarse)),
            0)
      << errors();
  EXPECT_TRUE(has(errors(), "[paper] 0 of ")) << errors();
  for (const char* name : {"fig15.csv", "fig15.svg", "fig18.csv", "fig18.svg", "report.html"})
    EXPECT_TRUE(fs::exists(runs_ / name)) << name;
  EXPECT_TRUE(has(content_of(runs_ / "report.html"), "Provenance"));
  EXPECT_FALSE(fs::exists(runs_ / "fig17a.csv"));
  EXPECT_TRUE(has(content_of(runs_ / "report.html"), "the wheel has not rolled that far"));
  EXPECT_FALSE(fs::exists(runs_ / "figures"));  // they are the files named above
  EXPECT_TRUE(has(program_.out(), "not run: corrugation D")) << program_.out();
  const std::string numbers = content_of(runs_ / "numbers.csv");
  EXPECT_TRUE(has(numbers, "\"Largest F_N over corrugation D\",kN,193.19,,")) << numbers;
  EXPECT_TRUE(has(numbers, "\"Creepage before the corrugation\",%,0.276,,")) << numbers;
  const std::string results = content_of(runs_ / "results.md");
  EXPECT_TRUE(has(results, "| Largest F_N over corrugation D | kN | 193.2 |")) << results;

  EXPECT_EQ(program_.call("paper --fig 3 --list"), 2);
  EXPECT_TRUE(has(errors(), "--fig 3: not among the figures 7, 8")) << errors();
}

}  // namespace
}  // namespace tread
