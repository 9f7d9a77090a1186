#include "drivers/process/interruption.hpp"

#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <ctime>

#include "core/error.hpp"

namespace tread {

namespace {

// A signal handler may touch only lock-free objects.
static_assert(std::atomic<int>::is_always_lock_free && std::atomic<bool>::is_always_lock_free &&
              std::atomic<std::int64_t>::is_always_lock_free);
std::atomic<bool> g_deferred = false;
std::atomic<int> g_stop = 0;             ///< signal that asked to stop
std::atomic<std::int64_t> g_asked_at{};  ///< time of the request on the steady clock; 0: never [ns]
std::atomic<bool> g_checkpoint = false;

constexpr std::size_t kLongest = 1000;
char g_early[2][kLongest + 1];  ///< while a signal may write one, the other can be replaced
std::atomic<int> g_which_early = 0;
char g_late[kLongest + 1];
char g_asked[kLongest + 1];

void set_sentence(char* place, const std::string& text) {
  std::strncpy(place, text.empty() ? "" : (text + "\n").c_str(), kLongest);
}

/// `timeout`, batch systems and shells signal a process and then its group: signals within this time are one
/// request.
constexpr std::int64_t kSameRequest = 500'000'000;  // [ns]

std::int64_t steady_now() {
  timespec now{};
  ::clock_gettime(CLOCK_MONOTONIC, &now);
  return now.tv_sec * std::int64_t{1'000'000'000} + now.tv_nsec;
}

void write_sentence(const char* sentence) {
  [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, sentence, std::strlen(sentence));
}

/// Notes the first request to stop. Returns true if this is a second one. The system repeats SIGXCPU every
/// second beyond a limit of processor time.
bool asks_again(int signal) {
  const std::int64_t now = steady_now();
  std::int64_t asked_at = 0;
  if (!g_asked_at.compare_exchange_strong(asked_at, now))
    return signal != SIGXCPU && now - asked_at >= kSameRequest;
  g_stop = signal;
  write_sentence(g_asked);
  return false;
}

extern "C" void on_signal(int signal) {
  const int error = errno;
  if (signal == SIGUSR1) {
    g_checkpoint = true;
  } else if (!g_deferred || asks_again(signal)) {
    write_sentence(g_deferred ? g_late : g_early[g_which_early]);
    ::_exit(static_cast<int>(ExitCode::resumable));
  }
  errno = error;
}

}  // namespace

Interruption::Interruption(const std::string& early, const std::string& late, const std::string& asked) {
  set_early(early);
  set_sentence(g_late, late);
  set_sentence(g_asked, asked);
  g_deferred = false;
  g_stop = 0;
  g_asked_at = 0;
  g_checkpoint = false;
  for (const StopSignal& signal : kStopSignals) handle(signal.number, on_signal);
  handle(SIGUSR1, on_signal);
  handle(SIGPIPE, SIG_IGN);
  handle(SIGXFSZ, SIG_IGN);
}

void Interruption::handle(int signal, void (*handler)(int)) {
  struct sigaction action {};
  action.sa_handler = handler;
  action.sa_flags = SA_RESTART;
  sigemptyset(&action.sa_mask);
  struct sigaction before {};
  ::sigaction(signal, nullptr, &before);
  // A user who starts a run with nohup wants SIGHUP ignored.
  if (signal == SIGHUP && before.sa_handler == SIG_IGN) return;
  ::sigaction(signal, &action, nullptr);
  before_.emplace_back(signal, before);
}

Interruption::~Interruption() {
  for (const auto& [signal, action] : before_) ::sigaction(signal, &action, nullptr);
}

void Interruption::set_early(const std::string& sentence) {
  const int other = 1 - g_which_early;
  set_sentence(g_early[other], sentence);
  g_which_early = other;
}

void Interruption::defer() {
  g_deferred = true;
}

const char* Interruption::stop_wanted() {
  const int stop = g_stop;
  if (stop == 0) return nullptr;
  return std::ranges::find(kStopSignals, stop, &StopSignal::number)->name;
}

bool Interruption::take_checkpoint_wanted() {
  return g_checkpoint && g_checkpoint.exchange(false);
}

}  // namespace tread
