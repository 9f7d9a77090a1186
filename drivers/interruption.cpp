#include "drivers/interruption.hpp"

#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstring>

#include "core/error.hpp"

namespace tread {

namespace {

// What a signal handler may touch.
static_assert(std::atomic<int>::is_always_lock_free && std::atomic<bool>::is_always_lock_free &&
              std::atomic<const char*>::is_always_lock_free);
std::atomic<bool> g_deferred = false;
std::atomic<int> g_stop = 0;  ///< the signal that asked
std::atomic<bool> g_checkpoint = false;
constexpr std::size_t kLongest = 1000;
char g_early[kLongest + 1];
char g_late[kLongest + 1];

void set_sentence(char* place, const std::string& text) {
  std::strncpy(place, (text + "\n").c_str(), kLongest);
}

extern "C" void on_signal(int signal) {
  const int error = errno;
  if (signal == SIGUSR1) {
    g_checkpoint = true;
  } else if (!g_deferred || g_stop.exchange(signal) != 0) {
    const char* sentence = g_deferred ? g_late : g_early;
    [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, sentence, std::strlen(sentence));
    ::_exit(static_cast<int>(ExitCode::resumable));
  }
  errno = error;
}

}  // namespace

Interruption::Interruption(const std::string& early, const std::string& late) {
  set_sentence(g_early, early);
  set_sentence(g_late, late);
  g_deferred = false;
  g_stop = 0;
  g_checkpoint = false;
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGUSR1, SIGPIPE, SIGXFSZ}) {
    struct sigaction action {};
    action.sa_handler = signal == SIGPIPE || signal == SIGXFSZ ? SIG_IGN : on_signal;
    action.sa_flags = SA_RESTART;
    sigemptyset(&action.sa_mask);
    struct sigaction before {};
    ::sigaction(signal, nullptr, &before);
    // Who starts a run with nohup means it.
    if (signal == SIGHUP && before.sa_handler == SIG_IGN) continue;
    ::sigaction(signal, &action, nullptr);
    before_.emplace_back(signal, before);
  }
}

Interruption::~Interruption() {
  for (const auto& [signal, action] : before_) ::sigaction(signal, &action, nullptr);
}

void Interruption::defer() {
  g_deferred = true;
}

const char* Interruption::stop_wanted() {
  switch (g_stop) {
    case 0:
      return nullptr;
    case SIGINT:
      return "SIGINT";
    case SIGTERM:
      return "SIGTERM";
    default:
      return "SIGHUP";
  }
}

bool Interruption::take_checkpoint_wanted() {
  return g_checkpoint && g_checkpoint.exchange(false);
}

}  // namespace tread
