#include "drivers/bench/hardware_counters.hpp"

#include <fmt/core.h>
#include <linux/perf_event.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace tread {

namespace {

constexpr std::array<std::uint64_t, 3> kEvents = {PERF_COUNT_HW_CPU_CYCLES, PERF_COUNT_HW_INSTRUCTIONS,
                                                  PERF_COUNT_HW_CACHE_MISSES};

int open_counter(std::uint64_t event) {
  perf_event_attr attributes{};
  attributes.size = sizeof attributes;
  attributes.type = PERF_TYPE_HARDWARE;
  attributes.config = event;
  attributes.inherit = 1;
  attributes.exclude_kernel = 1;
  attributes.exclude_hv = 1;
  return static_cast<int>(::syscall(SYS_perf_event_open, &attributes, 0, -1, -1, 0));
}

std::int64_t value_of(int file) {
  std::int64_t value = 0;
  return ::read(file, &value, sizeof value) == sizeof value ? value : 0;
}

}  // namespace

HardwareCounters::HardwareCounters() {
  for (std::size_t i = 0; i < kEvents.size() && available(); ++i) {
    files_[i] = open_counter(kEvents[i]);
    if (files_[i] < 0) reason_ = fmt::format("perf_event_open: {}", std::strerror(errno));
  }
}

HardwareCounters::~HardwareCounters() {
  for (const int file : files_)
    if (file >= 0) ::close(file);
}

CounterValues HardwareCounters::read() const {
  return {value_of(files_[0]), value_of(files_[1]), value_of(files_[2])};
}

[[gnu::noinline]] std::int64_t tread_counted_call(const HardwareCounters& counters,
                                                  const std::function<void()>& call) {
  const std::int64_t before = counters.read().instructions;
  call();
  return counters.read().instructions - before;
}

}  // namespace tread
