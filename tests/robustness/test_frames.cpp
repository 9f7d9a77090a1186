// Frames for ParaView: when they are due, what they show, what lies in the folder and on the disk. Their
// reader: tests/paraview. Kills: test_resume.cpp.

#include <fmt/core.h>
#include <gtest/gtest.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "drivers/engine/start/step_limit.hpp"
#include "drivers/results/disk_use.hpp"
#include "drivers/results/frame_files.hpp"
#include "drivers/results/growing_files.hpp"
#include "io/files/hdf5_file.hpp"
#include "io/text/text_file.hpp"
#include "tests/temporary_folder.hpp"
#include "tests/tyre_scene.hpp"

namespace {

/// Names of the files that have been forced to the disk.
std::set<std::string> forced;

}  // namespace

/// Takes the place of the C library's, and notes the file.
extern "C" int fsync(int descriptor) {
  std::error_code error;
  forced.insert(
      std::filesystem::read_symlink(fmt::format("/proc/self/fd/{}", descriptor), error).filename().string());
  return static_cast<int>(::syscall(SYS_fsync, descriptor));
}

namespace tread {
namespace {

namespace fs = std::filesystem;
using Steps = std::vector<std::int64_t>;

TEST(FrameSteps, AreEvenFromTheFirstStepToTheLast) {
  EXPECT_EQ(frame_steps(0, 100), Steps{});
  EXPECT_EQ(frame_steps(1, 100), Steps{100});
  EXPECT_EQ(frame_steps(2, 100), (Steps{1, 100}));
  EXPECT_EQ(frame_steps(4, 100), (Steps{1, 34, 67, 100}));
  EXPECT_EQ(frame_steps(40, 3), (Steps{1, 2, 3}));
  EXPECT_EQ(frame_steps(40, 1), Steps{1});
  EXPECT_EQ(frame_steps(40, 0), Steps{});
  const Steps many = frame_steps(1000000, std::int64_t{1} << 40);
  EXPECT_EQ(many.size(), 1000000U);
  EXPECT_EQ(many.back(), std::int64_t{1} << 40);
}

/// The checkpoints of a run go as soon as its files are there.
TEST(GrowingFilesTest, AreOnTheDiskOnceClosed) {
  const Model model{samples::tyre_scene({"scene.element_size=10 mm"})};
  const samples::TemporaryFolder folder;
  GrowingFiles files(model, folder.path, {});
  forced.clear();
  files.close();
  EXPECT_EQ(forced, (std::set<std::string>{"histories.csv", "patch.h5", "run.h5"}));
}

class Frames : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    simulation_.emplace(model_, solve_preload(model_, steady_motion(model_), [](const std::string&) {}), dt_);
    while (simulation_->steps() < kSteps) simulation_->step();
  }

  FrameFiles files(std::int64_t reached = 2 * kSteps) { return {model_, folder_, 2 * kSteps, dt_, reached}; }
  fs::path frame(std::int64_t steps) const { return folder_ / fmt::format("frames/step-{:012}.hdf", steps); }
  std::string series() const { return read_text_file(folder_ / "frames.hdf.series", 1 << 20); }
  void leave_frame(FrameFiles& files) {
    files.copy(*simulation_);
    files.write();
  }

  /// Shear stress and slip lie in the surface where the wheel presses, and friction is no larger than f p.
  void expect_contact_vectors(const Hdf5File& file, const std::vector<float>& pressure) {
    const std::vector<float> shear = file.read<float>("/VTKHDF/PointData/contact shear stress [Pa]");
    const std::vector<float> slip = file.read<float>("/VTKHDF/PointData/slip velocity [m s-1]");
    ASSERT_EQ(shear.size(), 3 * pressure.size());
    ASSERT_EQ(slip.size(), 3 * pressure.size());
    const double f = model_.scene.contact->largest_friction();
    double largest = 0, fastest = 0;
    for (std::size_t i = 0; i < pressure.size(); ++i) {
      const double size = std::hypot(shear[3 * i], shear[3 * i + 1], shear[3 * i + 2]);
      EXPECT_LE(size, 1.0001 * f * pressure[i]);
      EXPECT_LE(std::abs(shear[3 * i + 2]), 0.5 * size);  // the running band is nearly level
      largest = std::max(largest, size);
      const double speed = std::hypot(slip[3 * i], slip[3 * i + 1], slip[3 * i + 2]);
      EXPECT_TRUE(pressure[i] > 0 || speed == 0);
      fastest = std::max(fastest, speed);
    }
    EXPECT_NEAR(largest, model_.contact->nodes().max_shear(), 1e-5 * largest);
    EXPECT_GT(largest, 0);
    EXPECT_GT(fastest, 0);
    EXPECT_LT(fastest, 0.1 * model_.scene.motion->speed);
  }

  static constexpr std::int64_t kSteps = 40;
  samples::TemporaryFolder temporary_;
  const fs::path& folder_ = temporary_.path;
  Model model_{samples::tyre_scene(
      {"scene.element_size=10 mm", "output.frames=5", fmt::format("output.frame_cells={}", GetParam())})};
  double dt_ = 0.9 * step_limit(model_).stable_step;
  std::optional<Simulation> simulation_;
};

TEST_P(Frames, ShowTheMotion) {
  FrameFiles out = files();
  leave_frame(out);
  const Hdf5File file = Hdf5File::open_to_read(frame(kSteps));
  const VtkGrid grid = make_vtk_grid(model_.mesh, frame_cells(model_.scene));
  const std::vector<float> points = file.read<float>("/VTKHDF/Points");
  const std::vector<float> u = file.read<float>("/VTKHDF/PointData/displacement [m]");
  const std::vector<float> v = file.read<float>("/VTKHDF/PointData/velocity [m s-1]");
  const std::vector<float> p = file.read<float>("/VTKHDF/PointData/contact pressure [Pa]");
  const std::vector<float> stress = file.read<float>("/VTKHDF/CellData/von Mises stress [Pa]");
  ASSERT_EQ(points.size(), 3 * grid.points.size());
  ASSERT_EQ(u.size(), points.size());
  ASSERT_EQ(v.size(), points.size());
  ASSERT_EQ(stress.size(), grid.cells.size());
  EXPECT_EQ(file.read<double>("/VTKHDF/FieldData/time [s]"), std::vector{simulation_->time()});
  EXPECT_EQ(file.read<std::int64_t>("/VTKHDF/Connectivity"), grid.connectivity);

  EXPECT_FLOAT_EQ(*std::max_element(p.begin(), p.end()),
                  static_cast<float>(model_.contact->nodes().max_pressure()));
  expect_contact_vectors(file, p);
  const double speed = model_.scene.motion->speed;
  const BodyFrame& wheel = simulation_->wheel();
  double largest_error = 0;
  for (std::size_t i = 0; i < grid.points.size(); ++i) {
    const Vec3 at{points[3 * i], points[3 * i + 1], points[3 * i + 2]};
    const Vec3 velocity{v[3 * i], v[3 * i + 1], v[3 * i + 2]};
    if (grid.points[i].block != model_.index.tread) continue;
    const Vec3 arm = at - wheel.origin;
    EXPECT_LT(std::hypot(arm.x, arm.z), model_.wheel_radius() + 1e-5);
    largest_error =
        std::max(largest_error, norm(velocity - Vec3{speed + wheel.spin * arm.z, 0, -wheel.spin * arm.x}));
    if (p[i] > 0) ADD_FAILURE() << "the wheel's nodes carry no pressure of their own";
  }
  EXPECT_LT(largest_error, 0.05 * speed);  // what is left is elastic
  EXPECT_GT(*std::max_element(stress.begin(), stress.end()), 1e8F);
}

TEST_P(Frames, LieWholeInTheFolder) {
  FrameFiles out = files();
  EXPECT_TRUE(out.due(1) && out.due(2 * kSteps));
  EXPECT_FALSE(out.due(2) || out.due(kSteps + 5));
  forced.clear();
  leave_frame(out);
  EXPECT_TRUE(forced.contains("frames.hdf.series.part"));
  const samples::TemporaryFolder other;
  forced.clear();
  FrameFiles::take_over(folder_, other.path, kSteps);
  EXPECT_TRUE(forced.contains(frame(kSteps).filename().string() + ".part"));
  simulation_->step();
  leave_frame(out);
  leave_frame(out);  // once more on request: the same one
  EXPECT_EQ(out.count(), 2U);
  for (std::int64_t steps : {kSteps, kSteps + 1}) {
    EXPECT_TRUE(fs::exists(frame(steps)));
    EXPECT_NE(series().find(fmt::format("\"frames/step-{:012}.hdf\"", steps)), std::string::npos) << series();
  }
  // What a killed process left of a frame is not taken for one; the series comes back.
  std::ofstream(frame(7).string() + ".part") << "half";
  fs::remove(folder_ / "frames.hdf.series");
  FrameFiles again = files();
  EXPECT_EQ(again.count(), 2U);
  EXPECT_FALSE(fs::exists(frame(7).string() + ".part"));
  EXPECT_EQ(series().find("000007"), std::string::npos);
  EXPECT_NE(series().find("000041"), std::string::npos);
  EXPECT_FALSE(FrameFiles(model_, folder_, kSteps, dt_, kSteps).due(kSteps));  // it is there
  // Frames are counted while a damaged one is written again: the thread sanitizer looks on.
  std::ofstream(frame(kSteps + 1)) << "x";
  FrameFiles mended = files();
  EXPECT_EQ(mended.count(), 1U);
  mended.copy(*simulation_);
  std::thread writer([&] { mended.write(); });
  EXPECT_LE(mended.count(), 2U);
  writer.join();
  EXPECT_EQ(mended.count(), 2U);
  FrameFiles::remove(folder_);
  EXPECT_TRUE(fs::is_empty(folder_));
}

/// A run goes on from an older state, and ends earlier than it was to.
TEST_P(Frames, BeyondTheStateAreWrittenAgainAndBeyondTheEndAreNone) {
  FrameFiles out = files();
  leave_frame(out);
  const Steps due = frame_steps(5, 2 * kSteps);
  ASSERT_EQ(due[2], kSteps);
  const std::int64_t on_request = kSteps + 10;
  for (const std::int64_t later : {on_request, due[3], due[4]}) fs::copy_file(frame(kSteps), frame(later));
  EXPECT_FALSE(files().due(due[3]));
  const FrameFiles again = files(kSteps);
  EXPECT_EQ(again.count(), 2U);
  EXPECT_TRUE(again.due(due[3]) && again.due(due[4]));
  EXPECT_TRUE(fs::exists(frame(kSteps)) && fs::exists(frame(on_request)));
  fs::copy_file(frame(kSteps), frame(due[4]));
  const FrameFiles shorter(model_, folder_, due[3], dt_, 1);
  EXPECT_FALSE(fs::exists(frame(due[4])));
  EXPECT_EQ(series().find(fmt::format("{:012}", due[4])), std::string::npos) << series();
  EXPECT_NE(series().find(fmt::format("{:012}", kSteps)), std::string::npos) << series();
}

TEST_P(Frames, TakeWhatWasProjected) {
  FrameFiles out = files();
  leave_frame(out);
  const VtkGrid grid = make_vtk_grid(model_.mesh, frame_cells(model_.scene));
  const std::int64_t mesh = frame_bytes(grid).mesh;
  const auto of_mesh = static_cast<double>(mesh);
  EXPECT_NEAR(static_cast<double>(fs::file_size(folder_ / fmt::format("frames/mesh-{}.hdf", GetParam()))),
              of_mesh, 0.05 * of_mesh);
  const DiskUse use = disk_use(model_, dt_);
  const double of_frame = static_cast<double>(use.frames - mesh) / 5;
  EXPECT_NEAR(static_cast<double>(fs::file_size(frame(kSteps))), of_frame, 0.2 * of_frame);
  EXPECT_EQ(use.total(), use.results + use.frames + use.checkpoints);
}

INSTANTIATE_TEST_SUITE_P(All, Frames, testing::Values("faces", "elements"),
                         [](const auto& tested) { return std::string(tested.param); });

}  // namespace
}  // namespace tread
