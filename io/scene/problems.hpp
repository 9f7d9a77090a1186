#pragma once
// Problems in the user's files, collected so that one pass reports everything.

#include <string>
#include <vector>

#include "core/error.hpp"

namespace tread {

struct Problem {
  std::string file;  ///< file name, or "--set"
  int line = 0;      ///< from 1; 0: the file as a whole
  int column = 0;    ///< from 1; 0: the whole line
  std::string key;   ///< path of the key, "rail.length"; empty where no key is concerned
  std::string message;
};

/// "scenes/x.toml:12:3: rail.lenght: unknown key (did you mean rail.length?)"
std::string describe(const Problem& problem);

/// An InputError that lists every problem; `problems` holds them one by one for machine-readable output.
struct ProblemsError : InputError {
  explicit ProblemsError(std::vector<Problem> list);
  std::vector<Problem> problems;
};

}  // namespace tread
