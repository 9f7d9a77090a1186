#pragma once
// Tables, figures and files of `tread multibody`.

#include <optional>
#include <string>
#include <vector>

#include "drivers/report/provenance.hpp"
#include "drivers/studies/multibody/response_map.hpp"

namespace tread {

/// Everything that a call computed.
struct MultibodyOutcome {
  MultibodyModel model;
  MultibodyResult result;
  std::optional<double> filter_gain;       ///< gain with --filter [-]
  std::optional<Calibration> calibration;  ///< calibration with --calibrate
  std::optional<ResponseMap> map;          ///< map with --map
  std::vector<MapDot> dots;
  double seconds = 0;
};

/// The passage in a few rows.
Table multibody_table(const MultibodyOutcome& outcome);

/// Warnings of the passage and the map.
std::vector<std::string> warnings_of(const MultibodyOutcome& outcome);

/// The fit in a few rows.
Table calibration_table(const Calibration& calibration, const MultibodyModel& model);

std::string multibody_json(const MultibodyOutcome& outcome);

/// CSV files with a unit in every column's head.
std::string passage_csv(const MultibodyModel& model, const MultibodyResult& result);
std::string calibration_csv(const Calibration& calibration);
std::string map_csv(const ResponseMap& map);

/// `scene`: name of the scene's file.
Report multibody_report(const MultibodyOutcome& outcome, const std::string& scene,
                        const Provenance& provenance);

}  // namespace tread
