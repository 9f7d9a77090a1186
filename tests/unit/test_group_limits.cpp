// Limits of control groups, read from made-up folders.

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <limits>
#include <string>

#include "drivers/process/group_limits.hpp"
#include "drivers/process/machine.hpp"
#include "tests/temporary_folder.hpp"

namespace tread {
namespace {

namespace fs = std::filesystem;

class GroupLimitsOfFiles : public testing::Test {
 protected:
  void write(const std::string& name, const std::string& text) const {
    const fs::path path = temporary_.path / name;
    fs::create_directories(path.parent_path());
    std::ofstream(path) << text << '\n';
  }
  /// `own`: content of the file that names the groups.
  GroupLimits limits(const std::string& own) const {
    write("own", own);
    return group_limits(temporary_.path / "own", temporary_.path / "groups");
  }

  samples::TemporaryFolder temporary_;
};

constexpr std::int64_t kAnyMemory = std::numeric_limits<std::int64_t>::max();
constexpr int kAnyCores = std::numeric_limits<int>::max();

TEST_F(GroupLimitsOfFiles, NestedGroupsOfVersion2) {
  write("groups/memory.max", "max");
  write("groups/cpu.max", "max 100000");
  write("groups/job.scope/memory.max", "8589934592");
  write("groups/job.scope/cpu.max", "150000 100000");
  write("groups/job.scope/task/memory.max", "max");
  write("groups/job.scope/task/cpu.max", "400000 100000");
  write("groups/other/memory.max", "1000");
  const GroupLimits found = limits("0::/job.scope/task");
  EXPECT_EQ(found.memory, std::int64_t{8} << 30);
  EXPECT_EQ(found.cores, 2);
  EXPECT_EQ(limits("0::/").memory, kAnyMemory);
  EXPECT_EQ(limits("0::/").cores, kAnyCores);
}

/// A container sees its own group as the root, or has a line that names the group outside.
TEST_F(GroupLimitsOfFiles, RootOfAContainer) {
  write("groups/memory.max", "1073741824");
  write("groups/cpu.max", "50000 100000");
  for (const char* own : {"0::/", "0::/system.slice/container.scope", "0::/../outside"}) {
    EXPECT_EQ(limits(own).memory, std::int64_t{1} << 30) << own;
    EXPECT_EQ(limits(own).cores, 1) << own;
  }
}

TEST_F(GroupLimitsOfFiles, Version1HasAFolderForEachController) {
  const std::string own = "9:name=systemd:/\n4:memory:/docker/7f:a\n3:cpu,cpuacct:/docker/7f:a\n0::/";
  write("groups/memory/memory.limit_in_bytes", "9223372036854771712");
  write("groups/cpu,cpuacct/cpu.cfs_quota_us", "-1");
  write("groups/cpu,cpuacct/cpu.cfs_period_us", "100000");
  EXPECT_GT(limits(own).memory, std::int64_t{1} << 60);
  EXPECT_EQ(limits(own).cores, kAnyCores);
  write("groups/memory/docker/7f:a/memory.limit_in_bytes", "2147483648");
  write("groups/cpu,cpuacct/docker/7f:a/cpu.cfs_quota_us", "300001");
  write("groups/cpu,cpuacct/docker/7f:a/cpu.cfs_period_us", "100000");
  EXPECT_EQ(limits(own).memory, std::int64_t{2} << 30);
  EXPECT_EQ(limits(own).cores, 4);
}

TEST_F(GroupLimitsOfFiles, WhatIsNoNumberSetsNoLimit) {
  write("groups/memory.max", "99999999999999999999999");
  write("groups/cpu.max", "");
  for (const char* own : {"", "0", "0:", "0::/", "0::/nothing/there"}) {
    EXPECT_EQ(limits(own).memory, kAnyMemory) << own;
    EXPECT_EQ(limits(own).cores, kAnyCores) << own;
  }
  EXPECT_EQ(group_limits(temporary_.path / "none", temporary_.path / "none").memory, kAnyMemory);
}

TEST(GroupLimits, HoldForTheMachine) {
  EXPECT_LE(machine_memory(), group_limits().memory);
  EXPECT_LE(machine_cores(), group_limits().cores);
}

}  // namespace
}  // namespace tread
