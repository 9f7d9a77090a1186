#pragma once
// One value of a scene with its source.

#include <string>

namespace tread {

/// One value of a scene.
struct Entry {
  std::string path;         ///< "rail.length"
  std::string value;        ///< in SI, "15.2"
  std::string unit;         ///< "m"; empty for texts and pure numbers
  std::string source;       ///< "scenes/x.toml:12", "--set", "highspeed-slab-2014: Table 1", or "default"
  std::string description;  ///< what the key means
  std::string shown;        ///< the value for readers, in the unit of documentation: "15.2 m", "205.9 GPa"
};

}  // namespace tread
