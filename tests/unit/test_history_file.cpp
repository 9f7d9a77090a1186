#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "core/error.hpp"
#include "io/files/history_file.hpp"
#include "tests/temporary_folder.hpp"

namespace tread {
namespace {

namespace fs = std::filesystem;

class HistoryFileTest : public testing::Test {
 protected:
  std::string csv() const {
    std::stringstream text;
    text << std::ifstream(folder_ / "histories.csv").rdbuf();
    return text.str();
  }

  samples::TemporaryFolder temporary_;
  const fs::path& folder_ = temporary_.path;
  std::vector<Channel> channels_ = {{"time", "s", "Time since the start of rolling"},
                                    {"vertical_force", "N", "F_N"}};
};

TEST_F(HistoryFileTest, WritesTheSameRowsToBothFiles) {
  constexpr int kRows = 2500;  // more than two chunks, not a whole number of blocks
  {
    HistoryFile histories(folder_, channels_);
    for (int i = 0; i < kRows; ++i) histories.append(std::array{1e-5 * i, 1000.0 / (i + 1)});
    histories.close();
    EXPECT_EQ(histories.rows_written(), kRows);
  }
  const Hdf5File run = Hdf5File::open_to_read(folder_ / "run.h5");
  const std::vector<double> time = run.read<double>("/histories/time");
  const std::vector<double> force = run.read<double>("/histories/vertical_force");
  ASSERT_EQ(time.size(), std::size_t{kRows});
  ASSERT_EQ(force.size(), std::size_t{kRows});
  EXPECT_EQ(run.read_text_attribute("/histories/vertical_force", "unit"), "N");
  EXPECT_EQ(run.read_text_attribute("/histories/time", "description"), "Time since the start of rolling");

  std::ifstream file(folder_ / "histories.csv");
  std::string line;
  std::getline(file, line);
  EXPECT_EQ(line, "time [s],vertical_force [N]");
  for (std::size_t i = 0; i < time.size(); ++i) {
    EXPECT_EQ(time[i], 1e-5 * static_cast<double>(i));
    double t = 0;
    double f = 0;
    char comma = 0;
    ASSERT_TRUE(file >> t >> comma >> f) << "row " << i;
    EXPECT_NEAR(t, time[i], 5.1e-9 * time[i]);  // nine digits
    EXPECT_NEAR(f, force[i], 5.1e-9 * force[i]);
  }
  EXPECT_FALSE(file >> line);
}

TEST_F(HistoryFileTest, FlushedRowsCanBeReadWhileTheRunGoesOn) {
  HistoryFile histories(folder_, channels_);
  EXPECT_EQ(csv(), "time [s],vertical_force [N]\n");
  histories.append(std::array{0.0, 87560.0});
  histories.flush();
  EXPECT_EQ(csv(), "time [s],vertical_force [N]\n0,87560\n");
  // A copy holds the files of a killed run, without this process's memory.
  fs::copy_file(folder_ / "run.h5", folder_ / "copy.h5");
  EXPECT_EQ(Hdf5File::open_to_read(folder_ / "copy.h5").read<double>("/histories/vertical_force"),
            std::vector<double>{87560.0});
}

TEST_F(HistoryFileTest, DestructorKeepsWhatWaits) {
  { HistoryFile(folder_, channels_).append(std::array{0.5, -1.0}); }
  EXPECT_EQ(csv(), "time [s],vertical_force [N]\n0.5,-1\n");
}

TEST_F(HistoryFileTest, RefusesWrongRowsAndChannels) {
  HistoryFile histories(folder_, channels_);
  EXPECT_THROW(histories.append(std::array{1.0}), std::logic_error);
  EXPECT_THROW(HistoryFile(folder_, {}), std::logic_error);
  EXPECT_THROW(HistoryFile(folder_, {{"a", "s", ""}, {"a", "N", ""}}), std::logic_error);
  EXPECT_THROW(HistoryFile(folder_, {{"a/b", "s", ""}}), std::logic_error);
  histories.close();
  EXPECT_THROW(histories.append(std::array{1.0, 2.0}), std::logic_error);
}

TEST_F(HistoryFileTest, Hdf5TablesGrowByWholeRows) {
  const fs::path path = folder_ / "table.h5";
  Hdf5File file = Hdf5File::create(path);
  file.make_extendible<float>("/group/pairs", 16, {2});
  file.append<float>("/group/pairs", std::array{1.0F, 2.0F, 3.0F, 4.0F});
  file.append<float>("/group/pairs", std::array{5.0F, 6.0F});
  EXPECT_THROW(file.append<float>("/group/pairs", std::array{1.0F}), std::logic_error);
  file.close();

  file = Hdf5File::open_to_extend(path);
  file.append<float>("/group/pairs", std::array{7.0F, 8.0F});
  EXPECT_EQ(file.shape("/group/pairs"), (std::vector<std::uint64_t>{4, 2}));
  EXPECT_EQ(file.read<float>("/group/pairs"), (std::vector<float>{1, 2, 3, 4, 5, 6, 7, 8}));
  EXPECT_TRUE(file.contains("/group/pairs"));
  EXPECT_FALSE(file.contains("/nowhere/pairs"));
}

TEST_F(HistoryFileTest, AttributesOfTheRootCanBeReplaced) {
  HistoryFile(folder_, channels_, {{"title", "a"}, {"speed_m_per_s", 2.5}}).close();
  const Hdf5Attributes first = {{"title", "a"}, {"speed_m_per_s", 2.5}};
  EXPECT_EQ(Hdf5File::open_to_read(folder_ / "run.h5").attributes("/"), first);
  Hdf5File file = Hdf5File::open_to_extend(folder_ / "run.h5");
  file.set_attributes("/", {{"title", "longer"}, {"quality", ""}});
  file.write_attribute<double>("/", "pair", std::array{1.0, 2.0});
  file.close();
  const Hdf5Attributes then = {{"title", "longer"}, {"quality", ""}, {"speed_m_per_s", 2.5}};
  EXPECT_EQ(Hdf5File::open_to_read(folder_ / "run.h5").attributes("/"), then);
}

TEST_F(HistoryFileTest, TypesAreNamed) {
  Hdf5File file = Hdf5File::create(folder_ / "types.h5");
  file.write<float>("/f", std::array{1.0F});
  file.write<std::int32_t>("/i", std::array{std::int32_t{1}});
  file.write<std::uint8_t>("/u", std::array{std::uint8_t{1}});
  EXPECT_EQ(file.type("/f"), "float");
  EXPECT_EQ(file.type("/i"), "int32");
  EXPECT_EQ(file.type("/u"), "uint8");
  EXPECT_THROW(file.type("/absent"), InputError);
}

TEST_F(HistoryFileTest, ExternalLinksLeadToTheOtherFile) {
  Hdf5File::create(folder_ / "mesh.h5").write<std::int64_t>("/points", std::array<std::int64_t, 2>{3, 4});
  Hdf5File frame = Hdf5File::create(folder_ / "frame.h5");
  frame.link_external("/grid/points", "mesh.h5", "/points");
  EXPECT_EQ(frame.read<std::int64_t>("/grid/points"), (std::vector<std::int64_t>{3, 4}));
}

}  // namespace
}  // namespace tread
