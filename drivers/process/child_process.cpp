#include "drivers/process/child_process.hpp"

#include <fcntl.h>
#include <fmt/core.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <initializer_list>
#include <string_view>

#include "core/error.hpp"
#include "drivers/process/interruption.hpp"

namespace tread {

namespace {

constexpr int kNotStarted = 127;

/// This process's environment; `unbound`: with all cores for every thread of OpenMP.
std::vector<std::string> child_environment(bool unbound) {
  constexpr std::array<std::string_view, 4> kPlaces = {"OMP_PROC_BIND", "OMP_PLACES", "GOMP_CPU_AFFINITY",
                                                       "KMP_AFFINITY"};
  std::vector<std::string> texts;
  for (char** entry = ::environ; *entry; ++entry) {
    const std::string_view text = *entry;
    const std::string_view name = text.substr(0, text.find('='));
    if (!unbound || std::find(kPlaces.begin(), kPlaces.end(), name) == kPlaces.end())
      texts.emplace_back(text);
  }
  if (unbound) texts.emplace_back("OMP_PROC_BIND=false");
  return texts;
}

/// The texts as exec takes them, while they live.
std::vector<char*> pointers_to(std::vector<std::string>& texts) {
  std::vector<char*> pointers;
  pointers.reserve(texts.size() + 1);
  for (std::string& text : texts) pointers.push_back(text.data());
  pointers.push_back(nullptr);
  return pointers;
}

/// Replaces the child by the program. Only calls that are safe between fork and exec are used. Signals are
/// blocked.
[[noreturn]] void become(char* const* arguments, bool launched, const char* log, pid_t parent,
                         const sigset_t& mask) {
  for (const StopSignal& signal : kStopSignals) ::signal(signal.number, SIG_DFL);
  // A checkpoint asked for before the program has its handler must not end it; a launcher may have its own
  // use.
  ::signal(SIGUSR1, launched ? SIG_DFL : SIG_IGN);
  ::setpgid(0, 0);
  ::prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (::getppid() != parent) ::_exit(kNotStarted);
  const int in = ::open("/dev/null", O_RDONLY | O_CLOEXEC);
  const int out = ::open(log, O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
  if (in < 0 || out < 0) ::_exit(kNotStarted);
  ::dup2(in, STDIN_FILENO);
  ::dup2(out, STDOUT_FILENO);
  ::dup2(out, STDERR_FILENO);
  ::sigprocmask(SIG_SETMASK, &mask, nullptr);
  if (launched)
    ::execvp(arguments[0], arguments);
  else
    ::execv("/proc/self/exe", arguments);
  ::_exit(kNotStarted);
}

}  // namespace

std::filesystem::path own_program() {
  return std::filesystem::read_symlink("/proc/self/exe");
}

ChildProcess::ChildProcess(const std::vector<std::string>& arguments, const std::filesystem::path& log,
                           const std::vector<std::string>& launcher, bool beside) {
  std::vector<std::string> texts = launcher;
  texts.push_back(launcher.empty() ? "tread" : own_program().string());
  texts.insert(texts.end(), arguments.begin(), arguments.end());
  std::vector<std::string> settings = child_environment(beside && launcher.empty());
  const std::vector<char*> words = pointers_to(texts);
  std::vector<char*> environment = pointers_to(settings);
  const std::string log_name = log.string();
  const pid_t parent = ::getpid();
  // The parent's handlers must not take a signal for the child that comes before exec.
  sigset_t all;
  sigset_t before;
  ::sigfillset(&all);
  ::pthread_sigmask(SIG_SETMASK, &all, &before);
  process_ = ::fork();
  if (process_ == 0) {
    ::environ = environment.data();
    become(words.data(), !launcher.empty(), log_name.c_str(), parent, before);
  }
  const int error = errno;
  ::pthread_sigmask(SIG_SETMASK, &before, nullptr);
  if (process_ < 0)
    throw ResourceError(
        fmt::format("cannot start another process: {}; fewer --jobs need fewer", std::strerror(error)));
}

bool ChildProcess::ended(ProcessEnd& end) const {
  int status = 0;
  if (::waitpid(process_, &status, WNOHANG) != process_) return false;
  end = WIFSIGNALED(status) ? ProcessEnd{0, WTERMSIG(status)} : ProcessEnd{WEXITSTATUS(status), 0};
  return true;
}

void ChildProcess::send(int signal) const {
  ::kill(process_, signal);
}

void ChildProcess::send_to_group(int signal) const {
  // The child may not have made its group yet.
  if (::kill(-process_, signal) != 0) send(signal);
}

}  // namespace tread
