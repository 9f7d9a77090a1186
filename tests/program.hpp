#pragma once
// The program as a user starts it.

#include <fmt/core.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>
#include <string>
#include <thread>

#include "io/text/text.hpp"
#include "tests/temporary_folder.hpp"

namespace tread::samples {

inline std::string content_of(const std::filesystem::path& path) {
  std::stringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

inline bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// Tests the condition again and again for at most a minute.
inline bool wait_until(const std::function<bool()>& condition) {
  for (int i = 0; i < 6000; ++i) {
    if (condition()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return false;
}

/// Exit status of the process; after a signal 1000 + its number.
inline int wait_for(pid_t process) {
  int status = 0;
  ::waitpid(process, &status, 0);
  return WIFSIGNALED(status) ? 1000 + WTERMSIG(status) : WEXITSTATUS(status);
}

/// Starts a child process that calls `action`.
inline pid_t child(const std::function<void()>& action) {
  const pid_t process = ::fork();
  if (process != 0) return process;
  try {  // else it would go on with the tests of its parent
    action();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    ::_exit(99);
  }
  ::_exit(0);
}

/// A shipped scene as a word of a shell: the path of the sources may have blanks.
inline std::string scene_word(const std::string& name) {
  return shell_word(std::filesystem::path(TREAD_SOURCE_DIR) / "scenes" / name);
}

/// Starts the program in a shell, with its output in `folder`/out and `folder`/errors. `before`: commands
/// that the shell runs first. `launcher`: words before the program.
inline pid_t start_program(const std::string& arguments, const std::filesystem::path& folder,
                           const std::string& before = "", const std::string& launcher = "") {
  for (const char* name : {"out", "errors"}) std::ofstream(folder / name);  // nothing of a call before
  const std::string command =
      fmt::format("{} exec {} {} {} >{} 2>{}", before, launcher, shell_word(TREAD_EXECUTABLE), arguments,
                  shell_word(folder / "out"), shell_word(folder / "errors"));
  return child([&] {
    ::execl("/bin/sh", "sh", "-c", command.c_str(), nullptr);
    ::_exit(127);
  });
}

/// A folder that lives as long as the test and receives the program's output.
class Program {
 public:
  pid_t start(const std::string& arguments) const { return start_program(arguments, folder); }
  int call(const std::string& arguments) const { return wait_for(start(arguments)); }

  std::string out() const { return content_of(folder / "out"); }
  std::string errors() const { return content_of(folder / "errors"); }
  std::filesystem::path write(const std::string& name, const std::string& text) const {
    std::ofstream(folder / name) << text;
    return folder / name;
  }

 private:
  TemporaryFolder temporary_;

 public:
  const std::filesystem::path& folder = temporary_.path;
};

}  // namespace tread::samples
