#pragma once
// Progress lines on stderr.

#include <chrono>
#include <string>

namespace tread {

class Progress {
 public:
  explicit Progress(bool quiet);

  /// Writes the whole line at once.
  void say(const std::string& text) const;
  /// The same for a warning, which `quiet` does not hide.
  void warn(const std::string& text) const;

  /// Returns true if `interval` [s] of wall clock has passed since it last did.
  bool due(double interval);
  double seconds() const;  ///< time since construction [s]

 private:
  bool quiet_;
  bool terminal_;
  std::chrono::steady_clock::time_point start_;
  double last_ = -1e9;
};

/// Duration for reading: "52 min", "3.2 s", "1.4 h".
std::string duration_text(double seconds);

}  // namespace tread
