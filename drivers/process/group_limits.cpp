#include "drivers/process/group_limits.hpp"

#include <algorithm>
#include <fstream>
#include <string>

namespace tread {

namespace {

namespace fs = std::filesystem;

/// Time of processors in each period [us]; 0: no limit.
struct ProcessorTime {
  std::int64_t quota = 0;
  std::int64_t period = 0;
};

/// Reads numbers; leaves those that the file lacks. It may hold words, "max".
template <class... Number>
void read_numbers(const fs::path& path, Number&... numbers) {
  std::ifstream file(path);
  const auto read = [&](std::int64_t& number) {
    std::int64_t value = 0;
    if (file >> value) number = value;
  };
  (read(numbers), ...);
}

/// Those of one group; files of version 2 of control groups, then of version 1.
void add_limits(const fs::path& group, GroupLimits& limits) {
  for (const char* name : {"memory.max", "memory.limit_in_bytes"}) {
    std::int64_t bytes = 0;
    read_numbers(group / name, bytes);
    if (bytes > 0) limits.memory = std::min(limits.memory, bytes);
  }
  ProcessorTime time;
  read_numbers(group / "cpu.max", time.quota, time.period);
  read_numbers(group / "cpu.cfs_quota_us", time.quota);
  read_numbers(group / "cpu.cfs_period_us", time.period);
  if (time.quota <= 0 || time.period <= 0) return;
  const std::int64_t cores = (time.quota - 1) / time.period + 1;
  limits.cores = static_cast<int>(std::min<std::int64_t>(limits.cores, cores));
}

}  // namespace

/// Lines "number:controllers:/group/within it": version 1 has a folder for each list of controllers,
/// version 2 no list. In a container the folders may begin at its own group, whatever the line says.
GroupLimits group_limits(const fs::path& own, const fs::path& groups) {
  GroupLimits limits;
  std::ifstream file(own);
  for (std::string line; std::getline(file, line);) {
    const std::size_t first = line.find(':');
    const std::size_t second = first == std::string::npos ? first : line.find(':', first + 1);
    if (second == std::string::npos) continue;
    fs::path group = groups / line.substr(first + 1, second - first - 1);
    add_limits(group, limits);
    for (const fs::path& part : fs::path(line.substr(second + 1)).relative_path())
      add_limits(group /= part, limits);
  }
  return limits;
}

}  // namespace tread
