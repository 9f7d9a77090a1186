#pragma once
// Roughness levels of rails beside the limit of ISO 3095. [paper, Fig. 14]

#include <string>
#include <vector>

#include "drivers/studies/roughness/roughness_levels.hpp"
#include "io/report/report.hpp"

namespace tread {

struct NamedLevels {
  std::string label;  ///< name of the rail
  RoughnessLevels levels;
};

/// Levels over the bands from short to long.
Figure level_figure(const std::vector<NamedLevels>& rails);

}  // namespace tread
