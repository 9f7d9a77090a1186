#pragma once
// Progress lines on stderr.

#include <chrono>
#include <string>

namespace tread {

class Progress {
 public:
  explicit Progress(bool quiet);

  /// Whole line at once.
  void say(const std::string& text) const;

  /// True when `interval` [s] of wall clock has passed since it was last true.
  bool due(double interval);
  double seconds() const;  ///< since construction

 private:
  bool quiet_;
  bool terminal_;
  std::chrono::steady_clock::time_point start_;
  double last_ = -1e9;
};

/// "52 min", "3.2 s", "1.4 h".
std::string duration_text(double seconds);

}  // namespace tread
