#pragma once
// Limits that the kernel's control groups set for this process: those of containers and of batch systems.

#include <cstdint>
#include <filesystem>
#include <limits>

namespace tread {

struct GroupLimits {
  std::int64_t memory = std::numeric_limits<std::int64_t>::max();  ///< [B]
  int cores = std::numeric_limits<int>::max();  ///< whole cores that take the allowed processor time
};

/// The least limits of this process's groups and of those that hold them. What is not there sets no limit.
/// `own`: file that names the groups; `groups`: their folder.
GroupLimits group_limits(const std::filesystem::path& own = "/proc/self/cgroup",
                         const std::filesystem::path& groups = "/sys/fs/cgroup");

}  // namespace tread
