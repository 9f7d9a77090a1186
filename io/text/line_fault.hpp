#pragma once
// A fault of a file that a user wrote.

#include <string>

namespace tread {

/// A line of a file that cannot be read.
struct LineFault {
  int line = 0;  ///< from 1; 0: the file as a whole
  std::string message;
};

}  // namespace tread
