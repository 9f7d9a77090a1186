#pragma once
// The passages that the paper simulates, and those of them that have been run.

#include <string>
#include <vector>

#include "drivers/studies/study/finished_run.hpp"
#include "io/scene/study_reader.hpp"

namespace tread {

/// Quantities that the paper's figures vary; everything else is Table 1. Units as the paper states them.
struct Passage {
  double speed = 300;     ///< speed [km/h]
  double mu = 0.3;        ///< traction coefficient; negative brakes
  double wavelength = 0;  ///< wavelength L [mm]; 0: smooth rail
  double depth = 0;       ///< depth d_m [mm]
  double ramp = 5;        ///< ramp time T1 [ms]

  bool operator==(const Passage&) const = default;
};

Passage smooth_rail(double speed = 300, double mu = 0.3);
/// Passage over a corrugation; the default is corrugation D.
Passage corrugated(double wavelength = 80, double depth = 0.14);

/// Name of its folder: "80mm,0.14mm,300km_h,mu=0.3".
std::string name_of(const Passage& passage);

/// The passage as a point of a study: far enough to pass the corrugation, or the solution zone.
StudyPoint study_point(const Passage& passage);

/// Scene with which all passages begin.
std::string paper_scene();

/// Runs by passage.
class PassageRuns {
 public:
  void add(const Passage& passage, FinishedRun run) { runs_.emplace_back(passage, std::move(run)); }
  /// Run of a passage; nullptr if it has not been run.
  const FinishedRun* find(const Passage& passage) const;
  bool empty() const { return runs_.empty(); }

 private:
  std::vector<std::pair<Passage, FinishedRun>> runs_;
};

}  // namespace tread
