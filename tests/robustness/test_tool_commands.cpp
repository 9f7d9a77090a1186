// `tread multibody`, `roughness` and `profile` as a user calls them.

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "io/text/json.hpp"
#include "tests/commands_test.hpp"

namespace tread {
namespace {

namespace fs = std::filesystem;
using samples::Commands;
using samples::has;
using samples::Outcome;

TEST_F(Commands, MultibodyLeavesItsFiles) {
  fs::create_directory(folder_ / "figures");
  for (const char* foreign : {"figures/mine.svg", "calibration.csv"})
    std::ofstream(folder_ / foreign) << "mine";
  const Outcome outcome =
      call(fmt::format("multibody {} -t 1 --quiet --json --modes 40 --step \"20 us\" --filter -o {} "
                       "--map speed=250:300:50km/h wavelength=70:80:10mm",
                       scene("corrugation-d.toml"), folder_.string()));
  EXPECT_EQ(outcome.code, 0);
  for (const char* part : {"\"contact_filter_gain\": 0.94",
                           "\"loss_of_contact_share\": ", "\"beam\": \"Euler\"", "\"points\": 4"})
    EXPECT_TRUE(has(outcome.out, part)) << part << outcome.out;
  EXPECT_EQ(content("calibration.csv"), "mine");
  EXPECT_EQ(outcome.out, content("summary.json"));
  EXPECT_TRUE(content("multibody.csv")
                  .starts_with("time [s],wheel_x [m],vertical_force [N],wheel_deflection [m],"
                               "rail_deflection [m],sprung_deflection [m],followed_depth [m]\n"));
  EXPECT_TRUE(content("map.csv").starts_with("speed [m/s],wavelength [m],"));
  for (const char* part :
       {"Vertical force over the corrugation", "Largest F<sub>N</sub> over static", "1000 Hz", "Provenance"})
    EXPECT_TRUE(has(content("report.html"), part)) << part;
  EXPECT_TRUE(has(content("figures/map.svg"), "xmlns"));
  // Lines of one frequency reach the right border; their labels stand beside it.
  EXPECT_TRUE(has(content("figures/map.svg"), "x=\"775.0\""));
  // Another call leaves nothing of this one.
  EXPECT_EQ(call(fmt::format("multibody {} -t 1 --quiet --modes 40 --step \"20 us\" -o {}",
                             scene("corrugation-d.toml"), folder_.string()))
                .code,
            0);
  for (const char* gone : {"map.csv", "figures/map.svg"}) EXPECT_FALSE(fs::exists(folder_ / gone)) << gone;
  EXPECT_EQ(content("figures/mine.svg"), "mine");
  const Outcome local =
      call(fmt::format("multibody {} -t 1 --quiet --json --beam solid --wheel modal --contact "
                       "half-space",
                       scene("corrugation-d.toml")));
  EXPECT_EQ(local.code, 0);
  for (const char* part : {"\"beam\": \"Solid\"", "\"contact\": \"half-space\""})
    EXPECT_TRUE(has(local.out, part)) << part << local.out;
  // Its own curve is a run's history: the fit finds the spring that it was made with.
  std::ofstream(folder_ / "histories.csv") << content("multibody.csv");
  const Outcome fitted =
      call(fmt::format("multibody {0}/scene.resolved.toml -t 1 --quiet --modes 40 --step \"20 us\" --filter "
                       "--calibrate {0} -o {0}/fit",
                       folder_.string()));
  EXPECT_EQ(fitted.code, 0);
  EXPECT_TRUE(has(fitted.out, "C / Hertz")) << fitted.out;
  EXPECT_TRUE(fs::exists(folder_ / "fit" / "calibration.csv"));
  // On a map it is a dot that lies on the same value.
  const Outcome dotted = call(
      fmt::format("multibody {0}/scene.resolved.toml -t 1 --quiet --modes 40 --step \"20 us\" --dots {0} "
                  "--map speed=300:300:100km/h wavelength=80:80:10mm --json -o {0}/dotted",
                  folder_.string()));
  EXPECT_EQ(dotted.code, 0);
  const Json map = Json::parse(dotted.out)["map"];
  ASSERT_EQ(map["dots"].size(), 1U);
  EXPECT_NEAR(map["dots"][0]["speed_m_per_s"].get<double>(), 300 / 3.6, 1e-3);
  EXPECT_EQ(map["dots"][0]["wavelength_m"], 0.08);
  EXPECT_NEAR(map["dots"][0]["max_over_static"].get<double>(),
              map["largest"]["max_over_static"].get<double>(), 1e-3);
  EXPECT_TRUE(has(content("dotted/report.html"), "Dots: transient runs"));
  // A fastening has several spring-dampers.
  const Outcome apart = call(fmt::format(
      "multibody {0}/scene.resolved.toml -t 1 --quiet --modes 40 --step \"20 us\" --calibrate {0} "
      "--set fastenings.columns=2",
      folder_.string()));
  EXPECT_EQ(apart.code, 2);
  EXPECT_TRUE(has(apart.errors, "the number of the fastenings' spring-dampers along the rail is "))
      << apart.errors;
}

TEST_F(Commands, MultibodyRefusesWhatItCannotDo) {
  const std::string good = "multibody --quiet " + scene("corrugation-d.toml");
  for (const std::string& wrong :
       {good + " --beam rayleigh", good + " --step 5", good + " --step \"0 s\"", good + " --step \"1 s\"",
        good + " --modes 1", good + " --map speed=100:500:10km/h", good + " --dots " + folder_.string(),
        good + " --calibrate " + folder_.string(), good + " --set \"rail.length=8 m\"",
        good + " --beam solid --modes 40", good + " --filter --contact half-space", good + " --wheel soft",
        "multibody --quiet --contact half-space " + scene("smooth.toml"),
        "multibody --quiet " + scene("tyre.toml"), "multibody --quiet " + scene("bar-wave.toml"),
        "multibody --quiet --filter " + scene("smooth.toml")})
    EXPECT_EQ(call(wrong).code, 2) << wrong;
  EXPECT_EQ(call(good + " --step \"20 us\"").code, 3);
  const Outcome stiff = call(good + " --modes 2");
  EXPECT_EQ(stiff.code, 0);
  EXPECT_TRUE(has(stiff.out, "\n[warning] the shortest wave")) << stiff.out;
  std::ofstream(folder_ / "depth.txt") << "# x [m]  d [mm]\n0 0\n0.1 0.02\n0.5 0\n";
  const fs::path measured = folder_ / "measured.toml";
  std::ofstream(measured) << "[scene]\nbased_on = \"highspeed-slab-2014\"\n[corrugation]\nkind = \"table\"\n"
                             "file = \"depth.txt\"\n";
  for (const char* option : {"--filter", "--contact half-space"}) {
    const Outcome outcome = call(fmt::format("multibody --quiet {} {}", option, measured.string()));
    EXPECT_EQ(outcome.code, 2) << option;
    EXPECT_TRUE(has(outcome.errors, "a sine, and corrugation.kind is \"table\"; state")) << outcome.errors;
  }
  // A history with a broken row names its line.
  std::ofstream(folder_ / "scene.resolved.toml")
      << std::ifstream(fs::path(TREAD_SOURCE_DIR) / "scenes/corrugation-d.toml").rdbuf();
  std::ofstream(folder_ / "histories.csv") << "time [s],wheel_x [m],vertical_force [N]\n0,0,1\n1,1\n";
  const Outcome broken = call(good + " --json --calibrate " + folder_.string());
  EXPECT_EQ(broken.code, 2);
  // A run's results are not overwritten.
  EXPECT_EQ(call(good + " -o " + folder_.string()).code, 2);
  EXPECT_TRUE(has(broken.out, "histories.csv:3: 2 values under 3 columns")) << broken.out;
}

TEST_F(Commands, RoughnessReadsJudgesAndWrites) {
  const fs::path file = folder_ / "rail.txt";
  const auto write = [&](const std::string& head) {
    std::ofstream text(file);
    text << head;
    // 0.14 mm from crest to trough, 80 mm.
    for (int i = 0; i < 4000; ++i)
      text << fmt::format("{} {:.4f}\n", i, 70 * std::sin(2 * 3.14159265358979 * i / 80));
  };
  write("# x [mm] height [um]\n");
  const Outcome outcome =
      call(fmt::format("roughness {} --raw --json -t 1 -o {}/out", file.string(), folder_.string()));
  EXPECT_EQ(outcome.code, 0);
  EXPECT_TRUE(has(outcome.out, "\"wavelength_m\": 0.08,\n      \"level_dB_re_1_um\": 33.89")) << outcome.out;
  EXPECT_TRUE(has(content("out/levels.csv"), "0.08,33.89"));
  EXPECT_TRUE(has(content("out/report.html"), "limit of ISO 3095:2013"));
  EXPECT_TRUE(fs::exists(folder_ / "out" / "levels.svg"));
  write("");
  EXPECT_EQ(call("roughness " + file.string()).code, 2);  // no units
  const Outcome stated = call(fmt::format("roughness {} --units mm,um -t 1", file.string()));
  EXPECT_EQ(stated.code, 0);
  EXPECT_TRUE(has(stated.out, "33.9")) << stated.out;
  write("# x [mm] height [um]\n");
  EXPECT_EQ(call(fmt::format("roughness {} --units m,um", file.string())).code, 2);
}

TEST_F(Commands, AnOutputDoesNotReplaceTheInput) {
  const fs::path file = folder_ / "levels.csv";
  std::ofstream(file) << "mine\n";
  const fs::path own_scene = folder_ / "own.toml";
  std::ofstream(own_scene) << "scene.based_on = \"highspeed-slab-2014\"\n";
  for (const std::string& command :
       {fmt::format("export {} -o {}", own_scene.string(), own_scene.string()),
        fmt::format("roughness {} -o {}/./", file.string(), folder_.string()),
        fmt::format("profile CN60 --against {} --svg {}", file.string(), file.string())}) {
    const Outcome outcome = call(command);
    EXPECT_EQ(outcome.code, 2) << command;
    EXPECT_TRUE(has(outcome.errors, "would replace the input")) << outcome.errors;
  }
}

TEST_F(Commands, RoughnessNamesTheBrokenLine) {
  const fs::path file = folder_ / "rail.txt";
  const auto answer = [&](const std::string& text) {
    std::ofstream(file) << text;
    return call("roughness --json " + file.string());
  };
  const std::string head = "# x [m] r [um]\n0 1\n";
  const std::pair<const char*, const char*> wrongs[] = {{"0.001 x\n", "is not a number"},
                                                        {"0.001 1 2\n", "expected 2 numbers"},
                                                        {"0 2\n", "must grow"},
                                                        {"0.001 nan\n", "not finite"}};
  for (const auto& [line, reason] : wrongs) {
    const Outcome outcome = answer(head + line + "0.002 1\n");
    EXPECT_EQ(outcome.code, 2) << line;
    EXPECT_TRUE(has(outcome.out, "\"line\": 3")) << line << outcome.out;
    EXPECT_TRUE(has(outcome.out, reason)) << line << outcome.out;
  }
  const std::string bare = answer("0 1\n0.001 2\n").out;
  for (const char* part : {"units are missing", "# x [m]  height [um]", "or state --units m,um"})
    EXPECT_TRUE(has(bare, part)) << bare;
  EXPECT_TRUE(has(answer("# [m] [kg]\n0 1\n").out, "not a length"));
  EXPECT_TRUE(has(answer(head + "0.001 2\n0.002 2\n0.003 2\n0.5 2\n").out, "no rows between"));
  EXPECT_TRUE(has(answer(head + "0.001 2\n0.002 2\n").out, "no band of"));
  EXPECT_TRUE(has(answer("# x [m] r [um]\n0 0\n0.001 0\n0.002 0\n").out, "rail.txt: the record is flat"));
  std::string spike = head;
  for (int i = 1; i < 300; ++i) spike += fmt::format("{} {}\n", 1e-3 * i, i == 150 ? 101 : 1);
  EXPECT_TRUE(has(answer(spike).out, "the profile is flat once its spikes (1) are cut off"));
  EXPECT_TRUE(has(answer("").out, "at least two rows"));
  EXPECT_TRUE(has(call("roughness --units m,kg " + file.string()).errors, "--units m,kg: "));
  EXPECT_EQ(call("roughness " + (folder_ / "none.txt").string()).code, 2);
  EXPECT_EQ(call("roughness --segment 2 " + file.string()).code, 2);
}

TEST_F(Commands, ProfileShowsWritesAndMeets) {
  const fs::path clean = folder_ / "clean.txt", svg = folder_ / "s.svg";
  const Outcome built_in =
      call(fmt::format("profile S1002 --against 60E1 -o {} --svg {}", clean.string(), svg.string()));
  EXPECT_EQ(built_in.code, 0) << built_in.errors;
  EXPECT_TRUE(has(built_in.out, "height Sh 28.00 mm, thickness Sd 32.50 mm")) << built_in.out;
  EXPECT_TRUE(has(built_in.out, "area 76.70 cm2, height 172 mm, I_y 3038")) << built_in.out;
  EXPECT_TRUE(has(built_in.out, "wheel.lateral_offset")) << built_in.out;
  EXPECT_TRUE(has(content("s.svg"), "Curvature"));
  EXPECT_TRUE(has(content("s-touching.svg"), "place of contact"));
  // The clean columns read back, also after they were mirrored and turned.
  const Outcome again = call(fmt::format("profile {} --wheel --smoothing '0.01 mm' --json", clean.string()));
  EXPECT_EQ(again.code, 0) << again.errors;
  EXPECT_TRUE(has(again.out, "\"mirrored\": false")) << again.out;
  EXPECT_TRUE(has(again.out, "\"largest_deviation_m\": 9.")) << again.out;
  EXPECT_TRUE(has(call("profile " + clean.string()).out, "clean.txt, wheel"));  // by its first line
  std::string untitled = content("clean.txt");
  untitled.erase(0, untitled.find('\n') + 1);
  std::ofstream(folder_ / "untitled.txt") << untitled;
  EXPECT_TRUE(has(call("profile " + (folder_ / "untitled.txt").string()).errors, "state --wheel or --rail"));
  EXPECT_TRUE(
      has(call(fmt::format("profile {} --rail --section 60E3", clean.string())).errors, "choose from"));
  EXPECT_EQ(call(fmt::format("profile {} --rail --wheel", clean.string())).code, 2);
  EXPECT_EQ(call("profile LMA --against S1002").code, 2);
  EXPECT_EQ(call("profile LMA --against CN60 --inclination steep").code, 2);
  for (const std::string option : {"--smoothing '0.1 mm'", "--shift '2 mm'", "--mirrored", "--section 60E1"})
    EXPECT_TRUE(has(call("profile S1002 --against 60E1 " + option).errors, "and none is given")) << option;
  for (const std::string wrong : {"profile LMA --inclination steep", "profile CN60 --inclination 1:20"})
    EXPECT_TRUE(has(call(wrong).errors, "--against names no other body")) << wrong;
  EXPECT_EQ(call(fmt::format("profile {} --wheel --mirrored", clean.string())).code, 2);
  EXPECT_EQ(call(fmt::format("profile {} --wheel --smoothing 1", clean.string())).code, 2);
}

TEST_F(Commands, AFolderWithABlankReceivesTheOutput) {
  const fs::path folder = folder_ / "two words";
  fs::create_directory(folder);
  EXPECT_EQ(samples::wait_for(samples::start_program("version", folder)), 0);
  EXPECT_TRUE(samples::content_of(folder / "out").starts_with("tread "));
}

}  // namespace
}  // namespace tread
