#pragma once
// Errors that reach the user: each names the place, the value, the reason and the way out.

#include <stdexcept>
#include <string>

namespace tread {

/// Exit code of the process for an error that nothing handles. [docs/architecture.md, Exit codes]
enum class ExitCode { done = 0, input = 2, numerical = 3, resources = 4, resumable = 75 };

class Error : public std::runtime_error {
 public:
  Error(ExitCode code, const std::string& message) : std::runtime_error(message), code_(code) {}
  ExitCode code() const { return code_; }

 private:
  ExitCode code_;
};

/// A wrong scene or a wrong file that the scene names. The message says what to change.
struct InputError : Error {
  explicit InputError(const std::string& message) : Error(ExitCode::input, message) {}
};

/// A computation that cannot go on (divergence, lost contact of a preload, ...).
struct NumericalError : Error {
  explicit NumericalError(const std::string& message) : Error(ExitCode::numerical, message) {}
};

/// A run that was told to stop and can go on later.
struct Interrupted : Error {
  explicit Interrupted(const std::string& message) : Error(ExitCode::resumable, message) {}
};

/// A resource that the machine refuses (disk full, no permission, no memory).
struct ResourceError : Error {
  explicit ResourceError(const std::string& message) : Error(ExitCode::resources, message) {}
};

}  // namespace tread
