#pragma once
// Thousands of passages: the response over speed and wavelength.

#include <string>
#include <vector>

#include "drivers/studies/multibody/calibration.hpp"
#include "drivers/studies/multibody/multibody_run.hpp"

namespace tread {

/// Evenly spaced values.
struct MapAxis {
  std::string unit;            ///< unit as the user writes it, such as "km/h"
  std::vector<double> values;  ///< values, ascending, SI
};

struct MapAxes {
  MapAxis speed;       ///< [m/s]
  MapAxis wavelength;  ///< [m]
};

/// Reads axes such as "speed=100:500:10km/h" and "wavelength=40:150:2mm", in any order: first, last and step
/// with a common unit. Throws InputError that says what is wrong.
MapAxes parse_map_axes(const std::vector<std::string>& texts);

/// F_N over the evaluated stretch, over the static load.
struct MapPoint {
  double max = 0, min = 0;     ///< largest and smallest F_N [-]
  double loss_of_contact = 0;  ///< share of the stretch without contact [-]
};

struct ResponseMap {
  MapAxes axes;
  std::vector<MapPoint> points;       ///< points speed by speed, wavelengths running fastest
  double dt_first = 0, dt_last = 0;   ///< steps at the lowest and the highest speed [s]
  std::vector<std::string> warnings;  ///< sentences on cells beyond the model's range

  const MapPoint& at(std::size_t speed, std::size_t wavelength) const {
    return points[speed * axes.wavelength.values.size() + wavelength];
  }
};

/// Throws InputError unless the corrugation is a sine that holds a whole wave of each length.
void require_whole_waves(const MultibodyModel& model, const MapAxes& axes);

/// All passages with the model's depth of corrugation, start and fastenings. The part before the corrugation
/// is rolled once per speed. `filtered`: each wavelength is as deep as the contact filter leaves it. Throws
/// as require_whole_waves().
ResponseMap response_map(const MultibodyModel& model, const MapAxes& axes, const MultibodyStep& step,
                         bool filtered);

/// A transient run on the map.
struct MapDot {
  std::string label;        ///< name of its directory
  double speed = 0;         ///< speed on the evaluated stretch [m/s]
  double wavelength = 0;    ///< [m]
  double max = 0, min = 0;  ///< F_N over the run's static load [-]
  std::string remark;       ///< differences of its scene from the map's
};

/// Dot of a run. Throws InputError if the run has no sine or has not reached it, and as require_same_files()
/// and require_samples().
MapDot map_dot(const MultibodyModel& model, const TransientRun& run);

}  // namespace tread
