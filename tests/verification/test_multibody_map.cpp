// The fit of the contact spring and the map of response.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <initializer_list>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "core/error.hpp"
#include "core/parallel/parallel.hpp"
#include "drivers/run/scene_content.hpp"
#include "drivers/studies/multibody/local_parts.hpp"
#include "drivers/studies/multibody/multibody_report.hpp"
#include "drivers/studies/multibody/multibody_study.hpp"
#include "io/report/markup.hpp"
#include "io/scene/scene_reader.hpp"
#include "tests/measured.hpp"
#include "tests/refusal.hpp"
#include "tests/temporary_folder.hpp"

namespace tread {
namespace {

MultibodyModel model_of(double speed_km_h, double wavelength_mm) {
  const std::string text =
      "[scene]\ntitle = \"t\"\nbased_on = \"highspeed-slab-2014\"\n[motion]\nspeed = \"" +
      std::to_string(speed_km_h) + " km/h\"\n[corrugation]\nwavelength = \"" + std::to_string(wavelength_mm) +
      " mm\"\ndepth = \"0.1 mm\"\n";
  MultibodyModel model =
      multibody_model(resolve_scene(SceneSource{"test", text, {}}).scene, BeamTheory::euler);
  model.start = 0;
  return model;
}

constexpr MultibodyStep kQuick = {50, 1e-5};

/// Results of a run with another contact spring.
TransientRun run_with(double factor, double speed_km_h = 300) {
  MultibodyModel model = model_of(speed_km_h, 80);
  model.vehicle.contact *= factor;
  TransientRun run;
  run.directory = "made/up";
  run.scene = model.scene;
  for (const MultibodySample& s : run_multibody(model, kQuick).samples) {
    run.time.push_back(s.time);
    run.x.push_back(s.x);
    run.force.push_back(s.force);
  }
  return run;
}

TEST(Calibration, FindsTheSpringOfTheRun) {
  const MultibodyModel model = model_of(300, 80);
  const Calibration c = calibrate(model, run_with(0.62), kQuick);
  measured("fitted / true C", c.contact / model.vehicle.contact / 0.62);
  EXPECT_NEAR(c.contact / model.vehicle.contact, 0.62, 0.01);
  EXPECT_FALSE(c.at_bound);
  EXPECT_LT(c.after.misfit, 0.01 * c.before.misfit + 500);
  EXPECT_GT(c.before.force.range(), 1.1 * c.run.force.range());
  EXPECT_NEAR(c.after.force.range(), c.run.force.range(), 0.02 * c.run.force.range());
  EXPECT_TRUE(std::is_sorted(c.factors.begin(), c.factors.end()));
  EXPECT_EQ(c.first, 2.44);
  EXPECT_EQ(c.last, 2.92);
}

TEST(Calibration, SaysWhenNoSpringFits) {
  EXPECT_TRUE(calibrate(model_of(300, 80), run_with(20), kQuick).at_bound);
}

TEST(Calibration, RefusesARunThatIsAnother) {
  EXPECT_THROW(calibrate(model_of(250, 80), run_with(1), kQuick), InputError);
  EXPECT_THROW(calibrate(model_of(300, 65), run_with(1), kQuick), InputError);
  TransientRun brief = run_with(1);
  brief.x.resize(brief.x.size() / 3);
  brief.force.resize(brief.x.size());
  const auto refusals = [&] {
    return std::array{samples::refusal<InputError>([&] { calibrate(model_of(300, 80), brief, kQuick); }),
                      samples::refusal<InputError>([&] { map_dot(model_of(300, 80), brief); })};
  };
  for (const std::string& refused : refusals()) samples::expect_part(refused, "; let it roll further");
  brief.unfinished = "the run is not done: another command";
  for (const std::string& refused : refusals()) samples::expect_part(refused, "; " + brief.unfinished);
}

/// One of so many samples of a run, 0.83 mm apart.
TransientRun thinned(const TransientRun& run, std::size_t every) {
  TransientRun thin = run;
  for (std::vector<double> TransientRun::*column :
       {&TransientRun::time, &TransientRun::x, &TransientRun::force}) {
    (thin.*column).clear();
    for (std::size_t i = 0; i < run.x.size(); i += every) (thin.*column).push_back((run.*column)[i]);
  }
  return thin;
}

TEST(Calibration, RefusesSamplesTooFarApart) {
  const MultibodyModel model = model_of(300, 80);
  const TransientRun run = run_with(1);
  EXPECT_EQ(samples::refusal<InputError>([&] { map_dot(model, thinned(run, 10)); }), "");
  EXPECT_EQ(samples::refusal<InputError>([&] { calibrate(model, thinned(run, 10), kQuick); }), "");
  for (const std::size_t every : {std::size_t{16}, std::size_t{100}, run.x.size() - 1}) {
    const TransientRun few = thinned(run, every);
    const std::string dot = samples::refusal<InputError>([&] { map_dot(model, few); });
    EXPECT_TRUE(dot.starts_with("--dots made/up: its histories.csv has ")) << every << dot;
    const std::string fit = samples::refusal<InputError>([&] { calibrate(model, few, kQuick); });
    EXPECT_TRUE(fit.starts_with("--calibrate made/up: its histories.csv has ")) << every << fit;
    EXPECT_NE(fit.find("a shorter output.history_interval"), std::string::npos) << fit;
  }
}

/// A run that ends within the corrugation, beside a model that rolls on.
TEST(Calibration, ComparesTheShiftsOfTheSameCrests) {
  const MultibodyModel model = model_of(300, 80);
  const TransientRun whole = run_with(1);
  TransientRun brief = whole;
  const auto end = std::upper_bound(brief.x.begin(), brief.x.end(), 2.7);
  for (std::vector<double>* column : {&brief.time, &brief.force})
    column->resize(static_cast<std::size_t>(end - brief.x.begin()));
  brief.x.erase(end, brief.x.end());
  const Calibration c = calibrate(model, brief, kQuick);
  // Its three crests have other shifts than all six.
  EXPECT_GT(std::abs(c.run.shift - calibrate(model, whole, kQuick).run.shift), 0.02);
  EXPECT_NEAR(c.before.shift, c.run.shift, 1e-6);
}

/// Depths of a file of which the run keeps the checksum alone.
TEST(Calibration, RefusesARunWhoseFileHasChanged) {
  const samples::TemporaryFolder folder;
  const auto write = [&](const char* name, const std::string& text) {
    std::ofstream(folder.path / name) << text;
  };
  write("depths.txt", "# x [mm]  d [mm]\n0 0\n20 0.02\n40 0\n60 0.02\n80 0\n");
  write("scene.toml",
        "[scene]\nbased_on = \"highspeed-slab-2014\"\n[motion]\nspeed = \"300 km/h\"\n[corrugation]\n"
        "kind = \"table\"\nfile = \"depths.txt\"\n");
  keep_scene(folder.path, resolve_scene(folder.path / "scene.toml"));
  write("histories.csv", "time [s],wheel_x [m],vertical_force [N]\n0,0,1\n1,1,1\n");
  EXPECT_EQ(read_transient_run(folder.path).changed, "");
  write("depths.txt", "# x [mm]  d [mm]\n0 0\n20 0.03\n40 0\n60 0.02\n80 0\n");
  const TransientRun run = read_transient_run(folder.path);
  const MultibodyModel model = multibody_model(run.scene, BeamTheory::euler);
  const std::string file = "corrugation.file is a .txt file of checksum ";
  EXPECT_NE(samples::refusal<InputError>([&] { calibrate(model, run, kQuick); }).find(file),
            std::string::npos);
  EXPECT_NE(samples::refusal<InputError>([&] { map_dot(model, run); }).find(file), std::string::npos);
}

TEST(Calibration, RefusesAnotherTrackOrVehicle) {
  for (const auto change :
       std::initializer_list<void (*)(Scene&)>{[](Scene& scene) { scene.fastenings->damping *= 0.5; },
                                               [](Scene& scene) { scene.vehicle->unsprung_mass += 100; },
                                               [](Scene& scene) { scene.rail->origin += 0.1; },
                                               [](Scene& scene) { scene.corrugation->depth *= 1.1; }}) {
    TransientRun run = run_with(1);
    change(run.scene);
    EXPECT_THROW(calibrate(model_of(300, 80), run, kQuick), InputError);
  }
}

TEST(Calibration, RefusesAnotherWheelContactOrSurface) {
  using Change = void (*)(Scene&);
  for (const auto& [change, text] : std::initializer_list<std::pair<Change, const char*>>{
           {[](Scene& scene) { scene.wheel->diameter *= 1.05; }, "the wheel's diameter is 0.86 m here"},
           {[](Scene& scene) { scene.wheel->lateral_offset = 3e-3; }, "the contact's C is "},
           {[](Scene& scene) { scene.corrugation->centre = 15e-3; }, "the corrugations' depths differ by"},
           {[](Scene& scene) { scene.surfaces["weld"].at = 1; },
            "the surfaces' depths differ by up to 1 mm"}}) {
    TransientRun run = run_with(1);
    change(run.scene);
    const auto fit = [&] { calibrate(model_of(300, 80), run, kQuick); };
    samples::expect_part(samples::refusal<InputError>(fit), text);
  }
}

TEST(Calibration, RollsAsFastAsTheRun) {
  // Traction has made the run's wheel 5 % faster than its scene says.
  TransientRun run = run_with(0.62, 315);
  run.scene = model_of(300, 80).scene;
  const Calibration c = calibrate(model_of(300, 80), run, kQuick);
  EXPECT_NEAR(c.speed, 315 / 3.6, 1e-6);
  EXPECT_NEAR(c.contact / model_of(300, 80).vehicle.contact, 0.62, 0.01);
}

TEST(ResponseMap, AxesAreParsed) {
  const MapAxes axes = parse_map_axes({"wavelength=40:150:2mm", "speed=100:500:10km/h"});
  ASSERT_EQ(axes.speed.values.size(), 41U);
  ASSERT_EQ(axes.wavelength.values.size(), 56U);
  EXPECT_NEAR(axes.speed.values[20], 300 / 3.6, 1e-12);
  EXPECT_NEAR(axes.wavelength.values.back(), 0.15, 1e-12);
  EXPECT_EQ(parse_map_axes({"speed=300:300:10 km/h", "wavelength=0.05:0.08:0.01 m"}).speed.values.size(), 1U);
  for (const std::vector<std::string>& wrong :
       std::vector<std::vector<std::string>>{{"speed=100:500:10km/h", "speed=100:500:10km/h"},
                                             {"speed=100:500:10km/h", "depth=1:2:1mm"},
                                             {"speed=100:500km/h", "wavelength=40:150:2mm"},
                                             {"speed=100:500:10mm", "wavelength=40:150:2mm"},
                                             {"speed=100:500:10", "wavelength=40:150:2mm"},
                                             {"speed=500:100:10km/h", "wavelength=40:150:2mm"},
                                             {"speed=100:500:0km/h", "wavelength=40:150:2mm"},
                                             {"speed=100:500:0.001km/h", "wavelength=40:150:0.1mm"},
                                             {"speed=100:x:1km/h", "wavelength=40:150:2mm"}})
    EXPECT_THROW(parse_map_axes(wrong), InputError) << wrong[0] << " " << wrong[1];
}

TEST(ResponseMap, AxesWavesAndDotsAreReadBeforeAnyPassage) {
  const auto refusal = [](const std::string& corrugation, const std::vector<std::string>& map) {
    MultibodyOptions options;
    options.map = map;
    options.dots = {"no/run"};
    options.step = "1 s";  // the first passage refuses it
    options.quiet = true;
    const std::string text = "[scene]\nbased_on = \"highspeed-slab-2014\"\n[motion]\nspeed = \"300 km/h\"\n";
    return samples::refusal<InputError>([&] {
      run_multibody_study(resolve_scene(SceneSource{"test", text + corrugation, {}}), options);
    });
  };
  const char* const sine = "[corrugation]\nwavelength = \"80 mm\"\ndepth = \"0.1 mm\"\n";
  const std::string speed = "speed=200:300:50km/h";
  EXPECT_TRUE(refusal(sine, {speed}).starts_with("--map speed=200:300:50km/h: it takes both"));
  EXPECT_TRUE(
      refusal(sine, {speed, "wavelength=600:800:200mm"}).starts_with("--map: no whole wave of 800 mm "));
  EXPECT_TRUE(refusal("", {speed, "wavelength=60:80:20mm"}).starts_with("--map: the scene needs "));
  EXPECT_NE(refusal(sine, {speed, "wavelength=60:80:20mm"}).find("no/run"), std::string::npos);
}

TEST(ResponseMap, PointsAreThoseOfSinglePassages) {
  const MapAxes axes = parse_map_axes({"speed=200:300:100km/h", "wavelength=60:80:20mm"});
  const MultibodyStep step = {50, 5e-6};
  const ResponseMap map = response_map(model_of(120, 100), axes, step, false);
  for (std::size_t i = 0; i < 2; ++i)
    for (std::size_t j = 0; j < 2; ++j) {
      const MultibodyModel model =
          model_of(200 + 100 * static_cast<double>(i), 60 + 20 * static_cast<double>(j));
      const MultibodyResult r = run_multibody(model, step);
      EXPECT_NEAR(map.at(i, j).max, r.force.max / model.vehicle.load(), 1e-9) << i << " " << j;
      EXPECT_NEAR(map.at(i, j).min, r.force.min / model.vehicle.load(), 1e-9) << i << " " << j;
      EXPECT_NEAR(map.at(i, j).loss_of_contact, r.loss_of_contact, 1e-12) << i << " " << j;
    }
}

TEST(ResponseMap, ThreadsDoNotChangeIt) {
  const MapAxes axes = parse_map_axes({"speed=200:300:50km/h", "wavelength=60:80:20mm"});
  const auto with = [&](int count) {
    set_threads(count);
    return response_map(model_of(300, 80), axes, kQuick, true);
  };
  const ResponseMap one = with(1);
  const ResponseMap three = with(3);
  set_threads(1);
  for (std::size_t i = 0; i < one.points.size(); ++i) {
    EXPECT_EQ(one.points[i].max, three.points[i].max);
    EXPECT_EQ(one.points[i].min, three.points[i].min);
  }
}

TEST(ResponseMap, AnErrorLeavesTheThreads) {
  const MapAxes axes = parse_map_axes({"speed=200:300:50km/h", "wavelength=60:80:20mm"});
  set_threads(2);
  EXPECT_THROW(response_map(model_of(300, 80), axes, {50, 1e-4}, false), NumericalError);
  EXPECT_THROW(
      response_map(model_of(300, 80), parse_map_axes({"speed=200:300:50km/h", "wavelength=600:800:200mm"}),
                   kQuick, false),
      InputError);
  set_threads(1);
}

TEST(ResponseMap, DotsAreTheRunsOwnExtremes) {
  const MultibodyModel model = model_of(300, 80);
  const TransientRun run = run_with(0.8);
  const MapDot dot = map_dot(model, run);
  EXPECT_EQ(dot.label, "up");
  EXPECT_NEAR(dot.speed, model.speed, 1e-9 * model.speed);
  double largest = 0;
  for (std::size_t i = 0; i < run.x.size(); ++i)
    if (run.x[i] > 2.44 && run.x[i] < 2.92) largest = std::max(largest, run.force[i]);
  EXPECT_EQ(dot.max, largest / model.vehicle.load());
  EXPECT_TRUE(dot.remark.empty()) << dot.remark;
  MultibodyModel deeper = model;
  deeper.scene.corrugation->depth *= 2;
  EXPECT_FALSE(map_dot(deeper, run).remark.empty());
  MultibodyModel heavier = model;
  heavier.vehicle.unsprung_mass += 100;
  EXPECT_FALSE(map_dot(heavier, run).remark.empty());
  EXPECT_EQ(map_dot(heavier, run).max, dot.max);
}

TEST(ResponseMap, DotsOutsideHaveNoValueOfTheMap) {
  MultibodyOutcome outcome;
  outcome.model = model_of(300, 80);
  outcome.result = run_multibody(outcome.model, kQuick);
  const MapAxes axes = parse_map_axes({"speed=250:300:50km/h", "wavelength=70:80:10mm"});
  outcome.map = response_map(outcome.model, axes, kQuick, false);
  // Half a cell belongs to the map beyond the last value.
  outcome.dots = {{"inside", 320 / 3.6, 0.084, 1.5, 0.5, ""},
                  {"long", 300 / 3.6, 0.09, 1.5, 0.5, "other depth"},
                  {"slow", 100 / 3.6, 0.08, 9, 0.5, ""}};
  const Report report = multibody_report(outcome, "scene.toml", {});
  const auto map = std::find_if(report.chapters.begin(), report.chapters.end(),
                                [](const Chapter& chapter) { return chapter.title == "Map"; });
  ASSERT_NE(map, report.chapters.end());
  EXPECT_EQ(std::get<Heatmap>(map->blocks.at(0)).dots.size(), 1U);
  const auto& rows = std::get<Table>(map->blocks.at(1)).rows;
  ASSERT_EQ(rows.size(), 3U);
  EXPECT_EQ(rows[0][4], readable(outcome.map->at(1, 1).max, 3));
  EXPECT_EQ(rows[0][5], "");
  EXPECT_EQ(rows[1][4], "-");
  EXPECT_EQ(rows[1][5], "outside the map; other depth");
  EXPECT_EQ(rows[2][4], "-");
  EXPECT_EQ(rows[2][5], "outside the map");
}

TEST(ModelRange, ReachesToTheLowerTopOfRailAndWheel) {
  MultibodyModel model = model_of(300, 80);
  EXPECT_GE(top_of_modes(model, {}).frequency, 20e3);
  EXPECT_EQ(top_of_modes(model, 10).part, "--modes 10");
  model.solid = ModalBeam(model.rail, 0, 10, 5);
  EXPECT_EQ(top_of_modes(model, {}).frequency, 6e3);
  model.wheel.modes.resize(1);
  model.wheel.top = 5e3;
  EXPECT_EQ(top_of_modes(model, {}).part, "--wheel modal");
}

TEST(ModelRange, ABeamLacksAHeadOfAnotherMaterial) {
  MultibodyModel model = model_of(300, 80);
  Material light = model.scene.rail_material();
  light.density *= 0.9;
  model.scene.materials["light"] = light;
  model.scene.rail->head_material = "light";
  const std::vector<std::string> warnings = run_multibody(model, kQuick).warnings;
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_TRUE(warnings[0].starts_with("the beam is of rail.material alone")) << warnings[0];
}

TEST(ModelRange, WavesBeyondTheModesWarn) {
  const MultibodyModel model = model_of(300, 80);
  EXPECT_TRUE(run_multibody(model, kQuick).warnings.empty());
  const MultibodyStep few = {10, 1e-5};
  const std::vector<std::string> warnings = run_multibody(model, few).warnings;
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_TRUE(warnings[0].starts_with(
      "the shortest wave or surface, 80 mm, passes at 1042 Hz, and the modes of --modes 10 end at "))
      << warnings[0];
  const MapAxes axes = parse_map_axes({"speed=30:300:270km/h", "wavelength=80:480:400mm"});
  EXPECT_TRUE(response_map(model, axes, kQuick, false).warnings.empty());
  const ResponseMap map = response_map(model, axes, few, false);
  ASSERT_EQ(map.warnings.size(), 1U);
  EXPECT_TRUE(map.warnings[0].starts_with("in 1 of 4 cells of the map waves pass above ")) << map.warnings[0];
}

TEST(ModelRange, ForcesBeyondThePressedHalfSpacesWarn) {
  MultibodyModel model = model_of(300, 80);
  use_half_space_contact(model);
  EXPECT_NEAR(model.sine.most(), 3 * model.vehicle.load(), 1e-6);
  EXPECT_TRUE(run_multibody(model, kQuick).warnings.empty());
  model.sine = SineContact(sine_under_wheel(model), model.scene.elastic_pair(), 1.1 * model.vehicle.load());
  const std::vector<std::string> warnings = run_multibody(model, kQuick).warnings;
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_NE(warnings[0].find("--contact half-space presses up to 96.3 kN"), std::string::npos) << warnings[0];
  const ResponseMap map =
      response_map(model, parse_map_axes({"speed=300:300:50km/h", "wavelength=80:80:10mm"}), kQuick, false);
  ASSERT_EQ(map.warnings.size(), 1U);
  EXPECT_TRUE(map.warnings[0].starts_with("in 1 of 1 cells of the map F_N exceeds 96.3 kN"))
      << map.warnings[0];
}

TEST(ResponseMap, DotsNameOtherSinesAndSurfaces) {
  using Change = void (*)(Scene&);
  for (const auto& [change, text] : std::initializer_list<std::pair<Change, const char*>>{
           {[](Scene& scene) { scene.corrugation->width = 20e-3; }, "half width 20 mm, the map's is 30 mm"},
           {[](Scene& scene) { scene.corrugation->centre = 15e-3; }, "centre 15.0 mm from the contact, "},
           {[](Scene& scene) { scene.surfaces["weld"].at = 1; },
            "the surfaces' depths differ by up to 1 mm"}}) {
    TransientRun run = run_with(1);
    change(run.scene);
    const std::string remark = map_dot(model_of(300, 80), run).remark;
    EXPECT_TRUE(remark.starts_with(text)) << remark;
  }
}

}  // namespace
}  // namespace tread
