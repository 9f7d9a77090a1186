#pragma once
// Values from the literature that the report of a run shows beside its own: files share/references/*.toml,
// one for each scene of the library.

#include <array>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "core/scene.hpp"

namespace tread {

/// A value that the literature states.
struct Reference {
  std::string label, unit;
  double value = 0;    ///< in `unit`
  std::string result;  ///< path of the run's value in summary.json, "vertical_force_N.max"
  double scale = 1;    ///< from there to `unit`
  std::string over;    ///< path of a value that it is divided by; empty: none
  std::map<std::string, std::array<double, 2>> ranges;                 ///< bounds of other results, by path
  enum class After { start, ramp, corrugation } after = After::start;  ///< from where the run's value counts
  std::string remark;   ///< with {contact_mm} and {quality} of the run
  bool theory = false;  ///< stands beside theory
  std::string level;    ///< text of a line in the figure of the creepage; empty: none
};

struct References {
  std::string title;   ///< of the table
  std::string column;  ///< of its values
  std::vector<Reference> rows;
};

/// The file's references whose scenes hold for `scene`. Throws InputError where the file does not read.
References read_references(const std::filesystem::path& path, const Scene& scene);

}  // namespace tread
