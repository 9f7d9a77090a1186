// Checkpoint files: whole or refused with the reason, whatever happens to them.

#include <fmt/core.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmath>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>

#include "core/error.hpp"
#include "io/files/checkpoint_folder.hpp"
#include "io/files/hdf5_file.hpp"
#include "io/files/sealed_file.hpp"
#include "tests/fuzz/targets.hpp"
#include "tests/program.hpp"
#include "tests/refusal.hpp"
#include "tests/temporary_folder.hpp"

namespace tread {
namespace {

namespace fs = std::filesystem;

using samples::content_of;

void overwrite(const fs::path& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary | std::ios::trunc) << bytes;
}

/// Why the file is refused; empty: it is not.
std::string refusal(const fs::path& path) {
  return samples::refusal<InputError>([&] { read_sealed(path, "checkpoint", 1); });
}

SealedContent sample(double value) {
  return {{"state/u", std::vector{value, -0.0, -std::numeric_limits<double>::infinity()}},
          {"state/steps", std::vector<std::int64_t>{-3, std::numeric_limits<std::int64_t>::max()}},
          {"state/rail head", std::vector{value}},
          {"order/text", std::string("a\0b\nµ", 6)},
          {"order/nothing", std::string()},
          {"samples", std::vector<double>{}}};
}

class SealedFiles : public testing::Test {
 protected:
  samples::TemporaryFolder temporary_;
  const fs::path& folder_ = temporary_.path;
  fs::path path_ = folder_ / "a.h5";
};

TEST_F(SealedFiles, EveryBitComesBack) {
  write_sealed(path_, "checkpoint", 1, sample(0.1));
  const SealedContent back = read_sealed(path_, "checkpoint", 1);
  EXPECT_EQ(back, sample(0.1));
  EXPECT_TRUE(std::signbit(sealed_entry<std::vector<double>>(back, "state/u")[1]));
  EXPECT_THROW(sealed_entry<std::string>(back, "state/u"), InputError);
  EXPECT_THROW(sealed_entry<std::string>(back, "absent"), InputError);
  // What HDF5 tools see.
  EXPECT_EQ(Hdf5File::open_to_read(path_).read<double>("/state/u")[0], 0.1);
}

TEST_F(SealedFiles, EveryFlippedBitIsSeen) {
  write_sealed(path_, "checkpoint", 1, sample(0.1));
  const std::string bytes = content_of(path_);
  for (std::size_t at = 0; at < bytes.size(); at += 41) {
    std::string damaged = bytes;
    damaged[at] = static_cast<char>(damaged[at] ^ (1 << at % 8));
    overwrite(path_, damaged);
    EXPECT_NE(refusal(path_), "") << "byte " << at;
  }
}

TEST_F(SealedFiles, EveryLostEndIsSeen) {
  write_sealed(path_, "checkpoint", 1, sample(0.1));
  const std::string bytes = content_of(path_);
  for (std::size_t size = 0; size < bytes.size(); size += 37) {
    overwrite(path_, bytes.substr(0, size));
    const std::string reason = refusal(path_);
    EXPECT_NE(reason.find(size < 512 ? "cut short" : fmt::format("{} of {} bytes", size, bytes.size())),
              std::string::npos)
        << reason;
  }
  overwrite(path_, bytes + "more");
  EXPECT_NE(refusal(path_).find("bytes"), std::string::npos);
}

TEST_F(SealedFiles, OtherFilesAreRefusedWithTheReason) {
  const auto expect = [&](const std::string& part) {
    const std::string reason = refusal(path_);
    EXPECT_NE(reason.find(part), std::string::npos) << reason;
    EXPECT_NE(reason.find("a.h5"), std::string::npos) << reason;
    fs::remove_all(path_);
  };
  expect("No such file");
  overwrite(path_, std::string(2000, 'x'));
  expect("not a checkpoint file of tread");
  Hdf5File::create(path_).write<double>("/x", std::vector<double>(100, 1.0));
  expect("not a checkpoint file of tread");
  write_sealed(path_, "mesh", 1, sample(1));
  expect("not a checkpoint file of tread");
  write_sealed(path_, "checkpoint", 0, sample(1));
  expect("it is a checkpoint file of version 0, this program reads version 1");
  write_sealed(folder_ / "b.h5", "checkpoint", 1, sample(1));
  fs::create_symlink(folder_ / "b.h5", path_);
  expect("symbolic link");
  fs::create_directory(path_);
  expect("not a regular file");
  ASSERT_EQ(::mkfifo(path_.c_str(), 0600), 0);
  expect("not a regular file");
}

TEST_F(SealedFiles, EnormousSizesAreRefused) {
  // 8 TB, all but a few of them holes.
  write_sealed(path_, "checkpoint", 1, {{"a", std::vector{1.0}}});
  fs::resize_file(path_, std::uintmax_t{1} << 43);
  EXPECT_NE(refusal(path_).find(" bytes"), std::string::npos);
}

/// A sealed file whose list of entries is `index`, with a checksum that is right.
std::string sealed_with(const std::string& index) {
  const std::string head = fmt::format("tread checkpoint\nversion 1\nbytes 0\nindex {}\n", 512 + 16);
  return fuzz::resealed(head + std::string(512 - head.size(), '\0') + std::string(16, 'x') + index);
}

TEST_F(SealedFiles, WhatAForgedListStatesIsNotBelieved) {
  const auto expect_refused = [&](const std::string& index, const std::string& part) {
    overwrite(path_, sealed_with(index));
    const std::string reason = refusal(path_);
    EXPECT_NE(reason.find(part), std::string::npos) << index << ": " << reason;
  };
  overwrite(path_, sealed_with("byte 4 512 a\n"));
  EXPECT_EQ(read_sealed(path_, "checkpoint", 1), (SealedContent{{"a", std::string("xxxx")}}));
  for (const char* line : {"f64 2305843009213693952 512 a\n", "f64 2305843009213693951 512 a\n",
                           "byte 18446744073709551615 512 a\n", "i64 1 18446744073709551608 a\n",
                           "f64 1 560 a\n", "byte 500 512 a\nbyte 500 512 b\n"})
    expect_refused(line, "does not fit into its");
  for (const char* line : {"f16 1 512 a\n", "f64 -1 512 a\n", "f64 1 512\n", "f64 01 512 a\n", "\n",
                           "byte 1 512 a\nbyte 1 512 a\n", "byte 1 512  a\n"})
    expect_refused(line, "of its list of entries is broken");
}

class Checkpoints : public SealedFiles {
 protected:
  CheckpointFolder checkpoints_{folder_};
  std::vector<std::string> refused_;
};

TEST_F(Checkpoints, TheLastTwoAreKept) {
  for (const int steps : {5, 20, 100, 3000}) checkpoints_.write(steps, sample(steps));
  ASSERT_EQ(checkpoints_.states().size(), 2U);
  const auto found = checkpoints_.newest(refused_);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->steps, 3000);
  EXPECT_EQ(found->content, sample(3000));
  EXPECT_TRUE(refused_.empty());
  overwrite(folder_ / "step-x.h5", "not counted");
  EXPECT_EQ(checkpoints_.states().size(), 2U);
  checkpoints_.clear();
  EXPECT_TRUE(checkpoints_.states().empty());
}

TEST_F(Checkpoints, ThePreviousOneStandsInForADamagedOne) {
  checkpoints_.write(10, sample(10));
  checkpoints_.write(20, sample(20));
  const fs::path newest = checkpoints_.states().front();
  fs::resize_file(newest, fs::file_size(newest) - 1);
  const auto found = checkpoints_.newest(refused_);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->steps, 10);
  ASSERT_EQ(refused_.size(), 1U);
  EXPECT_NE(refused_[0].find(newest.string()), std::string::npos) << refused_[0];
  // The run goes on from step 10 and leaves the next one at 15: the damaged one does not stay.
  checkpoints_.write(15, sample(15));
  ASSERT_EQ(checkpoints_.states().size(), 2U);
  EXPECT_EQ(checkpoints_.newest(refused_)->steps, 15);
}

/// Its states are whole: nobody is to start the run anew for its permissions.
TEST_F(Checkpoints, AFolderThatMayNotBeReadIsNoDamage) {
  checkpoints_.write(10, sample(10));
  fs::permissions(folder_, fs::perms::none);
  const uid_t user = ::geteuid();
  if (user == 0) {
    ASSERT_EQ(::seteuid(65534), 0);  // root may read everywhere, nobody may not
  }
  const std::string message = samples::refusal<InputError>([&] { checkpoints_.newest(refused_); });
  ASSERT_EQ(::seteuid(user), 0);
  fs::permissions(folder_, fs::perms::owner_all);
  EXPECT_EQ(message,
            fmt::format("cannot read {}: Permission denied; change its permissions", folder_.string()));
}

TEST_F(Checkpoints, AKillAtAnyStageLeavesASoundOne) {
  for (int stage = 0; stage <= static_cast<int>(CheckpointStage::old_removed); ++stage) {
    checkpoints_.clear();
    fs::create_directories(folder_);
    checkpoints_.write(1, sample(1));
    const pid_t process = samples::child([&] {
      checkpoints_.write(2, sample(2), [&](CheckpointStage reached) {
        if (static_cast<int>(reached) == stage) ::kill(::getpid(), SIGKILL);
      });
    });
    ASSERT_EQ(samples::wait_for(process), 1000 + SIGKILL) << "stage " << stage;
    const auto found = checkpoints_.newest(refused_);
    ASSERT_TRUE(found);
    EXPECT_EQ(found->content, sample(static_cast<double>(found->steps)));
    EXPECT_EQ(found->steps, stage < static_cast<int>(CheckpointStage::in_place) ? 1 : 2) << "stage " << stage;
    checkpoints_.write(3, sample(3));
    for (const fs::directory_entry& entry : fs::directory_iterator(folder_))
      EXPECT_NE(entry.path().extension(), ".part") << entry.path();
  }
  EXPECT_TRUE(refused_.empty());
}

}  // namespace
}  // namespace tread
