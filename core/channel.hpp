#pragma once
// A column of the histories.

#include <string>

namespace tread {

struct Channel {
  std::string name;         ///< snake_case, unique
  std::string unit;         ///< SI unit, "-" without one
  std::string description;  ///< one line for the reader of run.h5
};

}  // namespace tread
