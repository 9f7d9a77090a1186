// The commands as a user calls them: exit codes, JSON, files.

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <cmath>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "drivers/process/machine.hpp"
#include "drivers/process/version.hpp"
#include "drivers/results/growing_files.hpp"
#include "drivers/results/patch_file.hpp"
#include "io/files/checkpoint_folder.hpp"
#include "io/text/json.hpp"
#include "tests/commands_test.hpp"

namespace tread {
namespace {

namespace fs = std::filesystem;
using samples::Commands;
using samples::has;
using samples::Outcome;

TEST_F(Commands, CheckListsEveryProblemWithItsPlace) {
  const fs::path file = folder_ / "bad.toml";
  std::ofstream(file) << "[scene]\ntitle = \"x\"\n[rail]\nlenght = \"3 m\"\nheight = \"3 kg\"\n";
  const Outcome outcome = call("check --json " + file.string());
  EXPECT_EQ(outcome.code, 2);
  EXPECT_TRUE(has(outcome.out, "\"ok\": false")) << outcome.out;
  EXPECT_TRUE(has(outcome.out, "\"key\": \"rail.lenght\"")) << outcome.out;
  EXPECT_TRUE(has(outcome.out, "\"line\": 4")) << outcome.out;
  EXPECT_TRUE(has(outcome.out, "\"key\": \"rail.height\"")) << outcome.out;
}

TEST_F(Commands, MissingSceneIsAProblemToo) {
  const Outcome outcome = call("mesh --json " + (folder_ / "none.toml").string());
  EXPECT_EQ(outcome.code, 2);
  EXPECT_TRUE(has(outcome.out, "cannot read")) << outcome.out;
}

/// A device has no end.
TEST_F(Commands, OnlyRegularFilesAreLookedInto) {
  for (const char* command : {"check", "sweep --list"}) {
    const pid_t process =
        samples::start_program(fmt::format("{} /dev/zero", command), folder_, "ulimit -t 2;");
    EXPECT_EQ(samples::wait_for(process), 2) << command;
    EXPECT_TRUE(has(content("errors"), "cannot read /dev/zero: it is not a regular file"))
        << content("errors");
  }
}

TEST_F(Commands, CheckStatesStepsAndFields) {
  const Outcome outcome = call("check --json -t 1 " + scene("bar-wave.toml"));
  EXPECT_EQ(outcome.code, 0);
  for (const char* part : {"\"ok\": true", "\"steps\": ", "\"memory_bytes\": ", "\"disk_bytes\": ",
                           "\"name\": \"displacement\""})
    EXPECT_TRUE(has(outcome.out, part)) << part;
  EXPECT_FALSE(has(outcome.out, "contact"));
  EXPECT_FALSE(has(outcome.out, "wheel_load_N"));
}

TEST_F(Commands, CheckAnswersFirstAndListsPhasesOnRequest) {
  const Outcome brief = call("check -t 1 " + scene("bar-wave.toml"));
  EXPECT_TRUE(has(brief.out, "Memory")) << brief.out;
  EXPECT_FALSE(has(brief.out, "Phase")) << brief.out;
  EXPECT_TRUE(has(call("check -t 1 --verbose " + scene("bar-wave.toml")).out, "Phase"));
}

TEST_F(Commands, CheckStatesTheWheelLoad) {
  const Outcome outcome = call("check -t 1 --set \"scene.element_size=11 mm\" " + scene("smooth.toml"));
  EXPECT_TRUE(has(outcome.out, "kN on the rail: 8000 kg sprung, 340 kg unsprung, ")) << outcome.out;
  EXPECT_TRUE(has(outcome.out, "kg of the wheel at 9.81 m/s2; axle load ")) << outcome.out;
  EXPECT_TRUE(
      has(outcome.out,
          "web 66.3 mm, sized by wheel.mass; usual webs have 18 to 40 mm, wheel.web_thickness states one"))
      << outcome.out;
}

TEST_F(Commands, CheckTellsALeaningHeadAndWhereAShapeLies) {
  ASSERT_EQ(call("profile 60E1 -o " + (folder_ / "head.txt").string()).code, 0);
  std::istringstream points(content("head.txt"));
  std::ofstream leaning(folder_ / "leaning.txt");
  for (std::string line; std::getline(points, line);) {
    double y = 0, z = 0;
    if (std::istringstream(line) >> y >> z)
      leaning << fmt::format("{:.6f} {:.6f}\n", y - 0.025 * z, z + 0.025 * y);
  }
  leaning.close();
  const std::string file = (folder_ / "leaning.txt").string();
  const std::string hint = "the head leans by 1:40 to the track's middle";
  EXPECT_TRUE(has(call("profile --rail --section 60E1 " + file).out, hint));
  std::ofstream(folder_ / "map.csv")
      << "# x [mm], y [mm], d [mm]\n0,0,0\n9,0,0\n20,0,0\n0,4,0\n9,4,.1\n20,4,0\n";
  const std::string check = fmt::format(
      "check --json -t 1 {} --set scene.based_on=ballasted-60e1 --set \"scene.element_size=11 mm\" --set "
      "rail.profile={} --set surface.a.kind=map --set surface.a.file={} --set \"surface.a.at=1 m\" --set "
      "\"surface.a.centre=-2 mm\"",
      scene("smooth.toml"), file, (folder_ / "map.csv").string());
  const std::string told = call(check).out;
  for (const std::string& part :
       {hint, std::string("\"deepest_x_m\": 1.009"), std::string("\"deepest_y_m\": 0.002"),
        std::string("\"web_sized_by_mass\": true")})
    EXPECT_TRUE(has(told, part)) << told;
  EXPECT_FALSE(has(call(check + " --set rail.inclination=0").out, hint));
}

TEST_F(Commands, WhatTheMeshDoesNotResolveIsAWarning) {
  const fs::path file = folder_ / "coarse.toml";
  std::ofstream(file)
      << "[scene]\ntitle = \"coarse\"\nbased_on = \"highspeed-slab-2014\"\nelement_size = \"11 mm\"\n"
         "[solution_zone]\nstart = \"0 m\"\nlength = \"0.1 m\"\n[motion]\nduration = \"0.1 ms\"\n"
         "[corrugation]\npresent = true\nstart = \"0 m\"\nlength = \"80 mm\"\napply = \"gap\"\n";
  const auto warnings = [&](const std::string& set) {
    return call("check --json -t 1 " + file.string() + set).out;
  };
  const std::string coarse = warnings("");
  EXPECT_TRUE(has(coarse, "the contact patch has 1.0 elements across")) << coarse;
  EXPECT_TRUE(has(coarse, "a wave of the corrugation has 7.3 elements")) << coarse;
  EXPECT_FALSE(has(coarse, "corrugation.depth")) << coarse;
  EXPECT_TRUE(has(warnings(" --set \"corrugation.depth=8 mm\""), "look at the units of corrugation.depth"));
  EXPECT_TRUE(has(call("check --json -t 1 " + scene("smooth.toml")).out, "\"warnings\": []"));
}

TEST_F(Commands, CheckReportsWhatRunRefuses) {
  const std::string check =
      fmt::format("check -t 1 {} --set \"scene.element_size=11 mm\" --set \"motion.traction.ramp=0 ms\"",
                  scene("smooth.toml"));
  const Outcome sliding = call(check + " --set contact.friction=0.3 --set motion.traction.mu=0.3");
  EXPECT_EQ(sliding.code, 2);
  EXPECT_TRUE(has(sliding.errors, "its patch would slide")) << sliding.errors;
  const Outcome large = call(check + " --set motion.traction.mu=0.1 --set \"output.disk_limit=1 kB\"");
  EXPECT_EQ(large.code, 2);
  EXPECT_TRUE(has(large.errors, "more than output.disk_limit")) << large.errors;
  // Without friction and traction nothing slides.
  const Outcome smooth = call(check + " --set contact.friction=0 --set motion.traction.mu=0");
  EXPECT_EQ(smooth.code, 0) << smooth.errors;
}

TEST_F(Commands, AMeshBeyondTheMemoryIsRefusedBeforeItIsBuilt) {
  constexpr std::int64_t kNeeded = 275'000'000'000;  // [B]
  if (machine_memory() > kNeeded) GTEST_SKIP() << "this machine could hold the mesh";
  for (const char* command : {"check ", "mesh "}) {
    const Outcome outcome =
        call(command + scene("tyre.toml") +
             " --set 'scene.element_size=0.7 mm' --set 'rail.length=1000 m' --set 'motion.duration=11.9 s'"
             " --set 'solution_zone.length=990 m' --set motion.traction.mu=0");
    EXPECT_EQ(outcome.code, 4);
    EXPECT_TRUE(has(outcome.errors, "elements, which need at least 275")) << outcome.errors;
    EXPECT_TRUE(has(outcome.errors, "raise scene.element_size")) << outcome.errors;
  }
}

TEST_F(Commands, ShippedScenesHaveNamesInEveryFolder) {
  EXPECT_EQ(call("check -t 1 bar-wave").code, 0);
  EXPECT_EQ(call("check -t 1 bar-wave.toml").code, 0);
  EXPECT_EQ(call("sweep --list studies/wavelengths").code, 0);
  EXPECT_EQ(call("check -t 1 bar-weave").code, 2);
  // A file of the working directory comes first.
  std::ofstream(folder_ / "bar-wave.toml") << "[scene]\ntitle = 3\n";
  fs::create_directory(folder_ / "bar-wave");
  for (const auto& [name, code] : {std::pair{"bar-wave.toml", 2}, {"bar-wave", 0}}) {
    const pid_t process = samples::start_program(fmt::format("check -t 1 {}", name), folder_,
                                                 fmt::format("cd {} &&", folder_.string()));
    EXPECT_EQ(samples::wait_for(process), code) << name;
  }
}

TEST_F(Commands, MoreThreadsThanCoresAreAWarning) {
  const int many = machine_cores() + 1;
  EXPECT_TRUE(has(call(fmt::format("check -t {} {}", many, scene("bar-wave.toml"))).errors,
                  fmt::format("{} threads on", many)));
  EXPECT_EQ(call("check -t 1 " + scene("bar-wave.toml")).errors, "");
  EXPECT_EQ(call("check -t 100000 " + scene("bar-wave.toml")).code, 2);
}

TEST_F(Commands, BoundThreadsKeepToACoreEach) {
  if (machine_cores() < 2) GTEST_SKIP() << "this machine has one core";
  const samples::Program program;
  const pid_t run = program.start(
      fmt::format("run {} -t 2 --bind --quiet -o {}", scene("tyre.toml"), (folder_ / "out").string()));
  const std::string name = "Cpus_allowed_list:\t";
  EXPECT_TRUE(samples::wait_until([&] {
    std::error_code none;
    for (const fs::directory_entry& thread :
         fs::directory_iterator(fmt::format("/proc/{}/task", run), none)) {
      const std::string status = samples::content_of(thread.path() / "status");
      const std::size_t place = status.find(name);
      if (place == std::string::npos) continue;
      // A list of several holds "-" or ",".
      if (status[status.find_first_of("-,\n", place)] == '\n') return true;
    }
    return false;
  })) << program.errors();
  ::kill(run, SIGTERM);
  EXPECT_EQ(samples::wait_for(run), 75) << program.errors();
}

TEST_F(Commands, AFinishedRunIsNotOverwritten) {
  const std::string run = fmt::format("run -t 1 --quiet --set output.frames=0 {} -o {}/out",
                                      scene("bar-wave.toml"), folder_.string());
  ASSERT_EQ(call(run).code, 0);
  const std::string summary = content("out/summary.json");
  const Outcome again = call(run);
  EXPECT_EQ(again.code, 2);
  EXPECT_TRUE(has(again.errors, "holds a finished run: --overwrite")) << again.errors;
  EXPECT_EQ(content("out/summary.json"), summary);
  const Outcome longer = call(fmt::format("resume {}/out --set motion.duration=9ms", folder_.string()));
  EXPECT_EQ(longer.code, 2);
  EXPECT_TRUE(has(longer.errors, "holds a finished run, which cannot go on")) << longer.errors;
  // A scene that cannot run throws nothing away.
  EXPECT_EQ(call(run + " --overwrite --set \"output.disk_limit=1 B\"").code, 2);
  EXPECT_EQ(content("out/summary.json"), summary);
  std::ofstream(folder_ / "out" / "compare.json") << "{}\n";  // of `tread compare`
  EXPECT_EQ(call(run + " --overwrite").code, 0);
  EXPECT_FALSE(fs::exists(folder_ / "out" / "compare.json"));
}

TEST_F(Commands, WhatCheckRefusesIsNeitherSolvedNorTakesTheWayOfAFinishedRun) {
  const std::string tyre =
      fmt::format("-t 1 {} --set \"motion.duration=0.1 ms\" --set output.frames=0 ", scene("tyre.toml"));
  const std::string coarse = "--set \"scene.element_size=8 mm\" ";
  const std::string waves =
      "--set corrugation.wavelength=20mm --set corrugation.start=0.13m --set corrugation.length=60mm ";
  const std::string out = (folder_ / "out").string();
  ASSERT_EQ(call(fmt::format("run --quiet -o {} {} {}", out, tyre, coarse)).code, 0);
  const std::string summary = content("out/summary.json");
  for (const auto& [wrong, answer] :
       {std::pair{coarse + "--set probe.a.x=0.2m --set probe.a.depth=0.25m", "probe.a: 250 mm below"},
        {coarse + "--set 'material.steel.damping={ kind = \"rayleigh_beta\", value = \"1e-5 s\" }'",
         "material damping: "},
        {coarse + "--set forks.present=true --set solution_zone.start=30mm", "state forks.at"},
        {coarse +
             "--set forks.present=true --set solution_zone.start=30mm --set corrugation.apply=gap --set "
             "corrugation.depth=2mm --set corrugation.wavelength=20mm --set corrugation.start=55mm --set "
             "corrugation.length=60mm",
         "state forks.at"},
        {coarse + "--set rail.origin=50mm --set corrugation.apply=gap --set corrugation.depth=10mm " + waves,
         "the wheel stands at"},
        {"--set scene.element_size=2mm --set corrugation.depth=7mm " + waves, "are turned inside out"}}) {
    EXPECT_EQ(call(fmt::format("check {} {}", tyre, wrong)).code, 2) << wrong;
    const Outcome anew = call(fmt::format("run -o {}/anew {} {}", folder_.string(), tyre, wrong));
    EXPECT_EQ(anew.code, 2) << wrong;
    EXPECT_TRUE(has(anew.errors, answer)) << anew.errors;
    EXPECT_TRUE(has(anew.errors, "[mesh]") && !has(anew.errors, "[preload]")) << anew.errors;
    const Outcome over = call(fmt::format("run --overwrite -o {} {} {}", out, tyre, wrong));
    EXPECT_EQ(over.code, 2) << wrong;
    EXPECT_TRUE(has(over.errors, answer)) << over.errors;
    EXPECT_EQ(content("out/summary.json"), summary) << wrong;
  }
}

/// Without the run, what was kept of its folder is all that is left.
TEST_F(Commands, ResultsThatAreKeptAloneAreNotOverwritten) {
  const auto run = [&](const char* folder, const std::string& more = "") {
    return call(fmt::format("run -t 1 --quiet --set output.frames=0 {} {} -o {}/{}", more,
                            scene("bar-wave.toml"), folder_.string(), folder));
  };
  EXPECT_EQ(run("out", "--set stop.steps=3").code, 4);
  fs::create_directories(folder_ / "copies");
  fs::copy_file(folder_ / "out/run.h5", folder_ / "copies/run.h5");
  fs::create_directories(folder_ / "states");
  fs::copy(folder_ / "out/checkpoint", folder_ / "states/forks");
  for (const auto& [folder, kept] : {std::pair{"copies", "run.h5"}, {"states", "forks/"}}) {
    const Outcome refused = run(folder);
    EXPECT_EQ(refused.code, 2) << folder;
    EXPECT_TRUE(has(refused.errors, fmt::format("holds results of a run ({}): --overwrite", kept)))
        << refused.errors;
    EXPECT_EQ(run(folder, "--overwrite --set \"output.disk_limit=1 B\"").code, 2) << folder;
    EXPECT_TRUE(fs::exists(folder_ / folder / kept)) << folder;
    EXPECT_EQ(run(folder, "--overwrite").code, 0) << folder;
  }
  // A run that was killed before its first state has lost nothing.
  for (const fs::path& state : CheckpointFolder(folder_ / "out/checkpoint").states()) fs::remove(state);
  EXPECT_EQ(run("out").code, 0);
}

TEST_F(Commands, RefusedOnesLeaveAFolderAsItWas) {
  const fs::path foreign = folder_ / "foreign";
  fs::create_directory(foreign);
  EXPECT_EQ(call("resume -t 1 " + foreign.string()).code, 2);
  EXPECT_EQ(call(fmt::format("ctl {} stop", foreign.string())).code, 2);
  EXPECT_TRUE(fs::is_empty(foreign));
  std::ofstream(foreign / "summary.json") << "{}\n";  // as of a finished run
  const fs::path worn = folder_ / "worn.toml";
  std::ofstream(worn)
      << samples::content_of(fs::path(TREAD_SOURCE_DIR) / "scenes/tyre.toml")
      << "[corrugation]\nstart = \"0.2 m\"\nlength = \"0.1 m\"\nwavelength = \"50 mm\"\ndepth = \"10 um\"\n"
         "apply = \"gap\"\n[wear]\nlongest = \"60 mm\"\n";
  for (const std::string& command :
       {"run -t 1 " + scene("bar-wave.toml"), "develop --from x " + worn.string()}) {
    const Outcome outcome = call(fmt::format("{} -o {}", command, foreign.string()));
    EXPECT_EQ(outcome.code, 2);
    EXPECT_TRUE(has(outcome.errors, " holds ")) << outcome.errors;
  }
  EXPECT_EQ(std::distance(fs::directory_iterator(foreign), {}), 1);
}

TEST_F(Commands, WithoutAFolderARunGetsADatedOneOfItsOwn) {
  // More runs than the seconds that they take.
  const std::string before = fmt::format("cd {} &&", folder_.string());
  std::vector<pid_t> processes;
  for (int i = 0; i < 6; ++i)
    processes.push_back(samples::start_program(
        "run -t 1 --quiet --set output.frames=0 --set motion.duration=1us " + scene("bar-wave.toml"), folder_,
        before));
  for (const pid_t process : processes) EXPECT_EQ(samples::wait_for(process), 0) << content("errors");
  int found = 0;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder_))
    found += entry.path().filename().string().starts_with("bar-wave-20") &&
             fs::exists(entry.path() / "summary.json");
  EXPECT_EQ(found, 6);
}

TEST_F(Commands, MeshWritesAFile) {
  const Outcome outcome = call(fmt::format("mesh -t 1 -o {} {} --set \"scene.element_size=8 mm\"",
                                           folder_.string(), scene("sphere-on-block.toml")));
  EXPECT_EQ(outcome.code, 0);
  EXPECT_TRUE(has(outcome.out, "tyre")) << outcome.out;
  EXPECT_TRUE(fs::exists(folder_ / "mesh.hdf"));
}

TEST_F(Commands, RunOfABarLeavesEverything) {
  EXPECT_EQ(call(fmt::format("run -t 1 --quiet -o {} {}", folder_.string(), scene("bar-wave.toml"))).code, 0);
  for (const char* name : {"scene.resolved.toml", "run.h5", "histories.csv", "summary.json", "report.html"})
    EXPECT_TRUE(fs::exists(folder_ / name)) << name;
  for (const char* name : {"patch.h5", "surface.h5", "surface_axis.csv", "deflection.csv"})
    EXPECT_FALSE(fs::exists(folder_ / name)) << name;
  const std::string report = content("report.html");
  EXPECT_TRUE(has(report, "Wave in a bar"));
  EXPECT_FALSE(has(report, "Creepage"));
}

TEST_F(Commands, AStaticRunLeavesItsPatch) {
  EXPECT_EQ(call(fmt::format("run -t 1 --json --quiet -o {} {} --set \"scene.element_size=4 mm\"",
                             folder_.string(), scene("sphere-on-block.toml")))
                .code,
            0);
  const fs::path file = folder_ / kPatchFile;
  const PatchAxes axes = read_patch_axes(file);
  const std::vector<PatchSample> samples = read_patch(file, {0});
  ASSERT_EQ(samples.size(), 1);
  const PatchWindow patch(axes, samples.front());
  const double pitch = patch.x(1) - patch.x(0);
  double force = 0;
  for (int i = 0; i < patch.stations(); ++i)
    for (std::size_t row = 1; row + 1 < axes.y.size(); ++row)
      force += pitch * 0.5 * (axes.y[row + 1] - axes.y[row - 1]) * patch.pressure(i, static_cast<int>(row));
  EXPECT_NEAR(force / 87564, 1, 0.01);
  EXPECT_TRUE(has(content("report.html"), "The patch at rest"));
  EXPECT_TRUE(has(content("summary.json"), "\"rail_tilt_rad\""));
}

TEST_F(Commands, AFullStandardOutputIsAnError) {
  const std::string command = fmt::format("{} check -t 1 {} >/dev/full 2>{}", shell_word(TREAD_EXECUTABLE),
                                          scene("bar-wave.toml"), (folder_ / "errors").string());
  EXPECT_EQ(WEXITSTATUS(std::system(command.c_str())), 4);
  EXPECT_TRUE(has(content("errors"), "standard output")) << content("errors");
}

TEST_F(Commands, AWayThatIsTooShortIsAWarning) {
  const auto warnings = [&](const std::string& file, const std::string& set) {
    return call("check --json -t 1 --set \"scene.element_size=11 mm\" " + set + " " + scene(file)).out;
  };
  EXPECT_FALSE(has(warnings("corrugation-d.toml", ""), "the wheel rolls to"));
  EXPECT_TRUE(has(warnings("corrugation-d.toml", "--set \"motion.speed=200 km/h\""),
                  "does not reach the corrugation, x = 2.4 to 2.96 m"));
  const std::string most = warnings("corrugation-d.toml", "--set \"motion.speed=250 km/h\"");
  EXPECT_TRUE(has(most, "does not pass the corrugation, x = 2.4 to 2.96 m")) << most;
  // The wheel gains some speed: 2.96 m / 250 km/h = 42.62 ms.
  EXPECT_TRUE(has(most, "motion.duration = \\\"42.59 ms\\\" passes it")) << most;
  EXPECT_TRUE(
      has(warnings("smooth.toml", "--set \"motion.duration=1 ms\""), "does not reach the solution zone"));
  EXPECT_TRUE(
      has(warnings("smooth.toml", "--set \"motion.duration=1 ms\" --set \"solution_zone.start=8.49 m\""),
          "passes it, with rail.length = \\\"15.4 m\\\" and fastenings.count = 24"));
  EXPECT_TRUE(has(warnings("squat.toml", "--set \"motion.duration=1 ms\""), "does not reach surface."));
  EXPECT_TRUE(has(warnings("squat.toml", "--set \"surface.squat.at=-1 m\""), "ahead of surface.squat"));
  EXPECT_TRUE(has(warnings("squat.toml", "--set \"surface.squat.centre=60 mm\""), "beside what the wheel"));
  EXPECT_TRUE(has(warnings("squat.toml",
                           "--set \"surface.waves={ kind = 'waves', wavelength = '0.2 m', length = '1 m', "
                           "depth = '0.1 mm', at = '5 m' }\""),
                  "does not reach surface.waves"));
  EXPECT_TRUE(has(warnings("wheel-flat.toml", "--set \"motion.duration=1 ms\""), "so that it has no effect"));
  EXPECT_TRUE(has(warnings("corrugation-d.toml",
                           "--set motion.present=false --set vehicle.present=false --set "
                           "load.present=true --set \"load.wheel_load=90 kN\""),
                  "acts on a rolling wheel alone"));
  EXPECT_TRUE(
      has(warnings("smooth.toml", "--set \"solution_zone.start=-3 m\""), "so that nothing is evaluated"));
  EXPECT_TRUE(has(warnings("corrugation-d.toml",
                           "--set \"corrugation.start=-20 mm\" --set \"solution_zone.start=-0.1 m\" --set "
                           "\"solution_zone.length=0.7 m\""),
                  "um deep under the wheel at its start"));
  // A wheel that brakes takes longer than the way at its first speed.
  const std::string brakes = "--set \"motion.speed=100 km/h\" --set \"motion.traction.mu=-0.3\" ";
  const std::string braked = warnings("corrugation-d.toml", brakes);
  const std::string words = "motion.duration = \\\"";
  const std::size_t begin = braked.find(words) + words.size();
  const std::string duration = braked.substr(begin, braked.find('\\', begin) - begin);
  EXPECT_TRUE(has(duration, " ms")) << braked;
  EXPECT_FALSE(has(warnings("corrugation-d.toml", brakes + "--set \"motion.duration=" + duration + "\""),
                   "the wheel rolls to"))
      << duration;
}

TEST_F(Commands, StaticSceneIsComparedWithHertz) {
  const std::string more = "--set \"scene.element_size=6 mm\" --set \"contact.penetration_ratio=0.05\"";
  EXPECT_EQ(
      call(fmt::format("run -t 1 --quiet -o {} {} {}", folder_.string(), more, scene("sphere-on-block.toml")))
          .code,
      0);
  const std::string report = content("report.html");
  EXPECT_TRUE(has(report, "Hertz for radii 430 and 430 mm; 2.1 elements across the patch do not resolve it"));
  EXPECT_FALSE(has(report, "Contact forces over"));
}

TEST_F(Commands, TheReportTellsOfATorqueThatRisesInAGuidedBore) {
  EXPECT_EQ(call(fmt::format("run -t 1 --quiet -o {} --set \"scene.element_size=12 mm\" --set "
                             "\"motion.duration=0.02 ms\" --set wheel.bore=guided {}",
                             folder_.string(), scene("tyre.toml")))
                .code,
            0);
  EXPECT_TRUE(has(content("report.html"), "They are not steady"));
  EXPECT_TRUE(has(content("report.html"), "the torque of motion.traction still changes"));
}

/// The shipped scenes with a rolling wheel, on a mesh that is fast rather than good.
class RollingScenes : public Commands, public testing::WithParamInterface<const char*> {};

TEST_P(RollingScenes, Run) {
  const std::string name = GetParam();
  EXPECT_EQ(
      call(fmt::format("run -t 1 --quiet -o {} --set \"scene.element_size=10 mm\" --set output.frames=2 "
                       "--set \"motion.duration=0.02 ms\" --set \"solution_zone.length=0.1 m\" {} {}",
                       folder_.string(),
                       name == "corrugation-d.toml"
                           ? "--set \"corrugation.length=0.08 m\" --set \"corrugation.start=2.41 m\""
                           : "",
                       scene(name)))
          .code,
      0);
  for (const char* file : {"report.html", "patch.h5", "surface.h5", "surface_axis.csv", "deflection.csv"})
    EXPECT_TRUE(fs::exists(folder_ / file)) << file;
}

INSTANTIATE_TEST_SUITE_P(Scenes, RollingScenes,
                         testing::Values("corrugation-d.toml", "smooth.toml", "rigid-ground.toml",
                                         "tyre.toml"));

TEST_F(Commands, VerifyTakesInputsAndJudges) {
  const std::string filter = "verify contact_filter --quiet --json -t 1 --set \"wavelength=40 mm\" ";
  const Outcome good = call(filter + "--set \"element_size=3.4 mm\"");
  EXPECT_EQ(good.code, 0) << good.out;
  EXPECT_TRUE(has(good.out, "{\"case\": \"contact_filter\", \"inputs\": {\"radius\": \"0.43 m\""))
      << good.out;
  EXPECT_TRUE(has(good.out, "\"bound\": 0.0618")) << good.out;
  EXPECT_TRUE(has(good.out, "\"pass\": true")) << good.out;
  // So coarse a mesh misses the largest pressure, and the program says so.
  const Outcome coarse =
      call("verify hertz_sphere --quiet --json -t 1 --set \"element_size=3.6 mm\" --set \"load=60 kN\"");
  EXPECT_EQ(coarse.code, 3) << coarse.out;
  EXPECT_TRUE(has(coarse.out, "\"pass\": false")) << coarse.out;
  const Outcome told =
      call("verify hertz_sphere contact_filter -t 1 --set \"element_size=3.6 mm\" --set \"load=60 kN\"");
  EXPECT_TRUE(has(told.errors, "[verify] 0 of 2 done  hertz_sphere\n")) << told.errors;
  EXPECT_TRUE(has(told.errors, "[verify] 1 of 2 done, 1 failed  contact_filter\n")) << told.errors;
}

TEST_F(Commands, VerifyRefusesWhatItDoesNotKnow) {
  for (const char* wrong : {"verify hertz_spere", "verify hertz_sphere --set radus=1",
                            "verify hertz_sphere --set \"radius=1 kg\"",
                            "verify hertz_sphere --set \"radius=9 m\"", "verify steady_rolling --set mu=0.6",
                            "verify hertz_sphere --set \"load=90 MN\"", "verify hertz_sphere --set radius"})
    EXPECT_EQ(call(wrong).code, 2) << wrong;
  EXPECT_TRUE(has(call("verify --list").out, "steady_rolling (standard): "));
}

TEST_F(Commands, VerifyListsTheNamedCases) {
  const std::string one = call("verify --list steady_rolling").out;
  EXPECT_TRUE(one.starts_with("steady_rolling (standard): ")) << one;
  EXPECT_FALSE(has(one, "hertz_sphere")) << one;
  EXPECT_EQ(call("verify --list hertz_spere").code, 2);
  const std::string list = call("verify --list --json hertz_sphere").out;
  const JsonRecord record = parse_json("{\"cases\": " + list + "}", "list");
  EXPECT_EQ(text_in(record, "cases.0.case"), "hertz_sphere");
  EXPECT_EQ(text_in(record, "cases.0.inputs.0.name"), "radius");
  EXPECT_FALSE(record.contains("cases.1.case"));
}

TEST_F(Commands, VerifyShowsWhatIsDoneWhereACaseCannotRun) {
  const Outcome outcome = call(
      "verify hertz_sphere ring_modes -t 1 --quiet --set \"element_size=3.6 mm\" --set \"load=60 kN\" "
      "--set \"thickness=1 mm\"");
  EXPECT_EQ(outcome.code, 2);
  EXPECT_TRUE(has(outcome.errors, "verify: thickness = 1 mm")) << outcome.errors;
  EXPECT_TRUE(has(outcome.out, "hertz_sphere")) << outcome.out;
}

TEST_F(Commands, WrongWordsAreProblemsInJson) {
  ::setenv("TREAD_CACHE_LIMIT", "-1", 1);
  for (const auto& [wrong, answer] :
       {std::pair{"check --json --nonsense", "--help` "},
        {"check --json", "--help` "},
        {"sweep --json x.toml --frm y", "--help` "},
        {"check --json corrugation-dd", "there is no such file; did you mean corrugation-d?"},
        {"dial --json --list tyr", "there is no such file; did you mean tyre?"},
        {"cache show --json --cache x", "TREAD_CACHE_LIMIT: "}}) {
    const Outcome outcome = call(wrong);
    EXPECT_EQ(outcome.code, 2) << wrong;
    EXPECT_TRUE(truth_in(parse_json(outcome.out, wrong), "ok") == false && has(outcome.out, "\"ok\": false"))
        << outcome.out;
    EXPECT_TRUE(has(outcome.out, answer)) << outcome.out;
  }
  ::unsetenv("TREAD_CACHE_LIMIT");
}

TEST_F(Commands, DevicesAreChosenByName) {
  const auto checked = call("check tyre --device emulated");
  EXPECT_EQ(checked.code, 0);
  EXPECT_NE(checked.out.find("Device    emulated"), std::string::npos) << checked.out;
  EXPECT_EQ(call("check tyre --device tpu").code, 2);
  EXPECT_EQ(call("check tyre --device gpu:9999").code, 4);
}

TEST_F(Commands, WrongWordsAreNamed) {
  for (const auto& [wrong, answer] :
       {std::pair{"rum x.toml", "there is no command 'rum'; did you mean 'run'?"},
        {"picture --help", "there is no command 'picture'; `tread --help` lists all"},
        {"develop x.toml --frm y",
         "tread develop: there is no option --frm; did you mean --from? `tread develop --help`"},
        {"run x.toml --gpu",
         "tread run: there is no option --gpu: a device belongs to the command: --device gpu"},
        {"run x.toml --mass-scaling=2", "masses are not scaled"},
        {"resume x --restart 3", "`tread resume DIR` goes on with a run"},
        {"bench kernels --kernels x",
         "tread bench kernels: there is no option --kernels; did you mean --kernel?"},
        {"run x.toml y.toml", "tread run: 'y.toml' was not expected here; `tread run --help` shows how"},
        {"run", "tread run: scene is required; `tread run --help` shows how"},
        {"", "tread: A subcommand is required; `tread --help` shows how"},
        {"run tyr", "tread: cannot read tyr: there is no such file; did you mean tyre?"},
        {"run nope", "tread: cannot read nope: there is no such file; shipped: "},
        {"run \"\"", "tread: the name of the scene is empty"},
        {"run tyre -o \"\"", "tread run: --output: the value is empty; state one, or leave the option out"},
        {"run tyre --from \"\"", "tread run: --from: the value is empty"},
        {"run tyre -q \"\"", "tread run: --quality: the value is empty"},
        {"sweep tyre --launcher \"\"", "tread sweep: --launcher: the value is empty"},
        {"cache clear --cache \"\"", "tread cache: --cache: the value is empty"},
        {"cache --cache= clear", "tread cache: --cache: the value is empty"},
        {"run tyre --bogus=", "tread run: there is no option --bogus=; "},
        {"sweep tyre", "is a scene, not a study: `tread run"},
        {"run x.toml -o y -t 0", "--threads: \"0\" is not a number of at least 1"},
        {"paper --jobs two", "--jobs: \"two\" is not a number of at least 1"},
        {"bench compare --by foo a b", "--by: foo not in {rate,limit,instructions}"},
        {"ctl y stop --wait -1", "--wait: \"-1\" is not a number of at least 0"}}) {
    const Outcome outcome = call(wrong);
    EXPECT_EQ(outcome.code, 2) << wrong;
    EXPECT_TRUE(has(outcome.errors, answer)) << wrong << outcome.errors;
    EXPECT_FALSE(has(outcome.errors, "tread: tread")) << wrong << outcome.errors;
  }
}

TEST_F(Commands, AnEmptyValueIsAProblemToo) {
  const Outcome outcome = call("check tyre --quiet= --set= --json");
  EXPECT_EQ(outcome.code, 2);
  EXPECT_TRUE(has(outcome.out, "\"message\": \"tread check: --set: the value is empty")) << outcome.out;
}

TEST_F(Commands, AnUnknownLibraryOfThreadsInTheEnvironmentIsRefused) {
  const std::string check = "check -t 1 " + scene("bar-wave.toml");
  ::setenv("TREAD_BACKEND", "foo", 1);
  const Outcome refused = call(check);
  const Outcome overridden = call(check + " --backend openmp");
  ::unsetenv("TREAD_BACKEND");
  EXPECT_EQ(refused.code, 2);
  EXPECT_TRUE(has(refused.errors, "TREAD_BACKEND = foo: threads can be run by tbb, openmp"))
      << refused.errors;
  EXPECT_EQ(overridden.code, 0) << overridden.errors;
}

TEST_F(Commands, PlacesOfOpenMPLeaveAllCores) {
  const std::string check = fmt::format("check {} --json", scene("bar-wave.toml"));
  const Outcome plain = call(check);
  ::setenv("OMP_PROC_BIND", "true", 1);
  const Outcome placed = call(check);
  ::unsetenv("OMP_PROC_BIND");
  ASSERT_EQ(plain.code, 0) << plain.errors;
  const auto threads = number_in(parse_json(plain.out, "check"), "threads");
  if (threads == 1) GTEST_SKIP() << "one core is allowed here: places cannot leave fewer";
  EXPECT_EQ(number_in(parse_json(placed.out, "check"), "threads"), threads);
}

TEST_F(Commands, ElementsThatDoNotFitNameTheirLine) {
  const fs::path scene = folder_ / "large.toml";
  std::ofstream(scene) << "[scene]\nbased_on = \"highspeed-slab-2014\"\nelement_size = \"14 mm\"\n";
  const Outcome outcome = call("check " + scene.string());
  EXPECT_EQ(outcome.code, 2);
  EXPECT_TRUE(has(outcome.errors, scene.string() + ":3: scene.element_size = 14 mm: rail: 2 layers of 14 mm"))
      << outcome.errors;
  EXPECT_TRUE(has(outcome.errors, "element_size of 12 mm at most fits, the other parts need 11.5 mm"))
      << outcome.errors;
}

TEST_F(Commands, VersionAndReferenceNeedNoScene) {
  EXPECT_TRUE(has(call("version --json").out, "\"compiler\": "));
  for (const char* command : {"--version", "run --version", "bench --version", "bench kernels --version"}) {
    const Outcome outcome = call(command);
    EXPECT_EQ(outcome.code, 0) << command;
    EXPECT_EQ(outcome.out, fmt::format("tread {}\n", program_version())) << command;
  }
  EXPECT_TRUE(has(call("--help").out, "Exit codes: 0 done"));
  EXPECT_TRUE(has(call("scene-reference").out, "# Scene reference"));
  EXPECT_TRUE(has(samples::content_of(fs::path(TREAD_SOURCE_DIR) / "CITATION.cff"),
                  fmt::format("\nversion: {}\n", program_version())));
}

TEST_F(Commands, VerboseAndQuietAreOptionsOfAll) {
  const Outcome verbose = call("version --verbose");
  EXPECT_TRUE(has(verbose.errors, fmt::format("[tread] tread {}", program_version()))) << verbose.errors;
  EXPECT_TRUE(has(verbose.errors, "of memory at the most")) << verbose.errors;
  EXPECT_EQ(call("version --quiet").errors, "");
  EXPECT_TRUE(has(call("check -t 1 --verbose " + scene("bar-wave.toml")).errors, "[tread] tread "));
}

}  // namespace
}  // namespace tread
