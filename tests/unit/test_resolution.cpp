// Warnings of scenes whose mesh, samples, way or depths do not show what they ask for.

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "drivers/engine/model/model.hpp"
#include "drivers/results/resolution.hpp"
#include "drivers/results/run_warnings.hpp"
#include "io/scene/resolving_size.hpp"
#include "io/scene/scene_reader.hpp"
#include "tests/temporary_folder.hpp"
#include "tests/tyre_scene.hpp"

namespace tread {
namespace {

using Overrides = std::vector<std::string>;

bool any_has(const std::vector<std::string>& warnings, const std::string& part) {
  return std::any_of(warnings.begin(), warnings.end(),
                     [&](const std::string& warning) { return warning.find(part) != std::string::npos; });
}

std::vector<std::string> of_tyre(Overrides overrides) {
  overrides.emplace_back("scene.element_size=12 mm");
  return resolution_warnings(Model(samples::tyre_scene(overrides)));
}

TEST(ElementSize, IsNamedWhereTheKeyTakesIt) {
  EXPECT_EQ(resolving_size(3e-4, "it"), "scene.element_size = \"0.3 mm\" resolves it");
  EXPECT_EQ(resolving_size(2.675e-3, "it"), "scene.element_size = \"2.6 mm\" resolves it");
  EXPECT_EQ(resolving_size(3e-5, "it"), "no mesh resolves it: scene.element_size is at least 0.05 mm");
}

TEST(EdgeWarning, IsOfProfilesThatTouchBesideOneAnother) {
  const std::string cut = "an edge cuts the patch";
  EXPECT_FALSE(any_has(of_tyre({}), cut));
  EXPECT_TRUE(any_has(of_tyre({"wheel.lateral_offset=45 mm"}), cut));
}

TEST(StressDepthWarning, NamesTheSmallestDepthOfAnElement) {
  EXPECT_TRUE(
      any_has(of_tyre({"output.stress_depth=0.5 mm"}), "output.stress_depth = 0.5 mm adds no stress"));
  EXPECT_FALSE(any_has(of_tyre({"output.stress_depth=20 mm"}), "output.stress_depth"));
}

TEST(RailEndWarning, ComparesTheRailWithTheLengthThatBends) {
  const auto rail = [](const char* stiffness) {
    return of_tyre({"rail.support=fastenings", "rail.height=150 mm", "rail.length=2.4 m", "rail.origin=1.2 m",
                    "fastenings.count=4", "fastenings.spacing=0.6 m", "fastenings.first=0.1 m",
                    "fastenings.pad_width=40 mm", std::string("fastenings.stiffness=") + stiffness});
  };
  EXPECT_TRUE(any_has(rail("20 MN/m"), "the rail ends at x = 1.2 m"));
  EXPECT_FALSE(any_has(rail("5000 MN/m"), "the rail ends"));
}

TEST(FasteningWarning, NamesKeysThatFillTheRail) {
  const auto track = [](const char* first, const char* origin, const char* count) {
    return of_tyre({"rail.support=fastenings", "rail.height=150 mm", "rail.length=2.4 m",
                    std::string("rail.origin=") + origin, std::string("fastenings.first=") + first,
                    std::string("fastenings.count=") + count, "fastenings.spacing=0.6 m",
                    "fastenings.pad_width=40 mm"});
  };
  EXPECT_FALSE(any_has(track("0.1 m", "1.2 m", "4"), "carries the rail"));
  EXPECT_TRUE(
      any_has(track("0.1 m", "1.6 m", "1"), "carries the rail beyond it; state fastenings.count = 4"));
  EXPECT_TRUE(any_has(track("1.3 m", "0.2 m", "2"),
                      "ahead of it; state fastenings.first = \"0.1 m\" and fastenings.count = 4"));
}

TEST(FreeFootWarning, IsOfTraction) {
  const auto with = [](const char* along, const char* traction) {
    return of_tyre({"rail.support=fastenings", "rail.height=150 mm", "rail.length=2.4 m",
                    "fastenings.count=4", "fastenings.spacing=0.6 m", "fastenings.first=0.1 m",
                    "fastenings.pad_width=40 mm", std::string("fastenings.along=") + along,
                    std::string("motion.traction.") + traction});
  };
  const std::string warning = "its ends alone hold the rail of 2.4 m along x";
  EXPECT_TRUE(any_has(with("free", "mu=-0.1"), warning));
  EXPECT_FALSE(any_has(with("free", "mu=0"), warning));
  EXPECT_FALSE(any_has(with("held", "mu=-0.1"), warning));
}

TEST(WayWarning, IsOfAWheelThatIsDrivenFromRest) {
  const auto at_rest = [](Overrides more) {
    for (const char* key : {"motion.speed=0 m/s", "motion.duration=10 ms"}) more.emplace_back(key);
    return of_tyre(more);
  };
  const auto under = [&](const char* torque) {
    return at_rest({std::string("motion.traction.torque=") + torque, "motion.traction.ramp=0 ms"});
  };
  const std::string zone = "reach the solution zone, x = 0.05 to 0.1 m";
  EXPECT_FALSE(any_has(at_rest({}), zone));
  EXPECT_TRUE(any_has(under("6 kN m"), "may not " + zone));
  EXPECT_TRUE(any_has(under("6 kN m"), "passes it"));
  EXPECT_TRUE(any_has(under("-6 kN m"), "motion.traction may stop it or turn it back before"));
}

TEST(FrictionTableWarning, IsOfRowsBeyondTheWay) {
  const samples::TemporaryFolder folder;
  const std::filesystem::path path = folder.path / "f.txt";
  std::ofstream(path) << "# x [m]  f [-]\n0 0.4\n1 0.3\n";
  const auto from = [&](const char* start) {
    return of_tyre({"contact.friction_law=table", "contact.friction_file=" + path.string(),
                    std::string("contact.friction_start=") + start});
  };
  EXPECT_FALSE(any_has(from("0 m"), "f is constant"));
  EXPECT_TRUE(any_has(from("100 m"), "covers x = 100 to 101 m"));
  EXPECT_TRUE(any_has(from("100 m"), "f is constant there, 0.4; change contact.friction_start"));
  EXPECT_TRUE(any_has(from("-100 m"), "f is constant there, 0.3"));
}

/// With w = pi v / a: g (w tau)^2 / (1 + (w tau)^2) is 78 % of a beta of 1e-4 s up to 10 kHz.
TEST(BranchWarning, IsOfAContactThatADampingStiffens) {
  const auto damped = [](const char* beta, const char* up_to) {
    return of_tyre(
        {fmt::format("material.steel.damping={{ kind = \"rayleigh_beta\", value = \"{}\" }}", beta),
         fmt::format("material.steel.damping_up_to={}", up_to)});
  };
  const std::string stiff =
      "material.steel.damping makes the contact too stiff: its branch raises the modulus";
  EXPECT_TRUE(any_has(damped("1e-4 s", "10 kHz"), stiff + " by 78 % at 6.2"));
  EXPECT_FALSE(any_has(damped("1e-4 s", "100 kHz"), stiff));
  EXPECT_FALSE(any_has(damped("1e-5 s", "10 kHz"), stiff));
}

/// Hertz: about 1195 MPa.
TEST(PlasticWarning, IsOfPressuresThatYieldAndOfWrongUnits) {
  const auto yielding = [](const char* stress) {
    return of_tyre({"material.steel.law=j2", std::string("material.steel.yield_stress=") + stress});
  };
  EXPECT_FALSE(any_has(yielding("800 MPa"), "material.steel.yield_stress"));
  EXPECT_TRUE(any_has(yielding("300 MPa"),
                      " times material.steel.yield_stress = 300 MPa: above 1.6 the material yields"));
  EXPECT_TRUE(any_has(yielding("0.3 MPa"), "above 6 no wheel or rail bears it; look at the unit"));
}

/// (10e) at 1193 MPa, 1.67 m/s and a fall by 0.3: four elements of 12 mm are the longest wave that decays
/// with 22 um.
TEST(MemoryWarning, IsOfWavesOfSlipThatTheMeshDecides) {
  const auto with = [](const char* memory, const char* fast) {
    return of_tyre({"contact.friction_law=falling", std::string("contact.friction_memory=") + memory,
                    std::string("contact.friction_fast=") + fast});
  };
  const std::string grow = "lets waves of slip grow down to ";
  EXPECT_TRUE(any_has(with("10 um", "0.2"),
                      "contact.friction_memory = 10 um " + grow + "22 mm, 1.9 elements: below 4"));
  EXPECT_TRUE(any_has(with("10 um", "0.2"), "state at least \"23 um\""));
  EXPECT_FALSE(any_has(with("23 um", "0.2"), grow));
  EXPECT_FALSE(any_has(with("0.001 um", "0.48"), grow)) << "radiation damps a small fall";
}

/// On mortar of 10 MPa a slab of 0.4 m, 0.2 m thick, lacks 8 % of a fastening's compliance.
TEST(SlabWarning, IsOfLayersOnWhichItWouldBend) {
  const auto track = [](const char* mortar) {
    return of_tyre({"rail.support=fastenings", "rail.height=150 mm", "rail.length=1.2 m", "rail.origin=0.6 m",
                    "fastenings.count=2", "fastenings.spacing=0.6 m", "fastenings.first=0.3 m",
                    "fastenings.pad_width=40 mm", "slab.pitch=0.6 m", "slab.gap=50 mm", "slab.width=0.4 m",
                    "slab.gap_material=slab", "material.slab.youngs_modulus=34.5 GPa",
                    "material.slab.poissons_ratio=0.25", "material.slab.density=2400 kg/m3",
                    std::string("material.mortar.youngs_modulus=") + mortar,
                    "material.mortar.poissons_ratio=0.2", "material.mortar.density=1600 kg/m3"});
  };
  EXPECT_FALSE(any_has(track("8 GPa"), "[slab]"));
  const std::vector<std::string> soft = track("10 MPa");
  EXPECT_TRUE(any_has(soft, "material.mortar.youngs_modulus = 10 MPa: its nodes move vertically"));
  EXPECT_TRUE(any_has(soft, "gives way by 1.2e-09 m/N under a fastening, a slab that bends by 4.9e-09 m/N"));
}

TEST(HammerWarning, IsOfBlowsThatAreNotResolved) {
  const auto blow = [](const Overrides& more) {
    Overrides all = {"rail.length=1.3 m", "rail.origin=0.65 m", "fastenings.count=2",
                     "scene.element_size=11 mm"};
    all.insert(all.end(), more.begin(), more.end());
    return resolution_warnings(
        Model(read_scene(std::filesystem::path(TREAD_SOURCE_DIR) / "scenes/hammer.toml", all)));
  };
  EXPECT_EQ(blow({}), Overrides{});
  EXPECT_TRUE(any_has(blow({"hammer.duration=0.1 ms"}), "5 samples: below 8"));
  EXPECT_TRUE(any_has(blow({"hammer.duration=1 us"}), "neither steps nor elements resolve it"));
  EXPECT_TRUE(any_has(blow({"motion.duration=0.1 ms"}), "is cut off at the run's end"));
  EXPECT_TRUE(any_has(blow({"motion.duration=0.1 ms"}), "fewer than 10 samples"));
  const auto beside_a_wheel = [](const char* speed) {
    return any_has(of_tyre({"hammer.force=1 kN", "hammer.duration=0.2 ms", speed}),
                   "holds the wheel's passage beside the blow");
  };
  EXPECT_TRUE(beside_a_wheel("motion.speed=300 km/h"));
  EXPECT_FALSE(beside_a_wheel("motion.speed=0 km/h"));
}

/// A map of 50 mm by 10 mm that is 10 um deep all over.
class MapWarnings : public testing::Test {
 protected:
  void SetUp() override {
    std::ofstream file(path_);
    file << "# x [mm]  y [mm]  d [um]\n";
    for (const char* y : {" -5", " 0", " 5"})
      for (const char* x : {"0", "25", "50"}) file << x << y << " 10\n";
  }
  std::vector<std::string> corrugation(const std::string& centre) const {
    return of_tyre({"corrugation.kind=map", "corrugation.file=" + path_.string(), "corrugation.start=50 mm",
                    "corrugation.centre=" + centre});
  }

  samples::TemporaryFolder folder_;
  std::filesystem::path path_ = folder_.path / "map.txt";
};

TEST_F(MapWarnings, AreOfWhereTheCentrePutsTheRows) {
  EXPECT_TRUE(any_has(corrugation("0 mm"), "y = -5 and 5 mm, are up to 10 and 10 um deep"));
  EXPECT_FALSE(any_has(corrugation("0 mm"), "beside what the wheel can touch"));
  EXPECT_FALSE(any_has(corrugation("60 mm"), "the outer rows of"));
  EXPECT_TRUE(any_has(corrugation("60 mm"), "corrugation lies at y = 55 to 65 mm, beside what the wheel"));
  EXPECT_TRUE(any_has(of_tyre({"surface.a.kind=map", "surface.a.file=" + path_.string(), "surface.a.at=50 mm",
                               "surface.a.centre=60 mm"}),
                      "its outer row alone has an effect; change surface.a.centre"));
}

TEST(CorrugationWarnings, AreOfPlaceWidthAndSlope) {
  const auto waves = [](Overrides more) {
    for (const char* key : {"corrugation.start=50 mm", "corrugation.length=50 mm"}) more.emplace_back(key);
    return of_tyre(more);
  };
  const std::string beside = "beside what the wheel can touch", narrow = "the width of the corrugation has";
  const Overrides sine = {"corrugation.wavelength=50 mm", "corrugation.depth=0.01 mm"};
  const auto with = [&](Overrides more) {
    more.insert(more.end(), sine.begin(), sine.end());
    return waves(more);
  };
  EXPECT_FALSE(any_has(with({"corrugation.width=70 mm"}), beside));
  EXPECT_FALSE(any_has(with({"corrugation.width=70 mm"}), narrow));
  EXPECT_TRUE(any_has(with({"corrugation.width=10 mm", "corrugation.centre=60 mm"}), beside));
  EXPECT_TRUE(any_has(with({"corrugation.width=10 mm"}), narrow));
  EXPECT_TRUE(any_has(waves({"corrugation.kind=random", "corrugation.rms=2 mm", "corrugation.longest=50 mm"}),
                      "look at the units of corrugation.rms"));
}

TEST(SurfaceWarnings, AreOfSlopesButNotOfFlats) {
  const auto surface = [](const Overrides& keys) {
    Overrides all = {"surface.a.at=75 mm"};
    for (const std::string& key : keys) all.push_back("surface.a." + key);
    return of_tyre(all);
  };
  const std::string units = "look at the units of surface.a.depth";
  EXPECT_TRUE(any_has(surface({"kind=dip", "length=20 mm", "depth=5 mm"}), units));
  EXPECT_FALSE(any_has(surface({"kind=dip", "length=20 mm", "depth=0.5 mm"}), units));
  EXPECT_FALSE(any_has(surface({"kind=flat", "length=180 mm"}), "look at the units"));
}

TEST(RunInWarning, IsOfAForceThatStillChanges) {
  RunResults results;
  const auto warns = [&](double change) {
    results.preload.run_in_change = change;
    return any_has(run_warnings(Model(samples::tyre_scene({"scene.element_size=12 mm"})), results),
                   "F_N still changed by ");
  };
  EXPECT_FALSE(warns(5e-3));
  EXPECT_TRUE(warns(0.05));
}

}  // namespace
}  // namespace tread
